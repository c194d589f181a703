// How is a pair of objects named, also where it is of an object with itself?

import type { Head } from './head';
import { INSIDE_MARKS } from './inside';

/** Two words and what stands between them: nothing where an object is paired with itself. */
export interface PairNames { a: string; sign: string; b: string }

export function pairNames(head: Head, a: number, b: number, inside = 0): PairNames {
  const name = head.objects[a]!.name;
  if (a === b) return { a: name, sign: '', b: 'with itself' };
  return { a: name, sign: INSIDE_MARKS[inside]!, b: head.objects[b]!.name };
}

export function pairText({ a, sign, b }: PairNames): string {
  return sign ? `${a} ${sign} ${b}` : `${a} ${b}`;
}
