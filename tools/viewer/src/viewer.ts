// What is shown now: the page, the frame, the selection and the settings of the view. Panels listen to its changes.

import type { ChunkSource } from './data/chunks';
import type { History } from './data/history';
import { groupOf } from './data/inside';
import { Page } from './data/page';
import type { FrameReport } from './data/report';
import { Search } from './data/search';

export type Selection =
  | { type: 'object'; object: number }
  | { type: 'pair'; a: number; b: number }
  | { type: 'contact'; a: number; b: number; kind: number; features: number[] }
  | { type: 'feature'; object: number; kind: number; index: number };

export type BoundsShape = 'off' | 'circles' | 'spheres';
export type PickMode = 'auto' | 'object' | 'pair' | 'contact' | 'feature';

export interface Display {
  surfaces: boolean;
  edges: boolean;
  opacity: number;
  clip: boolean;
  clipAxis: 'x' | 'y' | 'z' | 'view';
  /** Where the plane is, from 0 to 1 through the scene. */
  clipAt: number;
  clipFlipped: boolean;
  lines: boolean;
  hiddenLevels: Set<number>;
  witnesses: boolean;
  bounds: BoundsShape;
  boundsLevel: number;
  boundsOfAll: boolean;
  contacts: boolean;
  pushes: boolean;
  /** Push directions of edges that pierce, which carry nothing. */
  pierces: boolean;
  /** Ways out of pairs whose surfaces pass through each other. */
  ways: boolean;
  /** What meets between two steps. */
  impacts: boolean;
  arrowLength: number;
  pointSize: number;
  diagnostics: boolean;
  /** What is inside another object is seen through it. */
  insides: boolean;
  names: boolean;
  hiddenObjects: Set<number>;
  up: 'y' | 'z';
  pick: PickMode;
}

/** Which pairs and contacts are shown. An empty bound is null. */
export interface Filter {
  /** What the search asks for. */
  text: string;
  phases: boolean[];
  insides: boolean[];
  kinds: boolean[];
  /** For side a and side b: index 3·a + b. */
  sides: boolean[];
  distanceFrom: number | null;
  distanceTo: number | null;
  ageFrom: number | null;
  ageTo: number | null;
  onlySelected: boolean;
}

export type ViewerEvent = 'page' | 'frame' | 'selection' | 'history' | 'display' | 'theme' | 'play' | 'camera' | 'compute';

export function newFilter(): Filter {
  return {
    text: '', phases: Array(4).fill(true), insides: Array(3).fill(true),
    kinds: Array(6).fill(true), sides: Array(9).fill(true),
    distanceFrom: null, distanceTo: null, ageFrom: null, ageTo: null, onlySelected: false,
  };
}

function newDisplay(): Display {
  return {
    surfaces: true, edges: true, opacity: 1, clip: false, clipAxis: 'x', clipAt: 0.5, clipFlipped: false,
    lines: true, hiddenLevels: new Set(), witnesses: true, bounds: 'off', boundsLevel: 1, boundsOfAll: false,
    contacts: true, pushes: true, pierces: false, ways: true, impacts: true, arrowLength: 1, pointSize: 9, diagnostics: true, insides: true, names: false,
    hiddenObjects: new Set(), up: 'z', pick: 'auto',
  };
}

export class Viewer {
  page: Page | null = null;
  frame = -1;
  report: FrameReport | null = null;
  selection: Selection | null = null;
  /** Of the selection, as far as it is read. */
  history: History | null = null;
  readonly display = newDisplay();
  filter = newFilter();
  /** The camera goes to the next selection that is announced. */
  shouldFly = false;
  seekMs: number[] = [];
  /** Called before another frame is shown. */
  beforeSeek: () => void = () => {};
  private wanted = -1;
  private searched: Search | null = null;
  private readonly shownPairs = new Map<number, boolean>();
  private seeking: Promise<void> | null = null;
  private readonly listeners = new Map<ViewerEvent, (() => void)[]>();

  on(events: ViewerEvent[], listener: () => void): void {
    for (const event of events) this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }

  emit(event: ViewerEvent): void {
    if (event === 'page' || event === 'frame' || event === 'display') this.shownPairs.clear();
    for (const listener of this.listeners.get(event) ?? []) listener();
  }

  async open(source: ChunkSource): Promise<void> {
    const page = await Page.open(source);
    this.page = page;
    this.frame = this.wanted = -1;
    this.report = null;
    this.selection = null;
    this.history = null;
    this.filter = newFilter();
    this.display.hiddenObjects.clear();
    this.display.hiddenLevels.clear();
    // The first frame is there before panels hear of the page, so that they find objects in place.
    this.report = await page.load(0, () => this.page === page);
    this.frame = this.wanted = 0;
    this.emit('page');
    this.emit('frame');
    this.emit('selection');
  }

  /** Shows a frame. While one is on its way only the newest wish counts. */
  goTo(frame: number): Promise<void> {
    if (!this.page) return Promise.resolve();
    this.wanted = Math.max(0, Math.min(this.page.head.frames - 1, Math.round(frame)));
    this.seeking ??= this.seek().finally(() => (this.seeking = null));
    return this.seeking;
  }

  /** Shows another report of the frame, such as one that was computed for moved objects. */
  show(report: FrameReport): void {
    this.report = report;
    this.emit('frame');
  }

  /** Shows the frame as it was recorded. */
  reload(): Promise<void> {
    this.wanted = Math.max(0, this.frame);
    this.frame = -1;
    this.seeking ??= this.seek().finally(() => (this.seeking = null));
    return this.seeking;
  }

  /** Waits for the frame that is on its way. */
  settled(): Promise<void> {
    return this.seeking ?? Promise.resolve();
  }

  get isSeeking(): boolean {
    return this.seeking !== null;
  }

  private async seek(): Promise<void> {
    while (this.page && this.frame !== this.wanted) {
      const { page } = this;
      const frame = this.wanted;
      this.beforeSeek();
      const began = performance.now();
      const report = await page.load(frame, () => this.page === page);
      if (!report) return;
      this.frame = frame;
      this.report = report;
      this.emit('frame');
      this.seekMs.push(performance.now() - began);
      if (this.seekMs.length > 500) this.seekMs.shift();
    }
  }

  /** The frame with most contacts, then most impacts, pairs in contact and near pairs. Of several it is the first. */
  busiestFrame(): number {
    const { series, frames } = this.page!.head;
    const counts = (['contacts', 'impacts', 'in_contact', 'near'] as const).map((name) => series[name] ?? []);
    const isBusier = (frame: number, than: number) => {
      const differing = counts.find((values) => values[frame] !== values[than]);
      return differing !== undefined && differing[frame]! > differing[than]!;
    };
    let best = 0;
    for (let frame = 1; frame < frames; ++frame) if (isBusier(frame, best)) best = frame;
    return best;
  }

  get search(): Search {
    const { head } = this.page!;
    if (!this.searched?.isOf(this.filter.text, head)) this.searched = new Search(this.filter.text, head);
    return this.searched;
  }

  /** Whether lists and the picture show a pair of this frame. */
  showsPair(row: number): boolean {
    let isShown = this.shownPairs.get(row);
    if (isShown === undefined) {
      const { block } = this.report!;
      isShown = this.filter.phases[block.phase[row]!]! && this.filter.insides[groupOf(block.insideOf(row))]! && this.search.hasPair(block, row);
      this.shownPairs.set(row, isShown);
    }
    return isShown;
  }

  /** The objects that the search names, and those of pairs that are shown. Null without a search: all of them. */
  namedObjects(): Set<number> | null {
    const { page, report, search } = this;
    if (!page || !report || search.isEmpty) return null;
    const found = new Set(page.objects.map(({ index }) => index).filter((index) => search.hasObject(index)));
    for (const row of report.pairs()) if (this.showsPair(row)) found.add(report.block.pairA[row]!).add(report.block.pairB[row]!);
    return found;
  }

  select(selection: Selection | null, fly = false): void {
    this.selection = selection;
    this.shouldFly = fly;
    this.emit('selection');
    this.shouldFly = false;
  }

  changed(): void {
    this.emit('display');
  }

  /** The pair that is selected, or that the selected contact belongs to. */
  selectedPair(): { a: number; b: number } | null {
    const s = this.selection;
    return s && (s.type === 'pair' || s.type === 'contact') ? { a: s.a, b: s.b } : null;
  }

  /** The selected contact's row in this frame, or -1 where it is not listed. */
  selectedContactRow(): number {
    const s = this.selection;
    if (s?.type !== 'contact' || !this.report) return -1;
    const pair = this.report.rowOf(s.a, s.b);
    return pair < 0 ? -1 : this.report.contactOf(pair, s.kind, s.features);
  }

  selectedObjects(): number[] {
    const s = this.selection;
    if (!s) return [];
    if (s.type === 'object' || s.type === 'feature') return [s.object];
    return s.a === s.b ? [s.a] : [s.a, s.b];
  }

  contactSelection(contact: number, pair: number): Selection {
    const { block } = this.report!;
    return {
      type: 'contact', a: block.pairA[pair]!, b: block.pairB[pair]!, kind: block.kind[contact]!,
      features: [...block.features.subarray(4 * contact, 4 * contact + 4)],
    };
  }

  passes(contact: number, pair: number): boolean {
    const { filter, report } = this;
    const { block } = report!;
    if (!this.showsPair(pair) || !filter.kinds[block.kind[contact]!]) return false;
    if (!this.search.isEmpty && !this.search.hasContact(block, contact, pair)) return false;
    if (!filter.sides[3 * report!.sideA(contact) + report!.sideB(contact)]) return false;
    const distance = block.distance[contact]!;
    if (filter.distanceFrom !== null && distance < filter.distanceFrom) return false;
    if (filter.distanceTo !== null && distance > filter.distanceTo) return false;
    const age = report!.age(contact);
    if (filter.ageFrom !== null && age < filter.ageFrom) return false;
    if (filter.ageTo !== null && age > filter.ageTo) return false;
    if (!filter.onlySelected) return true;
    const [a, b] = [block.pairA[pair]!, block.pairB[pair]!];
    const chosen = this.selectedPair();
    if (chosen) return chosen.a === a && chosen.b === b;
    const objects = this.selectedObjects();
    return objects.length === 0 || objects.includes(a) || objects.includes(b);
  }
}
