// How is what is selected marked in 3D, and where is it?

import { PointBatch, SegmentBatch, SHAPE } from './batches3d';
import { Bounds } from './camera3d';
import type { ObjectState } from '../data/motion';
import { meetingOf } from './meetings';
import { palette } from '../palette';
import type { Layer, Stage } from './scene3d';
import type { Viewer } from '../viewer';

export class HighlightLayer implements Layer {
  private readonly points = new PointBatch(70);
  private readonly segments = new SegmentBatch(68, 3.2);
  readonly objects = [this.segments.object, this.points.object];

  get count(): number {
    return this.points.count + this.segments.count;
  }

  update(stage: Stage): void {
    this.points.clear();
    this.segments.clear();
    this.addSelection(stage);
    this.points.finish(stage.ratio, palette().outline);
    this.segments.finish();
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    this.segments.resize(width, height, ratio, near);
  }

  private addSelection(stage: Stage): void {
    const { selection, report } = stage.viewer;
    const { selected, second } = palette();
    if (selection?.type === 'feature') this.addFeature(stage, selection.object, selection.kind, selection.index, selected);
    if (selection?.type === 'pair' && report) {
      const row = report.rowOf(selection.a, selection.b);
      if (row < 0) return;
      const a = stage.local(report.block.witnessPoints, 6 * row);
      const b = stage.local(report.block.witnessPoints, 6 * row + 3);
      this.segments.add(a, b, selected);
      this.points.add(a, selected, SHAPE.halo, 18);
      this.points.add(b, second, SHAPE.halo, 18);
    }
    if (selection?.type === 'contact' && report) {
      const { a, b, features } = selection;
      this.addFeature(stage, a, features[0]!, features[1]!, selected);
      this.addFeature(stage, b, features[2]!, features[3]!, second);
      const row = stage.viewer.selectedContactRow();
      if (row < 0) return;
      this.points.add(stage.local(report.block.points, 6 * row), selected, SHAPE.halo, 24);
      this.points.add(stage.local(report.block.points, 6 * row + 3), second, SHAPE.halo, 19);
    }
  }

  private addFeature(stage: Stage, object: number, kind: number, index: number, colour: string): void {
    const state = stage.viewer.page!.objects[object];
    if (!state?.isThere) return;
    const corners = state.mesh.featureCorners(kind, index).map((v) => stage.local(state.vertex(v)));
    if (corners.some((p) => !Number.isFinite(p[0]))) return;
    if (kind === 0) this.points.add(corners[0]!, colour, SHAPE.disc, 12);
    const sides = kind === 2 ? corners.length : kind === 1 ? 1 : 0;
    for (let i = 0; i < sides; ++i) this.segments.add(corners[i]!, corners[(i + 1) % corners.length]!, colour);
  }

  /** The box of what is selected, for the camera. */
  boundsOf(viewer: Viewer): Bounds | null {
    const { selection, page, report } = viewer;
    if (!selection || !page) return null;
    const bounds = new Bounds();
    const addObject = (index: number) => {
      const object = page.objects[index]!;
      if (!object.isThere) return;
      bounds.add(object.low);
      bounds.add(object.high);
    };
    const addFeature = (index: number, kind: number, feature: number) => {
      const object = page.objects[index]!;
      if (!object.isThere) return;
      for (const v of object.mesh.featureCorners(kind, feature)) bounds.add(object.vertex(v));
      growAround(bounds, surroundings(object));
    };
    if (selection.type === 'object') addObject(selection.object);
    if (selection.type === 'feature') addFeature(selection.object, selection.kind, selection.index);
    if (selection.type === 'contact') {
      const row = viewer.selectedContactRow();
      if (row < 0) {
        addFeature(selection.a, selection.features[0]!, selection.features[1]!);
        addFeature(selection.b, selection.features[2]!, selection.features[3]!);
      } else {
        // A contact may lie on the face of a whole floor, so its points say more of where it is than its features.
        bounds.add(report!.block.points.subarray(6 * row, 6 * row + 3));
        bounds.add(report!.block.points.subarray(6 * row + 3, 6 * row + 6));
        growAround(bounds, Math.min(...[selection.a, selection.b].map((i) => surroundings(page.objects[i]!))));
      }
    }
    if (selection.type === 'pair') {
      const row = report?.rowOf(selection.a, selection.b) ?? -1;
      if (row < 0) [selection.a, selection.b].forEach(addObject);
      else addPair(bounds, viewer, row);
    }
    return bounds;
  }
}

/** How much of an object to show around one of its features: a few edges. */
function surroundings(object: ObjectState): number {
  const size = Math.hypot(...object.low.map((x, k) => object.high[k]! - x));
  return Math.min(0.5 * size, (3 * size) / Math.sqrt(Math.max(1, object.mesh.edgeCount)));
}

function growAround(bounds: Bounds, around: number): void {
  if (bounds.isEmpty) return;
  bounds.add(bounds.low, around);
  bounds.add(bounds.high, around);
}

function addPair(bounds: Bounds, viewer: Viewer, row: number): void {
  const { block } = viewer.report!;
  bounds.add(block.witnessPoints.subarray(6 * row, 6 * row + 3));
  bounds.add(block.witnessPoints.subarray(6 * row + 3, 6 * row + 6));
  for (let c = block.contactBegin[row]!; c < block.contactEnd[row]!; ++c) {
    bounds.add(block.points.subarray(6 * c, 6 * c + 3));
    bounds.add(block.points.subarray(6 * c + 3, 6 * c + 6));
  }
  const sweep = block.sweepOf(row);
  for (let i = sweep?.begin ?? 0; i < (sweep?.end ?? 0); ++i) {
    const meeting = meetingOf(viewer.page!, viewer.report!, i, row);
    if (meeting) bounds.add(meeting.place.toArray());
  }
  const sizes = [block.pairA[row]!, block.pairB[row]!].map((i) => {
    const object = viewer.page!.objects[i]!;
    return object.isThere ? Math.hypot(...object.low.map((x, k) => object.high[k]! - x)) : Infinity;
  });
  const around = Math.min(...sizes) * 0.35;
  if (Number.isFinite(around)) {
    bounds.add(bounds.low, around);
    bounds.add(bounds.high, around);
  }
}
