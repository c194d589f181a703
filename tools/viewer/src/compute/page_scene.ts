// How does the module get what the page shows in a frame, and what does it answer?

import { Table } from '../data/chunks';
import type { Head } from '../data/head';
import type { Mesh } from '../data/mesh';
import type { ObjectState } from '../data/motion';
import type { Page } from '../data/page';
import { FrameReport, ReportBlock } from '../data/report';
import type { ComputingModule } from './module';

const MOTIONS = ['deformable', 'rigid', 'fixed'];
/** With a budget of time, answers would depend on how fast this machine is. */
const LEFT_OUT = ['time_budget_us'];

export class PageScene {
  /** What of the settings the module could not take. */
  readonly notTaken: string[] = [];
  private steps = 0;

  constructor(private readonly module: ComputingModule, private readonly page: Page, private readonly frame: number) {
    module.call('begin_scene');
    this.takeSettings(page.head.settings);
    const meshes = new Map<Mesh, number>();
    for (const object of page.objects) {
      if (!object.isThere) continue;
      const { mesh } = object;
      if (!meshes.has(mesh)) meshes.set(mesh, this.addMesh(mesh));
      this.addObject(object, meshes.get(mesh)!, page.head);
    }
    this.takeFilters(page.head);
  }

  /** Tells the module where an object is. */
  place(object: ObjectState): void {
    if (this.page.head.objects[object.index]!.motion === 'deformable')
      this.module.call('set_positions', object.index, object.world, object.mesh.vertexCount);
    else this.module.call('set_pose', object.index, object.pose);
  }

  /** Steps, and gives the report as the frame's. Each step counts as a frame, so that contacts have an age. */
  step(): FrameReport {
    const number = (this.page.head.frame_numbers[this.frame] ?? this.frame) + this.steps++;
    const size = this.module.call('step', this.frame, number);
    const table = new Table(this.module.bytes(this.module.call('table'), size));
    return new FrameReport(new ReportBlock(table, true), 0, this.frame, number);
  }

  private takeSettings(settings: Record<string, unknown>): void {
    for (const [key, value] of Object.entries(settings))
      if (LEFT_OUT.includes(key) || !this.take(key, value)) this.notTaken.push(key.replaceAll('_', ' '));
  }

  private take(key: string, value: unknown): boolean {
    const { module } = this;
    if (value === 'infinity') return module.call('set_number', key, Infinity) === 1;
    if (typeof value === 'number' || typeof value === 'boolean') return module.call('set_number', key, Number(value)) === 1;
    if (key === 'accuracy') return this.takeAccuracy(value);
    return typeof value === 'string' && module.call('set_word', key, value) === 1;
  }

  private takeAccuracy(value: unknown): boolean {
    if (value === 'exact') return true;
    const { within, paper } = value as { within?: number; paper?: number[] };
    if (within !== undefined) return this.module.call('set_accuracy_within', within) === 1;
    return paper !== undefined && this.module.call('set_accuracy_of_paper', new Float64Array(paper), paper.length) === 1;
  }

  /** Faces in the caller's order, which numbers the edges too. */
  private addMesh(mesh: Mesh): number {
    const faces = Array.from({ length: mesh.faceCount }, (_, face) => mesh.faceCorners(face));
    const corners = new Uint32Array(faces.flat());
    const counts = new Uint32Array(faces.map((face) => face.length));
    return this.module.call('add_mesh', mesh.rest, mesh.vertexCount, corners, corners.length, counts, counts.length);
  }

  /** Ignored pairs and rules of this frame. */
  private takeFilters(head: Head): void {
    const isNow = (first: number, last: number) => first <= this.frame && this.frame <= last;
    const isThere = (object: number) => this.page.objects[object]!.isThere;
    for (const [a, b, first, last] of head.ignored ?? [])
      if (isNow(first, last) && isThere(a) && isThere(b)) this.module.call('ignore_pair', a, b);
    for (const [a, groupA, b, groupB, first, last] of head.ignored_groups ?? [])
      if (isNow(first, last) && isThere(a) && isThere(b)) this.module.call('ignore_groups', a, groupA, b, groupB);
    for (const { kinds, contact_distance, range, epsilon, first, last } of head.rules ?? [])
      if (isNow(first, last)) {
        const numbers = new Float64Array(epsilon ?? []);
        this.module.call('set_rule', ...kinds, Number(contact_distance ?? NaN), range === 'infinity' ? Infinity : range ?? NaN, numbers, numbers.length);
      }
  }

  private addObject(object: ObjectState, mesh: number, head: Head): void {
    const { motion, solid, swept, settings } = head.objects[object.index]!;
    const all = { solid: solid ?? false, swept: swept ?? false, ...settings };
    for (const [name, value] of Object.entries(all))
      if (!this.takeObjectSetting(name, value))
        this.notTaken.push(`${name.replaceAll('_', ' ')} of ${head.objects[object.index]!.name}`);
    this.module.call('add_object', object.index, mesh, MOTIONS.indexOf(motion));
    this.place(object);
  }

  private takeObjectSetting(name: string, value: unknown): boolean {
    const { module } = this;
    if (Array.isArray(value)) {
      const numbers = new Uint32Array(value as number[]);
      return (name === 'face_groups' || name === 'hidden_groups') && module.call(`set_${name}`, numbers, numbers.length) === 1;
    }
    return Number(value) <= Number.MAX_SAFE_INTEGER && module.call('set_object_number', name, Number(value)) === 1;
  }
}

/** How a computed report is beside the recorded one of the frame. */
export interface Comparison {
  /** Recorded pairs. */
  pairs: number;
  /** Those that the other has with the same bounds and the same contacts, bit for bit. */
  same: number;
  /** Pairs of one report that the other does not list. */
  missing: number;
  more: number;
  /** The largest difference of the distances of a pair. */
  apart: number;
}

export function compare(recorded: FrameReport, computed: FrameReport): Comparison {
  let [pairs, same, missing, apart] = [0, 0, 0, 0];
  for (const row of recorded.pairs()) {
    ++pairs;
    const other = computed.rowOf(recorded.block.pairA[row]!, recorded.block.pairB[row]!);
    if (other < 0) ++missing;
    else apart = Math.max(apart, Math.abs(recorded.block.upper[row]! - computed.block.upper[other]!));
    if (other >= 0 && JSON.stringify(rowOf(recorded.block, row)) === JSON.stringify(rowOf(computed.block, other))) ++same;
  }
  return { pairs, same, missing, more: computed.pairEnd - computed.pairBegin - (pairs - missing), apart };
}

/** What a row says, without what it knows of earlier steps. Equal texts of it are equal bits, but for the sign of a zero. */
export function rowOf(block: ReportBlock, row: number): unknown {
  const contacts = [];
  for (let c = block.contactBegin[row]!; c < block.contactEnd[row]!; ++c)
    contacts.push({
      kind: block.kind[c], sides: block.sides[c], distance: block.distance[c], features: [...block.features.subarray(4 * c, 4 * c + 4)],
      points: [...block.points.subarray(6 * c, 6 * c + 6)], normal: [...block.normal.subarray(3 * c, 3 * c + 3)] });
  return {
    a: block.pairA[row], b: block.pairB[row], lower: block.lower[row], upper: block.upper[row], inside: block.insideOf(row),
    way: block.wayOutOf(row), contacts };
}
