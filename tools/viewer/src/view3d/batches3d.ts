// How are many points, segments and spheres drawn in one call each?

import * as THREE from 'three';
import { channels } from '../palette';

export type Vec3 = readonly [number, number, number];

/** Shapes of a point. What they mean is said where they are used. */
export const SHAPE = { disc: 0, ring: 1, diamond: 2, small: 3, warning: 4, halo: 5, cross: 6 } as const;

/** Points and segments lie on surfaces. Drawn this little nearer to the eye, they are not cut by them. */
const PULL = 0.996;
/** What lies behind a surface is drawn too, this much fainter. */
const BEHIND = 0.4;

const POINT_VERTEX = /* glsl */ `
  attribute vec4 tint; attribute float shape; attribute float size;
  uniform float ratio; uniform float pull;
  varying vec4 vTint; varying float vShape; varying float vSize;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    eye.xyz *= pull;
    gl_Position = projectionMatrix * eye;
    gl_PointSize = size * ratio;
    vTint = tint; vShape = shape; vSize = size * ratio;
  }`;

const POINT_FRAGMENT = /* glsl */ `
  uniform vec3 outline; uniform float opacity; uniform float ratio;
  varying vec4 vTint; varying float vShape; varying float vSize;
  void main() {
    vec2 p = (gl_PointCoord - 0.5) * vSize;
    float r = 0.5 * vSize - ratio;
    float d = length(p) - r;
    if (vShape > 1.5 && vShape < 2.5) d = (abs(p.x) + abs(p.y)) * 0.8 - r * 0.9;
    if (vShape > 3.5 && vShape < 4.5) d = max(abs(p.x) * 0.87 - p.y * 0.5, p.y) - r * 0.55;
    if (vShape > 5.5) d = max(min(abs(p.x - p.y), abs(p.x + p.y)) * 0.707 - 0.38 * r, max(abs(p.x), abs(p.y)) - 0.8 * r);
    float cover = clamp(0.5 - d, 0.0, 1.0);
    float border = min(1.2 * ratio, 0.09 * vSize);
    float inner = clamp(0.5 - (d + border), 0.0, 1.0);
    vec3 colour = mix(outline, vTint.rgb, inner);
    if (vShape > 0.5 && vShape < 1.5) {
      float hole = clamp(0.5 - (d + 0.5 * r + border * 0.5), 0.0, 1.0);
      colour = mix(colour, outline, hole);
    }
    if (vShape > 3.5 && vShape < 4.5) {
      float mark = step(abs(p.x), 0.09 * r + 0.5) * step(abs(p.y + 0.02 * r), 0.3 * r);
      colour = mix(colour, outline, mark);
    }
    if (vShape > 4.5 && vShape < 5.5) { cover *= 1.0 - clamp(0.5 - (d + 2.5 * ratio), 0.0, 1.0); colour = vTint.rgb; }
    float alpha = cover * vTint.a * opacity;
    if (alpha < 0.02) discard;
    gl_FragColor = vec4(colour, alpha);
  }`;

const SEGMENT_VERTEX = /* glsl */ `
  attribute vec3 start; attribute vec3 end; attribute vec4 tint;
  uniform vec2 resolution; uniform float width; uniform float pull; uniform float near; uniform float taper;
  varying vec4 vTint; varying float vAcross; varying float vWidth;
  void main() {
    vec4 a = modelViewMatrix * vec4(start, 1.0);
    vec4 b = modelViewMatrix * vec4(end, 1.0);
    a.xyz *= pull; b.xyz *= pull;
    if (a.z > -near && b.z < -near) a = mix(a, b, (a.z + near) / (a.z - b.z));
    if (b.z > -near && a.z < -near) b = mix(b, a, (b.z + near) / (b.z - a.z));
    vec4 ca = projectionMatrix * a;
    vec4 cb = projectionMatrix * b;
    vec2 along = (cb.xy / cb.w - ca.xy / ca.w) * resolution;
    along = length(along) < 1e-6 ? vec2(1.0, 0.0) : normalize(along);
    vec4 clip = position.y < 0.5 ? ca : cb;
    vWidth = width * (1.0 - taper * position.y);
    float half_width = 0.5 * vWidth + 0.5;
    clip.xy += vec2(-along.y, along.x) * position.x * 2.0 * half_width / resolution * clip.w;
    gl_Position = clip;
    vTint = tint; vAcross = position.x * half_width;
  }`;

const SEGMENT_FRAGMENT = /* glsl */ `
  uniform float opacity;
  varying vec4 vTint; varying float vAcross; varying float vWidth;
  void main() {
    float cover = clamp(0.5 * vWidth + 0.5 - abs(vAcross), 0.0, 1.0);
    gl_FragColor = vec4(vTint.rgb, vTint.a * opacity * cover);
  }`;

const SPHERE_VERTEX = /* glsl */ `
  attribute vec4 ball; attribute vec4 tint;
  varying vec4 vTint;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(ball.xyz + ball.w * position, 1.0);
    vTint = tint;
  }`;

const SPHERE_FRAGMENT = /* glsl */ `
  uniform float opacity;
  varying vec4 vTint;
  void main() { gl_FragColor = vec4(vTint.rgb, vTint.a * opacity); }`;

type Uniforms = Record<string, THREE.IUniform>;

function overlay(vertexShader: string, fragmentShader: string, uniforms: Uniforms, behind: boolean, hidden = BEHIND): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexShader, fragmentShader, transparent: true, depthWrite: false, side: THREE.DoubleSide,
    uniforms: { ...uniforms, opacity: { value: behind ? hidden : 1 } },
    depthFunc: behind ? THREE.GreaterDepth : THREE.LessEqualDepth,
  });
}

/** An attribute that grows as it is filled. */
class Column {
  values: Float32Array | Uint8Array;
  attribute: THREE.BufferAttribute;

  constructor(private readonly geometry: THREE.BufferGeometry, private readonly name: string,
              private readonly size: number, private readonly isByte: boolean, private readonly isInstanced: boolean) {
    this.values = isByte ? new Uint8Array(0) : new Float32Array(0);
    this.attribute = this.make(64);
  }

  private make(count: number): THREE.BufferAttribute {
    const grown = this.isByte ? new Uint8Array(count * this.size) : new Float32Array(count * this.size);
    grown.set(this.values);
    // The renderer remembers how many instances the old arrays had room for, until the geometry is disposed of.
    this.geometry.dispose();
    this.values = grown;
    const Kind = this.isInstanced ? THREE.InstancedBufferAttribute : THREE.BufferAttribute;
    const attribute = new Kind(grown, this.size, this.isByte);
    attribute.setUsage(THREE.DynamicDrawUsage);
    this.geometry.setAttribute(this.name, attribute);
    return attribute;
  }

  write(index: number, ...values: number[]): void {
    const count = this.values.length / this.size;
    if (index >= count) this.attribute = this.make(2 * count);
    this.values.set(values, index * this.size);
  }

  finish(count: number): void {
    this.attribute.clearUpdateRanges();
    this.attribute.addUpdateRange(0, count * this.size);
    this.attribute.needsUpdate = true;
  }
}

/** The two ways in which overlays are drawn: in front of surfaces, and fainter behind them. */
function twice(make: (behind: boolean) => THREE.Object3D, order: number): THREE.Group {
  const group = new THREE.Group();
  for (const behind of [true, false]) {
    const object = make(behind);
    object.frustumCulled = false;
    object.renderOrder = order + (behind ? 0 : 1);
    group.add(object);
  }
  return group;
}

export class PointBatch {
  readonly object: THREE.Group;
  count = 0;
  private readonly geometry = new THREE.BufferGeometry();
  private readonly places = new Column(this.geometry, 'position', 3, false, false);
  private readonly tints = new Column(this.geometry, 'tint', 4, true, false);
  private readonly shapes = new Column(this.geometry, 'shape', 1, false, false);
  private readonly sizes = new Column(this.geometry, 'size', 1, false, false);
  private readonly uniforms = { ratio: { value: 1 }, pull: { value: PULL }, outline: { value: new THREE.Vector3() } };

  constructor(order: number) {
    this.object = twice((behind) => new THREE.Points(
      this.geometry, overlay(POINT_VERTEX, POINT_FRAGMENT, this.uniforms, behind)), order);
  }

  clear(): void {
    this.count = 0;
  }

  add(at: Vec3, colour: string, shape: number, size: number, alpha = 255): void {
    const i = this.count++;
    this.places.write(i, at[0], at[1], at[2]);
    this.tints.write(i, ...channels(colour), alpha);
    this.shapes.write(i, shape);
    this.sizes.write(i, size);
  }

  finish(ratio: number, outline: string): void {
    for (const column of [this.places, this.tints, this.shapes, this.sizes]) column.finish(this.count);
    this.geometry.setDrawRange(0, this.count);
    this.uniforms.ratio.value = ratio;
    this.uniforms.outline.value.fromArray(channels(outline).map((x) => x / 255));
    this.object.visible = this.count > 0;
  }
}

export class SegmentBatch {
  readonly object: THREE.Group;
  count = 0;
  private readonly geometry = new THREE.InstancedBufferGeometry();
  private readonly starts: Column;
  private readonly ends: Column;
  private readonly tints: Column;
  private readonly uniforms: { resolution: { value: THREE.Vector2 }; width: { value: number }; pull: { value: number };
                               near: { value: number }; taper: { value: number } };

  /** Segments that are pointed narrow to nothing at their end. `hidden` is how strong they are behind a surface. */
  constructor(order: number, private readonly width: number, isPointed = false, hidden = BEHIND) {
    this.uniforms = { resolution: { value: new THREE.Vector2(1, 1) }, width: { value: width }, pull: { value: PULL },
                      near: { value: 0.01 }, taper: { value: isPointed ? 1 : 0 } };
    this.geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, 0, 0, 1, 0, 0, 1, 1, 0, -1, 1, 0], 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.starts = new Column(this.geometry, 'start', 3, false, true);
    this.ends = new Column(this.geometry, 'end', 3, false, true);
    this.tints = new Column(this.geometry, 'tint', 4, true, true);
    this.object = twice((behind) => new THREE.Mesh(
      this.geometry, overlay(SEGMENT_VERTEX, SEGMENT_FRAGMENT, this.uniforms, behind, hidden)), order);
  }

  clear(): void {
    this.count = 0;
  }

  add(from: Vec3, to: Vec3, colour: string, alpha = 255): void {
    const i = this.count++;
    this.starts.write(i, from[0], from[1], from[2]);
    this.ends.write(i, to[0], to[1], to[2]);
    this.tints.write(i, ...channels(colour), alpha);
  }

  finish(): void {
    for (const column of [this.starts, this.ends, this.tints]) column.finish(this.count);
    this.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
  }

  resize(width: number, height: number, ratio: number, near: number): void {
    this.uniforms.resolution.value.set(width * ratio, height * ratio);
    this.uniforms.width.value = this.width * ratio;
    this.uniforms.near.value = near;
  }
}

/** Spheres, as three circles each or as translucent balls. */
export class SphereBatch {
  readonly object = new THREE.Group();
  count = 0;
  private readonly circles = new THREE.InstancedBufferGeometry();
  private readonly balls = new THREE.InstancedBufferGeometry();
  private readonly columns: Column[];
  private readonly ballColumn: Column;
  private readonly tintColumn: Column;

  constructor(order: number) {
    this.circles.setAttribute('position', new THREE.Float32BufferAttribute(threeCircles(48), 3));
    const ball = new THREE.IcosahedronGeometry(1, 4);
    this.balls.setAttribute('position', ball.getAttribute('position'));
    this.balls.setIndex(ball.getIndex());
    this.ballColumn = new Column(this.circles, 'ball', 4, false, true);
    this.tintColumn = new Column(this.circles, 'tint', 4, true, true);
    this.columns = [this.ballColumn, this.tintColumn];
    const lines = new THREE.LineSegments(this.circles, overlay(SPHERE_VERTEX, SPHERE_FRAGMENT, {}, false));
    lines.material.uniforms.opacity!.value = 0.55;
    const faces = new THREE.Mesh(this.balls, overlay(SPHERE_VERTEX, SPHERE_FRAGMENT, {}, false));
    (faces.material as THREE.ShaderMaterial).side = THREE.FrontSide;
    (faces.material as THREE.ShaderMaterial).uniforms.opacity!.value = 0.14;
    for (const object of [lines, faces]) {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.object.add(object);
    }
  }

  clear(): void {
    this.count = 0;
  }

  add(centre: Vec3, radius: number, colour: string): void {
    const i = this.count++;
    this.ballColumn.write(i, centre[0], centre[1], centre[2], radius);
    this.tintColumn.write(i, ...channels(colour), 255);
  }

  finish(areBalls: boolean): void {
    for (const column of this.columns) column.finish(this.count);
    if (this.balls.getAttribute('ball') !== this.ballColumn.attribute) this.balls.dispose();
    this.balls.setAttribute('ball', this.ballColumn.attribute);
    this.balls.setAttribute('tint', this.tintColumn.attribute);
    this.circles.instanceCount = this.balls.instanceCount = this.count;
    this.object.visible = this.count > 0;
    this.object.children[1]!.visible = areBalls;
  }
}

function threeCircles(parts: number): number[] {
  const out: number[] = [];
  for (let axis = 0; axis < 3; ++axis)
    for (let i = 0; i < 2 * parts; ++i) {
      const angle = (2 * Math.PI * ((i + 1) >> 1)) / parts;
      const point = [0, 0, 0];
      point[axis] = Math.cos(angle);
      point[(axis + 1) % 3] = Math.sin(angle);
      out.push(...point);
    }
  return out;
}
