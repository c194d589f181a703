// What can the reader do, and whose work is in the page?

import { h } from './dom';
import { commands } from '../keys';

declare const LICENCES: { name: string; version: string; text: string }[];

const MOUSE: [string, string][] = [
  ['drag', 'orbit; while the page computes, move what is under the pointer'], ['right drag, or two fingers', 'pan'], ['wheel, or pinch', 'zoom'],
  ['click', 'select a contact, a line’s pair or an object'], ['Shift-click', 'select a vertex, an edge or a face'],
  ['double-click', 'select and go there'], ['drag in the time line or a plot', 'scrub'],
];

export function fillHelp(dialog: HTMLDialogElement): void {
  const groups = new Map<string, [string, string][]>([['Pointer', MOUSE]]);
  for (const command of commands()) {
    const list = groups.get(command.group) ?? [];
    list.push([command.keysText ?? command.keys.map(keyName).join(' '), command.text]);
    groups.set(command.group, list);
  }
  dialog.replaceChildren(
    h('form', { method: 'dialog' }, h('h1', {}, 'Help'), h('button', { 'data-testid': 'help-close', 'aria-label': 'Close' }, '×')),
    h('div', { class: 'columns' }, ...[...groups].map(([name, rows]) => h('section', {}, h('h2', {}, name),
      h('dl', {}, ...rows.flatMap(([keys, text]) => [h('dt', {}, keys), h('dd', {}, text)]))))),
    h('section', {}, h('h2', {}, 'What is drawn'), h('p', {},
      'A contact is a point on each of the two features. Its arrow begins on b, and leads where b is pushed out: along the ' +
      'normal, or against it where the separation is negative. An edge that pierces a face carries nothing, and its arrow is off at first. Its colour is its kind. A disc lies in front of both surfaces, a ring behind one, a diamond where the two sides disagree, and a small ' +
      'dot where there is no side. Lines join the middle vertices of regions: red for level 1, green for 2, blue for 3. Grey ' +
      'lines are the witnesses of pairs. A thick purple arrow is the way out of a pair whose surfaces pass through each other. It begins in the ' +
      'middle of where they cross, leads where b leaves a, and is as long as the way is thick, or a little longer so that it is seen. Where ' +
      'features meet between the step before and this one, a narrowing teal line leads along the way of each vertex of them that moves. Both ' +
      'features are drawn where they meet, with a cross, in the colour of their kind. A page of each K-th frame has no steps before, and draws none of it. ' +
      'A search and the buttons over the list of pairs choose what lists and the picture show. In lists, a ⊂ b says that a is inside b, and a ✕ b that they cross; an object inside another ' +
      'one is seen through it. What lies behind a surface is fainter. Vertices of deformable objects are drawn to ' +
      'within the position error that the inspector shows; all numbers of reports are exact.')),
    h('section', {}, h('h2', {}, 'Licences'), ...LICENCES.map(({ name, version, text }) =>
      h('details', {}, h('summary', {}, `${name} ${version}`), h('pre', {}, text)))));
}

function keyName(key: string): string {
  const names: Record<string, string> = { ' ': 'Space', ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', Escape: 'Esc' };
  const parts = key.split('+');
  return parts.map((part) => names[part] ?? (part.length === 1 ? part.toUpperCase() : part)).join('+');
}
