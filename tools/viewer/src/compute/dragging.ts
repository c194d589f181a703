// How does a drag in the picture move an object or a vertex, along the plane of the screen?

import * as THREE from 'three';
import { note } from '../panels/dom';
import { pickSurface } from '../view3d/picking';
import type { Stage } from '../view3d/scene3d';
import type { Computing } from './computing';

export class Dragging {
  private held: { object: number; vertex: number | null; plane: THREE.Plane; last: THREE.Vector3 } | null = null;
  private next: [x: number, y: number] | null = null;

  constructor(private readonly stage: Stage, private readonly computing: Computing) {
    const { canvas } = stage;
    // Before the camera's controls, which otherwise turn the view.
    canvas.addEventListener('pointerdown', (event) => this.take(event), true);
    canvas.addEventListener('pointermove', (event) => this.ask(event), true);
    for (const end of ['pointerup', 'pointercancel'] as const) canvas.addEventListener(end, () => this.drop(), true);
  }

  private take(event: PointerEvent): void {
    if (!this.computing.isOn || event.button !== 0 || event.shiftKey) return;
    const { stage } = this;
    const hit = pickSurface(stage, event.offsetX, event.offsetY);
    if (!hit) return;
    const movesVertex = this.computing.movesVertices && this.computing.isDeformable(hit.object);
    const across = stage.eye.camera.getWorldDirection(new THREE.Vector3());
    this.held = {
      object: hit.object, vertex: movesVertex ? this.nearestVertex(hit.object, hit.triangle, hit.place) : null,
      plane: new THREE.Plane().setFromNormalAndCoplanarPoint(across, hit.place), last: hit.place };
    stage.eye.controls.enabled = false;
    stage.canvas.setPointerCapture(event.pointerId);
  }

  private nearestVertex(object: number, triangle: number, place: THREE.Vector3): number {
    const { mesh, world } = this.stage.viewer.page!.objects[object]!;
    const away = (v: number) => place.distanceTo(new THREE.Vector3(...this.stage.local(world, 3 * v)));
    return [...mesh.drawn.subarray(3 * triangle, 3 * triangle + 3)].sort((p, q) => away(p) - away(q))[0]!;
  }

  /** A step for each picture is enough, however often the pointer moves. */
  private ask(event: PointerEvent): void {
    if (!this.held) return;
    const isAsked = this.next !== null;
    this.next = [event.offsetX, event.offsetY];
    if (!isAsked) requestAnimationFrame(() => this.follow());
  }

  private follow(): void {
    const { held, next, stage } = this;
    this.next = null;
    if (!held || !next) return;
    const { clientWidth, clientHeight } = stage.canvas;
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * next[0]) / clientWidth - 1, 1 - (2 * next[1]) / clientHeight), stage.eye.camera);
    const place = caster.ray.intersectPlane(held.plane, new THREE.Vector3());
    if (!place) return;
    const by = place.clone().sub(held.last).toArray();
    held.last = place;
    if (by.every((x) => x === 0)) return;
    try {
      this.computing.move(held.object, held.vertex, by);
    } catch (error) {
      note((error as Error).message, true);
    }
  }

  private drop(): void {
    if (!this.held) return;
    this.follow();
    this.held = null;
    this.stage.eye.controls.enabled = true;
  }
}
