// Which settings has the view, and which filters have the contacts?

import { button, h } from './dom';
import { SIDES } from '../data/report';
import { newFilter, type Display, type Filter, type Viewer } from '../viewer';

type Flag = { [K in keyof Display]: Display[K] extends boolean ? K : never }[keyof Display];
type Range = 'distanceFrom' | 'distanceTo' | 'ageFrom' | 'ageTo';

export class ShowPanel {
  readonly element = h('div', { id: 'show', 'data-testid': 'show' });

  constructor(private readonly viewer: Viewer) {
    viewer.on(['page', 'display'], () => this.show());
  }

  show(): void {
    // A field in which somebody types is not made anew under the hands.
    if (this.element.contains(document.activeElement) && document.activeElement instanceof HTMLInputElement &&
        document.activeElement.type !== 'checkbox') return;
    const focused = document.activeElement?.getAttribute('data-testid');
    this.element.replaceChildren(this.surfaces(), this.clip(), this.lines(), this.bounds(), this.contacts(), this.filter());
    if (focused) this.element.querySelector<HTMLElement>(`[data-testid="${focused}"]`)?.focus();
  }

  private group(title: string, ...children: (HTMLElement | null)[]): HTMLElement {
    return h('section', {}, h('h2', {}, title), ...children);
  }

  private flag(name: Flag, text: string, key = ''): HTMLElement {
    const { display } = this.viewer;
    const input = h('input', {
      type: 'checkbox', checked: display[name], 'data-testid': `set-${name}`,
      change: () => {
        display[name] = !display[name];
        this.viewer.changed();
      } });
    return h('label', { class: 'flag' }, input, h('span', {}, text), key && h('kbd', {}, key));
  }

  private slider(name: 'opacity' | 'clipAt' | 'pointSize' | 'arrowLength', text: string, from: number, to: number): HTMLElement {
    const { display } = this.viewer;
    return h('label', { class: 'slider' }, h('span', {}, text), h('input', {
      type: 'range', min: from, max: to, step: 'any', value: display[name], 'data-testid': `set-${name}`,
      input: (event) => {
        display[name] = Number((event.target as HTMLInputElement).value);
        this.viewer.changed();
      } }));
  }

  private choice<K extends 'clipAxis' | 'bounds' | 'up'>(name: K, choices: Display[K][], labels: string[] = choices): HTMLElement {
    const { display } = this.viewer;
    return h('span', { class: 'choice', role: 'group' }, ...choices.map((value, i) => h('button', {
      type: 'button', 'aria-pressed': String(display[name] === value), 'data-testid': `set-${name}-${value}`,
      click: () => {
        display[name] = value;
        this.viewer.changed();
      } }, labels[i]!)));
  }

  private surfaces(): HTMLElement {
    return this.group('Surfaces',
      this.flag('surfaces', 'Faces (off: wireframe)', 'W'), this.flag('edges', 'Edges', 'E'),
      this.slider('opacity', 'Opacity', 0.05, 1),
      this.flag('insides', 'Objects inside others show through'), this.flag('names', 'Names', 'N'),
      h('div', { class: 'line' }, h('span', {}, 'Up axis'), this.choice('up', ['z', 'y'])));
  }

  private clip(): HTMLElement {
    return this.group('Clip plane', this.flag('clip', 'Cut surfaces open', 'C'),
      h('div', { class: 'line' }, this.choice('clipAxis', ['x', 'y', 'z', 'view']), this.flag('clipFlipped', 'Flip', '')),
      this.slider('clipAt', 'Place', 0, 1));
  }

  private lines(): HTMLElement {
    return this.group('Lines', this.flag('lines', 'Between middle vertices', 'L'),
      this.flag('witnesses', 'Witnesses of pairs', 'D'));
  }

  private bounds(): HTMLElement {
    const { display, page } = this.viewer;
    const levels = Math.max(1, ...(page?.head.meshes.map((m) => m.levels) ?? []));
    return this.group('Bounds of regions',
      h('div', { class: 'line' }, this.choice('bounds', ['off', 'circles', 'spheres']), h('kbd', {}, 'B')),
      h('div', { class: 'line' }, h('span', {}, 'Level'), h('span', { class: 'choice', role: 'group' },
        ...Array.from({ length: levels }, (_, level) => h('button', {
          type: 'button', 'aria-pressed': String(display.boundsLevel === level), 'data-testid': `bounds-level-${level}`,
          click: () => {
            display.boundsLevel = level;
            this.viewer.changed();
          } }, String(level))))),
      this.flag('boundsOfAll', 'Of all objects, not only those selected'));
  }

  private contacts(): HTMLElement {
    return this.group('Contacts', this.flag('contacts', 'Points', 'K'), this.flag('pushes', 'Push directions', 'M'),
      this.flag('pierces', 'Also of edges that pierce', 'Shift+M'),
      this.flag('ways', 'Ways out of pairs', 'S'),
      this.flag('impacts', 'Impacts between steps', 'Q'),
      this.flag('diagnostics', 'Diagnostics'),
      this.slider('pointSize', 'Point size', 3, 20), this.slider('arrowLength', 'Arrow length', 0.1, 4));
  }

  private filter(): HTMLElement {
    const { filter } = this.viewer;
    return this.group('Filter of pairs and contacts',
      this.sides(),
      this.range('Distance', 'distanceFrom', 'distanceTo'), this.range('Age', 'ageFrom', 'ageTo'),
      h('label', { class: 'flag' }, h('input', {
        type: 'checkbox', checked: filter.onlySelected, 'data-testid': 'filter-selected',
        change: () => {
          filter.onlySelected = !filter.onlySelected;
          this.viewer.changed();
        } }), h('span', {}, 'Only of the selection'), h('kbd', {}, 'O')),
      button('Show all', 'filter-reset', 'Take all filters and the search away (X)', () => resetFilter(this.viewer)));
  }

  /** A table of side a by side b. A cell switches the contacts with these two sides. */
  private sides(): HTMLElement {
    const { filter } = this.viewer;
    const order = [1, 2, 0];
    const table = h('div', { class: 'sides' }, h('span', {}, 'a \\ b'), ...order.map((b) => h('span', {}, SIDES[b]!)));
    for (const a of order) {
      table.append(h('span', {}, SIDES[a]!));
      for (const b of order) {
        const i = 3 * a + b;
        table.append(h('button', {
          type: 'button', 'aria-pressed': String(filter.sides[i]), 'data-testid': `side-${SIDES[a]}-${SIDES[b]}`,
          title: `Contacts with b's point at the ${SIDES[a]} of a, and a's point at the ${SIDES[b]} of b`,
          click: () => {
            filter.sides[i] = !filter.sides[i];
            this.viewer.changed();
          } }, filter.sides[i] ? '✓' : '–'));
      }
    }
    return table;
  }

  private range(text: string, from: Range, to: Range): HTMLElement {
    const field = (name: Range, label: string) => h('input', {
      type: 'number', step: 'any', value: this.viewer.filter[name] ?? '', placeholder: label, 'aria-label': `${text} ${label}`,
      'data-testid': `filter-${name}`,
      input: (event) => {
        const { value } = event.target as HTMLInputElement;
        this.viewer.filter[name] = value === '' ? null : Number(value);
        this.viewer.changed();
      } });
    return h('div', { class: 'range' }, h('span', {}, text), field(from, 'from'), field(to, 'to'));
  }
}

export function resetFilter(viewer: Viewer): void {
  viewer.filter = newFilter() satisfies Filter;
  viewer.changed();
}
