// What do the colours and shapes over the surfaces mean, how many are there, and which are shown?

import { CLASS_NAMES, sideClass } from '../view3d/contacts3d';
import { count, h, swatch } from './dom';
import { KIND_COLOURS, levelColour, palette } from '../palette';
import { KINDS } from '../data/report';
import type { Viewer } from '../viewer';

const CLASS_STYLES = ['dot', 'disc', 'ring', 'diamond'];

/** So many lines in a frame hide the surfaces. */
const CROWD = 300;

export class Legend {
  private areLevelsChosen = false;

  constructor(private readonly viewer: Viewer, private readonly element: HTMLElement) {
    viewer.on(['page'], () => (this.areLevelsChosen = false));
    viewer.on(['frame'], () => this.calm());
    viewer.on(['frame', 'page', 'display', 'selection', 'theme'], () => this.show());
  }

  /** Where lines first become very many, only those of level 1 stay on. After that the reader decides. */
  private calm(): void {
    const { block, pairBegin, pairEnd } = this.viewer.report!;
    if (this.areLevelsChosen || pairEnd === pairBegin) return;
    if (block.regionEnd[pairEnd - 1]! - block.regionBegin[pairBegin]! <= CROWD) return;
    this.areLevelsChosen = true;
    for (let level = 2; level < 64; ++level) this.viewer.display.hiddenLevels.add(level);
    this.viewer.changed();
  }

  private show(): void {
    const { viewer } = this;
    const { report } = viewer;
    if (!report) return;
    const kinds = Array(6).fill(0) as number[];
    const shown = Array(6).fill(0) as number[];
    const classes = Array(4).fill(0) as number[];
    for (const [contact, pair] of report.contacts()) {
      const kind = report.block.kind[contact]!;
      ++kinds[kind]!;
      if (!viewer.passes(contact, pair)) continue;
      ++shown[kind]!;
      ++classes[sideClass(report.sideA(contact), report.sideB(contact))]!;
    }
    const ways = [...report.pairs()].filter((row) => viewer.showsPair(row) && report.block.wayOutOf(row)?.direction.some((x) => x !== 0)).length;
    const impacts = [...report.impacts()].filter(([, pair]) => viewer.showsPair(pair)).length;
    this.element.replaceChildren(
      this.group('Contacts', KINDS.map((_, kind) => this.kindItem(kind, shown[kind]!, kinds[kind]!))),
      this.group('Sides', classes.map((n, i) => h('span', { class: 'key', title: `Contacts shown whose side is: ${CLASS_NAMES[i]}` },
        swatch(palette().neutral, CLASS_STYLES[i]!), CLASS_NAMES[i]!, h('small', {}, count(n))))),
      ways + impacts > 0 ? this.group('Pairs', [
        ...(ways > 0 ? [this.flagItem('ways', 'way out', ways, palette().crossing,
          'Ways out of pairs whose surfaces pass through each other, as long as they are thick (S)')] : []),
        ...(impacts > 0 ? [this.flagItem('impacts', 'impact', impacts, palette().way,
          'What meets between the step before and this one, and the ways of its vertices (Q)')] : [])]) : '',
      // Only scenes that ask for region distances have any.
      report.block.regionLevels.length > 0 ? this.group('Lines', this.levelItems()) : '');
  }

  private group(title: string, items: HTMLElement[]): HTMLElement {
    return h('div', { class: 'group' }, h('b', {}, title), ...items);
  }

  private kindItem(kind: number, shown: number, all: number): HTMLElement {
    const { filter } = this.viewer;
    return h('button', {
      type: 'button', class: 'key', 'aria-pressed': String(filter.kinds[kind]), 'data-testid': `kind-${KINDS[kind]}`,
      title: `${KINDS[kind]}: ${shown} shown of ${all}. Click to switch; Alt-click for it alone`,
      click: (event) => {
        if ((event as MouseEvent).altKey) filter.kinds = filter.kinds.map((_, k) => k === kind);
        else filter.kinds[kind] = !filter.kinds[kind];
        this.viewer.changed();
      } }, swatch(KIND_COLOURS[kind]!, 'disc'), KINDS[kind]!, h('small', {}, shown === all ? count(all) : `${count(shown)}/${count(all)}`));
  }

  private flagItem(name: 'ways' | 'impacts', text: string, n: number, colour: string, title: string): HTMLElement {
    const { display } = this.viewer;
    return h('button', {
      type: 'button', class: 'key', 'aria-pressed': String(display[name]), 'data-testid': name, title,
      click: () => {
        display[name] = !display[name];
        this.viewer.changed();
      } }, swatch(colour, 'line'), text, h('small', {}, count(n)));
  }

  private levelItems(): HTMLElement[] {
    const { display, report } = this.viewer;
    const counts = new Map<number, number>();
    for (const row of report!.pairs()) {
      const shown = this.viewer.showsPair(row) ? 1 : 0;
      for (let r = report!.block.regionBegin[row]!; r < report!.block.regionEnd[row]!; ++r) {
        const level = report!.block.regionLevels[r]!;
        counts.set(level, (counts.get(level) ?? 0) + shown);
      }
    }
    for (const level of [1, 2, 3]) if (!counts.has(level)) counts.set(level, 0);
    return [...counts].sort((p, q) => p[0] - q[0]).map(([level, n]) => h('button', {
      type: 'button', class: 'key', 'aria-pressed': String(display.lines && !display.hiddenLevels.has(level)),
      'data-testid': `level-${level}`, title: `Distances of regions of level ${level}, between their middle vertices (Alt+${level})`,
      click: () => toggleLevel(this.viewer, level) }, swatch(levelColour(level), 'line'), `level ${level}`, h('small', {}, count(n))));
  }
}

export function toggleLevel(viewer: Viewer, level: number): void {
  const { display } = viewer;
  if (!display.lines) {
    display.lines = true;
    display.hiddenLevels.delete(level);
  } else if (!display.hiddenLevels.delete(level)) {
    display.hiddenLevels.add(level);
  }
  viewer.changed();
}
