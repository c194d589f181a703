// Drives the viewer in a browser, without a network and without a graphics card.
//   node tests/viewer/viewer_test.mjs [PAGE.html REPORT.jsonl [swept] | PAGE.html CONTACTS.csv ROWS.csv]
// Without arguments it makes its own pages. With a page of `graze` it compares the page's numbers with those of a report, or
// with the tables that `graze export` writes of the same recording.
// CHROMIUM names the browser, and GRAZE_VIEWER_FOLDER the folder in which the viewer was built. Times are asserted unless the machine is busy or TIMES=print is set.

import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { availableParallelism, loadavg, tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { deepestOf, largeScene, longScene, makePage, pageHtml, separationOf, smallScene, sweptScene, viewFile } from './make_page.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const viewer = process.env.GRAZE_VIEWER_FOLDER ?? join(here, '../../tools/viewer');
const { chromium } = await import(join(viewer, 'node_modules/playwright-core/index.mjs'));
const template = readFileSync(join(viewer, 'dist/viewer.html'), 'utf8');
const folder = mkdtempSync(join(tmpdir(), 'graze-viewer-'));

let failures = 0;
function check(name, isGood, detail = '') {
  if (!isGood) ++failures;
  console.log(`${isGood ? 'ok  ' : 'FAIL'} ${name}${detail === '' ? '' : `: ${detail}`}`);
}

function same(name, got, wanted) {
  const isSame = JSON.stringify(got) === JSON.stringify(wanted);
  check(name, isSame, isSame ? '' : `got ${JSON.stringify(got)}, wanted ${JSON.stringify(wanted)}`);
}

const isBusy = () => process.env.TIMES === 'print' || loadavg()[0] > 1.5 * availableParallelism();

/** A limit of time, asserted only where the machine has time to keep it. */
function within(name, ms, limit) {
  const detail = `${ms.toFixed(0)} ms, limit ${limit} ms`;
  if (ms > limit && isBusy()) console.log(`note ${name}: ${detail} (not asserted: the machine is busy)`);
  else check(name, ms <= limit, detail);
}

// ---- The browser ----

// A machine that builds and tests beside this may take minutes over what else takes a second.
const patience = 300_000;
const browser = await chromium.launch({
  timeout: patience,
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: 'light', offline: true });
context.setDefaultTimeout(patience);

/** Opens a page and collects what the console says. */
/** Without another address the page shows its first frame. */
async function open(path, hash = '#f=0') {
  const page = await context.newPage();
  page.errors = [];
  page.on('console', (m) => {
    // A browser that draws with the processor warns of stalls when pixels are read; the page cannot help that.
    if (['error', 'warning'].includes(m.type()) && !/GPU stall|GL Driver Message/.test(m.text())) page.errors.push(m.text());
  });
  page.on('pageerror', (e) => page.errors.push(e.message));
  const began = performance.now();
  await page.goto(pathToFileURL(path).href + hash);
  await page.evaluate(() => window.graze.ready);
  page.openMs = performance.now() - began;
  return page;
}

function write(name, data) {
  const path = join(folder, name);
  writeFileSync(path, data);
  return path;
}

const drawn = (page) => page.evaluate(() => window.graze.drawn());
const goTo = (page, frame) => page.evaluate((f) => window.graze.goTo(f), frame);
const inspect = (page) => page.evaluate(() => window.graze.inspect());
const press = (page, id) => page.click(`[data-testid="${id}"]`);

// ---- What each check asks ----

/** The contacts of a report, in its order, with their pair. */
const contactsOf = (report) => report.pairs.flatMap((pair) => pair.contacts.map((contact) => ({ pair, contact })));

async function checkPlaying(page, frames) {
  await goTo(page, 0);
  await page.fill('[data-testid=speed]', '60');
  await page.press('[data-testid=speed]', 'Enter');
  await page.keyboard.press('Space');
  await page.waitForFunction(() => window.graze.frame >= 3);
  check('plays', (await drawn(page)).isPlaying);
  await page.keyboard.press('Space');
  check('pauses', !(await drawn(page)).isPlaying);
  const box = await page.locator('[data-testid=track]').boundingBox();
  const seen = [];
  for (const share of [0.9, 0.1, 0.55]) {
    await page.mouse.click(box.x + share * box.width, box.y + box.height / 2);
    await page.waitForFunction((f) => window.graze.frame === f, Math.floor(share * frames));
    seen.push(await page.evaluate(() => window.graze.frame));
  }
  same('scrubs forth and back', seen, [0.9, 0.1, 0.55].map((s) => Math.floor(s * frames)));
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((f) => window.graze.frame === f, Math.floor(0.55 * frames) + 1);
  check('steps by key', true);
}

async function checkSelection(page, made) {
  const frame = 52;
  await goTo(page, frame);
  await press(page, 'tab-pairs');
  const before = await page.evaluate(() => window.graze.link());
  await page.click('[data-key="p1-4"]');
  same('a pair is selected in the list', (await drawn(page)).selection, 'pair:4:90');
  await page.waitForTimeout(400);
  check('the camera goes there', (await page.evaluate(() => window.graze.link())).split('&')[1] !== before.split('&')[1]);
  await goTo(page, 3);
  await goTo(page, 80);
  same('the selection survives scrubbing', (await drawn(page)).selection, 'pair:4:90');
  await goTo(page, frame);
  await page.evaluate(() => window.graze.select(null));
  await page.keyboard.press('a');
  await page.waitForTimeout(400);
  await drawn(page);
  await page.fill('[data-testid=search]', 'cloth');
  same('the search finds pairs', (await drawn(page)).rows, made.reports[frame].pairs.filter((p) => p.b === 4).length);
  await page.fill('[data-testid=search]', '');
  await page.keyboard.press('Escape');
  await press(page, 'sort-separation');
  const distances = await page.$$eval('[data-testid=list] .row b:first-of-type', (cells) => cells.map((c) => Number(c.textContent)));
  check('the list sorts', distances.every((d, i) => i === 0 || distances[i - 1] <= d), distances.join(' '));
  await checkClick(page);
}

/** Clicks a contact where it stands on the screen, and expects it or one at the same place. */
async function checkClick(page) {
  const count = (await drawn(page)).contacts;
  const places = await page.evaluate((n) => Array.from({ length: n }, (_, i) => window.graze.contactAt(i)), count);
  const lonely = places.find((p) => p && p.y > 60 && p.y < 380 &&
    places.every((q) => q === p || Math.hypot(p.x - q.x, p.y - q.y) > 6));
  const box = await page.locator('[data-testid=view]').boundingBox();
  await page.mouse.click(box.x + lonely.x, box.y + lonely.y);
  const selection = await page.evaluate(() => window.graze.selection);
  const key = selection?.type === 'contact' &&
    `c${selection.a}-${selection.b}-${selection.kind}-${selection.features.join('-')}`;
  same('a click in 3D selects the contact there', key, lonely.key);
  await press(page, 'pick-object');
  await page.mouse.click(box.x + lonely.x, box.y + lonely.y);
  same('a click can select the object', (await page.evaluate(() => window.graze.selection))?.type, 'object');
  await press(page, 'pick-feature');
  await page.mouse.click(box.x + lonely.x, box.y + lonely.y);
  same('a click can select a feature', (await inspect(page)).selection?.type, 'feature');
  await press(page, 'pick-auto');
}

async function checkFilters(page, made) {
  const frame = 52;
  await page.evaluate(() => window.graze.select(null));
  await goTo(page, frame);
  const all = contactsOf(made.reports[frame]);
  const expect = async (name, test) => same(name, (await drawn(page)).contacts, all.filter(test).length);
  await expect('all contacts are drawn', () => true);
  await press(page, 'kind-VF');
  await expect('the filter by kind', ({ contact }) => contact.kind !== 'VF');
  await press(page, 'kind-VF');
  await press(page, 'tab-show');
  await press(page, 'side-front-front');
  await expect('the filter by sides', ({ contact }) => contact.side_a !== 1 || contact.side_b !== 1);
  await press(page, 'side-front-front');
  await page.fill('[data-testid=filter-distanceTo]', '0.05');
  await expect('the filter by distance', ({ contact }) => contact.distance <= 0.05);
  await page.fill('[data-testid=filter-ageFrom]', '4');
  const number = made.reports[frame].info.frame;
  await expect('the filter by age', ({ contact }) => contact.distance <= 0.05 && number - contact.since >= 4);
  await page.keyboard.press('Escape');
  await page.keyboard.press('x');
  await expect('without filters', () => true);
  await press(page, 'tab-pairs');
  await press(page, 'phase-touching');
  await expect('the filter by phase', ({ pair }) => pair.phase !== 'touching');
  same('which hides no surface', (await drawn(page)).surfaces, 5);
  await press(page, 'phase-touching');
  await checkSearch(page, made);
}

/** Lists and the picture show what the search names, and nothing else. */
async function checkSearch(page, made) {
  const nameOf = (object) => made.head.objects[object].name;
  const ofNames = (...words) => ({ pair: { a, b } }) => words.every((word) => nameOf(a).includes(word) || nameOf(b).includes(word));
  const searches = [
    [52, 'ball', ofNames('ball'), [1]], [52, 'Cloth BALL', ofNames('cloth', 'ball'), []],
    // A pair of others has its contacts cut there, which begins with the letter of a name.
    [61, 'c', ofNames('c'), [4]],
    [52, '90', ({ pair }) => pair.b === 4, [4]], [52, 'crossing', ({ pair }) => pair.inside === 'crossing', []],
    [52, 'rigid', ({ pair: { a, b } }) => a === 2 || b === 2, [2]], [52, 'vf', ({ contact }) => contact?.kind === 'VF', []],
    [52, 'nothing', () => false, []],
  ];
  for (const [frame, text, isNamed, alone] of searches) {
    await goTo(page, frame);
    await page.fill('[data-testid=search]', text);
    const { pairs } = made.reports[frame];
    const contacts = contactsOf(made.reports[frame]).filter(isNamed);
    const named = pairs.filter((pair) => isNamed({ pair }) || pair.contacts.some((contact) => isNamed({ pair, contact })));
    const objects = new Set([...alone, ...named.flatMap(({ a, b }) => [a, b])]);
    const there = [...objects].filter((i) => frame >= made.scene.objects[i].first && frame <= made.scene.objects[i].last);
    const rows = [];
    for (const tab of ['objects', 'pairs', 'contacts']) {
      await press(page, `tab-${tab}`);
      rows.push((await drawn(page)).rows);
    }
    const shown = await drawn(page);
    same(`the search for ${text} in lists and in the picture, frame ${frame}`, [rows, shown.contacts, shown.lines[0] ?? 0, shown.surfaces],
      [[alone.length, named.length, contacts.length], contacts.length, named.filter(({ a, b }) => there.includes(a) && there.includes(b)).length, there.length]);
  }
  await page.keyboard.press('Escape');
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('x');
  same('a key takes the search away', [await page.inputValue('[data-testid=search]'), (await drawn(page)).surfaces], ['', 5]);
  await press(page, 'tab-pairs');
}

async function checkLines(page, made) {
  await goTo(page, 52);
  await page.keyboard.press('a');
  await page.waitForTimeout(400);
  const lines = made.reports[52].pairs.flatMap((p) => p.regions);
  for (const level of [1, 2, 3]) {
    const wanted = lines.filter((l) => l.level === level).length;
    const before = await pixelsOf(page);
    await press(page, `level-${level}`);
    const off = (await drawn(page)).lines[level] ?? 0;
    const changed = difference(before, await pixelsOf(page));
    await press(page, `level-${level}`);
    const on = (await drawn(page)).lines[level] ?? 0;
    check(`lines of level ${level} on and off`, on === wanted && off === 0 && changed > 20, `${on} lines, ${changed} pixels`);
  }
  for (const [key, name, what] of [['w', 'faces', 500], ['e', 'edges', 200], ['k', 'contacts', 100], ['m', 'arrows', 50], ['s', 'ways out', 50],
    ['d', 'witnesses', 5], ['c', 'the clip plane', 500], ['r', 'transparency', 500]]) {
    const before = await pixelsOf(page);
    await page.keyboard.press(key);
    const changed = difference(before, await pixelsOf(page));
    await page.keyboard.press(key);
    const back = difference(before, await pixelsOf(page));
    check(`${name} on and off`, changed > what && back === 0, `${changed} pixels`);
  }
  await page.keyboard.press('b');
  const circles = (await drawn(page)).bounds;
  await page.keyboard.press('b');
  await page.keyboard.press('b');
  check('bounds of regions', circles > 0 && (await drawn(page)).bounds === 0, `${circles} regions`);
}

async function pixelsOf(page) {
  const text = await page.evaluate(() => {
    const { data } = window.graze.pixels();
    let text = '';
    for (let i = 0; i < data.length; i += 4) text += String.fromCharCode((data[i] + 2 * data[i + 1] + 4 * data[i + 2]) & 2047);
    return text;
  });
  return text;
}

function difference(before, after) {
  let count = 0;
  for (let i = 0; i < before.length; ++i) if (before[i] !== after[i]) ++count;
  return count;
}

/** Numbers that the inspector shows as text, by the name of the fact. */
const shownFacts = (page) => page.$$eval('[data-testid=selection-facts] output', (outputs) =>
  Object.fromEntries(outputs.map((o) => [o.dataset.fact, o.textContent])));

async function checkNumbers(page, made) {
  for (const frame of [5, 24, 52]) {
    const report = made.reports[frame];
    await goTo(page, frame);
    let wrong = 0;
    let compared = 0;
    for (const pair of report.pairs) {
      const serials = [pair.a, pair.b].map((i) => made.head.objects[i].serial);
      await page.evaluate((s) => window.graze.select(s), `pair:${serials.join(':')}`);
      const facts = await shownFacts(page);
      const [x, y, z] = pair.witness.points;
      const wanted = { lower: pair.lower, upper: pair.upper, 'point_a.x': x, 'point_a.y': y, 'point_a.z': z };
      // Three coordinates that are all integers are shown in one line.
      const plain = [x, y, z].every(Number.isInteger) ? { lower: pair.lower, upper: pair.upper } : wanted;
      for (const [key, value] of Object.entries(plain)) {
        ++compared;
        if (facts[key] !== String(value)) ++wrong;
      }
      if (facts.phase !== pair.phase) ++wrong;
    }
    for (const { pair, contact } of contactsOf(report).slice(0, 12)) {
      const kinds = ['vertex', 'edge', 'face'];
      const [ka, ia, kb, ib] = contact.features;
      const serials = [pair.a, pair.b].map((i) => made.head.objects[i].serial);
      await page.evaluate((s) => window.graze.select(s),
        `contact:${serials.join(':')}:${contact.kind}:${kinds[ka]}.${ia}:${kinds[kb]}.${ib}`);
      const { selection } = await inspect(page);
      const twins = pair.contacts.filter((c) => c.kind === contact.kind && c.features.join() === contact.features.join());
      const got = JSON.stringify([
        selection.distance, selection.point_a, selection.point_b, selection.normal, selection.since, selection.sunk]);
      ++compared;
      if (!twins.some((c) => got === JSON.stringify([
        c.distance, c.points.slice(0, 3), c.points.slice(3), c.normal, c.since, c.kind === 'EE' ? c.sunk : undefined]))) ++wrong;
    }
    check(`numbers of frame ${frame} to the last digit`, wrong === 0 && compared > 5, `${compared} compared, ${wrong} wrong`);
  }
  await goTo(page, 24);
  await page.evaluate(() => window.graze.select('feature:5:vertex.3'));
  const box = made.scene.objects[2];
  const m = box.pose(24);
  const [x, y, z] = box.mesh.points[3];
  const place = [0, 1, 2].map((k) => m[4 * k] * x + m[4 * k + 1] * y + m[4 * k + 2] * z + m[4 * k + 3]);
  same('a vertex of a rigid object to the last digit', (await inspect(page)).selection.position, place);
  await page.evaluate(() => window.graze.select('feature:4:vertex.100'));
  const at = (await inspect(page)).selection;
  const wanted = made.scene.objects[1].positions(24);
  const error = Math.max(...at.position.map((p, k) => Math.abs(p - wanted[300 + k])));
  check('a vertex of a deformable object within the position error', error <= at.position_error, `${error}`);
}

async function checkMarks(page) {
  await goTo(page, 41);
  const state = await drawn(page);
  check('a diagnostic is drawn where it happened', state.warnings === 1);
  const badges = () => page.textContent('[data-testid=badges]');
  check('stale and diagnostics are marked', /stale/.test(await badges()) && /1 diagnostic/.test(await badges()));
  await goTo(page, 60);
  check('incomplete is marked', /incomplete/.test(await badges()));
  await goTo(page, 78);
  check('DIVERGED is marked', /DIVERGED/.test(await badges()));
  await goTo(page, 10);
  same('objects are there from their first frame', (await drawn(page)).surfaces, 4);
  await goTo(page, 30);
  same('and until their last', (await drawn(page)).surfaces, 5);
  await page.keyboard.press('?');
  check('help opens and lists licences', /three 0\./.test(await page.textContent('#help')) && /uplot 1\./.test(await page.textContent('#help')));
  await page.keyboard.press('Escape');
}

/** What a page says of a pair of which one object is inside the other. */
async function checkInside(page, made) {
  const words = {
    none: 'Neither of ball and cloth </script> é is inside the other', crossing: 'ball and cloth </script> é cross',
    a_in_b: 'ball is inside cloth </script> é', b_in_a: 'cloth </script> é is inside ball',
  };
  const marks = { none: '–', crossing: '✕', a_in_b: '⊂', b_in_a: '⊃' };
  const ghosts = { none: [], crossing: [], a_in_b: [1], b_in_a: [4] };
  await press(page, 'tab-pairs');
  for (const frame of [51, 52, 53, 54]) {
    const { inside } = made.reports[frame].pairs.find((pair) => pair.a === 1 && pair.b === 4);
    await goTo(page, frame);
    await page.evaluate(() => window.graze.select('pair:4:90'));
    const shown = [
      (await inspect(page)).selection.inside, await page.textContent('[data-testid=inside-words]'),
      await page.textContent('[data-key="p1-4"] .mark'), (await drawn(page)).ghosts];
    same(`a pair of which one is inside the other: ${inside}`, shown, [inside, words[inside], marks[inside], ghosts[inside]]);
  }
  await goTo(page, 52);
  const rows = async () => (await drawn(page)).rows;
  const all = await rows();
  await press(page, 'inside-crossing');
  same('the filter of pairs that cross', [all, await rows()], [all, all - 1]);
  await press(page, 'inside-crossing');
  await page.fill('[data-testid=search]', 'crossing');
  same('the search finds what crosses', await rows(), 1);
  await page.fill('[data-testid=search]', '');
  await page.keyboard.press('Escape');
  await page.evaluate(() => window.graze.select('pair:3:4'));
  same('a pair says it if one of both is solid', await page.locator('[data-testid=inside-words]').count(), 1);
  await page.evaluate(() => window.graze.select('pair:3:5'));
  same('and says nothing if neither is', await page.locator('[data-testid=inside-words]').count(), 0);
  await page.evaluate(() => window.graze.select(null));
}

/** What a page shows of pairs whose surfaces pass through each other. */
async function checkWaysOut(page, made) {
  const wayOf = (frame) => made.reports[frame].pairs.find((pair) => pair.a === 1 && pair.b === 4).way_out;
  for (const frame of [51, 52, 53, 54]) {
    await goTo(page, frame);
    await page.evaluate(() => window.graze.select('pair:4:90'));
    const way = wayOf(frame);
    same(`the numbers of a way out, frame ${frame}`, (await inspect(page)).selection.way_out ?? null, way);
    const hasArrow = way !== null && way.direction.some((x) => x !== 0);
    const arrows = await page.evaluate(() => window.graze.waysOut());
    const legend = await page.locator('[data-testid=ways]').allTextContents();
    same('it has an arrow and a legend where it has a direction', [arrows.length, legend], hasArrow ? [1, ['way out1']] : [0, []]);
    if (!hasArrow) continue;
    const { from, to } = arrows[0];
    const length = Math.hypot(...to.map((x, k) => x - from[k]));
    const leads = from.every((x, k) => Math.abs(x - way.point[k]) < 1e-6 && Math.abs((to[k] - x) / length - way.direction[k]) < 1e-6);
    const isLong = way.thickness > 0.1 ? Math.abs(length - way.thickness) < 1e-6 : length > 0.03;
    check('it leads from its point along its direction, long enough to be seen', leads && isLong, `${length}`);
  }
  await goTo(page, 52);
  await press(page, 'ways');
  const off = (await drawn(page)).ways;
  await press(page, 'ways');
  same('the legend switches ways out', [off, (await drawn(page)).ways], [0, 1]);
  await checkPickedWay(page);
  await page.evaluate(() => window.graze.select(null));
}

/** A click on the arrow of a way out selects its pair. */
async function checkPickedWay(page) {
  await page.evaluate(() => window.graze.select(null));
  await press(page, 'pick-pair');
  const box = await page.locator('[data-testid=view]').boundingBox();
  const places = await page.evaluate(() => window.graze.wayPlaces());
  await page.mouse.click(box.x + places[0].x, box.y + places[0].y);
  same('a click on its arrow selects the pair', (await drawn(page)).selection, 'pair:4:90');
  await press(page, 'pick-auto');
}

/** Edges that pierce carry nothing. Two edges say whether they are sunk. */
async function checkPushes(page, made) {
  await goTo(page, 52);
  const contacts = contactsOf(made.reports[52]);
  const pierces = ({ kind, distance }) => kind === 'EF' && distance === 0;
  const { contacts: count, arrows } = await drawn(page);
  const without = contacts.filter(({ contact }) => pierces(contact)).length;
  same('contacts have arrows, but for edges that pierce', [count, arrows, without > 0],
    [contacts.length, contacts.length - without, true]);
  await page.keyboard.press('Shift+m');
  await drawn(page);
  const places = await page.evaluate((n) => Array.from({ length: n }, (_, i) => window.graze.arrowOf(i)), count);
  await page.keyboard.press('Shift+m');
  // All normals of edges that pierce lead along z. The arrow leads against it where the face of the other object is left at its back.
  const turned = places.map((arrow, i) => [arrow, contacts[i].contact]).filter(([, contact]) => pierces(contact))
    .map(([arrow, { side_b: side }]) => arrow && Math.sign(arrow.to[2] - arrow.from[2]) === (side === 2 ? -1 : 1));
  same('a key shows these arrows too', [places.filter((arrow) => arrow).length, turned.length, turned.every((isRight) => isRight), (await drawn(page)).arrows],
    [contacts.length, without, true, contacts.length - without]);
  const edges = contacts.filter(({ contact }) => contact.kind === 'EE' && contact.side_a === 2 && contact.side_b === 2);
  const wrong = [];
  for (const { pair, contact } of edges) {
    await page.evaluate((s) => window.graze.select(s),
      { type: 'contact', a: pair.a, b: pair.b, kind: 3, features: contact.features });
    const { selection } = await inspect(page);
    const sign = contact.sunk ? -1 : 1;
    const wanted = [contact.sunk, sign * contact.distance, contact.normal.map((x) => sign * x)];
    if (JSON.stringify([selection.sunk, selection.separation, selection.push]) !== JSON.stringify(wanted)) wrong.push(contact.features);
  }
  same('edges behind each other are deep where they are sunk', [edges.some(({ contact }) => contact.sunk),
    edges.some(({ contact }) => !contact.sunk), wrong], [true, true, []]);
  await checkDeepest(page, contacts);
  await checkHistory(page, made);
  await page.evaluate(() => window.graze.select(null));
}

/** The smallest separation of a pair stands in the inspector and in the list of pairs, which it sorts. */
async function checkDeepest(page, contacts) {
  const wanted = new Map();
  for (const { pair, contact } of contacts) {
    const key = `p${pair.a}-${pair.b}`;
    wanted.set(key, Math.min(wanted.get(key) ?? Infinity, separationOf(contact)));
  }
  await press(page, 'tab-pairs');
  const listed = new Map(await page.$$eval('[data-testid=list] .row', (rows) => rows.map((row) => [row.dataset.key, row.querySelector('b').textContent])));
  const wrong = [];
  for (const [key, deepest] of wanted) {
    const [a, b] = key.slice(1).split('-').map(Number);
    await page.evaluate((s) => window.graze.select(s), { type: 'pair', a, b });
    const { selection } = await inspect(page);
    const cell = listed.has(key) ? Number(listed.get(key).replace('−', '-')) : deepest;
    if (selection.deepest_separation !== deepest || Math.abs(cell - deepest) > 1e-3 * Math.abs(deepest)) wrong.push([key, deepest, cell]);
  }
  same('pairs have the separation of their deepest contact', [[...wanted.values()].some((x) => x < 0), wrong], [true, []]);
  const { frame } = await inspect(page);
  same('and the frame has that of the deepest of all', frame.deepest_separation, Math.min(...wanted.values()));
}

/** The lanes of the time line, with the frames after the first that each marks. */
const lanesOf = (page, frames) => page.evaluate((count) => {
  const track = document.getElementById('track');
  const keys = [...document.querySelectorAll('#timeline .marks .key')];
  // Of a copy, since the browser warns where a canvas is read more than once.
  const canvas = Object.assign(document.createElement('canvas'), { width: track.width, height: track.height });
  const copy = canvas.getContext('2d', { willReadFrequently: true });
  copy.drawImage(track, 0, 0);
  const size = track.height / Math.max(4, keys.length);
  return Object.fromEntries(keys.map((key, row) => {
    const colour = key.querySelector('i').style.getPropertyValue('--c');
    const wanted = [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16)).join();
    const { data } = copy.getImageData(0, Math.floor((Math.round(row * size) + Math.round((row + 1) * size)) / 2), track.width, 1);
    const isMarked = (f) => data.slice(4 * Math.floor(((f + 0.5) * track.width) / count)).slice(0, 3).join() === wanted;
    return [key.textContent, Array.from({ length: count }, (_, f) => f).filter((f) => f > 0 && isMarked(f))];
  }));
}, frames);

const STATES = ['selected pair', 'selected object', 'impacts', 'inside', 'crossing'];

/** For each lane that marks anything, whether it marks each frame: of the pairs that `has` takes, and diagnostics of some objects. */
function wantedLanes(made, selected, has, objects) {
  const some = (test) => made.reports.map(({ pairs }) => pairs.filter(has).some(test));
  const inContact = ({ phase }) => phase === 'began' || phase === 'touching';
  const lanes = {
    ...(selected ? { [`selected ${selected}`]: some(inContact) } : {}),
    began: some(({ phase }) => phase === 'began'), ended: some(({ phase }) => phase === 'ended'),
    impacts: some(({ sweep }) => sweep?.impacts.length > 0),
    inside: some(({ inside }) => inside === 'a_in_b' || inside === 'b_in_a'), crossing: some(({ inside }) => inside === 'crossing'),
    incomplete: some((pair) => pair.incomplete || pair.contacts_cut), stale: some(({ stale }) => stale),
    diagnostics: made.reports.map(({ diagnostics }) => diagnostics.some(({ object }) => !objects || objects.includes(object))),
    DIVERGED: made.reports.map((_, f) => made.head.diverged.includes(f)),
  };
  return Object.entries(lanes).filter(([, marks]) => marks.some((isMarked) => isMarked));
}

/** The time line and the plot of the selection follow what is selected. */
async function checkHistory(page, made) {
  const isPair = (a, b) => (pair) => pair.a === a && pair.b === b;
  const isOf = (object) => ({ a, b }) => a === object || b === object;
  const all = [
    [null, null, 'All', () => true, null], ['pair:4:90', 'pair', 'Pair', isPair(1, 4), [1, 4]], ['object:4', 'object', 'Object', isOf(1), [1]],
    ['pair:3:4', 'pair', 'Pair', isPair(0, 1), [0, 1]], ['feature:6:vertex.0', 'object', 'Object', isOf(3), [3]],
    [null, null, 'All', () => true, null],
  ];
  const seen = new Set();
  for (const [selection, kind, title, has, objects] of all) {
    await goTo(page, 0);
    await page.evaluate((s) => window.graze.select(s), selection);
    const lanes = wantedLanes(made, kind, has, objects);
    await page.waitForFunction(() => document.querySelectorAll('#timeline .marks .key').length > 0);
    const wanted = Object.fromEntries(lanes.map(([name, marks]) => [name, marks.flatMap((isMarked, f) => (isMarked && f > 0 ? [f] : []))]));
    for (let i = 0; i < 40 && JSON.stringify(await lanesOf(page, made.scene.frames)) !== JSON.stringify(wanted); ++i) await page.waitForTimeout(50);
    same(`the marks of the time line with ${selection} selected`, await lanesOf(page, made.scene.frames), wanted);
    for (const [name, frames] of Object.entries(wanted)) seen.add(`${name} ${frames}`);
    const next = made.reports.findIndex((_, f) => f > 0 && lanes.some(([name, marks]) => marks[f] && !(STATES.includes(name) && marks[f - 1])));
    await page.keyboard.press('.');
    await page.waitForFunction((f) => window.graze.frame === f, next, { timeout: 5000 }).catch(() => {});
    same('a key goes to the next of them', await page.evaluate(() => window.graze.frame), next);
    await checkPlot(page, made, title, kind && has);
  }
  check('which differ', seen.size > 15, `${seen.size} lanes`);
  await goTo(page, 52);
}

/** The plot has the smallest values of the selected pairs. Without a selection it has the depths of all contacts. */
async function checkPlot(page, made, title, has) {
  const least = (values) => (values.length ? Math.min(...values) : null);
  const rows = made.reports.map(({ pairs }) => pairs.filter(has ?? (() => true)));
  const bounds = (name) => rows.map((pairs) => (has ? least(pairs.map((pair) => pair[name])) : null));
  const deepest = rows.map((pairs) => deepestOf(pairs.flatMap(({ contacts }) => contacts)));
  same(`the plot of ${title}`, await page.evaluate(() => window.graze.plotted()), {
    title, lines: { lower: bounds('lower'), upper: bounds('upper'), deepest } });
}

/** Data of before pages knew of solids, sunk edges and ways out. */
async function checkOldData() {
  const made = makePage({ ...smallScene(), isOld: true });
  const page = await open(write('old.html', pageHtml(template, made.chunks)));
  await goTo(page, 52);
  await page.evaluate(() => window.graze.select('pair:4:90'));
  const { selection } = await inspect(page);
  const signs = await page.locator('[data-testid^=inside-]').count();
  await page.evaluate(() => window.graze.select(null));
  check('without depths the plot asks for a pair', await page.isVisible('[data-testid=plot-bounds] .hint'));
  await page.evaluate(() => window.graze.select('pair:4:90'));
  check('and not with one', !(await page.isVisible('[data-testid=plot-bounds] .hint')));
  same('older data says nothing of solids', [selection.listed, 'inside' in selection, signs, page.errors], [true, false, 0, []]);
  same('nor of ways out and of impacts', ['way_out' in selection, (await drawn(page)).ways, 'impacts' in selection,
    (await drawn(page)).impacts, await page.locator('[data-testid=impacts]').count()], [false, 0, false, 0, 0]);
  const { pair, contact } = contactsOf(made.reports[52]).find((c) =>
    c.contact.kind === 'EE' && c.contact.side_a === 2 && c.contact.side_b === 2 && !c.contact.sunk);
  await page.evaluate((s) => window.graze.select(s), { type: 'contact', a: pair.a, b: pair.b, kind: 3, features: contact.features });
  same('there, edges behind each other are deep', (await inspect(page)).selection.separation, -contact.distance);
  await page.close();
}

/** What a page shows of what meets between two steps, and of an object with itself. */
async function checkSwept() {
  const scene = sweptScene();
  const made = { scene, ...makePage(scene) };
  const page = await open(write('swept.html', pageHtml(template, made.chunks)));
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const settings = await page.textContent('#source');
  check('where something is swept, settings say how', /sweep tolerance 0.000001 · swept gap 0.1/.test(settings), settings);
  await checkImpactNumbers(page, made);
  await checkImpactWays(page);
  await checkImpactSwitch(page);
  await checkImpactsInTime(page);
  await checkSelfPair(page, made);
  same('no console error of what is swept', page.errors, []);
  await page.close();
  const thin = await open(write('thin.html', pageHtml(template, makePage({ ...scene, every: 2 }).chunks)));
  await goTo(thin, 5);
  await thin.evaluate(() => window.graze.select('pair:3:4'));
  same('a page without the step before has the numbers alone', [(await inspect(thin)).selection.impacts.length,
    (await drawn(thin)).impacts, await thin.evaluate(() => window.graze.impactWays())], [2, 0, []]);
  await thin.close();
}

const FEATURE_NAMES = ['vertex', 'edge', 'face'];
const serialOf = (made, object) => made.head.objects[object].serial;

/** The impacts of a pair as the inspector has them. */
function impactsOf(made, { a, b, sweep }) {
  const feature = (object, kind, index) => {
    const { edges } = made.scene.objects[object].mesh;
    return [FEATURE_NAMES[kind], index, ...(kind === 1 ? [edges.slice(2 * index, 2 * index + 2)] : [])];
  };
  return sweep.impacts.map(({ kind, status, lower, upper, features: [ka, ia, kb, ib] }) => (
    { kind, status, lower, upper, feature_a: feature(a, ka, ia), feature_b: feature(b, kb, ib) }));
}

async function checkImpactNumbers(page, made) {
  const wrong = [];
  for (let frame = 0; frame < made.scene.frames; ++frame) {
    await goTo(page, frame);
    for (const pair of made.reports[frame].pairs) {
      await page.evaluate((s) => window.graze.select(s), `pair:${serialOf(made, pair.a)}:${serialOf(made, pair.b)}`);
      const { time_of_impact, time_of_gap, impacts } = (await inspect(page)).selection;
      const wanted = pair.sweep ? [pair.sweep.time_of_impact, pair.sweep.time_of_gap, impactsOf(made, pair)] : [];
      const got = [time_of_impact, time_of_gap, impacts].filter((value) => value !== undefined);
      if (JSON.stringify(got) !== JSON.stringify(wanted)) wrong.push([frame, got, wanted]);
    }
  }
  same('the numbers of impacts', wrong, []);
  await goTo(page, 5);
  await page.evaluate(() => window.graze.select('pair:3:4'));
  const facts = await shownFacts(page);
  same('the inspector shows the times of a pair and of its impacts',
    [facts.time_of_impact, facts.time_of_gap, facts['impacts.0.lower'], facts['impacts.0.upper'], facts['impacts.0.feature_a'],
      facts['impacts.0.feature_b'], facts['impacts.1.lower']],
    ['0.5', '0.475', '0.5', String(0.5 + 2 ** -20), 'face 3', 'vertex 0', '0.65']);
  same('and their kinds and statuses', await page.$$eval('[data-testid^=impact-]', (heads) => heads.map((e) => e.textContent)),
    ['impact 1 of 2: VF, certain', 'impact 2 of 2: EE, possible']);
}

/** Ways as sorted texts, with coordinates within the error of positions. */
const wayTexts = (ways) => ways.map(({ from, to }) => [...from, ...to].map((x) => x.toFixed(3).replace('-0.000', '0.000')).join(' ')).sort();
const away = (p, q) => Math.hypot(...p.map((x, k) => x - q[k]));

async function checkImpactWays(page) {
  await page.evaluate(() => window.graze.select(null));
  const down = (x, y, from, to) => ({ from: [x, y, from], to: [x, y, to] });
  const dart = [down(0.3, 0.4, 1, -1), down(-0.3, 0.4, 1.6, -0.4)];
  const strip = [down(2.4, 0.3, 0.2, -0.2), down(2.4, 0.7, 0.2, -0.2)];
  const wanted = {
    4: [[], []], 5: [dart, [[0.3, 0.4, 0], [0, 0.4, 0]]], 7: [strip, [[2.4, 0.3, 0], [2.4, 0.7, 0]]],
    12: [[down(0.3, 0.4, 1, 0.25)], [[0.3, 0.4, 0.5]]], 14: [[], []], 16: [dart, [[0.3, 0.4, 0], [0, 0.4, 0]]],
  };
  for (const [frame, [ways, places]] of Object.entries(wanted)) {
    await goTo(page, Number(frame));
    same(`ways of vertices that meet something, frame ${frame}`, wayTexts(await page.evaluate(() => window.graze.impactWays())), wayTexts(ways));
    const found = await page.evaluate(() => window.graze.impactPlaces());
    check(`and where they meet, frame ${frame}`, found.length === places.length && places.every((p, i) => away(p, found[i]) < 2e-5),
      JSON.stringify(found));
  }
}

async function checkImpactSwitch(page) {
  await goTo(page, 5);
  await page.keyboard.press('a');
  await page.waitForTimeout(400);
  const count = async () => [(await drawn(page)).impacts, (await page.evaluate(() => window.graze.impactWays())).length];
  same('the legend counts impacts', await page.textContent('[data-testid=impacts]'), 'impact2');
  const colour = [15, 125, 140];
  const onWays = await page.evaluate(() => window.graze.impactWays());
  const drawnThere = async () => {
    const found = await page.evaluate(([places, [red, green, blue]]) => {
      const { width, height, data } = window.graze.pixels();
      const canvas = document.getElementById('view');
      return places.map(({ x, y }) => {
        const [px, py] = [Math.round((x * width) / canvas.clientWidth), Math.round(height - (y * height) / canvas.clientHeight)];
        for (let dx = -3; dx <= 3; ++dx)
          for (let dy = -3; dy <= 3; ++dy) {
            const at = 4 * ((py + dy) * width + px + dx);
            if (Math.abs(data[at] - red) + Math.abs(data[at + 1] - green) + Math.abs(data[at + 2] - blue) < 60) return true;
          }
        return false;
      });
    }, [onWays, colour]);
    return found.filter((isThere) => isThere).length;
  };
  const on = [await count(), await drawnThere()];
  await press(page, 'impacts');
  const off = [await count(), await drawnThere()];
  await press(page, 'impacts');
  // The second impact is only possible, so that its way is fainter.
  same('ways have their colour in the picture, and the legend switches them', [on, off, await count()], [[[2, 2], 1], [[0, 0], 0], [2, 2]]);
  const eyes = async (...objects) => { for (const object of objects) await press(page, `eye-${object}`); };
  await press(page, 'tab-objects');
  await eyes(0, 1);
  const hidden = await count();
  await eyes(0, 1);
  same('impacts of hidden objects are not drawn', [hidden, await count()], [[0, 0], [2, 2]]);
  await press(page, 'pick-pair');
  const box = await page.locator('[data-testid=view]').boundingBox();
  await page.mouse.click(box.x + onWays[1].x, box.y + onWays[1].y);
  same('a click on a way selects its pair', (await drawn(page)).selection, 'pair:3:4');
  await press(page, 'pick-auto');
}

/** Plots and the time line say in which frames something meets. */
async function checkImpactsInTime(page) {
  await page.evaluate(() => window.graze.select(null));
  await goTo(page, 0);
  const lanes = await page.$$eval('.marks .key', (keys) => keys.map((e) => e.textContent));
  const labels = await page.$$eval('[data-testid=plot-contacts] .u-label', (cells) => cells.map((e) => e.textContent));
  check('the time line and a plot have impacts', lanes.includes('impacts') && labels.includes('impacts'), `${lanes} ${labels}`);
  for (const [selection, wanted] of [[null, [5, 7, 12, 16]], ['pair:3:4', [5, 12, 16]]]) {
    await goTo(page, 0);
    await page.evaluate((s) => window.graze.select(s), selection);
    await page.waitForFunction((s) => document.querySelector('.marks .key')?.textContent === (s ? 'impacts' : 'began'), selection);
    const marks = [];
    for (const frame of wanted) {
      await page.keyboard.press('.');
      await page.waitForFunction((f) => window.graze.frame === f, frame, { timeout: 5000 }).catch(() => {});
      marks.push(await page.evaluate(() => window.graze.frame));
    }
    same(`a key goes to the next impacts, of ${selection ?? 'any pair'}`, marks, wanted);
  }
}

/** A pair of an object with itself. */
async function checkSelfPair(page, made) {
  await page.evaluate(() => window.graze.select(null));
  await goTo(page, 8);
  await press(page, 'tab-objects');
  const cells = await page.$$eval('[data-key="o2"] b', (numbers) => numbers.map((e) => e.textContent));
  same('an object counts a pair with itself once', cells, ['1', '1']);
  await press(page, 'tab-contacts');
  same('the contact names it', await page.textContent('[data-key^="c2-2"] .two'), 'VFstripwith itself');
  await press(page, 'tab-pairs');
  same('the list of pairs names it', await page.textContent('[data-key="p2-2"] .two'), 'stripwith itself');
  await page.fill('[data-testid=search]', 'itself');
  same('the search finds it', (await drawn(page)).rows, 1);
  await page.fill('[data-testid=search]', '');
  await page.keyboard.press('Escape');
  await page.click('[data-key="p2-2"]');
  await page.waitForTimeout(500);
  const { selection } = await inspect(page);
  const link = await page.evaluate(() => window.graze.link());
  // A link has the camera relative to the middle of the first frame.
  const target = /c=([^&]*)/.exec(link)[1].split(',').slice(3).map((x, k) => Number(x) + [1, 0, 0.8][k]);
  check('a click frames the object', away(target, [2.4, 0.3, 0.1]) < 1e-3, target.join(' '));
  same('its numbers', [selection.lower, selection.contacts, 'inside' in selection, await page.locator('[data-testid=inside-words]').count()],
    [0.2, 1, false, 0]);
  const section = '[data-testid=inspector] section:first-child';
  same('the inspector names it, with one link to the object', [await page.textContent(`${section} h2 span`),
    await page.$$eval(`${section} .links .link`, (links) => links.map((e) => e.textContent))], ['strip with itself', ['strip']]);
  same('a link has it', /s=pair:5:5/.test(link), true);
  await page.keyboard.press('i');
  const alone = (await drawn(page)).surfaces;
  await page.keyboard.press('i');
  same('it can be shown alone', [alone, (await drawn(page)).surfaces], [1, 3]);
  await page.evaluate((s) => window.graze.select(s), 'contact:5:5:VF:vertex.6:face.0');
  same('the contact is named in the inspector', await page.textContent(`${section} h2 span`), 'VF · strip with itself');
  await page.keyboard.press('f');
  await page.waitForTimeout(500);
  // The selected feature of a is blue, that of b orange. A face has four sides, and each side of the contact has a halo.
  const { highlights } = await drawn(page);
  const seen = await page.evaluate(() => {
    const { data } = window.graze.pixels();
    const count = (red, green, blue) => {
      let found = 0;
      for (let i = 0; i < data.length; i += 4)
        if (Math.abs(data[i] - red) + Math.abs(data[i + 1] - green) + Math.abs(data[i + 2] - blue) < 12) ++found;
      return found;
    };
    return [count(0, 114, 178), count(179, 89, 0)];
  });
  check('both features of the contact are seen', highlights === 7 && seen.every((n) => n > 30), `${highlights} marks, ${seen} pixels`);
  await page.evaluate((s) => window.graze.select(s), `object:${serialOf(made, 2)}`);
  same('the object leads to it', await page.$$eval(`${section} .links .link`, (links) => links.map((e) => e.textContent)), ['↔ itself']);
  await page.evaluate(() => window.graze.select(null));
}

/** Faults of earlier pages: words that were cut off or hidden, and an empty picture. */
async function checkLayout(page) {
  await page.evaluate(() => window.graze.select(null));
  await goTo(page, 41);
  const settings = await page.textContent('#source');
  check('settings are words', /accuracy paper 0.3, 0.2, 0.1 · 1 of 5 objects solid$/.test(settings), settings);
  const colours = await page.evaluate(() => {
    const track = document.getElementById('track');
    const x = Math.round((41.5 / 96) * track.width) + 4;
    const { data } = track.getContext('2d').getImageData(x, 0, 1, track.height);
    return [...new Set(Array.from({ length: track.height }, (_, y) => data.slice(4 * y, 4 * y + 3).join()))];
  });
  check('stale frames and diagnostics have rows of their own', colours.includes('184,168,0') && colours.includes('90,100,112'), colours.join(' '));
  await page.evaluate(() => window.graze.select('pair:4:90'));
  const cut = await page.$$eval('.u-legend, .facts dt', (elements) =>
    elements.filter((e) => e.scrollWidth > e.clientWidth).map((e) => e.textContent));
  same('no name of a number is cut off', cut, []);
  await checkLostObject(page);
  const corner = await page.evaluate(() => new Promise((resolve) => {
    const canvas = document.getElementById('view');
    let calls = 0;
    // It is called after the page's own observer, before the browser shows the frame.
    new ResizeObserver(() => {
      if (++calls < 2) return;
      const gl = canvas.getContext('webgl2');
      const pixel = new Uint8Array(4);
      gl.readPixels(2, gl.drawingBufferHeight - 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      resolve([...pixel].join());
    }).observe(canvas.parentElement);
    requestAnimationFrame(() => requestAnimationFrame(() => document.body.classList.toggle('noplots')));
  }));
  await page.evaluate(() => document.body.classList.toggle('noplots'));
  same('a picture of a new size is not shown empty', corner, '244,245,247,255');
}

/** Names and numbers in a row that touch each other or the end of their row, or that are cut off. */
function touchingTexts() {
  const found = [];
  const boxOf = (element) => {
    const range = document.createRange();
    range.selectNodeContents(element);
    return { text: element.textContent, box: range.getBoundingClientRect() };
  };
  for (const row of document.querySelectorAll('.heads, .tabs, .marks, .chips, .u-legend tbody')) {
    const outer = row.getBoundingClientRect();
    const parts = [...row.children].map(boxOf).filter(({ box }) => outer.width > 0 && box.width > 0);
    parts.forEach(({ text, box }, i) => {
      const next = parts[i + 1];
      if (next && next.box.top < box.bottom - 2 && next.box.left < box.right + 2) found.push(`${text} | ${next.text}`);
      if (box.right > outer.right + 1 || box.left < outer.left - 1 || box.bottom > outer.bottom + 2) found.push(`${text} is cut`);
    });
  }
  // A number stands under its head.
  const [heads, cells] = ['.heads .number', '.list .row:first-child b'].map((which) => [...document.querySelectorAll(which)].map(boxOf));
  heads.forEach(({ text, box }, i) => {
    if (cells[i] && Math.abs(cells[i].box.right - box.right) > 1.5) found.push(`${text} is not over ${cells[i].text}`);
  });
  return found;
}

/** In pages of any width, with each list and each order, heads do not run into each other. */
async function checkHeads(path) {
  const page = await open(path, '#f=52');
  const wrong = [];
  for (const width of [1600, 1280, 1101, 1000, 861, 800]) {
    await page.setViewportSize({ width, height: 720 });
    for (const selection of [null, 'pair:4:90', 'object:4']) {
      await page.evaluate((s) => window.graze.select(s), selection);
      await page.waitForTimeout(150);
      for (const tab of ['objects', 'pairs', 'contacts']) {
        await press(page, `tab-${tab}`);
        for (const click of [0, 1, 1, 2, 2]) {
          await page.evaluate((i) => document.querySelectorAll('.heads button')[i].click(), click);
          for (const text of await page.evaluate(touchingTexts)) wrong.push(`${width} ${tab}: ${text}`);
        }
      }
    }
  }
  same('heads do not run into each other', [...new Set(wrong)], []);
  await page.close();
}

/** An object of which no vertex is finite. */
async function checkLostObject(page) {
  await goTo(page, 44);
  await page.evaluate(() => window.graze.select('object:90'));
  const facts = (await inspect(page)).selection;
  check('an object without a place has no box', facts.exists && !('box_low' in facts) && facts.vertices_not_finite.length > 0);
  await page.keyboard.press('a');
  await page.keyboard.press('v');
  await page.waitForTimeout(400);
  await drawn(page);
  const before = await pixelsOf(page);
  await press(page, 'set-diagnostics');
  const changed = difference(before, await pixelsOf(page));
  await press(page, 'set-diagnostics');
  await page.keyboard.press('v');
  check('its diagnostic is in the picture', changed > 50, `${changed} pixels`);
  await page.evaluate(() => window.graze.select(null));
}

// ---- Keys ----

/** All that a key can change, as text. */
async function stateOf(page) {
  return page.evaluate(() => {
    const states = [...document.querySelectorAll('[aria-selected], [aria-pressed]')];
    return JSON.stringify([
      window.graze.link(), window.graze.drawn(), document.documentElement.dataset.theme, document.body.className,
      document.getElementById('right').dataset.shown, states.map((e) => e.ariaSelected ?? e.ariaPressed),
      document.getElementById('speed').value, document.getElementById('names').textContent, document.activeElement.id,
      document.getElementById('help').open, document.getElementById('note').textContent,
    ]);
  });
}

/** Keys whose work is seen in the picture alone. */
const SEEN_KEYS = ['r', 'Shift+c', '<', '>', 'b'];

const LABELS = { ' ': 'Space', ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', Escape: 'Esc' };
const labelOf = (key) => key === '+' ? key : key.split('+').map((part) => LABELS[part] ?? (part.length === 1 ? part.toUpperCase() : part)).join('+');

/** Keys of time, and the frame after each, beginning at 52. */
const TIME_KEYS = [['ArrowLeft', 51], ['ArrowRight', 52], ['PageUp', 42], ['PageDown', 52], ['Home', 0], ['End', 95]];

/** Each of these changes something. Where the selection matters it stands beside the key. */
const OTHER_KEYS = [
  [' '], [' '], [','], ['.'], ['['], [']'], ['Shift+r'], ['Shift+r'], ['t'], ['t'],
  ['f', 'pair:4:90'], ['a'], ['Shift+ArrowLeft'], ['Shift+ArrowRight'], ['Shift+ArrowUp'], ['Shift+ArrowDown'],
  ['Alt+ArrowLeft'], ['Alt+ArrowRight'], ['Alt+ArrowUp'], ['Alt+ArrowDown'], ['+'], ['='], ['-'], ['_'], ['u'], ['u'], ['a'],
  ['w'], ['w'], ['e'], ['e'], ['r'], ['r'], ['c'], ['Shift+c'], ['<'], ['>'], ['c'], ['k'], ['k'], ['m'], ['m'], ['Shift+m'], ['Shift+m'], ['s'], ['s'], ['q'], ['q'],
  ['o', 'pair:4:90'], ['x'], ['l'], ['l'], ...[1, 2, 3, 4, 9, 1, 2, 3, 4, 9].map((level) => [`Alt+${level}`]),
  ['d'], ['d'], ['b'], ['Shift+b'], ['b'], ['b'], ['n'], ['n'], ['i', 'object:4'], ['i'], ['h', 'object:4'], ['i'],
  ['1'], ['3'], ['2'], ['ArrowDown'], ['j'], ['j'], ['ArrowUp'], ['Shift+j'], ['Escape'], ['/'], ['Escape'], ['p'], ['v'], ['v'],
  ['y'], ['g'], ['g'], ['g'], ['?'], ['Escape'],
];

async function checkKeys(path) {
  const page = await open(path);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  // compute_test.mjs tests the keys of the page that computes.
  const tested = new Set(['…', ...['Shift+o', 'z', 'Shift+z'].map(labelOf)]);
  await goTo(page, 52);
  const frames = [];
  for (const [key, frame] of TIME_KEYS) {
    await page.keyboard.press(key);
    await page.waitForFunction((f) => window.graze.frame === f, frame, { timeout: 5000 }).catch(() => {});
    frames.push([key, await page.evaluate(() => window.graze.frame)]);
    tested.add(labelOf(key));
  }
  same('keys of time', frames, TIME_KEYS);
  await goTo(page, 52);
  const idle = [];
  for (const [key, selection] of OTHER_KEYS) {
    if (selection) await page.evaluate((s) => window.graze.select(s), selection);
    const look = SEEN_KEYS.includes(key) ? pixelsOf : stateOf;
    const before = await look(page);
    await page.keyboard.press(key);
    // Some work is done a little later, such as that of the clipboard.
    let isChanged = false;
    for (let i = 0; i < 40 && !isChanged; ++i) {
      isChanged = before !== await look(page);
      if (!isChanged) await page.waitForTimeout(50);
    }
    if (!isChanged) idle.push(key);
    tested.add(labelOf(key));
  }
  same('each key changes something', idle, []);
  // A browser asks only soon after a key, which a busy machine may miss.
  let chooser = null;
  for (let i = 0; i < 10 && !chooser; ++i)
    [chooser] = await Promise.all([page.waitForEvent('filechooser', { timeout: 10_000 }).catch(() => null),
      page.keyboard.press('Shift+o')]);
  check('a key asks for a file', chooser !== null);
  await page.keyboard.press('?');
  const told = await page.$$eval('#help .columns section', (sections) => sections.slice(1).flatMap((section) =>
    [...section.querySelectorAll('dt')].flatMap((dt) => dt.textContent.split(' '))));
  same('all keys of the help page are tested', told.filter((key) => !tested.has(key)), []);
  same('no console error after all keys', page.errors, []);
  await page.close();
}

async function checkLink(page, path) {
  await goTo(page, 33);
  await page.evaluate(() => window.graze.select('object:6'));
  const hash = await page.evaluate(() => window.graze.link());
  const other = await open(path, hash);
  same('a link shows the same place', await other.evaluate(() => window.graze.link()), hash);
  await other.close();
}

async function checkSchemes(page) {
  const light = await pixelsOf(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.waitForTimeout(200);
  const dark = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  check('the dark scheme', dark === 'rgb(27, 31, 36)' && difference(light, await pixelsOf(page)) > 1000, dark);
  await press(page, 'theme');
  const chosen = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  check('the switch to light', chosen === 'rgb(255, 255, 255)', chosen);
}

/** A page whose address names no frame opens at the one with most contacts, and shows what is there. */
async function checkFirstFrame(made) {
  const page = await open(write('first.html', pageHtml(template, made.chunks)), '');
  const counts = made.reports.map((report) => contactsOf(report).length);
  const busiest = counts.indexOf(Math.max(...counts));
  const { contacts } = await drawn(page);
  same('a page opens at the frame with most contacts', [busiest > 0, await page.evaluate(() => window.graze.frame), contacts],
    [true, busiest, counts[busiest]]);
  const places = await page.evaluate((n) => Array.from({ length: n }, (_, i) => window.graze.contactAt(i)), contacts);
  const box = await page.locator('[data-testid=view]').boundingBox();
  check('and all of them are in the picture', places.every((p) => p && p.x > 0 && p.y > 0 && p.x < box.width && p.y < box.height));
  await page.close();
  const scene = sweptScene();
  const bare = { ...scene, answers: (f) => scene.answers(f).map((pair) => ({ ...pair, contacts: [], phase: 'near', sweep: f === 5 ? null : pair.sweep })) };
  const meets = await open(write('meets.html', pageHtml(template, makePage(bare).chunks)), '');
  // From frame 5 on two pairs are near. Two impacts are in frames 7 and 16.
  same('without contacts it is the one with most impacts', [await meets.evaluate(() => window.graze.frame), (await drawn(meets)).impacts], [7, 2]);
  await meets.close();
}

async function checkFile(made) {
  const page = await open(write('empty.html', template));
  check('a page without data asks for a file', /Drop a .grazeview/.test(await page.textContent('[data-testid=empty]')));
  await page.setInputFiles('[data-testid=file]', write('small.grazeview', viewFile(made.chunks)));
  await page.waitForFunction(() => window.graze.frame === 0);
  same('a file opens', await page.textContent('[data-testid=title]'), made.head.title);
  await page.setInputFiles('[data-testid=file]', write('bad.grazeview', Buffer.from('no such file')));
  await page.waitForFunction(() => /not a .grazeview/.test(document.getElementById('note').textContent));
  check('a bad file is refused with a reason', true);
  await checkDrop(page, made);
  same('no console error without data', page.errors, []);
  await page.close();
}

/** Drops a file on the page as a pointer does. */
async function checkDrop(page, made) {
  const drop = (name, bytes) => page.evaluate(([fileName, base64]) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], fileName));
    const send = (type) => document.getElementById('view').dispatchEvent(
      new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
    send('dragover');
    const isMarked = document.body.classList.contains('dropping');
    send('drop');
    return isMarked && !document.body.classList.contains('dropping');
  }, [name, bytes.toString('base64')]);
  const other = new Map(made.chunks);
  other.set('head', gzipSync(JSON.stringify({ ...made.head, title: 'dropped' })));
  check('the page shows where a file may fall', await drop('dropped.grazeview', viewFile(other)));
  await page.waitForFunction(() => document.getElementById('title').textContent === 'dropped');
  check('a file that is dropped opens', (await drawn(page)).surfaces > 0);
  await drop('wrong.grazeview', Buffer.from('no such file'));
  await page.waitForFunction(() => /^wrong.grazeview: .*not a .grazeview/.test(document.getElementById('note').textContent));
  same('a bad file leaves the page as it is', await page.textContent('[data-testid=title]'), 'dropped');
}

// ---- Large pages ----

const median = (values) => [...values].sort((p, q) => p - q)[values.length >> 1];

async function checkLarge(name, scene, level, limits) {
  const { chunks, head } = makePage(scene, level);
  const path = write(`${name}.html`, pageHtml(template, chunks));
  const size = statSync(path).size / 1e6;
  const page = await open(path);
  const script = await page.evaluate(async ({ frames, times }) => {
    const seeks = [];
    for (let i = 0; i < times; ++i) {
      const began = performance.now();
      await window.graze.goTo((i * 397 + 200) % frames);
      seeks.push(performance.now() - began);
      // The software renderer is behind by now; a person would not seek again before they see something.
      window.graze.pixels();
    }
    const draws = [];
    for (let i = 0; i < 3; ++i) {
      const began = performance.now();
      window.graze.pixels();
      draws.push(performance.now() - began);
    }
    return { seeks, draws };
  }, { frames: head.frames, times: limits.seeks });
  const stats = await page.evaluate(() => window.graze.stats());
  console.log(`info ${name}: page ${size.toFixed(1)} MB, open ${page.openMs.toFixed(0)} ms, seek ${median(script.seeks).toFixed(0)} ms, ` +
    `drawn in software in ${median(script.draws).toFixed(0)} ms, block decoded in ${stats.decodeMs.toFixed(0)} ms`);
  check(`${name}: the page is below ${limits.size} MB`, size < limits.size, `${size.toFixed(1)} MB`);
  if (limits.open) within(`${name}: opens`, page.openMs, limits.open);
  if (limits.seek) within(`${name}: seeks, median`, median(script.seeks), limits.seek);
  same(`${name}: no console error`, page.errors, []);
  await page.close();
}

// ---- A page of graze ----

/** An impact of a report as the inspector has it. */
const impactIn = ({ kind, a, b, time: [lower, upper], status }) => ({ kind, status, lower, upper, feature_a: a, feature_b: b });

/** With `isSwept` the report must have impacts, and an object with itself. */
async function checkAgainstReport(path, reportPath, isSwept = false) {
  const [header, ...lines] = readFileSync(reportPath, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  const page = await open(path);
  const numbers = await page.evaluate(() => {
    const frames = Number(document.getElementById('frame').max) + 1;
    return { frames };
  });
  let compared = 0;
  let wrong = 0;
  for (const share of [0, 0.5, 1]) {
    await goTo(page, Math.round(share * (numbers.frames - 1)));
    const { frame } = await inspect(page);
    const report = lines.find((line) => line.frame === frame.frame);
    for (const pair of report?.pairs ?? []) {
      await page.evaluate((s) => window.graze.select(s), { type: 'pair', a: pair.a, b: pair.b });
      const { selection } = await inspect(page);
      ++compared;
      const got = [selection.phase, selection.lower, selection.upper, selection.witness_a, selection.point_a, selection.point_b, selection.contacts,
        selection.way_out, selection.time_of_impact ?? 1, selection.time_of_gap ?? 1, selection.impacts ?? []];
      const wanted = [pair.phase, ...pair.distance, pair.witness.a, pair.witness.point_a, pair.witness.point_b,
        (pair.contacts ?? []).length, pair.way_out, pair.time_of_impact ?? 1, pair.time_of_gap ?? 1, (pair.impacts ?? []).map(impactIn)];
      if (JSON.stringify(got) !== JSON.stringify(wanted)) ++wrong;
      for (const c of (pair.contacts ?? []).slice(0, 20)) {
        const feature = ([kind, index]) => [['vertex', 'edge', 'face'].indexOf(kind), index];
        await page.evaluate((s) => window.graze.select(s), {
          type: 'contact', a: pair.a, b: pair.b, kind: ['VV', 'VE', 'VF', 'EE', 'EF', 'FF'].indexOf(c.kind),
          features: [...feature(c.a), ...feature(c.b)] });
        const shown = (await inspect(page)).selection;
        ++compared;
        const gotContact = [shown.feature_a, shown.feature_b, shown.distance, shown.point_a, shown.point_b, shown.normal, shown.side_a, shown.side_b, shown.since, shown.sunk ?? false];
        const wantedContact = [c.a, c.b, c.distance, c.point_a, c.point_b, c.normal, ...c.side, c.since, c.sunk ?? false];
        if (JSON.stringify(gotContact) !== JSON.stringify(wantedContact)) ++wrong;
      }
    }
  }
  const settings = await page.textContent('#source');
  check('settings of sweeps are named where something is swept', /swe[ep]/.test(settings) === isSwept, settings);
  if (isSwept) {
    const pairs = lines.flatMap((line) => line.pairs ?? []);
    const meeting = pairs.filter((pair) => pair.impacts);
    check('the report has impacts of two objects and of one with itself',
      meeting.some((pair) => pair.a !== pair.b) && meeting.some((pair) => pair.a === pair.b) && pairs.some((pair) => pair.time_of_gap < 1));
    await checkPlacesOfReport(page, lines);
  }
  check(`numbers of ${path} are those of its report`, compared > 0 && wrong === 0,
    `${header.objects.length} objects, ${compared} compared, ${wrong} wrong`);
  same('no console error', page.errors, []);
  await page.close();
}

/** Each impact has a cross at the time that the report says: on both the sheet and the strip's bottom, z is 0. */
async function checkPlacesOfReport(page, lines) {
  let count = 0;
  let wrong = 0;
  for (const [frame, line] of lines.filter(({ pairs }) => pairs).entries()) {
    await goTo(page, frame);
    const places = await page.evaluate(() => window.graze.impactPlaces());
    const impacts = line.pairs.flatMap((pair) => pair.impacts ?? []);
    count += impacts.length;
    wrong += Math.abs(places.length - impacts.length) + places.filter(([, , z]) => Math.abs(z) > 1e-4).length;
  }
  check('each impact has its cross where the features meet', count > 0 && wrong === 0, `${count} impacts, ${wrong} wrong`);
}

// ---- A page of a recording ----

/** The rows of a table that `graze export` wrote, by the names of the columns. No cell of ours has a comma. */
function readTable(path) {
  const [names, ...lines] = readFileSync(path, 'utf8').trim().split('\n').map((line) => line.split(','));
  return lines.map((cells) => Object.fromEntries(cells.map((cell, i) => [names[i], cell])));
}

const pointOf = (row, name) => ['x', 'y', 'z'].map((axis) => Number(row[`${name}_${axis}`]));

function insideSentence({ inside, name_a: a, name_b: b }) {
  if (inside === 'a_in_b') return `${a} is inside ${b}`;
  if (inside === 'b_in_a') return `${b} is inside ${a}`;
  return inside === 'crossing' ? `${a} and ${b} cross` : `Neither of ${a} and ${b} is inside the other`;
}

/** The way out in a row of the table; undefined where its cells are empty. */
function wayOutOf(row) {
  if (row.way_fullness === '') return undefined;
  return { direction: pointOf(row, 'way_direction'), point: pointOf(row, 'way_point'), fullness: Number(row.way_fullness),
           thickness: Number(row.way_thickness), extent: Number(row.way_extent) };
}

/** Compares what the page says of one row of a report with the table. */
async function comparePair(page, row) {
  await page.evaluate((s) => window.graze.select(s), `pair:${row.object_a}:${row.object_b}`);
  const { selection } = await inspect(page);
  const inside = { a_in_b: [Number(row.object_a)], b_in_a: [Number(row.object_b)] }[row.inside] ?? [];
  const { ghosts } = await drawn(page);
  const got = [selection.phase, selection.lower, selection.upper, selection.inside, selection.contacts,
    await page.textContent('[data-testid=inside-words]'), inside.every((object) => ghosts.includes(object)), selection.way_out];
  const wanted = [row.phase, Number(row.distance_lower), Number(row.distance_upper), row.inside, Number(row.contacts),
    insideSentence(row), true, wayOutOf(row)];
  return JSON.stringify(got) === JSON.stringify(wanted);
}

/** Compares the numbers of a contact with the table, and its arrow with where the push leads. An edge that pierces has one only if asked for. */
async function compareContact(page, row, arrows, allArrows) {
  const features = ['a', 'b'].map((side) => `${row[`feature_kind_${side}`]}.${row[`feature_${side}`]}`);
  await page.evaluate((s) => window.graze.select(s), `contact:${row.object_a}:${row.object_b}:${row.kind}:${features.join(':')}`);
  const { selection } = await inspect(page);
  const push = pointOf(row, 'push');
  const got = [selection.separation, selection.push, selection.distance, selection.side_a, selection.side_b, String(selection.sunk ?? false)];
  const wanted = [Number(row.separation), push, Number(row.distance), row.side_a, row.side_b, row.sunk];
  const { a, b, kind, features: numbers } = await page.evaluate(() => window.graze.selection);
  const key = `c${a}-${b}-${kind}-${numbers.join('-')}`;
  const pierces = row.kind === 'EF' && Number(row.distance) === 0;
  if (arrows.has(key) === pierces) return false;
  const arrow = allArrows.get(key);
  const way = arrow.to.map((x, k) => x - arrow.from[k]);
  const size = Math.hypot(...way);
  const begin = pointOf(row, 'point_b');
  const leads = size > 0 && way.every((x, k) => Math.abs(x / size - push[k]) < 1e-6 && Math.abs(arrow.from[k] - begin[k]) < 1e-6);
  return leads && JSON.stringify(got) === JSON.stringify(wanted);
}

async function checkAgainstTables(path, contactsPath, rowsPath) {
  const [contacts, rows] = [readTable(contactsPath), readTable(rowsPath)];
  const page = await open(path);
  const wrong = { rows: 0, contacts: 0 };
  let compared = 0;
  for (const frame of new Set(rows.map((row) => row.frame))) {
    await goTo(page, Number(frame));
    const { contacts: count } = await drawn(page);
    const arrowsNow = async () => new Map((await page.evaluate((n) => Array.from({ length: n }, (_, i) => window.graze.arrowOf(i)), count))
      .filter((arrow) => arrow).map((arrow) => [arrow.key, arrow]));
    const arrows = await arrowsNow();
    await page.keyboard.press('Shift+m');
    await drawn(page);
    const allArrows = await arrowsNow();
    await page.keyboard.press('Shift+m');
    for (const row of rows.filter((r) => r.frame === frame)) if (!(await comparePair(page, row))) ++wrong.rows;
    for (const row of contacts.filter((r) => r.frame === frame).filter((_, i) => i % 5 === 0)) {
      ++compared;
      if (!(await compareContact(page, row, arrows, allArrows))) ++wrong.contacts;
    }
  }
  const behind = contacts.filter((row) => Number(row.separation) < 0).length;
  check('the recording has all that a pair of solids can be', ['none', 'a_in_b', 'b_in_a', 'crossing'].every((inside) =>
    rows.some((row) => row.inside === inside)) && behind > 20 && behind < contacts.length, `${behind} contacts behind`);
  same(`numbers of ${rows.length} rows and ${compared} contacts that differ from the recording`, wrong, { rows: 0, contacts: 0 });
  check('the settings name the detail and the solids', /detail nearest .*all 3 objects solid/.test(await page.textContent('#source')));
  await page.evaluate(() => window.graze.select(null));
  await press(page, 'tab-show');
  const before = await pixelsOf(page);
  await press(page, 'set-insides');
  const changed = difference(before, await pixelsOf(page));
  check('what is inside shows through, on and off', changed > 200, `${changed} pixels`);
  same('no console error', page.errors, []);
  await page.close();
}

// ---- All of it ----

try {
  const [givenPage, givenReport, givenRows] = process.argv.slice(2);
  if (givenRows === 'swept') {
    await checkAgainstReport(givenPage, givenReport, true);
  } else if (givenRows) {
    await checkAgainstTables(givenPage, givenReport, givenRows);
  } else if (givenPage) {
    await checkAgainstReport(givenPage, givenReport);
  } else {
    const scene = smallScene();
    const made = { scene, ...makePage(scene) };
    const path = write('small.html', pageHtml(template, made.chunks));
    const page = await open(path);
    check('a page from disk opens', (await page.evaluate(() => window.graze.error)) === null);
    await checkPlaying(page, scene.frames);
    await checkSelection(page, made);
    await checkFilters(page, made);
    await checkLines(page, made);
    await checkNumbers(page, made);
    await checkInside(page, made);
    await checkWaysOut(page, made);
    await checkPushes(page, made);
    await checkMarks(page);
    await checkLayout(page);
    await checkHeads(path);
    await checkLink(page, path);
    await checkSchemes(page);
    same('no console error', page.errors, []);
    await page.close();
    await checkKeys(path);
    await checkFirstFrame(made);
    await checkFile(made);
    await checkOldData();
    await checkSwept();
    await checkLarge('1,000 frames of 10,000 vertices', longScene(), 4, { size: 60, open: 2000, seek: 50, seeks: 15 });
    await checkLarge('2 × 100,000 vertices', largeScene(), 1, { size: 60, seeks: 4 });
  }
} catch (error) {
  check('runs to its end', false, error.stack);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
console.log(failures === 0 ? 'all checks passed' : `${failures} checks failed`);
process.exit(failures === 0 ? 0 : 1);
