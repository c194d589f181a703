// Which frame is shown, what happened when, and how does one get there?

import { button, h } from './dom';
import { droppedAt } from '../data/head';
import type { Mark } from '../data/history';
import { palette, PHASE_COLOURS } from '../palette';
import { SPEEDS, type Player } from '../player';
import type { Viewer } from '../viewer';

/** A lane of a state marks each frame in which it lasts. */
interface Lane { name: string; colour: () => string; test: (frame: number) => boolean; isState?: boolean }

export class Timeline {
  readonly element = h('div', { id: 'timeline' });
  private readonly track = h('canvas', {
    id: 'track', 'data-testid': 'track', tabindex: 0, role: 'slider', 'aria-label': 'Frame' }) as HTMLCanvasElement;
  private readonly place = h('input', {
    type: 'number', id: 'frame', 'data-testid': 'frame', min: 0, step: 1, 'aria-label': 'Page frame',
    change: () => void this.viewer.goTo(Number(this.place.value)) }) as HTMLInputElement;
  private readonly words = h('span', { id: 'framewords', 'data-testid': 'framewords' });
  private readonly speed = h('input', {
    type: 'number', id: 'speed', 'data-testid': 'speed', list: 'speeds', step: 'any', 'aria-label': 'Frames a second',
    title: 'Frames a second ([ and ]); below 0 backwards', change: () => this.player.setSpeed(Number(this.speed.value)) }) as HTMLInputElement;
  private readonly play = button('▶', 'play', 'Play or pause (Space)', () => this.player.toggle());
  private readonly loop = button('⟲', 'loop', 'Begin again at the end', () => {
    this.player.loops = !this.player.loops;
    this.viewer.emit('play');
  });
  private readonly keys = h('span', { class: 'marks' });
  private marks: HTMLCanvasElement | null = null;

  constructor(private readonly viewer: Viewer, private readonly player: Player) {
    const go = (text: string, id: string, title: string, to: () => number) => button(text, id, title, () => void viewer.goTo(to()));
    this.element.append(
      h('div', { class: 'transport' },
        go('|◂', 'first', 'First frame (Home)', () => 0),
        go('◂', 'back', 'One frame back (←)', () => viewer.frame - 1), this.play,
        go('▸', 'next', 'One frame on (→)', () => viewer.frame + 1),
        go('▸|', 'last', 'Last frame (End)', () => viewer.page!.head.frames - 1), this.loop,
        h('label', {}, this.speed, h('span', { class: 'quiet' }, 'fps')),
        h('datalist', { id: 'speeds' }, ...SPEEDS.map((s) => h('option', { value: s }))),
        h('label', { class: 'framebox' }, h('span', { class: 'quiet' }, 'frame'), this.place), this.words,
        h('span', { class: 'space' }), this.keys),
      this.track);
    this.listen();
  }

  private listen(): void {
    const { track, viewer } = this;
    const scrub = (event: PointerEvent) => void viewer.goTo(this.frameAt(event.offsetX));
    track.addEventListener('pointerdown', (event) => {
      track.setPointerCapture(event.pointerId);
      scrub(event);
    });
    track.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) scrub(event);
    });
    new ResizeObserver(() => this.redraw()).observe(track);
    viewer.on(['page', 'theme', 'history'], () => this.redraw());
    viewer.on(['frame'], () => this.show());
    viewer.on(['play', 'page'], () => {
      this.play.textContent = this.player.isPlaying ? '❚❚' : '▶';
      this.loop.setAttribute('aria-pressed', String(this.player.loops));
      if (document.activeElement !== this.speed) this.speed.value = String(this.player.speed);
    });
  }

  /** The nearest frame, from the one shown on in a direction, where something is marked, or where a state begins. */
  nextMark(direction: 1 | -1): number | null {
    const { page, frame } = this.viewer;
    if (!page) return null;
    for (let f = frame + direction; f >= 0 && f < page.head.frames; f += direction)
      if (this.lanes().some((lane) => lane.test(f) && !(lane.isState && lane.test(f - 1)))) return f;
    return null;
  }

  /** While something is selected, lanes are those of its pairs. Frames that are dropped or diverged lack every pair. */
  private lanes(): Lane[] {
    const { head } = this.viewer.page!;
    const diverged = new Set(head.diverged ?? []);
    const { history } = this.viewer;
    const has = (name: Exclude<Mark, 'touching'>) => (f: number) => ((history?.marks[name] ?? head.series[name])?.[f] ?? 0) > 0;
    return [
      ...(history ? [{ name: `selected ${history.of}`, colour: () => palette().selected, test: (f: number) => history.marks.touching[f]! > 0, isState: true }] : []),
      { name: 'began', colour: () => PHASE_COLOURS[1]!, test: has('began') },
      { name: 'ended', colour: () => PHASE_COLOURS[3]!, test: has('ended') },
      { name: 'impacts', colour: () => palette().way, test: has('impacts'), isState: true },
      { name: 'inside', colour: () => palette().inside, test: has('inside'), isState: true },
      { name: 'crossing', colour: () => palette().crossing, test: has('crossing'), isState: true },
      { name: 'incomplete', colour: () => '#cc79a7', test: (f) => has('incomplete')(f) || has('contacts_cut')(f) },
      { name: 'stale', colour: () => palette().neutral, test: has('stale') },
      { name: 'diagnostics', colour: () => '#b8a800', test: has('diagnostics') },
      { name: 'dropped', colour: () => '#d55e00', test: (f) => droppedAt(head, f).before + droppedAt(head, f).after > 0 },
      { name: 'DIVERGED', colour: () => palette().warning, test: (f) => diverged.has(f) },
    ];
  }

  private frameAt(x: number): number {
    const { frames } = this.viewer.page?.head ?? { frames: 1 };
    return Math.floor((x / Math.max(1, this.track.clientWidth)) * frames);
  }

  private redraw(): void {
    if (!this.viewer.page) return;
    this.drawMarks();
    this.show();
  }

  /** Draws the marks once, into a picture of their own, over which the place in time moves. */
  private drawMarks(): void {
    const { head } = this.viewer.page!;
    const ratio = devicePixelRatio;
    const [width, height] = [Math.max(1, this.track.clientWidth * ratio), Math.max(1, this.track.clientHeight * ratio)];
    this.track.width = width;
    this.track.height = height;
    this.marks = document.createElement('canvas');
    this.marks.width = width;
    this.marks.height = height;
    const pen = this.marks.getContext('2d')!;
    const used = this.lanes().filter((lane) => head.frame_numbers.some((_, f) => lane.test(f)));
    // Each kind has a row of its own, so that none hides another.
    const size = height / Math.max(4, used.length);
    for (const [row, lane] of used.entries()) {
      pen.fillStyle = lane.colour();
      const least = lane.name === 'DIVERGED' ? 4 * ratio : 2 * ratio;
      const wide = Math.max(least, width / head.frames - ratio);
      // Whole pixels, since with many rows half of one is a large part of its height.
      const [top, bottom] = [Math.round(row * size), Math.round((row + 1) * size)];
      const gap = Math.min(ratio, Math.floor((bottom - top) / 4));
      for (let f = 0; f < head.frames; ++f)
        if (lane.test(f)) pen.fillRect(((f + 0.5) * width) / head.frames - wide / 2, top + gap, wide, bottom - top - 2 * gap);
    }
    this.keys.replaceChildren(...used.map((lane) => h('span', { class: 'key' },
      h('i', { class: 'swatch square', style: `--c:${lane.colour()}` }), lane.name)));
  }

  private show(): void {
    const { viewer, track, marks } = this;
    if (!viewer.page || !marks) return;
    const { head } = viewer.page;
    const pen = track.getContext('2d')!;
    const style = getComputedStyle(track);
    pen.clearRect(0, 0, track.width, track.height);
    pen.fillStyle = style.getPropertyValue('--trackfill');
    pen.fillRect(0, 0, ((viewer.frame + 0.5) / head.frames) * track.width, track.height);
    pen.drawImage(marks, 0, 0);
    pen.fillStyle = style.getPropertyValue('--accent');
    pen.fillRect(Math.round(((viewer.frame + 0.5) / head.frames) * track.width - devicePixelRatio), 0, 2 * devicePixelRatio, track.height);
    track.setAttribute('aria-valuenow', String(viewer.frame));
    track.setAttribute('aria-valuemax', String(head.frames - 1));
    this.place.max = String(head.frames - 1);
    if (document.activeElement !== this.place) this.place.value = String(viewer.frame);
    this.words.textContent = `of ${(head.frames - 1).toLocaleString('en')}`;
    this.words.title = 'Page frames are counted from 0';
    if (head.every !== 1 || head.frame_numbers[viewer.frame] !== viewer.frame)
      this.words.textContent += ` · source frame ${(head.frame_numbers[viewer.frame] ?? 0).toLocaleString('en')}`;
  }
}
