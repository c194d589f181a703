// Which objects, pairs and contacts does the search name?

import type { Head } from './head';
import { groupOf, INSIDE_GROUPS, INSIDES } from './inside';
import { KINDS, PHASES, type ReportBlock } from './report';

interface Word { text: string; isName: boolean }

/** The words of the search. One that is in the name of an object asks for names. Each other one asks for a serial, a motion or a state. */
export class Search {
  private readonly words: Word[];
  private readonly names: string[];

  constructor(private readonly text: string, private readonly head: Head) {
    this.names = head.objects.map(({ name, serial }) => (name || `object ${serial}`).toLowerCase());
    const words = text.toLowerCase().split(/\s+/).filter((word) => word);
    this.words = words.map((word) => ({ text: word, isName: this.names.some((name) => name.includes(word)) }));
  }

  isOf(text: string, head: Head): boolean {
    return this.text === text && this.head === head;
  }

  get isEmpty(): boolean { return this.words.length === 0; }

  hasObject(object: number): boolean {
    return this.words.every((word) => this.isNamed(word, object));
  }

  /** A pair is named by either of its objects, by its state, and by the kinds of its contacts. */
  hasPair(block: ReportBlock, row: number): boolean {
    return this.words.every((word) => this.namesPair(word, block, row) || (!word.isName && hasKind(word.text, block, row)));
  }

  /** Of the contacts of a pair that is named, those are named whose kind the search does not exclude. */
  hasContact(block: ReportBlock, contact: number, row: number): boolean {
    return this.words.every((word) => this.namesPair(word, block, row) || (!word.isName && isKind(word.text, block.kind[contact]!)));
  }

  private isNamed({ text, isName }: Word, object: number): boolean {
    if (isName) return this.names[object]!.includes(text);
    const { serial, motion } = this.head.objects[object]!;
    return String(serial) === text || motion.startsWith(text);
  }

  private namesPair(word: Word, block: ReportBlock, row: number): boolean {
    if (this.isNamed(word, block.pairA[row]!) || this.isNamed(word, block.pairB[row]!)) return true;
    return !word.isName && statesOf(block, row).some((state) => state.startsWith(word.text));
  }
}

const isKind = (text: string, kind: number): boolean => KINDS[kind]?.toLowerCase() === text;

function hasKind(text: string, block: ReportBlock, row: number): boolean {
  for (let c = block.contactBegin[row]!; c < block.contactEnd[row]!; ++c) if (isKind(text, block.kind[c]!)) return true;
  return false;
}

/** The words that say how a pair is. */
function statesOf(block: ReportBlock, row: number): string[] {
  const [inside, flags] = [block.insideOf(row), block.flags[row]!];
  return [
    PHASES[block.phase[row]!] ?? '?',
    ...(inside ? [INSIDES[inside]!, INSIDE_GROUPS[groupOf(inside)]!] : []),
    ...['incomplete', 'stale', 'contacts_cut'].filter((_, bit) => flags & (1 << bit)),
    ...((block.sweepOf(row)?.timeOfImpact ?? 1) < 1 ? ['impact'] : []),
    ...(block.pairA[row] === block.pairB[row] ? ['with', 'itself'] : []),
  ];
}
