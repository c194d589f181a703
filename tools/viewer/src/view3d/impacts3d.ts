// How is drawn what meets between two steps: the ways of its vertices, and the features where they meet?

import type * as THREE from 'three';
import { PointBatch, SegmentBatch, SHAPE, type Vec3 } from './batches3d';
import { cornersAt, meetingOf, type Way } from './meetings';
import type { DrawnLine } from './lines3d';
import { KIND_COLOURS, palette } from '../palette';
import type { Layer, Stage } from './scene3d';

/** What met is often inside another object by the end of the step, so it is hardly fainter there. */
const HIDDEN = 0.7;
const FAINT = 50;
/** An impact that is only possible is drawn this strongly. */
const POSSIBLE = 120;

/** For each impact, the way of each vertex that moves, both features at the time of impact, and a cross where they meet. */
export class ImpactsLayer implements Layer {
  /** The ways that are drawn, each once, and can be picked. */
  shown: DrawnLine[] = [];
  /** The crosses: places relative to the stage's origin. */
  places: Vec3[] = [];
  private readonly ways = new SegmentBatch(26, 5, true, HIDDEN);
  private readonly features = new SegmentBatch(28, 2.2, false, HIDDEN);
  private readonly crosses = new PointBatch(46);
  readonly objects = [this.ways.object, this.features.object, this.crosses.object];
  private readonly drawn = new Set<string>();

  update(stage: Stage): void {
    for (const batch of [this.ways, this.features, this.crosses]) batch.clear();
    this.shown = [];
    this.places = [];
    this.drawn.clear();
    if (stage.viewer.display.impacts) this.add(stage);
    this.ways.finish();
    this.features.finish();
    this.crosses.finish(stage.ratio, palette().outline);
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    for (const batch of [this.ways, this.features]) batch.resize(width, height, ratio, near);
  }

  private add(stage: Stage): void {
    const { page, report, display } = stage.viewer;
    const chosen = stage.viewer.selectedPair();
    for (const [impact, pair] of report?.impacts() ?? []) {
      const { block } = report!;
      const [a, b] = [block.pairA[pair]!, block.pairB[pair]!];
      if (!stage.viewer.showsPair(pair) || (!stage.isDrawn(a) && !stage.isDrawn(b))) continue;
      const isOther = chosen && (chosen.a !== a || chosen.b !== b);
      const alpha = isOther ? FAINT : block.impactStatus[impact] === 1 ? POSSIBLE : 255;
      const colour = KIND_COLOURS[block.impactKind[impact]!] ?? '#999999';
      const meeting = meetingOf(page!, report!, impact, pair);
      if (!meeting) continue;
      for (const way of [meeting.a, meeting.b]) {
        this.addWay(stage, way, pair, alpha);
        this.addFeature(stage, cornersAt(way, meeting.time), colour, alpha);
      }
      const place = local(stage, meeting.place);
      this.crosses.add(place, colour, SHAPE.cross, 1.6 * display.pointSize, alpha);
      this.places.push(place);
    }
  }

  /** Impacts share vertices, whose ways are drawn once. */
  private addWay(stage: Stage, way: Way, pair: number, alpha: number): void {
    way.vertices.forEach((vertex, i) => {
      const [from, to] = [way.from[i]!, way.to[i]!];
      const key = `${way.object}/${vertex}`;
      if (this.drawn.has(key) || from.equals(to)) return;
      this.drawn.add(key);
      const [a, b] = [local(stage, from), local(stage, to)];
      this.ways.add(a, b, palette().way, alpha);
      this.shown.push({ a, b, pair, level: 0 });
    });
  }

  private addFeature(stage: Stage, corners: THREE.Vector3[], colour: string, alpha: number): void {
    const sides = corners.length > 2 ? corners.length : corners.length - 1;
    for (let i = 0; i < sides; ++i)
      this.features.add(local(stage, corners[i]!), local(stage, corners[(i + 1) % corners.length]!), colour, alpha);
  }
}

const local = (stage: Stage, point: THREE.Vector3): Vec3 => stage.local(point.toArray());
