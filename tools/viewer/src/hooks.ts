// What may tests and the console ask of the page?

import type { Computing } from './compute/computing';
import type { Vec3 } from './view3d/batches3d';
import type { Facts } from './panels/facts';
import { frameFacts, selectionFacts } from './panels/facts';
import { selectionKey, type Lists } from './panels/lists';
import { parseSelection, selectionText, type Link } from './link';
import { rowOf } from './compute/page_scene';
import { pickSurface, Screen } from './view3d/picking';
import type { Player } from './player';
import type { Plots } from './panels/plots';
import type { Stage } from './view3d/scene3d';
import type { Selection, Viewer } from './viewer';

export interface Hooks {
  ready: Promise<void>;
  error: string | null;
  readonly frame: number;
  readonly selection: Selection | null;
  goTo(frame: number): Promise<void>;
  /** A selection, or its text as it is in a link. */
  select(selection: Selection | string | null): void;
  inspect(): { frame: Facts; selection: Facts | null };
  /** What is in the scene now. */
  drawn(): Record<string, unknown>;
  /** Where a contact that is shown stands on the screen, in pixels of the canvas. */
  contactAt(index: number): { x: number; y: number; key: string } | null;
  /** The arrow of a contact that is shown, in the coordinates of the scene; null where it has none. */
  arrowOf(index: number): { from: number[]; to: number[]; key: string } | null;
  /** The arrows of ways out, in the coordinates of the scene. */
  waysOut(): { from: number[]; to: number[] }[];
  /** Where their middles stand on the screen, in pixels of the canvas. */
  wayPlaces(): { x: number; y: number }[];
  /** The ways of vertices that meet something between two steps, in the coordinates of the scene, and a place on the screen a quarter of the way along. */
  impactWays(): { from: number[]; to: number[]; x: number; y: number }[];
  /** Where features meet between two steps, in the coordinates of the scene. */
  impactPlaces(): number[][];
  /** The lines of the plot of the selection, by label, and its title. */
  plotted(): { title: string; lines: Record<string, (number | null)[]> };
  pixels(): { width: number; height: number; data: Uint8Array };
  link(): string;
  /** What the page computes, which also moves objects for tests. */
  readonly computing: Computing;
  /** Where a place of the surface of an object stands on the screen, in pixels of the canvas, if nothing hides it. */
  objectAt(object: number): { x: number; y: number } | null;
  /** The vertices of all objects as they are shown. */
  vertices(): number[][];
  /** The rows of the report that is shown, without what they know of earlier steps. */
  rows(): unknown[];
  stats(): Record<string, number>;
}

const inScene = (stage: Stage, point: readonly number[]): number[] => point.map((x, k) => x + stage.origin[k]!);
/** Where a share of a line stands on the screen. */
function onScreen(stage: Stage, { a, b }: { a: Vec3; b: Vec3 }, share: number): { x: number; y: number } {
  const [x, y] = new Screen(stage).at(a.map((from, k) => from + share * (b[k]! - from)) as unknown as Vec3)!;
  return { x, y };
}
/** The middle of a triangle of an object, that nearest to the middle of those in sight. */
function placeOnScreen(stage: Stage, object: number): { x: number; y: number } | null {
  const { mesh, world } = stage.viewer.page!.objects[object]!;
  const screen = new Screen(stage);
  const inSight: [number, number][] = [];
  const step = 3 * Math.ceil(mesh.drawn.length / 900);
  for (let t = 0; t < mesh.drawn.length; t += step) {
    const corners = [0, 1, 2].map((k) => stage.local(world, 3 * mesh.drawn[t + k]!));
    const p = screen.at([0, 1, 2].map((k) => (corners[0]![k]! + corners[1]![k]! + corners[2]![k]!) / 3) as unknown as Vec3);
    if (p && pickSurface(stage, p[0], p[1])?.object === object) inSight.push([p[0], p[1]]);
  }
  const middle = [0, 1].map((k) => inSight.reduce((sum, p) => sum + p[k]!, 0) / inSight.length);
  const away = ([x, y]: [number, number]) => Math.hypot(x - middle[0]!, y - middle[1]!);
  const [x, y] = inSight.sort((p, q) => away(p) - away(q))[0] ?? [];
  return x === undefined || y === undefined ? null : { x, y };
}
const median = (values: number[]): number => [...values].sort((p, q) => p - q)[values.length >> 1] ?? 0;

export function makeHooks(viewer: Viewer, stage: Stage, player: Player, lists: Lists, plots: Plots, link: Link, computing: Computing, ready: Promise<void>): Hooks {
  return {
    ready,
    error: null,
    get frame() { return viewer.frame; },
    get selection() { return viewer.selection; },
    async goTo(frame) {
      await viewer.goTo(frame);
      stage.draw();
    },
    select: (s) => viewer.select(typeof s === 'string' ? parseSelection(viewer, s) : s),
    inspect: () => ({ frame: frameFacts(viewer), selection: selectionFacts(viewer) }),
    drawn() {
      stage.draw();
      return {
        contacts: stage.contacts.shown.length, arrows: stage.contacts.arrows.filter((arrow) => arrow).length, ways: stage.ways.shown.length, impacts: stage.impacts.places.length, warnings: stage.contacts.warningCount,
        lines: stage.lines.counts(), hiddenLevels: [...viewer.display.hiddenLevels], bounds: stage.lines.boundCount, highlights: stage.highlight.count,
        ghosts: stage.surfaces.flatMap((s, i) => (s.isGhost ? [i] : [])),
        surfaces: stage.surfaces.filter((s) => s.object.visible).length, rows: lists.rows.length,
        isPlaying: player.isPlaying, selection: viewer.selection && selectionText(viewer, viewer.selection),
      };
    },
    contactAt(index) {
      const place = stage.contacts.places[index];
      const p = place && new Screen(stage).at(place);
      if (!p) return null;
      const [contact, pair] = stage.contacts.shown[index]!;
      return { x: p[0], y: p[1], key: selectionKey(viewer.contactSelection(contact, pair)) };
    },
    arrowOf(index) {
      const arrow = stage.contacts.arrows[index];
      if (!arrow) return null;
      const [from, to] = arrow.map((end) => inScene(stage, end)) as [number[], number[]];
      const [contact, pair] = stage.contacts.shown[index]!;
      return { from, to, key: selectionKey(viewer.contactSelection(contact, pair)) };
    },
    waysOut: () => stage.ways.shown.map(({ a, b }) => ({ from: inScene(stage, a), to: inScene(stage, b) })),
    wayPlaces: () => stage.ways.shown.map((line) => onScreen(stage, line, 0.5)),
    impactWays: () => stage.impacts.shown.map((line) => ({
      from: inScene(stage, line.a), to: inScene(stage, line.b), ...onScreen(stage, line, 0.25) })),
    impactPlaces: () => stage.impacts.places.map((place) => inScene(stage, place)),
    plotted: () => plots.last(),
    pixels: () => stage.pixels(),
    link: () => link.text(),
    computing,
    objectAt: (object) => placeOnScreen(stage, object),
    vertices: () => viewer.page!.objects.map((object) => [...object.world]),
    rows: () => [...viewer.report!.pairs()].map((row) => rowOf(viewer.report!.block, row)),
    stats: () => ({
      frameMs: median(stage.renderMs), seekMs: median(viewer.seekMs),
      decodeMs: median([...(viewer.page?.motions.decodeMs ?? [])]), decodeReportMs: median([...(viewer.page?.reports.decodeMs ?? [])]),
      openMs: Number(document.documentElement.dataset.openMs ?? 0),
    }),
  };
}
