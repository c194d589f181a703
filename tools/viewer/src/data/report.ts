// What does the report of a frame say?

import type { Table } from './chunks';

export const PHASES = ['near', 'began', 'touching', 'ended'] as const;
export const KINDS = ['VV', 'VE', 'VF', 'EE', 'EF', 'FF'] as const;
export const SIDES = ['none', 'front', 'back'] as const;
export const FEATURE_KINDS = ['vertex', 'edge', 'face'] as const;
export const IMPACT_STATUSES = ['certain', 'possible', 'at_start'] as const;
/** In the sides of a contact: two edges are sunk. */
const SUNK = 16;

export interface Diagnostic { frame: number; object: number | null; kind: string; message: string }
/** How b leaves a where the surfaces of a pair pass through each other. A direction of zeros is none. */
export interface WayOut {
  direction: [number, number, number];
  point: [number, number, number];
  fullness: number;
  thickness: number;
  extent: number;
}
/** When the surfaces of a pair meet or come near between two steps, and its rows of impacts. */
export interface Sweep { timeOfImpact: number; timeOfGap: number; begin: number; end: number }
export interface FrameInfo { frame: number; tag: string; complete: boolean; statistics: Record<string, unknown> }

/** The reports of a block of frames: columns, with one entry for each pair, contact and region distance. */
export class ReportBlock {
  readonly byteLength: number;
  readonly diagnostics: Diagnostic[];
  readonly infos: FrameInfo[];
  readonly begin: Uint32Array;
  readonly end: Uint32Array;
  readonly pairA: Uint32Array;
  readonly pairB: Uint32Array;
  readonly phase: Uint8Array;
  readonly flags: Uint8Array;
  /** Empty in older data. */
  readonly inside: Uint8Array;
  readonly lower: Float64Array;
  readonly upper: Float64Array;
  readonly witnessFeatures: Uint32Array;
  readonly witnessPoints: Float64Array;
  readonly contactBegin: Uint32Array;
  readonly contactEnd: Uint32Array;
  readonly regionBegin: Uint32Array;
  readonly regionEnd: Uint32Array;
  readonly kind: Uint8Array;
  readonly sides: Uint8Array;
  readonly features: Uint32Array;
  readonly points: Float64Array;
  readonly normal: Float64Array;
  readonly distance: Float64Array;
  readonly since: Uint32Array;
  readonly regionLevels: Uint32Array;
  readonly regionIds: Uint32Array;
  readonly regionPoints: Float64Array;
  readonly regionDistance: Float64Array;
  /** The rows of ways out by their pairs. */
  private readonly wayOfPair: Map<number, number>;
  private readonly wayDirection: Float64Array;
  private readonly wayPoint: Float64Array;
  private readonly wayFullness: Float64Array;
  private readonly wayThickness: Float64Array;
  private readonly wayExtent: Float64Array;
  readonly impactKind: Uint8Array;
  readonly impactStatus: Uint8Array;
  readonly impactFeatures: Uint32Array;
  readonly impactTimes: Float64Array;
  /** The rows of sweeps by their pairs. */
  private readonly sweepOfPair: Map<number, Sweep>;

  constructor(table: Table, private readonly saysSunk: boolean) {
    this.byteLength = table.byteLength;
    this.diagnostics = (table.header.diagnostics ?? []) as Diagnostic[];
    this.infos = (table.header.frames_info ?? []) as FrameInfo[];
    this.begin = table.u32('frame_pair_begin');
    this.end = table.u32('frame_pair_end');
    this.pairA = table.u32('pair_a');
    this.pairB = table.u32('pair_b');
    this.phase = table.u8('pair_phase');
    this.flags = table.u8('pair_flags');
    this.inside = table.u8('pair_inside');
    this.lower = table.f64('pair_lower');
    this.upper = table.f64('pair_upper');
    this.witnessFeatures = table.u32('witness_features');
    this.witnessPoints = table.f64('witness_points');
    this.contactBegin = table.u32('pair_contact_begin');
    this.contactEnd = table.u32('pair_contact_end');
    this.regionBegin = table.u32('pair_region_begin');
    this.regionEnd = table.u32('pair_region_end');
    this.kind = table.u8('contact_kind');
    this.sides = table.u8('contact_sides');
    this.features = table.u32('contact_features');
    this.points = table.f64('contact_points');
    this.normal = table.f64('contact_normal');
    this.distance = table.f64('contact_distance');
    this.since = table.u32('contact_since');
    this.regionLevels = table.u32('region_levels');
    this.regionIds = table.u32('region_ids');
    this.regionPoints = table.f64('region_points');
    this.regionDistance = table.f64('region_distance');
    this.wayOfPair = new Map([...table.u32('way_pair')].map((pair, way) => [pair, way]));
    this.wayDirection = table.f64('way_direction');
    this.wayPoint = table.f64('way_point');
    this.wayFullness = table.f64('way_fullness');
    this.wayThickness = table.f64('way_thickness');
    this.wayExtent = table.f64('way_extent');
    this.impactKind = table.u8('impact_kind');
    this.impactStatus = table.u8('impact_status');
    this.impactFeatures = table.u32('impact_features');
    this.impactTimes = table.f64('impact_times');
    this.sweepOfPair = sweepsOf(table);
  }

  /** Whether an object of a pair is inside the other, as a number of INSIDES. */
  insideOf(row: number): number {
    return this.inside[row] ?? 0;
  }

  /** Whether two edges are sunk. In older data they are where each lies behind the other's surface. */
  isSunk(contact: number): boolean {
    const sides = this.sides[contact]!;
    if (this.saysSunk) return (sides & SUNK) !== 0;
    return KINDS[this.kind[contact]!] === 'EE' && this.distance[contact] !== 0 && (sides & 15) === 2 + 4 * 2;
  }

  sideA(contact: number): number { return this.sides[contact]! & 3; }
  sideB(contact: number): number { return (this.sides[contact]! >> 2) & 3; }

  isTouching(row: number): boolean {
    const phase = PHASES[this.phase[row]!];
    return phase === 'began' || phase === 'touching';
  }

  /** Two edges are behind where they are sunk. With a vertex, its side of the other surface decides; else both sides do. At distance 0 nothing is behind. */
  isBehind(contact: number): boolean {
    const { distance, features, kind } = this;
    if (KINDS[kind[contact]!] === 'EE') return this.isSunk(contact);
    if (distance[contact] === 0) return false;
    const [isVertexA, isVertexB] = [features[4 * contact] === 0, features[4 * contact + 2] === 0];
    const [isBehindA, isBehindB] = [SIDES[this.sideA(contact)] === 'back', SIDES[this.sideB(contact)] === 'back'];
    if (!isVertexA && !isVertexB) return isBehindA && isBehindB;
    return (isVertexB && isBehindA) || (isVertexA && isBehindB);
  }

  /** The distance with a sign, as docs/answers.md says. */
  separation(contact: number): number {
    const distance = this.distance[contact]!;
    return this.isBehind(contact) ? -distance : distance;
  }

  /** The smallest separation of a pair's contacts, or null where none is listed. */
  deepestOf(row: number): number | null {
    let deepest: number | null = null;
    for (let c = this.contactBegin[row]!; c < this.contactEnd[row]!; ++c)
      if (deepest === null || this.separation(c) < deepest) deepest = this.separation(c);
    return deepest;
  }

  /** The way out of a pair, or null where the report has none. */
  wayOutOf(row: number): WayOut | null {
    const way = this.wayOfPair.get(row);
    if (way === undefined) return null;
    const triple = (values: Float64Array) => [...values.subarray(3 * way, 3 * way + 3)] as [number, number, number];
    return {
      direction: triple(this.wayDirection), point: triple(this.wayPoint), fullness: this.wayFullness[way]!,
      thickness: this.wayThickness[way]!, extent: this.wayExtent[way]!,
    };
  }

  /** What a pair met between two steps, or null where it met nothing and came near nothing. */
  sweepOf(row: number): Sweep | null {
    return this.sweepOfPair.get(row) ?? null;
  }

  /** The row of a pair in the i-th frame of the block, or -1. */
  rowOf(i: number, a: number, b: number): number {
    for (let row = this.begin[i]!; row < this.end[i]!; ++row)
      if (this.pairA[row] === a && this.pairB[row] === b) return row;
    return -1;
  }
}

function sweepsOf(table: Table): Map<number, Sweep> {
  const [impact, gap] = [table.f64('sweep_time_of_impact'), table.f64('sweep_time_of_gap')];
  const [begin, end] = [table.u32('sweep_impact_begin'), table.u32('sweep_impact_end')];
  return new Map([...table.u32('sweep_pair')].map((pair, i) =>
    [pair, { timeOfImpact: impact[i]!, timeOfGap: gap[i]!, begin: begin[i]!, end: end[i]! }]));
}

/** One frame's part of a block. Pairs and contacts are named by their rows in the block. */
export class FrameReport {
  readonly info: FrameInfo;
  readonly diagnostics: Diagnostic[];

  constructor(readonly block: ReportBlock, readonly inBlock: number, readonly frame: number, frameNumber: number) {
    this.info = block.infos[inBlock] ?? { frame: frameNumber, tag: '', complete: true, statistics: {} };
    this.diagnostics = block.diagnostics.filter((d) => d.frame === frame);
  }

  get pairBegin(): number { return this.block.begin[this.inBlock] ?? 0; }
  get pairEnd(): number { return this.block.end[this.inBlock] ?? 0; }

  *pairs(): Generator<number> {
    for (let row = this.pairBegin; row < this.pairEnd; ++row) yield row;
  }

  *contacts(): Generator<[contact: number, pair: number]> {
    for (const pair of this.pairs())
      for (let c = this.block.contactBegin[pair]!; c < this.block.contactEnd[pair]!; ++c) yield [c, pair];
  }

  *impacts(): Generator<[impact: number, pair: number]> {
    for (const pair of this.pairs()) {
      const sweep = this.block.sweepOf(pair);
      for (let i = sweep?.begin ?? 0; i < (sweep?.end ?? 0); ++i) yield [i, pair];
    }
  }

  rowOf(a: number, b: number): number {
    return this.block.rowOf(this.inBlock, a, b);
  }

  /** The contact of a pair with these features, or -1. */
  contactOf(pair: number, kind: number, features: readonly number[]): number {
    const { block } = this;
    for (let c = block.contactBegin[pair]!; c < block.contactEnd[pair]!; ++c)
      if (block.kind[c] === kind && features.every((value, k) => block.features[4 * c + k] === value)) return c;
    return -1;
  }

  sideA(contact: number): number { return this.block.sideA(contact); }
  sideB(contact: number): number { return this.block.sideB(contact); }

  /** The distance with a sign, and the direction along which b is moved to make it grow, as docs/answers.md says. */
  separation(contact: number): number {
    return this.block.separation(contact);
  }

  push(contact: number): [number, number, number] {
    const [x, y, z] = this.block.normal.subarray(3 * contact, 3 * contact + 3) as unknown as [number, number, number];
    return this.block.isBehind(contact) || this.leadsIn(contact) ? [-x, -y, -z] : [x, y, z];
  }

  /** Where an edge pierces a face, the side of the pierced object says whether the face's normal leads into its solid. */
  private leadsIn(contact: number): boolean {
    const { distance, features } = this.block;
    const [isFaceA, isFaceB] = [features[4 * contact] === 2, features[4 * contact + 2] === 2];
    if (distance[contact] !== 0 || isFaceA === isFaceB) return false;
    return SIDES[isFaceA ? this.sideA(contact) : this.sideB(contact)] === 'back';
  }

  /** Whether an edge pierces a face. Such a contact carries nothing. */
  pierces(contact: number): boolean {
    return KINDS[this.block.kind[contact]!] === 'EF' && this.block.distance[contact] === 0;
  }

  age(contact: number): number { return this.info.frame - this.block.since[contact]!; }
}
