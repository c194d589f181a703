// How has the selection been over all frames?

import type { Selection, Viewer } from '../viewer';
import type { Page } from './page';
import { groupOf } from './inside';
import type { ReportBlock } from './report';

/** What the time line marks: how many pairs of the selection are so in a frame, or how many impacts and diagnostics it has. */
export const MARKS = [
  'began', 'touching', 'ended', 'impacts', 'inside', 'crossing', 'incomplete', 'stale', 'contacts_cut', 'diagnostics',
] as const;
export type Mark = (typeof MARKS)[number];

/** Numbers of a pair, or of all pairs of an object, by frame: the smallest of its pairs. Null where none is listed, and for `deepest` without a contact. */
export class History {
  readonly lower: (number | null)[];
  readonly upper: (number | null)[];
  /** The smallest separation of its contacts. */
  readonly deepest: (number | null)[];
  readonly marks: Record<Mark, Uint32Array>;

  /** Of the pair of two objects, which may be the same, or of all pairs of the one object. */
  constructor(readonly of: 'pair' | 'object', private readonly objects: readonly number[], frames: number) {
    const empty = (): (number | null)[] => Array<number | null>(frames).fill(null);
    this.lower = empty();
    this.upper = empty();
    this.deepest = empty();
    this.marks = Object.fromEntries(MARKS.map((name) => [name, new Uint32Array(frames)])) as Record<Mark, Uint32Array>;
  }

  add(block: ReportBlock, firstFrame: number): void {
    for (let i = 0; i < block.begin.length; ++i)
      for (let row = block.begin[i]!; row < block.end[i]!; ++row)
        if (this.has(block.pairA[row]!, block.pairB[row]!)) this.addRow(block, row, firstFrame + i);
    for (const { object, frame } of block.diagnostics)
      if (object !== null && this.objects.includes(object)) ++this.marks.diagnostics[frame]!;
  }

  private has(a: number, b: number): boolean {
    const [first, second] = this.objects;
    return this.of === 'pair' ? a === first && b === second : a === first || b === first;
  }

  private addRow(block: ReportBlock, row: number, frame: number): void {
    const { marks } = this;
    const [flags, inside, sweep] = [block.flags[row]!, groupOf(block.insideOf(row)), block.sweepOf(row)];
    const count = (name: Mark, n: boolean | number) => (marks[name][frame]! += Number(n));
    const least = (values: (number | null)[], value: number | null) => {
      if (value !== null) values[frame] = Math.min(values[frame] ?? Infinity, value);
    };
    least(this.lower, block.lower[row]!);
    least(this.upper, block.upper[row]!);
    least(this.deepest, block.deepestOf(row));
    count('began', block.phase[row] === 1);
    count('touching', block.isTouching(row));
    count('ended', block.phase[row] === 3);
    count('impacts', sweep ? sweep.end - sweep.begin : 0);
    count('inside', inside === 1);
    count('crossing', inside === 2);
    count('incomplete', (flags & 1) !== 0);
    count('stale', (flags & 2) !== 0);
    count('contacts_cut', (flags & 4) !== 0);
  }
}

/** What the history of a selection is of: its pair, or its object. */
function subjectOf(s: Selection | null): { of: 'pair' | 'object'; objects: number[] } | null {
  if (!s) return null;
  return s.type === 'pair' || s.type === 'contact' ? { of: 'pair', objects: [s.a, s.b] } : { of: 'object', objects: [s.object] };
}

/** Reads the history of whatever is selected, a little at a time, and says so as it grows. */
export class HistoryReader {
  private page: Page | null = null;
  private subject = 'null';

  constructor(private readonly viewer: Viewer) {
    viewer.on(['page', 'selection'], () => void this.read());
  }

  private async read(): Promise<void> {
    const { viewer } = this;
    const { page } = viewer;
    const subject = subjectOf(viewer.selection);
    const text = JSON.stringify(subject);
    if (!page || (page === this.page && text === this.subject)) return;
    this.page = page;
    this.subject = text;
    const history = subject && new History(subject.of, subject.objects, page.head.frames);
    viewer.history = history;
    viewer.emit('history');
    if (!history) return;
    const here = page.blockOf(viewer.frame);
    const blocks = Array.from({ length: page.blockCount }, (_, k) => k).sort((p, q) => Math.abs(p - here) - Math.abs(q - here));
    let shown = performance.now();
    for (const k of blocks) {
      // Blocks that are not in memory are read past the cache, so that they throw nothing out of it.
      const block = page.reports.peek(`report/${k}`) ?? await page.readReport(`report/${k}`);
      if (viewer.history !== history) return;
      history.add(block, k * page.head.block);
      if (performance.now() - shown < 150) continue;
      viewer.emit('history');
      await new Promise((resolve) => setTimeout(resolve));
      shown = performance.now();
    }
    viewer.emit('history');
  }
}
