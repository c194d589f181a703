// How does the page say, and find, that one object is inside another?

import type { Head } from './head';
import type { FrameReport } from './report';

/** What a row of a pair says, in the order of the numbers that the page has. */
export const INSIDES = ['none', 'a_in_b', 'b_in_a', 'crossing'] as const;

/** What stands between the names of a and b in a list. */
export const INSIDE_MARKS = ['–', '⊂', '⊃', '✕'] as const;

/** The three groups by which the list of pairs is filtered. */
export const INSIDE_GROUPS = ['outside', 'inside', 'crossing'] as const;
export const SHORT_GROUPS = ['out', 'in', 'cross'] as const;
export const groupOf = (inside: number): number => (inside === 0 ? 0 : inside === 3 ? 2 : 1);

/** The words for a pair of which one object is a solid. */
export function insideWords(a: string, b: string, inside: number): string {
  return [`Neither of ${a} and ${b} is inside the other`, `${a} is inside ${b}`, `${b} is inside ${a}`, `${a} and ${b} cross`][inside] ?? '';
}

/** The objects that are wholly inside another one. */
export function objectsInside(report: FrameReport): Set<number> {
  const found = new Set<number>();
  for (const row of report.pairs()) {
    const inside = report.block.insideOf(row);
    if (inside === 1) found.add(report.block.pairA[row]!);
    if (inside === 2) found.add(report.block.pairB[row]!);
  }
  return found;
}

/** How many of a page's objects are solids, as words for its settings. Pages that do not know have none. */
export function solidsText(head: Head): string {
  const solids = head.objects.filter((object) => object.solid).length;
  if (solids === 0) return '';
  return solids === head.objects.length ? `all ${solids} objects solid` : `${solids} of ${head.objects.length} objects solid`;
}
