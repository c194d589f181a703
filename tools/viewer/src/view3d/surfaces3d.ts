// How is one object drawn: its faces, the edges over them, and what other objects hide of it?

import * as THREE from 'three';
import type { ObjectState } from '../data/motion';
import { channels, type Palette } from '../palette';

const CLIP = /* glsl */ `
  uniform vec4 clip;
  void clipPoint(vec3 p) { if (dot(p, clip.xyz) > clip.w) discard; }`;

const FACE_VERTEX = /* glsl */ `
  varying vec3 vPlace; varying vec3 vEye;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    vPlace = position; vEye = eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;

/** Faces are lit flat, from the derivatives of the place, so nothing has to be computed when they deform. */
const FACE_FRAGMENT = /* glsl */ `
  ${CLIP}
  uniform vec3 front; uniform vec3 back; uniform float opacity;
  varying vec3 vPlace; varying vec3 vEye;
  void main() {
    clipPoint(vPlace);
    vec3 n = normalize(cross(dFdx(vEye), dFdy(vEye)));
    float key = max(dot(n, normalize(vec3(-0.45, 0.6, 0.65))), 0.0);
    float fill = max(dot(n, normalize(vec3(0.7, -0.1, 0.5))), 0.0);
    vec3 base = gl_FrontFacing ? front : back;
    gl_FragColor = vec4(base * (0.5 + 0.5 * key + 0.16 * fill), opacity);
  }`;

const EDGE_VERTEX = /* glsl */ `
  varying vec3 vPlace;
  void main() {
    vPlace = position;
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    eye.xyz *= 0.9985;
    gl_Position = projectionMatrix * eye;
  }`;

const EDGE_FRAGMENT = /* glsl */ `
  ${CLIP}
  uniform vec3 colour; uniform float opacity;
  varying vec3 vPlace;
  void main() { clipPoint(vPlace); gl_FragColor = vec4(colour, opacity); }`;

export interface SurfaceLook {
  faces: boolean;
  edges: boolean;
  opacity: number;
  /** 0 is not selected, 1 the selected object or the first of a pair, 2 the second of a pair. */
  selected: number;
  /** Whether it is inside another object, through which it is seen then. */
  isInside: boolean;
}

/** How strongly an object is seen through the one that it is inside of. */
const GHOST = 0.5;

const colour3 = (colour: string) => new THREE.Vector3(...channels(colour).map((x) => x / 255));

export class SurfaceView {
  readonly object = new THREE.Group();
  private readonly place: THREE.BufferAttribute;
  private readonly faceGeometry = new THREE.BufferGeometry();
  private readonly edgeGeometry = new THREE.BufferGeometry();
  private readonly faceMaterial: THREE.ShaderMaterial;
  private readonly edgeMaterial: THREE.ShaderMaterial;
  private readonly ghostMaterial: THREE.ShaderMaterial;
  private readonly faces: THREE.Mesh;
  private readonly edges: THREE.LineSegments;
  private readonly ghost: THREE.Mesh;
  private readonly edgeLength: number;
  private shownVersion = -1;
  private hadHoles = false;
  private edgeOpacity = 0.5;

  constructor(private readonly state: ObjectState, private readonly origin: readonly number[], clip: THREE.Vector4) {
    const { mesh } = state;
    this.place = new THREE.BufferAttribute(new Float32Array(3 * mesh.vertexCount), 3);
    this.place.setUsage(THREE.DynamicDrawUsage);
    for (const geometry of [this.faceGeometry, this.edgeGeometry]) geometry.setAttribute('position', this.place);
    this.setIndices(mesh.drawn, mesh.edges);
    this.faceMaterial = new THREE.ShaderMaterial({
      vertexShader: FACE_VERTEX, fragmentShader: FACE_FRAGMENT, side: THREE.DoubleSide,
      uniforms: { clip: { value: clip }, front: { value: colour3('#ffffff') }, back: { value: colour3('#000000') },
                  opacity: { value: 1 } },
    });
    this.edgeMaterial = new THREE.ShaderMaterial({
      vertexShader: EDGE_VERTEX, fragmentShader: EDGE_FRAGMENT, transparent: true, depthWrite: false,
      uniforms: { clip: { value: clip }, colour: { value: colour3('#000000') }, opacity: { value: 1 } },
    });
    this.ghostMaterial = new THREE.ShaderMaterial({
      vertexShader: FACE_VERTEX, fragmentShader: FACE_FRAGMENT, transparent: true, depthWrite: false, depthFunc: THREE.GreaterDepth,
      uniforms: { clip: { value: clip }, front: { value: colour3('#ffffff') }, back: { value: colour3('#000000') },
                  opacity: { value: GHOST } },
    });
    this.faces = new THREE.Mesh(this.faceGeometry, this.faceMaterial);
    this.edges = new THREE.LineSegments(this.edgeGeometry, this.edgeMaterial);
    this.edges.renderOrder = 5;
    this.ghost = new THREE.Mesh(this.faceGeometry, this.ghostMaterial);
    this.ghost.renderOrder = 6;
    for (const object of [this.faces, this.edges, this.ghost]) {
      object.frustumCulled = false;
      this.object.add(object);
    }
    this.edgeLength = medianEdge(state);
  }

  /** Brings the vertices to where the object is now. */
  sync(): void {
    const { state, origin } = this;
    this.object.visible = state.isThere;
    if (!state.isThere || state.version === this.shownVersion) return;
    this.shownVersion = state.version;
    const { world } = state;
    const out = this.place.array as Float32Array;
    const [x, y, z] = [origin[0]!, origin[1]!, origin[2]!];
    for (let v = 0; v < out.length; v += 3) {
      out[v] = world[v]! - x;
      out[v + 1] = world[v + 1]! - y;
      out[v + 2] = world[v + 2]! - z;
    }
    this.place.needsUpdate = true;
    this.leaveHoles();
  }

  look(look: SurfaceLook, palette: Palette, isHidden: boolean): void {
    this.object.visible = this.state.isThere && !isHidden;
    this.faces.visible = look.faces;
    this.faceMaterial.uniforms.front!.value = colour3(palette.objects[this.state.index % palette.objects.length]!);
    this.faceMaterial.uniforms.back!.value = colour3(palette.back);
    this.ghost.visible = look.isInside && look.faces;
    this.ghostMaterial.uniforms.front!.value = colour3(palette.inside);
    this.faceMaterial.uniforms.opacity!.value = look.opacity;
    this.faceMaterial.transparent = look.opacity < 1;
    this.faceMaterial.depthWrite = look.opacity >= 1;
    const edge = look.selected === 1 ? palette.selected : look.selected === 2 ? palette.second : palette.edge;
    this.edgeMaterial.uniforms.colour!.value = colour3(look.faces || look.selected ? edge : palette.neutral);
    this.edgeOpacity = !look.edges && !look.selected ? 0 : look.selected ? 0.85 : look.faces ? 0.4 : 0.75;
  }

  get isGhost(): boolean {
    return this.object.visible && this.ghost.visible;
  }

  /** Edges fade where they are so dense on the screen that they would cover the faces. */
  fadeEdges(eye: THREE.Vector3, pixelsPerUnit: number): void {
    const centre = this.state.centre();
    const size = Math.hypot(...[0, 1, 2].map((k) => this.state.high[k]! - this.state.low[k]!)) / 2;
    const far = Math.hypot(...centre.map((x, k) => x - this.origin[k]! - eye.getComponent(k)));
    const pixels = (this.edgeLength * pixelsPerUnit) / Math.max(far - 0.7 * size, 0.05 * size, 1e-12);
    const fade = this.faces.visible ? Math.min(1, Math.max(0, (pixels - 4) / 8)) : Math.min(1, pixels / 4 + 0.15);
    this.edgeMaterial.uniforms.opacity!.value = this.edgeOpacity * fade;
    this.edges.visible = this.edgeOpacity * fade > 0.01;
  }

  dispose(): void {
    for (const part of [this.faceGeometry, this.edgeGeometry, this.faceMaterial, this.edgeMaterial, this.ghostMaterial]) part.dispose();
  }

  private setIndices(faces: Uint32Array, edges: Uint32Array): void {
    this.faceGeometry.setIndex(new THREE.BufferAttribute(faces, 1));
    this.edgeGeometry.setIndex(new THREE.BufferAttribute(edges, 1));
  }

  /** Faces and edges at vertices that are not finite are left out. */
  private leaveHoles(): void {
    const { mesh, notFinite } = this.state;
    if (notFinite.length === 0 && !this.hadHoles) return;
    this.hadHoles = notFinite.length > 0;
    const bad = new Set(notFinite);
    this.setIndices(without(mesh.drawn, 3, bad), without(mesh.edges, 2, bad));
  }
}

function without(index: Uint32Array, size: number, bad: Set<number>): Uint32Array {
  if (bad.size === 0) return index;
  const kept: number[] = [];
  for (let i = 0; i < index.length; i += size) {
    const corners = index.subarray(i, i + size);
    if (!corners.some((v) => bad.has(v))) kept.push(...corners);
  }
  return new Uint32Array(kept);
}

/** The median of some edges. A mean says little where a few edges are much longer than the others. */
function medianEdge({ mesh, world }: ObjectState): number {
  const step = Math.max(1, Math.floor(mesh.edgeCount / 500));
  const lengths: number[] = [];
  for (let e = 0; e < mesh.edgeCount; e += step) {
    const [v, w] = [3 * mesh.edges[2 * e]!, 3 * mesh.edges[2 * e + 1]!];
    const length = Math.hypot(world[v]! - world[w]!, world[v + 1]! - world[w + 1]!, world[v + 2]! - world[w + 2]!);
    if (Number.isFinite(length)) lengths.push(length);
  }
  return lengths.sort((p, q) => p - q)[lengths.length >> 1] ?? 1;
}
