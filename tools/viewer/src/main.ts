// How do the parts of the page come together?

import { PageChunks } from './data/chunks';
import { ComputeBar } from './compute/bar';
import { Computing } from './compute/computing';
import { Dragging } from './compute/dragging';
import { button, byId, copy, h, note } from './panels/dom';
import { droppedAt, shownSettings } from './data/head';
import { fillHelp } from './panels/help';
import { makeHooks, type Hooks } from './hooks';
import { solidsText } from './data/inside';
import { HistoryReader } from './data/history';
import { Inspector } from './panels/inspector';
import { listenForKeys, setCommands, type Command } from './keys';
import { Legend, toggleLevel } from './panels/legend';
import { Link } from './link';
import { Lists } from './panels/lists';
import { FileOpener } from './data/open_file';
import { Player } from './player';
import { Plots } from './panels/plots';
import { Stage } from './view3d/scene3d';
import { resetFilter, ShowPanel } from './panels/show_panel';
import { StageExtras } from './stage_extras';
import { nextTheme, startTheme } from './theme';
import { Timeline } from './panels/timeline';
import { Viewer, type Display, type PickMode } from './viewer';

declare global {
  interface Window { graze: Hooks }
}

const viewer = new Viewer();
startTheme(viewer);
const stage = new Stage(viewer, byId('view') as HTMLCanvasElement);
const player = new Player(viewer);
const lists = new Lists(viewer);
const inspector = new Inspector(viewer);
const showPanel = new ShowPanel(viewer);
const timeline = new Timeline(viewer, player);
const plots = new Plots(viewer);
const opener = new FileOpener(viewer);
const link = new Link(viewer, stage);
const computing = new Computing(viewer);
const computeBar = new ComputeBar(viewer, computing);
new Dragging(stage, computing);
const help = byId('help') as HTMLDialogElement;
new Legend(viewer, byId('legend'));
new StageExtras(viewer, stage);
new HistoryReader(viewer);

function showRight(which: 'inspector' | 'show'): void {
  const tab = (name: typeof which, text: string) => h('button', {
    type: 'button', role: 'tab', 'aria-selected': String(name === which), 'data-testid': `tab-${name}`,
    click: () => showRight(name) }, text);
  byId('right').replaceChildren(
    h('div', { class: 'tabs', role: 'tablist' }, tab('inspector', 'Inspector'), tab('show', 'View and filters')),
    which === 'inspector' ? inspector.element : showPanel.element);
  byId('right').dataset.shown = which;
}

/** A page opens where most is to be seen. */
async function showBusiest(): Promise<void> {
  const frame = viewer.busiestFrame();
  if (frame === 0) return;
  await viewer.goTo(frame);
  stage.fitAll(true);
}

function showBar(): void {
  const { page, report } = viewer;
  if (!page || !report) return;
  const { block } = report;
  const badge = (text: string, kind: string, title: string) => h('span', { class: `badge ${kind}`, title }, text);
  let flags = 0;
  for (const row of report.pairs()) flags |= block.flags[row]!;
  const badges: HTMLElement[] = [];
  if (computing.isOn) badges.push(badge('COMPUTED HERE', 'warn', 'These numbers are not of the recording: this page computed them'));
  if (page.head.diverged?.includes(viewer.frame)) badges.push(badge('DIVERGED', 'bad', 'A replay gave another report for this frame'));
  const dropped = droppedAt(page.head, viewer.frame);
  if (dropped.before) badges.push(badge(`${dropped.before} dropped before`, 'odd', 'The recorder could not record these frames'));
  if (dropped.after) badges.push(badge(`${dropped.after} dropped after`, 'odd', 'The recorder could not record these frames'));
  if (flags & 1) badges.push(badge('incomplete', 'odd', 'A budget or a limit left something out'));
  if (flags & 2) badges.push(badge('stale', 'odd', 'Some pairs have old values, because an object could not be read'));
  if (flags & 4) badges.push(badge('contacts cut', 'odd', 'A limit left contacts out'));
  if (report.diagnostics.length) badges.push(badge(`${report.diagnostics.length} diagnostic${report.diagnostics.length > 1 ? 's' : ''}`, 'warn',
    report.diagnostics.map((d) => `${d.kind}: ${d.message}`).join('\n')));
  byId('badges').replaceChildren(...badges);
}

function showTitle(): void {
  const { head } = viewer.page!;
  document.title = `${head.title} – graze`;
  byId('title').textContent = head.title;
  const values = shownSettings(head).map(([key, value]) => `${key.replaceAll('_', ' ')} ${settingText(value)}`);
  const settings = [...values, solidsText(head)].filter((text) => text).join(' · ');
  byId('source').textContent = settings;
  byId('source').title = `${head.source} · graze ${head.graze} · ${head.frames} frames of ${head.source_frames}\n${settings}`;
  document.body.classList.add('loaded');
  byId('empty').replaceChildren();
}

/** A setting as words: {"paper": [24, 14, 8]} is "paper 24, 14, 8". */
function settingText(value: unknown): string {
  if (Array.isArray(value)) return value.map(settingText).join(', ');
  if (value === null || typeof value !== 'object') return String(value);
  return Object.entries(value).map(([key, part]) => `${key} ${settingText(part)}`.trim()).join(', ');
}

function flip(name: { [K in keyof Display]: Display[K] extends boolean ? K : never }[keyof Display]): void {
  viewer.display[name] = !viewer.display[name];
  viewer.changed();
}

function nextOf<T>(values: readonly T[], value: T): T {
  return values[(values.indexOf(value) + 1) % values.length]!;
}

function goToMark(direction: 1 | -1): void {
  const frame = timeline.nextMark(direction);
  if (frame === null) note('No more marks that way');
  else void viewer.goTo(frame);
}

function isolate(): void {
  const { hiddenObjects } = viewer.display;
  const chosen = viewer.selectedObjects();
  if (hiddenObjects.size > 0 || chosen.length === 0) hiddenObjects.clear();
  else for (const object of viewer.page?.objects ?? []) if (!chosen.includes(object.index)) hiddenObjects.add(object.index);
  viewer.changed();
}

function openHelp(): void {
  if (help.open) return;
  fillHelp(help);
  help.showModal();
}

function togglePlots(): void {
  document.body.classList.toggle('noplots');
}

function timeCommands(): Command[] {
  const group = 'Time';
  const by = (n: number) => () => void viewer.goTo(viewer.frame + n);
  return [
    { group, keys: [' '], text: 'play or pause', run: () => player.toggle() },
    { group, keys: ['ArrowLeft'], text: 'one frame back', run: by(-1) },
    { group, keys: ['ArrowRight'], text: 'one frame on', run: by(1) },
    { group, keys: ['PageUp'], text: 'ten frames back', run: by(-10) },
    { group, keys: ['PageDown'], text: 'ten frames on', run: by(10) },
    { group, keys: ['Home'], text: 'first frame', run: () => void viewer.goTo(0) },
    { group, keys: ['End'], text: 'last frame', run: () => void viewer.goTo(1e9) },
    { group, keys: [','], text: 'mark before', run: () => goToMark(-1) },
    { group, keys: ['.'], text: 'next mark', run: () => goToMark(1) },
    { group, keys: ['['], text: 'slower', run: () => player.faster(-1) },
    { group, keys: [']'], text: 'faster', run: () => player.faster(1) },
    { group, keys: ['Shift+r'], text: 'turn time round', run: () => player.setSpeed(-player.speed) },
    { group, keys: ['t'], text: 'plots on or off', run: togglePlots },
  ];
}

function cameraCommands(): Command[] {
  const group = 'Camera';
  const { eye } = stage;
  const pan = (x: number, y: number) => () => eye.pan(x, y);
  const turn = (x: number, y: number) => () => eye.turn(x, y);
  return [
    { group, keys: ['f'], text: 'fit the selection', run: () => stage.fitSelection() },
    { group, keys: ['a'], text: 'fit all', run: () => stage.fitAll() },
    { group, keys: ['Shift+ArrowLeft'], text: 'turn left', run: turn(-0.05, 0) },
    { group, keys: ['Shift+ArrowRight'], text: 'turn right', run: turn(0.05, 0) },
    { group, keys: ['Shift+ArrowUp'], text: 'turn up', run: turn(0, 0.05) },
    { group, keys: ['Shift+ArrowDown'], text: 'turn down', run: turn(0, -0.05) },
    { group, keys: ['Alt+ArrowLeft'], text: 'pan left', run: pan(-0.06, 0) },
    { group, keys: ['Alt+ArrowRight'], text: 'pan right', run: pan(0.06, 0) },
    { group, keys: ['Alt+ArrowUp'], text: 'pan up', run: pan(0, 0.06) },
    { group, keys: ['Alt+ArrowDown'], text: 'pan down', run: pan(0, -0.06) },
    { group, keys: ['+', '='], text: 'nearer', run: () => eye.zoom(0.85) },
    { group, keys: ['-', '_'], text: 'further', run: () => eye.zoom(1 / 0.85) },
    { group, keys: ['u'], text: 'y or z is up', run: () => {
      viewer.display.up = viewer.display.up === 'z' ? 'y' : 'z';
      viewer.changed();
    } },
  ];
}

function viewCommands(): Command[] {
  const group = 'View';
  const { display } = viewer;
  return [
    { group, keys: ['w'], text: 'wireframe', run: () => flip('surfaces') },
    { group, keys: ['e'], text: 'edges', run: () => flip('edges') },
    { group, keys: ['r'], text: 'see through surfaces', run: () => {
      display.opacity = display.opacity < 1 ? 1 : 0.35;
      viewer.changed();
    } },
    { group, keys: ['c'], text: 'clip plane', run: () => flip('clip') },
    { group, keys: ['Shift+c'], text: 'next axis of the clip plane', run: () => {
      display.clipAxis = nextOf(['x', 'y', 'z', 'view'] as const, display.clipAxis);
      viewer.changed();
    } },
    { group, keys: ['<', '>'], text: 'move the clip plane', run: () => {} },
    { group, keys: ['k'], text: 'contacts', run: () => flip('contacts') },
    { group, keys: ['m'], text: 'push directions', run: () => flip('pushes') },
    { group, keys: ['Shift+m'], text: 'also of edges that pierce', run: () => flip('pierces') },
    { group, keys: ['s'], text: 'ways out of pairs', run: () => flip('ways') },
    { group, keys: ['q'], text: 'impacts between steps', run: () => flip('impacts') },
    { group, keys: ['o'], text: 'only contacts of the selection', run: () => {
      viewer.filter.onlySelected = !viewer.filter.onlySelected;
      viewer.changed();
    } },
    { group, keys: ['x'], text: 'take all filters and the search away', run: () => resetFilter(viewer) },
    { group, keys: ['l'], text: 'lines between middle vertices', run: () => flip('lines') },
    { group, keys: [1, 2, 3, 4, 5, 6, 7, 8, 9].map((level) => `Alt+${level}`), keysText: 'Alt+1 … Alt+9', text: 'lines of this level',
      run: (key) => toggleLevel(viewer, Number(key.at(-1))) },
    { group, keys: ['d'], text: 'witnesses of pairs', run: () => flip('witnesses') },
    { group, keys: ['b'], text: 'bounds of regions', run: () => {
      display.bounds = nextOf(['off', 'circles', 'spheres'] as const, display.bounds);
      viewer.changed();
    } },
    { group, keys: ['Shift+b'], text: 'next level of bounds', run: () => {
      const most = Math.max(1, ...(viewer.page?.head.meshes.map((mesh) => mesh.levels) ?? []));
      display.boundsLevel = (display.boundsLevel + 1) % most;
      viewer.changed();
    } },
    { group, keys: ['z'], text: 'compute here, and drag objects', run: () => void computeBar.toggle() },
    { group, keys: ['Shift+z'], text: 'drag objects, or vertices', run: () => computeBar.toggleVertices() },
    { group, keys: ['n'], text: 'names', run: () => flip('names') },
    { group, keys: ['h'], text: 'hide the selected objects', run: () => {
      for (const object of viewer.selectedObjects()) display.hiddenObjects.add(object);
      viewer.changed();
    } },
    { group, keys: ['i'], text: 'the selected objects alone, or all', run: isolate },
  ];
}

function pageCommands(): Command[] {
  const group = 'Lists and page';
  return [
    { group, keys: ['1'], text: 'list of objects', run: () => lists.setTab('objects') },
    { group, keys: ['2'], text: 'list of pairs', run: () => lists.setTab('pairs') },
    { group, keys: ['3'], text: 'list of contacts', run: () => lists.setTab('contacts') },
    { group, keys: ['ArrowDown', 'j'], text: 'next row', run: () => lists.step(1) },
    { group, keys: ['ArrowUp', 'Shift+j'], text: 'row before', run: () => lists.step(-1) },
    { group, keys: ['/'], text: 'search', run: () => lists.focusSearch() },
    { group, keys: ['Escape'], text: 'select nothing', run: () => viewer.select(null) },
    { group, keys: ['p'], text: 'what a click selects', run: () => {
      const picks: PickMode[] = ['auto', 'object', 'pair', 'contact', 'feature'];
      viewer.display.pick = nextOf(picks, viewer.display.pick);
      note(`A click selects: ${viewer.display.pick}`);
      viewer.changed();
    } },
    { group, keys: ['v'], text: 'inspector, or view and filters', run: () =>
      showRight(byId('right').dataset.shown === 'show' ? 'inspector' : 'show') },
    { group, keys: ['y'], text: 'copy a link to this place', run: copyLink },
    { group, keys: ['Shift+o'], text: 'open a file', run: () => opener.ask() },
    { group, keys: ['g'], text: 'light, dark, or as the system', run: () => note(`Colours: ${nextTheme(viewer)}`) },
    { group, keys: ['?'], text: 'help', run: openHelp },
  ];
}

/** Without the module the button says so when it is pressed. */
function computeButton(): HTMLElement {
  const title = computing.isThere ? 'Compute in this page: drag objects, and contacts follow (Z)'
    : 'This page was built without the module that computes';
  const element = button('Compute', 'compute', title, () => void computeBar.toggle());
  viewer.on(['compute'], () => element.setAttribute('aria-pressed', String(computing.isOn)));
  return element;
}

function copyLink(): void {
  void copy(location.href.split('#')[0] + link.text());
}

/** These two move, where all others switch, so they have a listener of their own. */
function listenForClipKeys(): void {
  addEventListener('keydown', (event) => {
    const by = event.key === '<' ? -0.02 : event.key === '>' ? 0.02 : 0;
    if (by === 0 || event.target instanceof HTMLInputElement) return;
    viewer.display.clip = true;
    viewer.display.clipAt = Math.min(1, Math.max(0, viewer.display.clipAt + by));
    viewer.changed();
  });
}

async function start(): Promise<void> {
  const chunks = new PageChunks();
  if (!chunks.has('head')) {
    opener.showEmpty();
    return;
  }
  await viewer.open(chunks);
  if (!link.namesFrame()) await showBusiest();
  await link.read();
  stage.draw();
  document.documentElement.dataset.openMs = String(Math.round(performance.now()));
  viewer.page?.prefetch(viewer.page.blockOf(viewer.frame) + 1);
}

byId('left').append(lists.element);
showRight('inspector');
byId('time').append(timeline.element, plots.element);
byId('tools').append(
  computeButton(),
  button('Open', 'open', 'Open a .grazeview file (Shift+O)', () => opener.ask()),
  button('Link', 'link', 'Copy a link to this frame, camera and selection (Y)', copyLink),
  button('◐', 'theme', 'Light, dark, or as the system (G)', () => note(`Colours: ${nextTheme(viewer)}`)),
  button('?', 'helpbutton', 'Help (?)', openHelp));
setCommands([...timeCommands(), ...cameraCommands(), ...viewCommands(), ...pageCommands()]);
listenForKeys();
listenForClipKeys();
viewer.on(['display'], () => {
  if (stage.eye.up !== viewer.display.up) stage.eye.setUp(viewer.display.up);
});
viewer.on(['page'], showTitle);
viewer.on(['frame', 'compute'], showBar);
viewer.on(['selection'], () => {
  if (viewer.selection && byId('right').dataset.shown !== 'inspector') showRight('inspector');
  if (viewer.shouldFly && viewer.selection) stage.fitSelection();
});

const ready = start();
ready.catch((error: Error) => {
  window.graze.error = error.message;
  note(error.message, true);
});
window.graze = makeHooks(viewer, stage, player, lists, plots, link, computing, ready);
