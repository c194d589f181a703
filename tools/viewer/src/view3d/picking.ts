// What is under the pointer: a contact, a line of a pair, a feature or an object?

import * as THREE from 'three';
import type { Vec3 } from './batches3d';
import type { Stage } from './scene3d';
import type { PickMode, Selection } from '../viewer';

const NEAR_PIXELS = 9;

interface SurfaceHit { object: number; triangle: number; place: THREE.Vector3; distance: number }

/** Places on the screen, in pixels of the page. */
export class Screen {
  private readonly matrix: THREE.Matrix4;
  private readonly width: number;
  private readonly height: number;

  constructor(stage: Stage) {
    const { camera } = stage.eye;
    camera.updateMatrixWorld();
    this.matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.width = stage.canvas.clientWidth;
    this.height = stage.canvas.clientHeight;
  }

  /** x, y in pixels and the distance from the eye; null behind the eye. */
  at(point: Vec3): [number, number, number] | null {
    const p = new THREE.Vector4(point[0], point[1], point[2], 1).applyMatrix4(this.matrix);
    if (p.w <= 0) return null;
    return [((p.x / p.w + 1) / 2) * this.width, ((1 - p.y / p.w) / 2) * this.height, p.w];
  }
}

export function pick(stage: Stage, x: number, y: number, mode: PickMode): Selection | null {
  const contact = mode === 'auto' || mode === 'contact' ? pickContact(stage, x, y) : null;
  if (contact) return contact;
  const pair = mode === 'auto' || mode === 'pair' ? pickPair(stage, x, y) : null;
  if (pair) return pair;
  if (mode === 'contact' || mode === 'pair') return null;
  const hit = pickSurface(stage, x, y);
  if (!hit) return null;
  return mode === 'feature' ? featureAt(stage, hit, x, y) : { type: 'object', object: hit.object };
}

/** The contact nearest to the pointer. Of some equally near ones, that nearest to the eye. */
function pickContact(stage: Stage, x: number, y: number): Selection | null {
  const screen = new Screen(stage);
  let best = -1;
  let least = Infinity;
  stage.contacts.places.forEach((place, i) => {
    const p = screen.at(place);
    if (!p) return;
    const away = Math.hypot(p[0] - x, p[1] - y);
    if (away > NEAR_PIXELS) return;
    const rank = Math.round(away / 2) + p[2] * 1e-6;
    if (rank < least) [least, best] = [rank, i];
  });
  if (best < 0) return null;
  const [contact, pair] = stage.contacts.shown[best]!;
  return stage.viewer.contactSelection(contact, pair);
}

function pickPair(stage: Stage, x: number, y: number): Selection | null {
  const screen = new Screen(stage);
  let best = -1;
  let least = 6;
  const lines = [...stage.lines.shown, ...stage.ways.shown, ...stage.impacts.shown];
  lines.forEach((line, i) => {
    const [p, q] = [screen.at(line.a), screen.at(line.b)];
    if (!p || !q) return;
    const away = distanceToSegment(x, y, p, q);
    if (away < least) [least, best] = [away, i];
  });
  if (best < 0) return null;
  const { block } = stage.viewer.report!;
  const { pair } = lines[best]!;
  return { type: 'pair', a: block.pairA[pair]!, b: block.pairB[pair]! };
}

function distanceToSegment(x: number, y: number, p: readonly number[], q: readonly number[]): number {
  const [dx, dy] = [q[0]! - p[0]!, q[1]! - p[1]!];
  const squared = dx * dx + dy * dy;
  const t = squared > 0 ? Math.min(1, Math.max(0, ((x - p[0]!) * dx + (y - p[1]!) * dy) / squared)) : 0;
  return Math.hypot(x - p[0]! - t * dx, y - p[1]! - t * dy);
}

export function pickSurface(stage: Stage, x: number, y: number): SurfaceHit | null {
  const { clientWidth, clientHeight } = stage.canvas;
  const caster = new THREE.Raycaster();
  caster.setFromCamera(new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), stage.eye.camera);
  let best: SurfaceHit | null = null;
  for (const object of stage.viewer.page?.objects ?? []) {
    if (!stage.isDrawn(object.index)) continue;
    const hit = castAt(stage, object.index, caster.ray, best?.distance ?? Infinity);
    if (hit) best = hit;
  }
  return best;
}

/** Tests all triangles of an object. Only a click does this, so there is no tree. */
function castAt(stage: Stage, index: number, ray: THREE.Ray, nearerThan: number): SurfaceHit | null {
  const object = stage.viewer.page!.objects[index]!;
  const box = new THREE.Box3(new THREE.Vector3(...stage.local(object.low)), new THREE.Vector3(...stage.local(object.high)));
  if (!ray.intersectsBox(box.expandByScalar(1e-9))) return null;
  const { drawn } = object.mesh;
  const { world } = object;
  const [ox, oy, oz] = stage.origin;
  const corners = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()] as const;
  const place = new THREE.Vector3();
  let best: SurfaceHit | null = null;
  let least = nearerThan;
  for (let t = 0; t < drawn.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const v = 3 * drawn[t + k]!;
      corners[k]!.set(world[v]! - ox, world[v + 1]! - oy, world[v + 2]! - oz);
    }
    if (!ray.intersectTriangle(...corners, false, place)) continue;
    const distance = place.distanceTo(ray.origin);
    if (!(distance < least) || stage.isClipped(place.toArray())) continue;
    least = distance;
    best = { object: index, triangle: t / 3, place: place.clone(), distance };
  }
  return best;
}

/** The vertex near the pointer, else the edge near it, else the face. */
function featureAt(stage: Stage, hit: SurfaceHit, x: number, y: number): Selection {
  const screen = new Screen(stage);
  const { mesh, world } = stage.viewer.page!.objects[hit.object]!;
  const face = mesh.faceOfDrawn(hit.triangle);
  const corners = mesh.faceCorners(face);
  const places = corners.map((v) => screen.at(stage.local(world, 3 * v)));
  const { object } = hit;
  for (const [i, p] of places.entries())
    if (p && Math.hypot(p[0] - x, p[1] - y) < 8) return { type: 'feature', object, kind: 0, index: corners[i]! };
  for (const [i, p] of places.entries()) {
    const j = (i + 1) % corners.length;
    const q = places[j];
    if (!p || !q || distanceToSegment(x, y, p, q) > 5) continue;
    const edge = mesh.edgeBetween(corners[i]!, corners[j]!);
    if (edge >= 0) return { type: 'feature', object, kind: 1, index: edge };
  }
  return { type: 'feature', object, kind: 2, index: face };
}
