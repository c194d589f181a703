// Where is every vertex in a frame?

import type { Table } from './chunks';
import type { Head } from './head';
import type { Mesh } from './mesh';

const NOT_FINITE = -2147483648;

interface TrackHead {
  object: number;
  frames: number[];
  array: string;
  kind: 'positions' | 'pose';
  origin: [number, number, number];
  step: number;
}

/** The motion of one object in a block. Coded differences are summed only as far as a frame needs them. */
class Track {
  private readonly sums: Int32Array | null;
  private at = -1;

  constructor(readonly head: TrackHead, private readonly bytes: Uint8Array, private readonly poses: Float64Array) {
    this.sums = head.kind === 'positions' ? new Int32Array(bytes.length / 4 / head.frames.length) : null;
  }

  /** Which of the track's frames a page frame shows. */
  slot(frame: number): number {
    let slot = 0;
    while (slot + 1 < this.head.frames.length && this.head.frames[slot + 1]! <= frame) ++slot;
    return slot;
  }

  write(slot: number, rest: Float64Array, out: Float64Array): void {
    if (this.sums) this.writePositions(slot, this.sums, out);
    else writePosed(this.pose(slot)!, rest, out);
  }

  private writePositions(slot: number, sums: Int32Array, out: Float64Array): void {
    if (slot < this.at) this.at = -1;
    while (this.at < slot) this.add(++this.at, sums);
    const n = out.length / 3;
    const [x, y, z] = this.head.origin;
    const { step } = this.head;
    for (let v = 0, o = 0; v < n; ++v, o += 3) {
      const isFinite = sums[v] !== NOT_FINITE;
      out[o] = isFinite ? x + step * sums[v]! : NaN;
      out[o + 1] = isFinite ? y + step * sums[n + v]! : NaN;
      out[o + 2] = isFinite ? z + step * sums[2 * n + v]! : NaN;
    }
  }

  private add(slot: number, sums: Int32Array): void {
    const n = sums.length;
    const plane0 = this.bytes.subarray(4 * n * slot, 4 * n * slot + n);
    const plane1 = this.bytes.subarray(4 * n * slot + n, 4 * n * slot + 2 * n);
    const plane2 = this.bytes.subarray(4 * n * slot + 2 * n, 4 * n * slot + 3 * n);
    const plane3 = this.bytes.subarray(4 * n * slot + 3 * n, 4 * n * slot + 4 * n);
    if (slot === 0) sums.fill(0);
    for (let i = 0; i < n; ++i) {
      const u = plane0[i]! | (plane1[i]! << 8) | (plane2[i]! << 16) | (plane3[i]! << 24);
      sums[i] = (sums[i]! + ((u >>> 1) ^ -(u & 1))) | 0;
    }
  }

  /** The upper three rows of the matrix. Null for positions. */
  pose(slot: number): Float64Array | null {
    return this.sums ? null : this.poses.subarray(12 * slot, 12 * slot + 12);
  }
}

const STANDING = new Float64Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);

/** The same order of operations as in graze, so that a posed vertex is the same double. */
function writePosed(m: Float64Array, rest: Float64Array, out: Float64Array): void {
  for (let v = 0; v < out.length; v += 3) {
    const [x, y, z] = [rest[v]!, rest[v + 1]!, rest[v + 2]!];
    for (let k = 0; k < 3; ++k) out[v + k] = m[4 * k]! * x + m[4 * k + 1]! * y + m[4 * k + 2]! * z + m[4 * k + 3]!;
  }
}

/** The motion of all objects in a block of frames. */
export class MotionBlock {
  readonly byteLength: number;
  private readonly tracks = new Map<number, Track>();

  constructor(table: Table) {
    this.byteLength = table.byteLength;
    for (const head of table.header.tracks as TrackHead[]) {
      const isPose = head.kind === 'pose';
      const none = new Uint8Array(0);
      const track = new Track(head, isPose ? none : table.u8(head.array), isPose ? table.f64(head.array) : new Float64Array(0));
      this.tracks.set(head.object, track);
    }
  }

  track(object: number): Track | undefined {
    return this.tracks.get(object);
  }
}

/** An object as it is in the frame that is shown. */
export class ObjectState {
  readonly world: Float64Array;
  isThere = false;
  /** Goes up whenever `world` is written. */
  version = 0;
  notFinite: number[] = [];
  low = [0, 0, 0];
  high = [0, 0, 0];
  /**
   * Where the vertices were when the step began. It is null where the page does not know it, and where nobody asked for it.
   * It is `world` where the object stood.
   */
  before: Float64Array | null = null;
  /** Where a rigid or fixed object is: the upper three rows of its matrix. */
  readonly pose = new Float64Array(STANDING);
  private shown = '';
  private earlier: Float64Array | null = null;

  constructor(readonly index: number, readonly mesh: Mesh) {
    this.world = new Float64Array(mesh.rest);
  }

  /** Shows where the step to a frame begins, from the block of the frame before; forgets it without one. Goes before show(). */
  showStart(block: MotionBlock | null, frame: number, head: Head): void {
    const { first, motion } = head.objects[this.index]!;
    const track = block?.track(this.index);
    this.before = null;
    if (!block) return;
    this.before = this.world;
    // A fixed object stands where it is placed, and another one in its first step.
    if (motion === 'fixed' || first >= frame || !track) return;
    this.before = this.earlier ??= new Float64Array(this.world.length);
    track.write(track.slot(frame - 1), this.mesh.rest, this.earlier);
  }

  show(block: MotionBlock, blockIndex: number, frame: number, head: Head): void {
    const { first, last } = head.objects[this.index]!;
    this.isThere = first <= frame && frame <= last;
    if (!this.isThere) return;
    const track = block.track(this.index);
    const slot = track ? track.slot(frame) : 0;
    const key = `${blockIndex}/${slot}`;
    if (key === this.shown) return;
    this.shown = key;
    if (track) track.write(slot, this.mesh.rest, this.world);
    else this.world.set(this.mesh.rest);
    this.pose.set(track?.pose(slot) ?? STANDING);
    ++this.version;
    this.measure();
  }

  /**
   * Moves the object, or one vertex of a deformable one, away from where the frame has it. The step begins where it was. A
   * posed object moves by its pose, so that each vertex is the double that graze has.
   */
  move(by: readonly number[], isPosed: boolean, vertex: number | null): void {
    this.keepStart();
    if (isPosed) {
      for (let k = 0; k < 3; ++k) this.pose[4 * k + 3]! += by[k]!;
      writePosed(this.pose, this.mesh.rest, this.world);
    } else {
      const [from, to] = vertex === null ? [0, this.world.length] : [3 * vertex, 3 * vertex + 3];
      for (let i = from; i < to; ++i) this.world[i]! += by[i % 3]!;
    }
    ++this.version;
    this.measure();
  }

  /** A step begins where the object is now. */
  keepStart(): void {
    this.before = this.earlier ??= new Float64Array(this.world.length);
    this.before.set(this.world);
  }

  /** The next show() puts it back to where the frame has it. */
  forgetMoves(): void {
    this.shown = '';
  }

  private measure(): void {
    const { world, low, high } = this;
    this.notFinite = [];
    low.fill(Infinity);
    high.fill(-Infinity);
    for (let v = 0; v < world.length; v += 3) {
      if (!Number.isFinite(world[v])) {
        this.notFinite.push(v / 3);
        continue;
      }
      for (let k = 0; k < 3; ++k) {
        const x = world[v + k]!;
        if (x < low[k]!) low[k] = x;
        if (x > high[k]!) high[k] = x;
      }
    }
  }

  vertex(v: number): [number, number, number] {
    return [this.world[3 * v]!, this.world[3 * v + 1]!, this.world[3 * v + 2]!];
  }

  /** False where no vertex is finite. */
  get hasBox(): boolean {
    return this.low[0]! <= this.high[0]!;
  }

  centre(): [number, number, number] {
    return [0, 1, 2].map((k) => (this.low[k]! + this.high[k]!) / 2) as [number, number, number];
  }
}
