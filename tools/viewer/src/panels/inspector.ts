// How are the numbers of the selection and of the frame shown, ready to copy?

import { button, copy, h } from './dom';
import { frameFacts, numberText, selectionFacts, type Fact, type Facts } from './facts';
import { insideWords } from '../data/inside';
import { pairText } from '../data/pair_names';
import { KINDS } from '../data/report';
import type { Selection, Viewer } from '../viewer';

const LABELS: Record<string, string> = { type: '', a: 'a', b: 'b' };
/** These are in the heading already. */
const IN_HEADING = new Set(['type', 'kind', 'name', 'a', 'b', 'object', 'serial', 'serial_a', 'serial_b']);

const LONG_TEXT = 60;
/** Of more rows of one list the first are shown. A copy has all. */
const MOST_ROWS = 50;

export class Inspector {
  readonly element = h('div', { id: 'inspector', 'data-testid': 'inspector' });

  constructor(private readonly viewer: Viewer) {
    viewer.on(['frame', 'selection', 'page'], () => this.show());
  }

  show(): void {
    const { viewer } = this;
    if (!viewer.page || !viewer.report) return;
    const facts = selectionFacts(viewer);
    const { scrollTop } = this.element;
    this.element.replaceChildren(
      ...(facts ? [this.section(heading(facts), facts, this.links())] : [hint()]),
      this.section(`Frame ${viewer.report.info.frame}`, frameFacts(viewer), null, 'frame'));
    this.element.scrollTop = scrollTop;
  }

  private section(title: string, facts: Facts, links: HTMLElement | null, what = 'selection'): HTMLElement {
    const table = h('dl', { class: 'facts', 'data-testid': `${what}-facts` });
    if (facts.listed === false) table.append(h('p', { class: 'quiet' }, 'Not listed in this frame.'));
    for (const [key, fact] of Object.entries(facts)) addFact(table, key, fact, what === 'frame');
    return h('section', {},
      h('h2', {}, h('span', { title }, title), h('button', {
        type: 'button', class: 'small', title: 'Copy all as JSON', 'data-testid': `copy-${what}`,
        click: () => void copy(JSON.stringify(facts, null, 1)) }, 'Copy')),
      what === 'selection' ? this.insideLine() : null, links, table);
  }

  /** Whether one object of the selected pair is inside the other, in words, where one of them is a solid. */
  private insideLine(): HTMLElement | null {
    const pair = this.viewer.selectedPair();
    const row = pair ? this.viewer.report!.rowOf(pair.a, pair.b) : -1;
    const objects = pair ? [this.viewer.page!.head.objects[pair.a]!, this.viewer.page!.head.objects[pair.b]!] : [];
    if (row < 0 || pair!.a === pair!.b || !objects.some((object) => object.solid)) return null;
    const inside = this.viewer.report!.block.insideOf(row);
    return h('p', { class: `inside in${inside}`, 'data-testid': 'inside-words' }, insideWords(objects[0]!.name, objects[1]!.name, inside));
  }

  /** Ways from what is selected to what belongs to it. */
  private links(): HTMLElement {
    const { viewer } = this;
    const { selection } = viewer;
    const bar = h('p', { class: 'links' });
    const link = (text: string, to: Selection) =>
      bar.append(h('button', { type: 'button', class: 'link', click: () => viewer.select(to, true) }, text));
    const objectLink = (object: number) => link(viewer.page!.head.objects[object]!.name, { type: 'object', object });
    if (selection?.type === 'contact') link('pair', { type: 'pair', a: selection.a, b: selection.b });
    for (const object of selection?.type === 'object' ? [] : viewer.selectedObjects()) objectLink(object);
    if (selection?.type === 'contact') {
      const [ka, ia, kb, ib] = selection.features as [number, number, number, number];
      link('feature a', { type: 'feature', object: selection.a, kind: ka, index: ia });
      link('feature b', { type: 'feature', object: selection.b, kind: kb, index: ib });
    }
    if (selection?.type === 'object') {
      const report = viewer.report!;
      for (const row of report.pairs()) {
        const [a, b] = [report.block.pairA[row]!, report.block.pairB[row]!];
        if (a !== selection.object && b !== selection.object) continue;
        if (bar.childElementCount >= 12) break;
        const other = a === b ? 'itself' : viewer.page!.head.objects[a === selection.object ? b : a]!.name;
        link(`↔ ${other}`, { type: 'pair', a, b });
      }
    }
    bar.append(button('×', 'deselect', 'Select nothing (Esc)', () => viewer.select(null)));
    return bar;
  }
}

function hint(): HTMLElement {
  return h('section', {}, h('p', { class: 'quiet' },
    'Click an object, a contact or a line, or choose a row in a list. Shift-click a surface for the vertex, edge or face.'));
}

function heading(facts: Facts): string {
  if (facts.type === 'object') return `${facts.name}`;
  if (facts.type === 'pair') return namesIn(facts);
  if (facts.type === 'contact') return `${facts.kind} · ${namesIn(facts)}`;
  return `${facts.kind} ${facts.index} of ${facts.object}`;
}

/** Serials tell objects apart, where names may repeat. */
function namesIn({ a, b, serial_a, serial_b }: Facts): string {
  const isOfSelf = serial_a === serial_b;
  return pairText({ a: String(a), sign: isOfSelf ? '' : '–', b: isOfSelf ? 'with itself' : String(b) });
}

function addFact(table: HTMLElement, key: string, fact: Fact, isFrame: boolean): void {
  if ((!isFrame && IN_HEADING.has(key) && !key.startsWith('serial')) || key === 'type' || key === 'listed') return;
  if (fact !== null && typeof fact === 'object' && !Array.isArray(fact)) {
    const entries = Object.entries(fact as Facts);
    if (entries.length === 0) return;
    if (entries.every(([k]) => (KINDS as readonly string[]).includes(k) || /^\d+$/.test(k))) {
      addRow(table, key, entries.map(([k, v]) => `${k} ${v}`).join(', '));
      return;
    }
    table.append(h('h3', {}, key.replaceAll('_', ' ')));
    for (const [name, value] of entries) addFact(table, name, value, isFrame);
    return;
  }
  if (isList(fact)) {
    addList(table, key, fact);
    return;
  }
  if (isPoint(fact)) {
    fact.forEach((x, i) => addRow(table, i === 0 ? key : '', numberText(x), 'xyz'[i]!, `${key}.${'xyz'[i]}`));
    return;
  }
  addRow(table, key, text(fact), '', key);
}

const isList = (fact: Fact): fact is readonly Facts[] =>
  Array.isArray(fact) && fact.length > 0 && fact.every((part) => part !== null && typeof part === 'object' && !Array.isArray(part));

/** Each part has a heading, with its kind and status, and below it its numbers. */
function addList(table: HTMLElement, key: string, list: readonly Facts[]): void {
  const one = key.replace(/s$/, '');
  list.slice(0, MOST_ROWS).forEach((part, i) => {
    const { kind, status, ...numbers } = part;
    table.append(h('h3', { 'data-testid': `${one}-${i}` }, `${one} ${i + 1} of ${list.length}: ${text(kind!)}, ${text(status!).replaceAll('_', ' ')}`));
    for (const [name, value] of Object.entries(numbers)) addRow(table, name, text(value), '', `${key}.${i}.${name}`);
  });
  if (list.length > MOST_ROWS)
    table.append(h('p', { class: 'quiet' }, `${list.length - MOST_ROWS} more are in what “Copy” copies.`));
}

function isPoint(fact: Fact): fact is readonly number[] {
  return Array.isArray(fact) && fact.length === 3 && fact.every((x) => typeof x === 'number') &&
    !fact.every((x) => Number.isInteger(x));
}

function text(fact: Fact): string {
  if (typeof fact === 'number') return numberText(fact);
  if (!Array.isArray(fact)) return typeof fact === 'boolean' ? (fact ? 'yes' : 'no') : String(fact);
  if (fact.length > 0 && fact.every(isPoint)) return fact.map((p) => `(${text(p)})`).join(' ');
  if (typeof fact[0] === 'string' && typeof fact[1] === 'number')
    return `${fact[0]} ${fact[1]}${fact[2] ? ` (${text(fact[2])})` : ''}`;
  return fact.map(text).join(', ');
}

function addRow(table: HTMLElement, key: string, value: string, axis = '', id = key): void {
  const label = LABELS[key] ?? key.replaceAll('_', ' ');
  // A long text has lines of its own, so that the names of numbers keep their width.
  const width = value.length > LONG_TEXT ? 'long' : '';
  table.append(
    h('dt', { class: width }, label),
    h('dd', { class: width }, axis && h('i', {}, axis), h('output', {
      'data-fact': id, title: `${value}\nClick to copy`, click: () => void copy(value) }, value)));
}
