// What is in the opened page, and what is in memory of it?

import { BlockCache, readJson, readTable, type ChunkSource } from './chunks';
import { checkHead, droppedAt, type Head } from './head';
import { Mesh } from './mesh';
import { MotionBlock, ObjectState } from './motion';
import { FrameReport, ReportBlock } from './report';

const CACHE_BYTES = 192 * 1024 * 1024;

export class Page {
  readonly motions: BlockCache<MotionBlock>;
  readonly reports: BlockCache<ReportBlock>;
  readonly objects: ObjectState[];

  private constructor(readonly source: ChunkSource, readonly head: Head, meshes: Mesh[]) {
    this.motions = new BlockCache(CACHE_BYTES, async (name) => new MotionBlock(await readTable(source, name)));
    this.reports = new BlockCache(CACHE_BYTES, (name) => this.readReport(name));
    this.objects = head.objects.map((object, i) => new ObjectState(i, meshes[object.mesh]!));
  }

  static async open(source: ChunkSource): Promise<Page> {
    const head = checkHead(await readJson(source, 'head'));
    const meshes = await Promise.all(head.meshes.map(async (m) => new Mesh(await readTable(source, m.chunk))));
    return new Page(source, head, meshes);
  }

  blockOf(frame: number): number {
    return Math.floor(frame / this.head.block);
  }

  get blockCount(): number {
    return Math.ceil(this.head.frames / this.head.block);
  }

  /** Decodes what a frame needs, moves the objects there and gives its report. */
  async load(frame: number, isWanted: () => boolean): Promise<FrameReport | null> {
    const k = this.blockOf(frame);
    const [motion, report] = await Promise.all([this.motions.get(`motion/${k}`), this.reports.get(`report/${k}`)]);
    const shown = new FrameReport(report, frame - k * this.head.block, frame, this.head.frame_numbers[frame] ?? frame);
    const meeting = this.hasStepBefore(frame) ? objectsThatMeet(shown) : new Set<number>();
    const before = meeting.size > 0 ? await this.motions.get(`motion/${this.blockOf(frame - 1)}`) : null;
    if (!isWanted()) return null;
    for (const object of this.objects) {
      object.showStart(meeting.has(object.index) ? before : null, frame, this.head);
      object.show(motion, k, frame, this.head);
    }
    return shown;
  }

  /** Whether the frame before is the source's frame before. */
  private hasStepBefore(frame: number): boolean {
    return frame > 0 && this.head.every === 1 && droppedAt(this.head, frame).before === 0;
  }

  /** Reads a block of reports past the cache. */
  async readReport(name: string): Promise<ReportBlock> {
    return new ReportBlock(await readTable(this.source, name), this.head.version > 1);
  }

  prefetch(block: number): void {
    if (block < 0 || block >= this.blockCount) return;
    void this.motions.get(`motion/${block}`).catch(() => {});
    void this.reports.get(`report/${block}`).catch(() => {});
  }
}

/** The objects whose features meet between two steps. */
function objectsThatMeet(report: FrameReport): Set<number> {
  const found = new Set<number>();
  for (const [, pair] of report.impacts()) {
    found.add(report.block.pairA[pair]!);
    found.add(report.block.pairB[pair]!);
  }
  return found;
}
