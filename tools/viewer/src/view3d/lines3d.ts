// How are the lines between middle vertices, the bounds of regions and the witnesses of pairs drawn?

import { PointBatch, SegmentBatch, SHAPE, SphereBatch, type Vec3 } from './batches3d';
import { levelColour, palette } from '../palette';
import type { Layer, Stage } from './scene3d';

export interface DrawnLine { a: Vec3; b: Vec3; pair: number; level: number }

export class LinesLayer implements Layer {
  /** What is drawn and can be picked. A witness has level 0. */
  shown: DrawnLine[] = [];
  boundCount = 0;
  private readonly lines = new SegmentBatch(20, 2.2);
  private readonly witnesses = new SegmentBatch(22, 1.6);
  private readonly ends = new PointBatch(24);
  private readonly bounds = new SphereBatch(10);
  readonly objects = [this.bounds.object, this.lines.object, this.witnesses.object, this.ends.object];

  /** How many lines of each level are drawn. Index 0 counts witnesses. */
  counts(): number[] {
    const counts: number[] = [];
    for (const { level } of this.shown) counts[level] = (counts[level] ?? 0) + 1;
    return Array.from(counts, (n) => n ?? 0);
  }

  update(stage: Stage): void {
    for (const batch of [this.lines, this.witnesses, this.ends, this.bounds]) batch.clear();
    this.shown = [];
    const { display } = stage.viewer;
    if (display.lines && stage.viewer.report) this.addLines(stage);
    if (display.witnesses) this.addWitnesses(stage);
    if (display.bounds !== 'off') this.addBounds(stage);
    this.lines.finish();
    this.witnesses.finish();
    this.ends.finish(stage.ratio, palette().outline);
    this.bounds.finish(display.bounds === 'spheres');
    this.boundCount = this.bounds.count;
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    for (const batch of [this.lines, this.witnesses]) batch.resize(width, height, ratio, near);
  }

  private *pairs(stage: Stage): Generator<number> {
    const { report } = stage.viewer;
    if (!report) return;
    for (const pair of report.pairs())
      if (stage.viewer.showsPair(pair) && stage.isDrawn(report.block.pairA[pair]!) && stage.isDrawn(report.block.pairB[pair]!)) yield pair;
  }

  /** Very many lines are drawn thinner in colour and without their ends, so that surfaces stay in sight. */
  private strength = 1;

  /** With a pair selected, lines of other pairs are faint. */
  private alpha(stage: Stage, pair: number): number {
    const chosen = stage.viewer.selectedPair();
    const { block } = stage.viewer.report!;
    return !chosen || (block.pairA[pair] === chosen.a && block.pairB[pair] === chosen.b) ? 255 : 50;
  }

  private addLines(stage: Stage): void {
    this.strength = Math.min(1, Math.max(0.25, Math.sqrt(150 / Math.max(1, this.countLines(stage)))));
    const { hiddenLevels } = stage.viewer.display;
    for (const pair of this.pairs(stage)) {
      const { block } = stage.viewer.report!;
      const alpha = this.alpha(stage, pair) * this.strength;
      // Lines of a pair are sorted by level. The few of level 1 are drawn last, over the many of deeper levels.
      for (let r = block.regionEnd[pair]! - 1; r >= block.regionBegin[pair]!; --r) {
        const level = block.regionLevels[r]!;
        if (hiddenLevels.has(level)) continue;
        const [a, b] = [stage.local(block.regionPoints, 6 * r), stage.local(block.regionPoints, 6 * r + 3)];
        const colour = levelColour(level);
        this.lines.add(a, b, colour, alpha);
        if (this.strength > 0.6) {
          this.ends.add(a, colour, SHAPE.disc, 5, alpha);
          this.ends.add(b, colour, SHAPE.disc, 5, alpha);
        }
        this.shown.push({ a, b, pair, level });
      }
    }
  }

  private countLines(stage: Stage): number {
    const { block } = stage.viewer.report!;
    let count = 0;
    for (const pair of this.pairs(stage))
      for (let r = block.regionBegin[pair]!; r < block.regionEnd[pair]!; ++r)
        if (!stage.viewer.display.hiddenLevels.has(block.regionLevels[r]!)) ++count;
    return count;
  }

  private addWitnesses(stage: Stage): void {
    const { neutral } = palette();
    for (const pair of this.pairs(stage)) {
      const { block } = stage.viewer.report!;
      const a = stage.local(block.witnessPoints, 6 * pair);
      const b = stage.local(block.witnessPoints, 6 * pair + 3);
      const alpha = this.alpha(stage, pair);
      this.witnesses.add(a, b, neutral, alpha);
      this.ends.add(a, neutral, SHAPE.disc, 6, alpha);
      this.ends.add(b, neutral, SHAPE.disc, 6, alpha);
      this.shown.push({ a, b, pair, level: 0 });
    }
  }

  /** Regions of the chosen level, of the selected objects or of all. */
  private addBounds(stage: Stage): void {
    const { page, display } = stage.viewer;
    const chosen = stage.viewer.selectedObjects();
    for (const object of page?.objects ?? []) {
      if (!stage.isDrawn(object.index)) continue;
      if (!display.boundsOfAll && chosen.length > 0 && !chosen.includes(object.index)) continue;
      for (const region of object.mesh.regionsAtLevel(display.boundsLevel)) {
        const middle = object.vertex(object.mesh.regionMiddle[region]!);
        if (!Number.isFinite(middle[0])) continue;
        const colour = display.boundsLevel === 0 ? palette().neutral : levelColour(display.boundsLevel);
        this.bounds.add(stage.local(middle), object.mesh.regionRadius(region, object.world), colour);
      }
    }
  }
}
