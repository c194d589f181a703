// How has the selected pair been over all frames?

import type { Viewer } from '../viewer';
import type { Page } from './page';
import type { ReportBlock } from './report';

/** Numbers of one pair by frame. Null where the report does not list it, and for `deepest` where no contact is listed. */
export class PairHistory {
  readonly lower: (number | null)[];
  readonly upper: (number | null)[];
  /** The smallest separation of its contacts. */
  readonly deepest: (number | null)[];
  readonly isTouching: boolean[];

  constructor(readonly a: number, readonly b: number, frames: number) {
    const empty = (): (number | null)[] => Array<number | null>(frames).fill(null);
    this.lower = empty();
    this.upper = empty();
    this.deepest = empty();
    this.isTouching = Array<boolean>(frames).fill(false);
  }

  add(block: ReportBlock, firstFrame: number): void {
    for (let i = 0; i < block.begin.length; ++i) {
      const row = block.rowOf(i, this.a, this.b);
      if (row < 0) continue;
      const frame = firstFrame + i;
      this.lower[frame] = block.lower[row]!;
      this.upper[frame] = block.upper[row]!;
      this.deepest[frame] = block.deepestOf(row);
      this.isTouching[frame] = block.isTouching(row);
    }
  }
}

/** Reads the history of whichever pair is selected, a little at a time, and says so as it grows. */
export class HistoryReader {
  private page: Page | null = null;

  constructor(private readonly viewer: Viewer) {
    viewer.on(['page', 'selection'], () => void this.read());
  }

  private async read(): Promise<void> {
    const { viewer } = this;
    const { page } = viewer;
    const pair = viewer.selectedPair();
    const last = viewer.history;
    if (!page || (page === this.page && pair?.a === last?.a && pair?.b === last?.b)) return;
    this.page = page;
    const history = pair && new PairHistory(pair.a, pair.b, page.head.frames);
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
