// What are the faces, edges and regions of a mesh?

import type { Table } from './chunks';

export class Mesh {
  readonly triangles: Uint32Array;
  readonly quads: Uint32Array;
  readonly edges: Uint32Array;
  readonly rest: Float64Array;
  readonly regionLevel: Uint8Array;
  readonly regionMiddle: Uint32Array;
  /** Corners of all triangles to draw: those of the mesh, then two for each quad, split from its first corner. */
  readonly drawn: Uint32Array;
  private readonly faceOrder: Uint32Array | null;
  private readonly faceOfSlot: Uint32Array | null;
  private readonly regionBegin: Uint32Array;
  private readonly regionEnd: Uint32Array;
  private readonly regionVertices: Uint32Array;

  constructor(table: Table) {
    this.triangles = table.u32('triangles');
    this.quads = table.u32('quads');
    this.edges = table.u32('edges');
    this.rest = table.f64('rest');
    this.regionLevel = table.u8('region_level');
    this.regionMiddle = table.u32('region_middle');
    this.regionBegin = table.u32('region_begin');
    this.regionEnd = table.u32('region_end');
    this.regionVertices = table.u32('region_vertices');
    this.faceOrder = table.has('face_order') ? table.u32('face_order') : null;
    this.faceOfSlot = this.faceOrder && invert(this.faceOrder);
    this.drawn = splitQuads(this.triangles, this.quads);
  }

  get vertexCount(): number { return this.rest.length / 3; }
  get edgeCount(): number { return this.edges.length / 2; }
  get faceCount(): number { return this.triangles.length / 3 + this.quads.length / 4; }

  /** The corners of a face, in the caller's numbering. */
  faceCorners(face: number): number[] {
    const slot = this.faceOrder ? this.faceOrder[face]! : face;
    const count = this.triangles.length / 3;
    if (slot < count) return [...this.triangles.subarray(3 * slot, 3 * slot + 3)];
    return [...this.quads.subarray(4 * (slot - count), 4 * (slot - count) + 4)];
  }

  /** The face, in the caller's numbering, to which a drawn triangle belongs. */
  faceOfDrawn(triangle: number): number {
    const count = this.triangles.length / 3;
    const slot = triangle < count ? triangle : count + ((triangle - count) >> 1);
    return this.faceOfSlot ? this.faceOfSlot[slot]! : slot;
  }

  /** The corners of a feature: kind 0 is a vertex, 1 an edge, 2 a face. */
  featureCorners(kind: number, index: number): number[] {
    if (kind === 0) return [index];
    if (kind === 1) return [this.edges[2 * index]!, this.edges[2 * index + 1]!];
    return this.faceCorners(index);
  }

  edgeBetween(v: number, w: number): number {
    const [low, high] = v < w ? [v, w] : [w, v];
    for (let e = 0; e < this.edgeCount; ++e) {
      const [p, q] = [this.edges[2 * e]!, this.edges[2 * e + 1]!];
      if ((p === low && q === high) || (p === high && q === low)) return e;
    }
    return -1;
  }

  /** The regions to show for a level: those of the level, and leaves above it. */
  regionsAtLevel(level: number): number[] {
    const found: number[] = [];
    for (let r = 0; r < this.regionLevel.length; ++r) if (this.regionLevel[r] === level) found.push(r);
    return found;
  }

  /** The largest distance of a region's vertices from its middle vertex. Vertices that are not finite are left out. */
  regionRadius(region: number, world: Float64Array): number {
    const m = 3 * this.regionMiddle[region]!;
    const [x, y, z] = [world[m]!, world[m + 1]!, world[m + 2]!];
    let most = 0;
    for (let i = this.regionBegin[region]!; i < this.regionEnd[region]!; ++i) {
      const v = 3 * this.regionVertices[i]!;
      const squared = (world[v]! - x) ** 2 + (world[v + 1]! - y) ** 2 + (world[v + 2]! - z) ** 2;
      if (squared > most) most = squared;
    }
    return Math.sqrt(most);
  }
}

function invert(order: Uint32Array): Uint32Array {
  const inverse = new Uint32Array(order.length);
  order.forEach((slot, face) => (inverse[slot] = face));
  return inverse;
}

function splitQuads(triangles: Uint32Array, quads: Uint32Array): Uint32Array {
  if (quads.length === 0) return triangles;
  const drawn = new Uint32Array(triangles.length + (quads.length / 4) * 6);
  drawn.set(triangles);
  for (let q = 0, at = triangles.length; q < quads.length; q += 4, at += 6) {
    const [a, b, c, d] = [quads[q]!, quads[q + 1]!, quads[q + 2]!, quads[q + 3]!];
    drawn.set([a, b, c, a, c, d], at);
  }
  return drawn;
}
