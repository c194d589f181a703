// Which objects, pairs and contacts are there, and how does one find one of them?

import { count, h, short, swatch } from './dom';
import { groupOf, INSIDE_GROUPS, insideWords, SHORT_GROUPS } from '../data/inside';
import { pairNames, pairText, type PairNames } from '../data/pair_names';
import { KIND_COLOURS, palette, PHASE_COLOURS } from '../palette';
import { KINDS, PHASES } from '../data/report';
import type { Selection, Viewer } from '../viewer';
import { VirtualList } from './virtual_list';

type Tab = 'objects' | 'pairs' | 'contacts';
interface Row {
  key: string; selection: Selection; cells: (string | number)[]; colour: string; isFaint: boolean;
  names?: Names;
}
/** The names of a pair's objects, whether one is inside the other, and what stands before them. */
interface Names extends PairNames { lead?: string; inside: number }
interface ColumnHead { name: string; title: string; isNumber: boolean }

const COLUMNS: Record<Tab, ColumnHead[]> = {
  objects: [
    { name: 'object', title: 'Name', isNumber: false },
    { name: 'pairs', title: 'Pairs listed in this frame', isNumber: true },
    { name: 'contacts', title: 'Contacts in this frame', isNumber: true },
  ],
  pairs: [
    { name: 'pair', title: 'Names of a and b', isNumber: false },
    { name: 'separation', title: 'The smallest separation of its contacts; without contacts the lower bound of the distance', isNumber: true },
    { name: 'contacts', title: 'Contacts in this frame', isNumber: true },
  ],
  contacts: [
    { name: 'contact', title: 'Kind and objects', isNumber: false },
    { name: 'separation', title: 'Distance, negative where it lies behind a surface', isNumber: true },
    { name: 'age', title: 'Frames since it began', isNumber: true },
  ],
};

export function selectionKey(s: Selection): string {
  if (s.type === 'object') return `o${s.object}`;
  if (s.type === 'pair') return `p${s.a}-${s.b}`;
  if (s.type === 'contact') return `c${s.a}-${s.b}-${s.kind}-${s.features.join('-')}`;
  return `f${s.object}-${s.kind}-${s.index}`;
}

const joined = (names: Names): string => `${names.lead ? `${names.lead}  ` : ''}${pairText(names)}`;

function titleOf({ cells, names }: Row): string {
  return names?.inside ? `${cells[0]}\n${insideWords(names.a, names.b, names.inside)}` : String(cells[0]);
}

/** Each of two names gives way where both do not fit, so that the end of neither pushes the other out. */
function twoNames({ lead, a, sign, b, inside }: Names): HTMLElement {
  return h('span', { class: 'two' }, lead && h('i', {}, lead), h('span', {}, a), sign && h('i', { class: `mark in${inside}` }, sign), h('span', {}, b));
}

export class Lists {
  readonly element = h('div', { class: 'panel' });
  tab: Tab = 'pairs';
  rows: Row[] = [];
  private selectedAt = -1;
  private readonly search = h('input', {
    type: 'search', id: 'search', 'data-testid': 'search', placeholder: 'Search  ( / )', 'aria-label': 'Search lists and picture',
    title: 'Names of objects, else serials, motions or states such as crossing. Lists and the picture show only what is named',
    input: () => {
      this.viewer.filter.text = this.search.value;
      this.viewer.changed();
    } }) as HTMLInputElement;
  private readonly tabs = h('div', { class: 'tabs', role: 'tablist' });
  private readonly chips = h('div', { class: 'chips' });
  private readonly heads = h('div', { class: 'heads' });
  private readonly list = new VirtualList<Row>('list', (row, i) => this.rowElement(row, i));
  private readonly order: Record<Tab, { column: number; isDown: boolean } | null> = { objects: null, pairs: null, contacts: null };

  constructor(private readonly viewer: Viewer) {
    this.element.append(this.tabs, this.search, this.chips, this.heads, this.list.element);
    this.list.element.addEventListener('keydown', (event) => this.onKey(event));
    viewer.on(['frame', 'page', 'display', 'theme'], () => this.show());
    viewer.on(['selection'], () => {
      this.show();
      this.reveal();
    });
  }

  setTab(tab: Tab): void {
    this.tab = tab;
    this.show();
    this.reveal();
  }

  focusSearch(): void {
    this.search.focus();
    this.search.select();
  }

  /** Selects the row that is so many further down. */
  step(by: number): void {
    if (this.rows.length === 0) return;
    const now = this.selectedIndex();
    const next = now < 0 ? (by > 0 ? 0 : this.rows.length - 1) : Math.max(0, Math.min(this.rows.length - 1, now + by));
    this.viewer.select(this.rows[next]!.selection, true);
  }

  show(): void {
    if (!this.viewer.page || !this.viewer.report) return;
    if (this.search.value !== this.viewer.filter.text) this.search.value = this.viewer.filter.text;
    this.rows = this.tab === 'objects' ? this.objectRows() : this.tab === 'pairs' ? this.pairRows() : this.contactRows();
    this.sort();
    this.selectedAt = this.selectedIndex();
    this.showTabs();
    this.showChips();
    this.showHeads();
    this.list.show(this.rows);
  }

  private objectRows(): Row[] {
    const { head, objects } = this.viewer.page!;
    const report = this.viewer.report!;
    const { block } = report;
    const pairs = new Uint32Array(objects.length);
    const contacts = new Uint32Array(objects.length);
    for (const row of report.pairs())
      for (const object of new Set([block.pairA[row]!, block.pairB[row]!])) {
        ++pairs[object]!;
        contacts[object]! += block.contactEnd[row]! - block.contactBegin[row]!;
      }
    const colours = palette().objects;
    return head.objects.map((object, i) => ({
      key: `o${i}`, selection: { type: 'object', object: i }, colour: colours[i % colours.length]!,
      isFaint: !objects[i]!.isThere, cells: [object.name || `object ${object.serial}`, pairs[i]!, contacts[i]!],
    } satisfies Row)).filter((_, i) => this.viewer.search.hasObject(i));
  }

  private pairRows(): Row[] {
    const { head } = this.viewer.page!;
    const { block } = this.viewer.report!;
    const rows: Row[] = [];
    for (const row of this.viewer.report!.pairs()) {
      if (!this.viewer.showsPair(row)) continue;
      const phase = block.phase[row]!;
      const inside = block.insideOf(row);
      const [a, b] = [block.pairA[row]!, block.pairB[row]!];
      const names = { ...pairNames(head, a, b, inside), inside };
      rows.push({
        key: `p${a}-${b}`, selection: { type: 'pair', a, b }, colour: PHASE_COLOURS[phase]!, isFaint: phase === 3,
        names: { ...names, b: names.b + (block.flags[row] ? ' ⚠' : '') },
        cells: [joined(names), block.deepestOf(row) ?? block.lower[row]!, block.contactEnd[row]! - block.contactBegin[row]!],
      });
    }
    return rows;
  }

  private contactRows(): Row[] {
    const { viewer } = this;
    const { head } = viewer.page!;
    const report = viewer.report!;
    const { block } = report;
    const rows: Row[] = [];
    for (const [contact, pair] of report.contacts()) {
      if (!viewer.passes(contact, pair)) continue;
      const selection = viewer.contactSelection(contact, pair);
      const kind = block.kind[contact]!;
      const inside = block.insideOf(pair);
      const names = { lead: KINDS[kind] ?? '?', ...pairNames(head, block.pairA[pair]!, block.pairB[pair]!, inside), inside };
      rows.push({
        key: selectionKey(selection), selection, colour: KIND_COLOURS[kind] ?? '#999999', isFaint: false,
        names, cells: [joined(names), report.separation(contact), report.age(contact)],
      });
    }
    return rows;
  }

  private sort(): void {
    const order = this.order[this.tab];
    if (!order) return;
    const sign = order.isDown ? -1 : 1;
    this.rows.sort((p, q) => {
      const [x, y] = [p.cells[order.column]!, q.cells[order.column]!];
      return sign * (typeof x === 'number' ? x - (y as number) : String(x).localeCompare(String(y)));
    });
  }

  private showTabs(): void {
    const { head, objects } = this.viewer.page!;
    const report = this.viewer.report!;
    let contacts = 0;
    for (const row of report.pairs()) contacts += report.block.contactEnd[row]! - report.block.contactBegin[row]!;
    const there = objects.filter((o) => o.isThere).length;
    const counts: [Tab, number][] = [['objects', Math.min(there, head.objects.length)], ['pairs', report.pairEnd - report.pairBegin], ['contacts', contacts]];
    this.tabs.replaceChildren(...counts.map(([tab, n]) => h('button', {
      type: 'button', role: 'tab', 'aria-selected': String(tab === this.tab), 'data-testid': `tab-${tab}`,
      click: () => this.setTab(tab) }, tab[0]!.toUpperCase() + tab.slice(1), h('small', {}, count(n)))));
  }

  private showChips(): void {
    this.chips.hidden = this.tab !== 'pairs';
    if (this.chips.hidden) return;
    const { filter } = this.viewer;
    const report = this.viewer.report!;
    const phases = [0, 0, 0, 0];
    const insides = [0, 0, 0];
    for (const row of report.pairs()) {
      ++phases[report.block.phase[row]!]!;
      ++insides[groupOf(report.block.insideOf(row))]!;
    }
    const hasSolids = this.viewer.page!.head.objects.some((object) => object.solid);
    const marks = ['–', '⊂', '✕'];
    this.chips.replaceChildren(
      ...PHASES.map((name, i) => this.chip(filter.phases, i, `phase-${name}`, `Show pairs that are ${name}`,
        swatch(PHASE_COLOURS[i]!), name, phases[i]!)),
      ...(hasSolids ? INSIDE_GROUPS.map((name, i) => this.chip(filter.insides, i, `inside-${name}`,
        ['Show pairs of which neither is inside the other', 'Show pairs of which one is inside the other', 'Show pairs that cross'][i]!,
        h('i', { class: `mark in${[0, 1, 3][i]}` }, marks[i]!), SHORT_GROUPS[i]!, insides[i]!)) : []));
  }

  /** A button that shows or hides the pairs of one sort. */
  private chip(shown: boolean[], i: number, id: string, title: string, sign: HTMLElement, name: string, n: number): HTMLElement {
    return h('button', {
      type: 'button', class: 'chip', 'aria-pressed': String(shown[i]), 'data-testid': id, title,
      click: () => {
        shown[i] = !shown[i];
        this.viewer.changed();
      } }, sign, name, h('small', {}, count(n)));
  }

  private showHeads(): void {
    const order = this.order[this.tab];
    this.heads.className = `heads ${this.tab}`;
    this.heads.replaceChildren(...COLUMNS[this.tab].map((column, i) => h('button', {
      type: 'button', class: column.isNumber ? 'number' : '', title: `${column.title}. Click to sort`,
      'data-testid': `sort-${column.name}`, click: () => this.sortBy(i) },
      column.name + (order?.column === i ? (order.isDown ? '↓' : '↑') : ''))));
  }

  /** Up, then down, then the report's own order. */
  private sortBy(column: number): void {
    const order = this.order[this.tab];
    const isSame = order?.column === column;
    this.order[this.tab] = isSame && order.isDown ? null : { column, isDown: isSame };
    this.show();
  }

  private rowElement(row: Row, index: number): HTMLElement {
    const isSelected = index === this.selectedAt;
    const [name, ...numbers] = row.cells;
    const element = h('div', {
      class: `row${row.isFaint ? ' faint' : ''}`, role: 'option', 'aria-selected': String(isSelected), 'data-key': row.key,
      title: titleOf(row), click: () => this.viewer.select(row.selection, true) },
      swatch(row.colour, this.tab === 'objects' ? 'square' : ''), row.names ? twoNames(row.names) : h('span', {}, String(name)),
      ...numbers.map((x) => h('b', {}, typeof x === 'number' ? short(x) : x)));
    if (row.selection.type === 'object') element.append(this.eye(row.selection.object));
    return element;
  }

  private eye(object: number): HTMLElement {
    const { hiddenObjects } = this.viewer.display;
    const isHidden = hiddenObjects.has(object);
    return h('button', {
      type: 'button', class: 'eye', title: isHidden ? 'Show the object' : 'Hide the object', 'aria-pressed': String(!isHidden),
      'data-testid': `eye-${object}`,
      click: (event) => {
        event.stopPropagation();
        if (!hiddenObjects.delete(object)) hiddenObjects.add(object);
        this.viewer.changed();
      } }, isHidden ? '○' : '●');
  }

  private selectedIndex(): number {
    const { selection } = this.viewer;
    if (!selection) return -1;
    const keys = [selectionKey(selection)];
    if (selection.type === 'contact' && this.tab === 'pairs') keys.push(`p${selection.a}-${selection.b}`);
    if (selection.type === 'feature' && this.tab === 'objects') keys.push(`o${selection.object}`);
    return this.rows.findIndex((row) => keys.includes(row.key));
  }

  private reveal(): void {
    if (this.selectedAt >= 0) this.list.scrollTo(this.selectedAt);
  }

  private onKey(event: KeyboardEvent): void {
    const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: 12, PageUp: -12, Home: -1e9, End: 1e9 };
    const by = steps[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.step(by);
  }
}
