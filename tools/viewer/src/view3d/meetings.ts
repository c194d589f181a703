// Where do two features meet between two steps, and which way do their vertices go until then?

import * as THREE from 'three';
import type { ObjectState } from '../data/motion';
import type { Page } from '../data/page';
import type { FrameReport } from '../data/report';

/** The corners of a feature where the step begins, and where it ends. */
export interface Way { object: number; vertices: number[]; from: THREE.Vector3[]; to: THREE.Vector3[] }

export interface Meeting {
  a: Way;
  b: Way;
  /** The time in the step: the middle of its two bounds. */
  time: number;
  /** Where the features are nearest to each other at this time. */
  place: THREE.Vector3;
}

/** Rounding of positions that have no error of their own, beside the size of what moves. */
const ROUNDING = 1e-9;

export function cornersAt({ from, to }: Way, time: number): THREE.Vector3[] {
  return from.map((corner, i) => corner.clone().lerp(to[i]!, time));
}

/** The meeting of an impact. It is null where the page has not where the step began, or where a vertex is not finite. */
export function meetingOf(page: Page, report: FrameReport, impact: number, pair: number): Meeting | null {
  const { block } = report;
  const [ka, ia, kb, ib] = block.impactFeatures.subarray(4 * impact, 4 * impact + 4) as unknown as [number, number, number, number];
  const [objectA, objectB] = [page.objects[block.pairA[pair]!]!, page.objects[block.pairB[pair]!]!];
  const [a, b] = [wayOf(objectA, ka, ia), wayOf(objectB, kb, ib)];
  if (!a || !b) return null;
  const [lower, upper] = [block.impactTimes[2 * impact]!, block.impactTimes[2 * impact + 1]!];
  const error = [objectA, objectB].reduce((sum, { index }) => sum + 2 * page.head.objects[index]!.position_error, 0);
  const size = Math.max(...[objectA, objectB].map(({ low, high }) => Math.hypot(...low.map((x, k) => high[k]! - x))));
  const longest = Math.max(lengthOf(a), lengthOf(b));
  const tolerance = error + (upper - lower) * longest + ROUNDING * (size + longest);
  return likeliest(a, b, (lower + upper) / 2, tolerance, objectA === objectB);
}

/**
 * A page does not say which objects jumped. One that did stood at its new place for the whole step. So where the features
 * do not meet if both have moved, one of them stood: the one with which they come nearest.
 */
function likeliest(a: Way, b: Way, time: number, tolerance: number, isOfSelf: boolean): Meeting {
  const ways: [Way, Way][] = [[a, b]];
  if (!isOfSelf) ways.push([a, standing(b)], [standing(a), b]);
  let best: Meeting | null = null;
  let least = Infinity;
  for (const [p, q] of ways) {
    const { place, distance } = nearest(cornersAt(p, time), cornersAt(q, time));
    if (best && distance >= least) continue;
    [best, least] = [{ a: p, b: q, time, place }, distance];
    if (distance <= tolerance) break;
  }
  return best!;
}

const standing = (way: Way): Way => ({ ...way, from: way.to });

function wayOf(object: ObjectState, kind: number, index: number): Way | null {
  const { before } = object;
  if (!before || !object.isThere) return null;
  const vertices = object.mesh.featureCorners(kind, index);
  const at = (world: Float64Array) => vertices.map((v) => new THREE.Vector3().fromArray(world, 3 * v));
  const [from, to] = [at(before), at(object.world)];
  const areFinite = [...from, ...to].every((p) => Number.isFinite(p.x + p.y + p.z));
  return areFinite ? { object: object.index, vertices, from, to } : null;
}

function lengthOf({ from, to }: Way): number {
  return Math.max(...from.map((p, i) => p.distanceTo(to[i]!)));
}

/** The middle between the closest points of a vertex and a face, or of two edges. */
function nearest(a: THREE.Vector3[], b: THREE.Vector3[]): { place: THREE.Vector3; distance: number } {
  const [p, q] = [new THREE.Vector3(), new THREE.Vector3()];
  if (a.length === 2 && b.length === 2) new THREE.Line3(a[0], a[1]).distanceSqToLine3(new THREE.Line3(b[0], b[1]), p, q);
  else if (a.length === 1) closestOfFace(a[0]!, b, p, q);
  else closestOfFace(b[0]!, a, p, q);
  return { place: p.clone().lerp(q, 0.5), distance: p.distanceTo(q) };
}

/** A quad is two triangles, split from its first corner. */
function closestOfFace(vertex: THREE.Vector3, face: THREE.Vector3[], onVertex: THREE.Vector3, onFace: THREE.Vector3): void {
  onVertex.copy(vertex);
  let least = Infinity;
  for (let i = 1; i + 1 < face.length; ++i) {
    const point = new THREE.Triangle(face[0], face[i], face[i + 1]).closestPointToPoint(vertex, new THREE.Vector3());
    const distance = point.distanceTo(vertex);
    if (distance >= least) continue;
    least = distance;
    onFace.copy(point);
  }
}
