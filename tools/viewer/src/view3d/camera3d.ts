// Where does the eye stand, and what does it fit into the picture?

import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

/** A box in the coordinates of the scene. */
export class Bounds {
  low = [Infinity, Infinity, Infinity];
  high = [-Infinity, -Infinity, -Infinity];

  add(point: ArrayLike<number>, grow = 0): void {
    for (let k = 0; k < 3; ++k) {
      if (!Number.isFinite(point[k])) return;
      this.low[k] = Math.min(this.low[k]!, point[k]! - grow);
      this.high[k] = Math.max(this.high[k]!, point[k]! + grow);
    }
  }

  get isEmpty(): boolean {
    return !(this.low[0]! <= this.high[0]!);
  }

  centre(): [number, number, number] {
    return this.low.map((x, k) => (x + this.high[k]!) / 2) as [number, number, number];
  }

  radius(): number {
    return Math.hypot(...this.low.map((x, k) => this.high[k]! - x)) / 2;
  }

  /** Makes the box at least so large. */
  widen(least: number): void {
    const grow = Math.max(0, least - this.radius());
    this.low = this.low.map((x) => x - grow);
    this.high = this.high.map((x) => x + grow);
  }
}

const FLIGHT_MS = 260;

export class Eye {
  readonly camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  readonly controls: OrbitControls;
  private flight: { began: number; from: [THREE.Vector3, THREE.Vector3]; to: [THREE.Vector3, THREE.Vector3] } | null = null;

  constructor(canvas: HTMLCanvasElement, private readonly onMove: () => void) {
    this.camera.up.set(0, 0, 1);
    this.controls = this.makeControls(canvas);
  }

  private makeControls(canvas: HTMLCanvasElement): OrbitControls {
    const controls = new OrbitControls(this.camera, canvas);
    controls.zoomToCursor = true;
    controls.screenSpacePanning = true;
    controls.zoomSpeed = 1.4;
    controls.addEventListener('change', () => this.onMove());
    controls.addEventListener('start', () => (this.flight = null));
    return controls;
  }

  get up(): 'y' | 'z' {
    return this.camera.up.y === 1 ? 'y' : 'z';
  }

  setUp(up: 'y' | 'z'): void {
    this.camera.up.set(0, up === 'y' ? 1 : 0, up === 'z' ? 1 : 0);
    // The controls take the up direction of the camera only when they are made.
    const controls = this.controls as unknown as { _quat: THREE.Quaternion; _quatInverse: THREE.Quaternion };
    controls._quat.setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    controls._quatInverse.copy(controls._quat).invert();
    this.controls.update();
    this.onMove();
  }

  /** Looks at a box from the present direction, or from the one given, as near as all its corners allow. */
  fit(low: readonly number[], high: readonly number[], direction?: THREE.Vector3, isSudden = false): void {
    const centre = new THREE.Vector3(...low.map((x, k) => (x + high[k]!) / 2));
    const away = direction ?? this.camera.position.clone().sub(this.controls.target);
    if (away.lengthSq() === 0) away.set(1, -1, 1);
    away.normalize();
    const place = centre.clone().addScaledVector(away, 1.06 * this.distanceFor(low, high, centre, away));
    const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (isSudden || isStill) this.place(place, centre);
    else {
      this.flight = { began: performance.now(), from: [this.camera.position.clone(), this.controls.target.clone()],
                      to: [place, centre] };
      this.onMove();
    }
  }

  private distanceFor(low: readonly number[], high: readonly number[], centre: THREE.Vector3, away: THREE.Vector3): number {
    const turn = new THREE.Matrix4().lookAt(away, new THREE.Vector3(), this.camera.up);
    const [right, up, back] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    turn.extractBasis(right, up, back);
    const tall = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    let most = 1e-9;
    for (let i = 0; i < 8; ++i) {
      const corner = new THREE.Vector3(...low.map((x, k) => (i >> k) & 1 ? high[k]! : x)).sub(centre);
      const sideways = Math.max(Math.abs(corner.dot(right)) / (tall * this.camera.aspect), Math.abs(corner.dot(up)) / tall);
      most = Math.max(most, sideways + corner.dot(back));
    }
    return most;
  }

  place(position: THREE.Vector3, target: THREE.Vector3): void {
    this.flight = null;
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.onMove();
  }

  /** Goes on with a flight. True while it lasts. */
  fly(): boolean {
    if (!this.flight) return false;
    const { began, from, to } = this.flight;
    const t = Math.min(1, (performance.now() - began) / FLIGHT_MS);
    const eased = t * t * (3 - 2 * t);
    this.camera.position.lerpVectors(from[0], to[0], eased);
    this.controls.target.lerpVectors(from[1], to[1], eased);
    if (t >= 1) this.flight = null;
    this.controls.update();
    return this.flight !== null;
  }

  /** Keeps the near and far planes close around the scene, so that depths stay distinct. */
  setDepths(radius: number): void {
    const far = this.camera.position.length();
    this.camera.near = Math.max(far - 2 * radius, 0.002 * Math.min(radius, this.distance()), 1e-9);
    this.camera.far = far + 3 * radius;
    this.camera.updateProjectionMatrix();
  }

  distance(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /** Turns, or moves along the screen, by shares of a half turn or of the distance. */
  turn(right: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const toY = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    const angles = new THREE.Spherical().setFromVector3(offset.applyQuaternion(toY));
    angles.theta += right * Math.PI;
    angles.phi = Math.min(Math.PI - 0.01, Math.max(0.01, angles.phi - up * Math.PI));
    offset.setFromSpherical(angles).applyQuaternion(toY.invert());
    this.place(this.controls.target.clone().add(offset), this.controls.target);
  }

  pan(right: number, up: number): void {
    const shift = new THREE.Vector3(right, up, 0).multiplyScalar(this.distance()).applyQuaternion(this.camera.quaternion);
    this.place(this.camera.position.clone().add(shift), this.controls.target.clone().add(shift));
  }

  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.place(this.controls.target.clone().add(offset), this.controls.target);
  }
}
