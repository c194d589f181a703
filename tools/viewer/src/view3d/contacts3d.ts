// How are contacts drawn: points, pushes, kinds and sides, and where diagnostics happened?

import { PointBatch, SegmentBatch, SHAPE, type Vec3 } from './batches3d';
import type { ObjectState } from '../data/motion';
import { KIND_COLOURS, palette } from '../palette';
import type { Layer, Stage } from './scene3d';

/** What a point's shape says: 0 no side, 1 in front of both, 2 behind one, 3 the two sides disagree. */
export function sideClass(a: number, b: number): 0 | 1 | 2 | 3 {
  if (a === 0 && b === 0) return 0;
  if (a + b === 3 && a * b === 2) return 3;
  return a === 2 || b === 2 ? 2 : 1;
}

export const CLASS_SHAPES = [SHAPE.small, SHAPE.disc, SHAPE.ring, SHAPE.diamond];
export const CLASS_NAMES = ['no side', 'in front', 'behind', 'disagree'];

/** Where an object's diagnostic is shown: beside its vertices that are not finite, else in its middle. */
export function diagnosticPlace(object: ObjectState): [number, number, number] {
  const bad = new Set(object.notFinite);
  if (bad.size === 0) return object.centre();
  const sum: [number, number, number] = [0, 0, 0];
  let count = 0;
  const { edges } = object.mesh;
  for (let i = 0; i < edges.length; ++i) {
    const other = edges[i ^ 1]!;
    if (!bad.has(edges[i]!) || bad.has(other)) continue;
    object.vertex(other).forEach((x, k) => (sum[k]! += x));
    ++count;
  }
  return count ? (sum.map((x) => x / count) as [number, number, number]) : object.centre();
}

/** Where an object is shown that has no good vertex: at a witness of its pairs, which are still of its last good positions. */
function lastKnownPlace(stage: Stage, object: number): ArrayLike<number> {
  const { report } = stage.viewer;
  for (const pair of report?.pairs() ?? []) {
    const { pairA, pairB, witnessPoints } = report!.block;
    const side = [pairA[pair], pairB[pair]].indexOf(object);
    const at = 6 * pair + 3 * side;
    if (side >= 0 && Number.isFinite(witnessPoints[at])) return witnessPoints.subarray(at, at + 3);
  }
  return stage.sceneBounds().isEmpty ? stage.origin : stage.sceneBounds().centre();
}

/** Arrows are short beside the smaller object and beside the scene, so that many small objects stay in sight. */
export function arrowLength(stage: Stage, a: number, b: number): number {
  const sizes = [a, b].map((index) => {
    const object = stage.viewer.page!.objects[index]!;
    return object.isThere && object.hasBox ? Math.hypot(...object.low.map((x, k) => object.high[k]! - x)) : Infinity;
  });
  return Math.min(0.05 * stage.radius, 0.25 * Math.min(...sizes));
}

/** Adds a shaft and a head, and returns where the arrow begins and ends. */
export function addArrow(shafts: SegmentBatch, heads: SegmentBatch, from: Vec3, direction: Vec3, length: number, colour: string): [Vec3, Vec3] {
  const along = (share: number) => from.map((x, k) => x + share * length * direction[k]!) as unknown as Vec3;
  shafts.add(from, along(0.7), colour);
  heads.add(along(0.55), along(1), colour);
  return [from, along(1)];
}

export class ContactsLayer implements Layer {
  /** The contacts that are drawn, as rows of the report, in the order of `places`. */
  shown: [contact: number, pair: number][] = [];
  places: Vec3[] = [];
  private readonly points = new PointBatch(40);
  private readonly warnings = new PointBatch(60);
  /** Where each arrow begins and ends, in the order of `places`; null without one, as where arrows are off. */
  arrows: ([from: Vec3, to: Vec3] | null)[] = [];
  private readonly segments = new SegmentBatch(30, 1.8);
  private readonly heads = new SegmentBatch(32, 6.5, true);
  readonly objects = [this.segments.object, this.heads.object, this.points.object, this.warnings.object];

  get warningCount(): number { return this.warnings.count; }

  update(stage: Stage): void {
    for (const batch of [this.points, this.warnings, this.segments, this.heads]) batch.clear();
    this.shown = [];
    this.places = [];
    this.arrows = [];
    const { display } = stage.viewer;
    if (display.contacts) this.addContacts(stage);
    if (display.diagnostics) this.addDiagnostics(stage);
    const { outline } = palette();
    this.points.finish(stage.ratio, outline);
    this.warnings.finish(stage.ratio, outline);
    this.segments.finish();
    this.heads.finish();
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    for (const batch of [this.segments, this.heads]) batch.resize(width, height, ratio, near);
  }

  private addContacts(stage: Stage): void {
    const { viewer } = stage;
    const { report, display } = viewer;
    if (!report || report.pairEnd === report.pairBegin) return;
    const { block } = report;
    const contacts = block.contactEnd[report.pairEnd - 1]! - block.contactBegin[report.pairBegin]!;
    // Where there are many, smaller points keep their colours apart.
    const pointSize = display.pointSize * Math.min(1, Math.max(0.5, Math.sqrt(300 / Math.max(1, contacts))));
    for (const [contact, pair] of report.contacts()) {
      if (!stage.isDrawn(block.pairA[pair]!) && !stage.isDrawn(block.pairB[pair]!)) continue;
      if (!viewer.passes(contact, pair)) continue;
      const a = stage.local(block.points, 6 * contact);
      const b = stage.local(block.points, 6 * contact + 3);
      const middle = a.map((x, k) => (x + b[k]!) / 2) as unknown as Vec3;
      const colour = KIND_COLOURS[block.kind[contact]!] ?? '#999999';
      const group = sideClass(report.sideA(contact), report.sideB(contact));
      const size = group === 0 ? 0.7 * pointSize : pointSize;
      this.points.add(a, colour, CLASS_SHAPES[group]!, size);
      if (block.distance[contact]! > 0) {
        this.points.add(b, colour, CLASS_SHAPES[group]!, 0.62 * size);
        this.segments.add(a, b, colour, 150);
      }
      const length = display.arrowLength * arrowLength(stage, block.pairA[pair]!, block.pairB[pair]!);
      const hasPush = display.pushes && (display.pierces || !report.pierces(contact));
      this.arrows.push(hasPush ? addArrow(this.segments, this.heads, b, report.push(contact), length, colour) : null);
      this.shown.push([contact, pair]);
      this.places.push(middle);
    }
  }

  private addDiagnostics(stage: Stage): void {
    const { page, report } = stage.viewer;
    for (const diagnostic of report?.diagnostics ?? []) {
      const object = diagnostic.object === null ? undefined : page!.objects[diagnostic.object];
      if (!object?.isThere) continue;
      const place = object.hasBox ? diagnosticPlace(object) : lastKnownPlace(stage, object.index);
      this.warnings.add(stage.local(place), palette().warning, SHAPE.warning, 30);
    }
  }
}
