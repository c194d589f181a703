// How does the 3D view come together: canvas, surfaces and overlays, drawn only when something changed?

import * as THREE from 'three';
import { Bounds, Eye } from './camera3d';
import { ContactsLayer } from './contacts3d';
import { objectsInside } from '../data/inside';
import { HighlightLayer } from './highlight3d';
import { ImpactsLayer } from './impacts3d';
import { LinesLayer } from './lines3d';
import { channels, palette } from '../palette';
import { SurfaceView } from './surfaces3d';
import type { Viewer } from '../viewer';
import { WaysLayer } from './ways3d';

/** A part of the picture that is drawn over the surfaces. */
export interface Layer {
  readonly objects: THREE.Object3D[];
  update(stage: Stage): void;
  resize?(width: number, height: number, ratio: number, near: number): void;
}

/** Where the processor has to draw, edges are not smoothed: that would take several times as long. */
function makeRenderer(canvas: HTMLCanvasElement): THREE.WebGLRenderer {
  const options = { antialias: true, alpha: false, powerPreference: 'high-performance' } as const;
  const context = canvas.getContext('webgl2', { ...options, failIfMajorPerformanceCaveat: true }) ??
    canvas.getContext('webgl2', { ...options, antialias: false });
  if (!context) throw new Error('This browser gives no WebGL 2, which the 3D view needs.');
  const renderer = new THREE.WebGLRenderer({ canvas, context: context as WebGL2RenderingContext });
  // Colours are written as they are on the screen.
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  // Asking for errors waits until each shader is ready.
  renderer.debug.checkShaderErrors = false;
  return renderer;
}

export class Stage {
  readonly eye: Eye;
  readonly contacts = new ContactsLayer();
  readonly lines = new LinesLayer();
  readonly ways = new WaysLayer();
  readonly impacts = new ImpactsLayer();
  readonly highlight = new HighlightLayer();
  /** The middle of the scene in the first frame. Everything is drawn relative to it, so that floats do. */
  origin: [number, number, number] = [0, 0, 0];
  radius = 1;
  renderMs: number[] = [];
  surfaces: SurfaceView[] = [];
  readonly afterRender: (() => void)[] = [];
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly clip = new THREE.Vector4(0, 0, 0, 1e30);
  private readonly layers: Layer[] = [this.lines, this.contacts, this.ways, this.impacts, this.highlight];
  private isAsked = false;
  private isWanted = false;
  private isStale = true;
  private size = '';
  /** The objects that the search names, or null without a search. */
  private named: Set<number> | null = null;

  constructor(readonly viewer: Viewer, readonly canvas: HTMLCanvasElement) {
    this.renderer = makeRenderer(canvas);
    this.eye = new Eye(canvas, () => {
      this.ask();
      viewer.emit('camera');
    });
    for (const layer of this.layers) this.scene.add(...layer.objects);
    viewer.on(['page'], () => this.openPage());
    viewer.on(['frame', 'selection', 'display', 'theme'], () => this.refresh());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  /** Asks for a picture in the next animation frame. */
  ask(): void {
    this.isWanted = true;
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      // Somebody may have drawn in the meantime.
      if (this.isWanted) this.draw();
    });
  }

  refresh(): void {
    this.isStale = true;
    this.named = this.viewer.namedObjects();
    this.ask();
  }

  /** Brings everything up to date and draws now. */
  draw(): void {
    const began = performance.now();
    this.isWanted = false;
    const isFlying = this.eye.fly();
    if (this.isStale) this.update();
    this.eye.setDepths(this.radius);
    this.setClip();
    const { height } = this.canvas;
    const pixelsPerUnit = height / (2 * Math.tan(THREE.MathUtils.degToRad(this.eye.camera.fov / 2)));
    for (const surface of this.surfaces) surface.fadeEdges(this.eye.camera.position, pixelsPerUnit);
    this.resizeLayers();
    this.renderer.render(this.scene, this.eye.camera);
    for (const listener of this.afterRender) listener();
    this.renderMs.push(performance.now() - began);
    if (this.renderMs.length > 200) this.renderMs.shift();
    if (isFlying) this.ask();
  }

  /** Colours of pixels as they are on the screen, for tests: rows from the bottom, four bytes each. */
  pixels(): { width: number; height: number; data: Uint8Array } {
    this.draw();
    const gl = this.renderer.getContext();
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const data = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return { width, height, data };
  }

  get ratio(): number {
    return this.renderer.getPixelRatio();
  }

  local(point: ArrayLike<number>, at = 0): [number, number, number] {
    return [point[at]! - this.origin[0], point[at + 1]! - this.origin[1], point[at + 2]! - this.origin[2]];
  }

  isDrawn(object: number): boolean {
    return !!this.viewer.page?.objects[object]?.isThere && !this.isHidden(object);
  }

  /** Objects are hidden one by one, or by a search that names others. */
  private isHidden(object: number): boolean {
    return this.viewer.display.hiddenObjects.has(object) || this.named?.has(object) === false;
  }

  /** Whether the clip plane leaves a point, given relative to the origin. */
  isClipped(p: readonly number[]): boolean {
    return p[0]! * this.clip.x + p[1]! * this.clip.y + p[2]! * this.clip.z > this.clip.w;
  }

  fitAll(isSudden = false, direction?: THREE.Vector3): void {
    const bounds = this.sceneBounds();
    if (bounds.isEmpty) return;
    this.eye.fit(this.local(bounds.low), this.local(bounds.high), direction, isSudden);
  }

  fitSelection(): void {
    const bounds = this.highlight.boundsOf(this.viewer);
    if (!bounds || bounds.isEmpty) return this.fitAll();
    bounds.widen(0.004 * this.radius);
    this.eye.fit(this.local(bounds.low), this.local(bounds.high));
  }

  sceneBounds(): Bounds {
    const bounds = new Bounds();
    for (const object of this.viewer.page?.objects ?? []) {
      if (!this.isDrawn(object.index)) continue;
      bounds.add(object.low);
      bounds.add(object.high);
    }
    return bounds;
  }

  private openPage(): void {
    this.named = null;
    for (const surface of this.surfaces) {
      this.scene.remove(surface.object);
      surface.dispose();
    }
    const bounds = this.sceneBounds();
    this.origin = bounds.isEmpty ? [0, 0, 0] : bounds.centre();
    this.surfaces = this.viewer.page!.objects.map((state) => new SurfaceView(state, this.origin, this.clip));
    for (const surface of this.surfaces) this.scene.add(surface.object);
    this.viewer.display.up = this.guessUp();
    const { up } = this.viewer.display;
    this.eye.setUp(up);
    const start = this.startBounds(bounds);
    // A ground around what moves is looked at from higher up, so that its rim hides nothing.
    const height = start === bounds ? 0.8 : 1.3;
    if (!start.isEmpty)
      this.eye.fit(this.local(start.low), this.local(start.high),
        up === 'z' ? new THREE.Vector3(0.75, -1.25, height) : new THREE.Vector3(0.75, height, 1.25), true);
    this.refresh();
  }

  /** What the first picture shows: all objects, or those that move where a fixed one is much larger than they are together. */
  private startBounds(all: Bounds): Bounds {
    const moving = new Bounds();
    for (const object of this.viewer.page!.objects) {
      if (!this.isDrawn(object.index) || this.viewer.page!.head.objects[object.index]!.motion === 'fixed') continue;
      moving.add(object.low);
      moving.add(object.high);
    }
    return moving.isEmpty || all.radius() < 1.3 * moving.radius() ? all : moving;
  }

  /** The axis across the largest flat object, which is likely a ground; z where there is none. */
  private guessUp(): 'y' | 'z' {
    let up: 'y' | 'z' = 'z';
    let most = 0;
    for (const object of this.viewer.page!.objects) {
      const size = [0, 1, 2].map((k) => object.high[k]! - object.low[k]!);
      const thin = size.indexOf(Math.min(...size));
      const [p, q] = size.filter((_, k) => k !== thin) as [number, number];
      if (thin === 0 || size[thin]! > 0.12 * Math.min(p, q) || p * q <= most) continue;
      most = p * q;
      up = thin === 1 ? 'y' : 'z';
    }
    return up;
  }

  private update(): void {
    this.isStale = false;
    const { page, display, selection } = this.viewer;
    const colours = palette();
    this.renderer.setClearColor(new THREE.Color(...channels(colours.background).map((x) => x / 255)));
    if (!page) return;
    const chosen = this.viewer.selectedObjects();
    const inside = display.insides && this.viewer.report ? objectsInside(this.viewer.report) : new Set<number>();
    this.surfaces.forEach((surface, i) => {
      surface.sync();
      const selected = selection?.type === 'object' || selection?.type === 'pair' ? chosen.indexOf(i) + 1 : 0;
      const look = { faces: display.surfaces, edges: display.edges, opacity: display.opacity, selected, isInside: inside.has(i) };
      surface.look(look, colours, this.isHidden(i));
    });
    this.measure();
    for (const layer of this.layers) layer.update(this);
  }

  /** The radius of all that is drawn, around the origin. It only grows while the scene stays about the same. */
  private measure(): void {
    const bounds = this.sceneBounds();
    if (bounds.isEmpty) return;
    const corners = [0, 1, 2].map((k) => Math.max(Math.abs(bounds.low[k]! - this.origin[k]!), Math.abs(bounds.high[k]! - this.origin[k]!)));
    this.radius = Math.max(Math.hypot(...corners), 1e-9);
  }

  private setClip(): void {
    const { display } = this.viewer;
    if (!display.clip) {
      this.clip.set(0, 0, 0, 1e30);
      return;
    }
    const normal = new THREE.Vector3();
    if (display.clipAxis === 'view') this.eye.camera.getWorldDirection(normal).negate();
    else normal.setComponent('xyz'.indexOf(display.clipAxis), 1);
    const bounds = this.sceneBounds();
    const centre = bounds.isEmpty ? [0, 0, 0] : this.local(bounds.centre());
    const half = bounds.isEmpty ? 1 : display.clipAxis === 'view' ? bounds.radius()
      : (bounds.high['xyz'.indexOf(display.clipAxis)]! - bounds.low['xyz'.indexOf(display.clipAxis)]!) / 2;
    const middle = centre[0]! * normal.x + centre[1]! * normal.y + centre[2]! * normal.z;
    const offset = middle + (2 * display.clipAt - 1) * half * 1.001;
    const sign = display.clipFlipped ? -1 : 1;
    this.clip.set(sign * normal.x, sign * normal.y, sign * normal.z, sign * offset);
  }

  private resize(): void {
    const box = this.canvas.parentElement!.getBoundingClientRect();
    const [width, height] = [Math.max(1, box.width), Math.max(1, box.height)];
    const size = `${width} ${height} ${devicePixelRatio}`;
    if (size === this.size) return;
    this.size = size;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.eye.camera.aspect = width / height;
    this.eye.camera.updateProjectionMatrix();
    // A new size empties the canvas. It is drawn before the browser shows it.
    this.isStale = true;
    this.draw();
  }

  private resizeLayers(): void {
    const { width, height } = this.canvas;
    for (const layer of this.layers) layer.resize?.(width / this.ratio, height / this.ratio, this.ratio, this.eye.camera.near);
  }
}
