// What is shown while the page computes: the frame's objects, which the reader moves, and the module's report of each step.

import type { FrameReport } from '../data/report';
import type { Viewer } from '../viewer';
import { ComputingModule, hasModule } from './module';
import { short } from '../panels/dom';
import { compare, PageScene, type Comparison } from './page_scene';

export class Computing {
  isOn = false;
  /** Whether a drag moves a vertex of a deformable object, and not all of the object. */
  movesVertices = false;
  /** What the reader has to know of the numbers. */
  words: string[] = [];
  stepMs = 0;
  /** The first step beside the recorded frame. */
  atFirst: Comparison = { pairs: 0, same: 0, missing: 0, more: 0, apart: 0 };
  private module: ComputingModule | null = null;
  private scene: PageScene | null = null;

  constructor(private readonly viewer: Viewer) {
    viewer.beforeSeek = () => this.stop();
    viewer.on(['page'], () => this.stop());
  }

  get isThere(): boolean {
    return hasModule() && typeof WebAssembly === 'object';
  }

  /** Computes the frame that is shown. Fails with words where that cannot be. */
  async start(): Promise<void> {
    const { viewer } = this;
    if (this.isOn || !viewer.page || !viewer.report) return;
    if (!this.isThere) throw new Error('This page was built without the module that computes: graze needs Emscripten for it.');
    this.module ??= await ComputingModule.load();
    await viewer.settled();
    if (this.isOn) return;
    const recorded = viewer.report;
    this.scene = new PageScene(this.module, viewer.page, viewer.frame);
    this.isOn = true;
    this.step();
    this.atFirst = compare(recorded, viewer.report);
    this.words = this.wordsOf(this.scene.notTaken, recorded);
    viewer.emit('compute');
  }

  /** Shows the recorded frame again. */
  async leave(): Promise<void> {
    if (!this.isOn) return;
    this.stop();
    await this.viewer.reload();
  }

  isDeformable(object: number): boolean {
    return this.viewer.page!.head.objects[object]!.motion === 'deformable';
  }

  /** Moves an object, or a vertex of a deformable one, and steps. */
  move(object: number, vertex: number | null, by: readonly number[]): void {
    const { page } = this.viewer;
    if (!this.scene || !page) return;
    for (const other of page.objects) if (other.isThere && other.index !== object) other.keepStart();
    const moved = page.objects[object]!;
    moved.move(by, !this.isDeformable(object), vertex);
    this.scene.place(moved);
    this.step();
  }

  private step(): void {
    const began = performance.now();
    const report = this.scene!.step();
    this.stepMs = performance.now() - began;
    this.viewer.show(report);
  }

  private stop(): void {
    if (!this.isOn) return;
    this.isOn = false;
    this.scene = null;
    for (const object of this.viewer.page?.objects ?? []) object.forgetMoves();
    this.viewer.emit('compute');
  }

  private wordsOf(notTaken: string[], recorded: FrameReport): string[] {
    const { pairs, same, missing, more, apart } = this.atFirst;
    const { head, objects } = this.viewer.page!;
    const isRounded = objects.some((object) => object.isThere && head.objects[object.index]!.position_error > 0);
    const words = [`${same} of ${pairs} recorded pairs are equal bit for bit`];
    if (apart > 0) words.push(`distances differ by up to ${short(apart)}${isRounded ? ', as this page has rounded positions of deformable objects' : ''}`);
    if (missing + more > 0)
      words.push(`${missing} pairs are missing and ${more} are more`);
    if (recorded.block.regionDistance.length > 0) words.push('lines between regions are not computed');
    if (notTaken.length > 0) words.push(`settings not taken over: ${[...new Set(notTaken)].slice(0, 6).join(', ')}`);
    return words;
  }
}
