// How are the ways out of pairs drawn?

import { PointBatch, SegmentBatch, SHAPE } from './batches3d';
import { addArrow, arrowLength } from './contacts3d';
import type { DrawnLine } from './lines3d';
import { palette } from '../palette';
import type { Layer, Stage } from './scene3d';

/** A way out begins inside the two objects, so it is hardly fainter there. */
const HIDDEN = 0.8;

/** An arrow for each pair: from the middle of where its surfaces cross, as long as the way is thick, or a little longer so that it is seen. */
export class WaysLayer implements Layer {
  /** What is drawn and can be picked. */
  shown: DrawnLine[] = [];
  private readonly shafts = new SegmentBatch(34, 3.6, false, HIDDEN);
  private readonly heads = new SegmentBatch(36, 13, true, HIDDEN);
  private readonly starts = new PointBatch(38);
  readonly objects = [this.shafts.object, this.heads.object, this.starts.object];

  update(stage: Stage): void {
    for (const batch of [this.shafts, this.heads, this.starts]) batch.clear();
    this.shown = [];
    if (stage.viewer.display.ways) this.add(stage);
    this.shafts.finish();
    this.heads.finish();
    this.starts.finish(stage.ratio, palette().outline);
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    for (const batch of [this.shafts, this.heads]) batch.resize(width, height, ratio, near);
  }

  private add(stage: Stage): void {
    const { report, display } = stage.viewer;
    const { crossing } = palette();
    for (const pair of report?.pairs() ?? []) {
      const { block } = report!;
      const way = block.wayOutOf(pair);
      const [a, b] = [block.pairA[pair]!, block.pairB[pair]!];
      if (!way?.direction.some((x) => x !== 0) || !stage.viewer.showsPair(pair)) continue;
      if (!stage.isDrawn(a) && !stage.isDrawn(b)) continue;
      const length = Math.max(way.thickness, 2.5 * display.arrowLength * arrowLength(stage, a, b));
      const [from, to] = addArrow(this.shafts, this.heads, stage.local(way.point), way.direction, length, crossing);
      this.starts.add(from, crossing, SHAPE.disc, 8);
      this.shown.push({ a: from, b: to, pair, level: 0 });
    }
  }
}
