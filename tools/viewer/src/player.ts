// How does time run while the page plays?

import type { Viewer } from './viewer';

export const SPEEDS = [0.5, 1, 2, 5, 10, 15, 24, 30, 60, 120, 240];

export class Player {
  isPlaying = false;
  loops = true;
  /** Page frames a second. Below 0 time runs backwards. */
  speed = 24;
  private time = 0;
  private last = 0;
  private waitingFor = -1;

  constructor(private readonly viewer: Viewer) {
    viewer.on(['page'], () => this.stop());
  }

  toggle(): void {
    if (this.isPlaying) this.stop();
    else this.play();
  }

  play(): void {
    const { page } = this.viewer;
    if (!page || this.isPlaying || page.head.frames < 2) return;
    const end = this.speed > 0 ? page.head.frames - 1 : 0;
    this.time = this.viewer.frame === end ? page.head.frames - 1 - end : this.viewer.frame;
    this.isPlaying = true;
    this.last = performance.now();
    this.viewer.emit('play');
    requestAnimationFrame(() => this.tick());
  }

  stop(): void {
    this.isPlaying = false;
    this.viewer.emit('play');
  }

  setSpeed(speed: number): void {
    if (!Number.isFinite(speed) || speed === 0) return;
    this.speed = speed;
    this.viewer.emit('play');
  }

  /** The next speed up or down of the list, with its sign kept. */
  faster(by: 1 | -1): void {
    const size = Math.abs(this.speed);
    const next = by > 0 ? SPEEDS.find((s) => s > size) : SPEEDS.findLast((s) => s < size);
    if (next) this.setSpeed(Math.sign(this.speed) * next);
  }

  private tick(): void {
    const { page } = this.viewer;
    if (!this.isPlaying || !page) return;
    const now = performance.now();
    // Somebody who scrubs while it plays goes on from there.
    if (!this.viewer.isSeeking && this.waitingFor >= 0 && this.viewer.frame !== this.waitingFor) this.time = this.viewer.frame;
    if (!this.viewer.isSeeking) this.time += (this.speed * Math.min(now - this.last, 250)) / 1000;
    this.last = now;
    const { frames } = page.head;
    if (this.time >= frames || this.time < 0) {
      if (!this.loops) {
        void this.viewer.goTo(this.time < 0 ? 0 : frames - 1);
        this.stop();
        return;
      }
      this.time = ((this.time % frames) + frames) % frames;
    }
    const frame = Math.floor(this.time);
    if (frame !== this.viewer.frame && !this.viewer.isSeeking) void this.viewer.goTo(frame);
    this.waitingFor = frame;
    this.prefetch(frame);
    requestAnimationFrame(() => this.tick());
  }

  private prefetch(frame: number): void {
    const page = this.viewer.page!;
    const next = page.blockOf(frame) + Math.sign(this.speed);
    page.prefetch(this.loops ? (next + page.blockCount) % page.blockCount : next);
  }
}
