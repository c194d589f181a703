// The page that computes. Its numbers are compared with recordings and with the program, bit for bit.
//   node tests/viewer/compute_test.mjs GRAZE DEMO_SCENE.json SOLIDS.json FOLDER
// CHROMIUM names the browser, and GRAZE_VIEWER_FOLDER the folder in which the viewer was built with the module.

import { execFileSync } from 'node:child_process';
import { openAsBlob, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { rowsOfProgram } from './compute_scene.mjs';

const [graze, demo, solids, folder] = process.argv.slice(2);
const viewer = process.env.GRAZE_VIEWER_FOLDER;
const { chromium } = await import(join(viewer, 'node_modules/playwright-core/index.mjs'));
const { buildSync } = await import(join(viewer, 'node_modules/esbuild/lib/main.js'));

let failures = 0;
function check(name, isGood, detail = '') {
  if (!isGood) ++failures;
  console.log(`${isGood ? 'ok  ' : 'FAIL'} ${name}${detail === '' ? '' : `: ${detail}`}`);
}

function same(name, got, wanted) {
  const [a, b] = [JSON.stringify(got), JSON.stringify(wanted)];
  let at = 0;
  while (at < a.length && a[at] === b[at]) ++at;
  check(name, a === b, a === b ? '' : `got …${a.slice(Math.max(0, at - 60), at + 60)}, wanted …${b.slice(Math.max(0, at - 60), at + 60)}`);
}

// ---- Without a browser: the module beside a recording ----

/** The viewer's own code that reads pages and calls the module. */
const code = buildSync({
  stdin: { resolveDir: viewer, contents: ['compute/module', 'compute/page_scene', 'data/chunks', 'data/page', 'data/report']
    .map((name) => `export * from './src/${name}.ts';`).join('\n') },
  bundle: true, format: 'esm', write: false });
writeFileSync(join(folder, 'code.mjs'), code.outputFiles[0].text);
const { compare, ComputingModule, FileChunks, Page, PageScene } = await import(join(folder, 'code.mjs'));

function pageOf(scene, name, ...more) {
  const path = join(folder, name);
  execFileSync(graze, ['run', scene, '--html', path, '--no-times', ...more]);
  return path;
}

const openData = async (path) => Page.open(await FileChunks.open(await openAsBlob(path)));

async function checkAgainstRecording(name, page, module) {
  const wrong = [];
  let [pairs, contacts] = [0, 0];
  for (let frame = 0; frame < page.head.frames; ++frame) {
    const recorded = await page.load(frame, () => true);
    const scene = new PageScene(module, page, frame);
    const found = compare(recorded, scene.step());
    pairs += found.pairs;
    contacts += [...recorded.contacts()].length;
    if (found.same < found.pairs || found.more > 0 || scene.notTaken.length > 0) wrong.push({ frame, ...found, notTaken: scene.notTaken });
  }
  check(`${name}: the module has ${pairs} pairs and ${contacts} contacts of all frames of a recording, bit for bit`,
    wrong.length === 0 && contacts > 50, wrong.length === 0 ? '' : JSON.stringify(wrong));
}

/** A page of which something was left out has to answer otherwise, so that each is known to have an effect. */
async function checkFilters(module) {
  const scene = join(folder, 'filtered.json');
  const page = await openData(pageOf(scene, 'filtered.grazeview'));
  await checkAgainstRecording('filtered', page, module);
  execFileSync(graze, ['run', scene, '--record', join(folder, 'filtered.graze')]);
  execFileSync(graze, ['view', join(folder, 'filtered.graze'), '-o', join(folder, 'viewed.grazeview')]);
  await checkAgainstRecording('filtered, by way of a recording', await openData(join(folder, 'viewed.grazeview')), module);
  const frame = Math.floor(page.head.frames / 2);
  const recorded = await page.load(frame, () => true);
  const answer = (head) => compare(recorded, new PageScene(module, Object.assign(Object.create(page), { head }), frame).step());
  const without = (key) => ({ ...page.head, [key]: undefined });
  const objects = page.head.objects.map(({ settings: { hidden_groups: _, ...settings } = {}, ...object }) => ({ ...object, settings }));
  const heads = {
    ignored: without('ignored'), ignored_groups: without('ignored_groups'), rules: without('rules'),
    hidden_groups: { ...page.head, objects },
    'the frames of ignored': { ...page.head, ignored: page.head.ignored.map(([a, b]) => [a, b, frame + 1, frame + 1]) } };
  for (const [name, head] of Object.entries(heads)) {
    const found = answer(head);
    check(`the page needs ${name}`, found.same < found.pairs || found.more > 0, JSON.stringify(found));
  }
}

async function checkModule() {
  const module = await ComputingModule.from(readFileSync(join(viewer, 'module.wasm')));
  await checkAgainstRecording('solids', await openData(pageOf(solids, 'solids.grazeview')), module);
  await checkFilters(module);
  same('words of the library reach the page', thrownBy(() => module.call('set_positions', 99, new Float64Array(3), 1)),
    'the scene has no object 99 of the page');
}

function thrownBy(call) {
  try {
    call();
  } catch (error) {
    return error.message;
  }
  return null;
}

// ---- In a browser ----

const patience = 300_000;
const browser = await chromium.launch({
  timeout: patience, executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: 'light', offline: true });
context.setDefaultTimeout(patience);

async function open(path, frame) {
  const page = await context.newPage();
  page.on('pageerror', (error) => check(`no error in ${path}`, false, error.message));
  await page.goto(`${pathToFileURL(path).href}#f=${frame}`);
  await page.evaluate(() => window.graze.ready);
  return page;
}

const rows = (page) => page.evaluate(() => window.graze.rows());
const vertices = (page) => page.evaluate(() => window.graze.vertices());
const turnOn = async (page) => {
  await page.click('[data-testid=compute]');
  await page.waitForFunction(() => window.graze.computing.isOn && document.querySelector('#computing.shown'));
};
/** Waits until the page has shown what the last move of the pointer asked for. */
const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Drags what is shown of an object, and gives the vertices before and after. */
async function drag(page, object, byX, byY) {
  const before = await vertices(page);
  const place = await page.evaluate((o) => window.graze.objectAt(o), object);
  const box = await page.locator('[data-testid=view]').boundingBox();
  const [x, y] = [box.x + place.x, box.y + place.y];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let step = 1; step <= 4; ++step) {
    await page.mouse.move(x + (byX * step) / 4, y + (byY * step) / 4);
    await settle(page);
  }
  await page.mouse.up();
  await settle(page);
  return { before, after: await vertices(page) };
}

const moved = (before, after) => before.flatMap((old, i) => (JSON.stringify(old) === JSON.stringify(after[i]) ? [] : [i]));
const differing = (before, after) => new Set(before.flatMap((x, i) => (x === after[i] ? [] : [Math.floor(i / 3)])));

async function checkSameAsProgram(name, page, data) {
  const { head } = data;
  const meshes = [];
  data.objects.forEach((object, i) => (meshes[head.objects[i].mesh] = object.mesh));
  const shown = await rows(page);
  const frame = await page.evaluate(() => window.graze.frame);
  const contacts = shown.reduce((sum, row) => sum + row.contacts.length, 0);
  same(`${name}: ${shown.length} pairs and ${contacts} contacts are the program's`, shown, rowsOfProgram(graze, folder, head, frame, meshes, await vertices(page)));
  return contacts;
}

async function checkSolids() {
  const path = pageOf(solids, 'solids.html');
  const data = await openData(join(folder, 'solids.grazeview'));
  const page = await open(path, 14);
  const recorded = await rows(page);
  await turnOn(page);
  same('computing begins with the recorded rows', await rows(page), recorded);
  check('and says so', /\b(\d+) of \1 recorded pairs are equal bit for bit/.test(await page.textContent('[data-testid=compute-words]')));
  const view = await page.evaluate(() => window.graze.link());
  const { before, after } = await drag(page, 2, -15, 4);
  same('a drag moves one object', moved(before, after), [2]);
  same('and not the view', (await page.evaluate(() => window.graze.link())).split('&')[1], view.split('&')[1]);
  check('contacts follow', JSON.stringify(await rows(page)) !== JSON.stringify(recorded));
  await checkSameAsProgram('a dragged solid', page, data);
  const { contacts } = (await rows(page)).find((row) => row.a === 1 && row.b === 2);
  const { kind, features, distance } = contacts.find((contact) => contact.distance !== 0);
  await page.evaluate((selection) => window.graze.select(selection), { type: 'contact', a: 1, b: 2, kind, features });
  const facts = JSON.stringify((await page.evaluate(() => window.graze.inspect())).selection);
  check('the inspector has the numbers', facts.includes(String(distance)), `${distance}`);
  await page.keyboard.press('z');
  await page.waitForFunction(() => !window.graze.computing.isOn);
  await page.waitForFunction((text) => JSON.stringify(window.graze.rows()) === text, JSON.stringify(recorded));
  same('the recorded frame is back', await vertices(page), before);
  await turnOn(page);
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction(() => window.graze.frame === 15);
  check('another frame is a recorded one', !(await page.evaluate(() => window.graze.computing.isOn)));
  await page.close();
}

async function checkDemo() {
  const path = pageOf(demo, 'demo.html');
  const data = await openData(pageOf(demo, 'demo.grazeview'));
  const bytes = statSync(path).size;
  check('the page of the demonstration is below 10 MB', bytes < 10e6, `${(bytes / 1e6).toFixed(1)} MB`);
  const page = await open(path, 60);
  await turnOn(page);
  const atFirst = await page.evaluate(() => window.graze.computing.atFirst);
  check('rounded positions give nearly the recorded distances', atFirst.pairs > 5 && atFirst.missing + atFirst.more === 0 && atFirst.apart < 1e-4, JSON.stringify(atFirst));
  check('what the page could not take over', await page.evaluate(() => window.graze.computing.words.every((text) => !text.includes('not taken'))));
  await checkSameAsProgram('before a drag', page, data);
  const standing = await rows(page);
  await drag(page, 3, -60, 10);
  check('pairs follow', JSON.stringify(await rows(page)) !== JSON.stringify(standing));
  await checkSameAsProgram('a dragged pawn', page, data);
  await page.keyboard.press('Shift+Z');
  const { before, after } = await drag(page, 1, 0, -30);
  same('a drag can move one vertex', [moved(before, after), differing(before[1], after[1]).size], [[1], 1]);
  const contacts = await checkSameAsProgram('a dragged vertex', page, data);
  check('there are contacts', contacts > 100, contacts);
  const ms = await page.evaluate(() => window.graze.computing.stepMs);
  console.log(`note a step of the demonstration takes ${ms.toFixed(1)} ms in the page`);
  await page.close();
}

async function checkWithout() {
  const html = readFileSync(join(folder, 'solids.html'), 'utf8').replace(/<script type="application\/x-graze-module">[^<]*<\/script>/, '');
  const path = join(folder, 'without.html');
  writeFileSync(path, html);
  const page = await open(path, 20);
  await page.click('[data-testid=compute]');
  await page.waitForFunction(() => document.querySelector('#note.shown'));
  check('a page without the module says so', /built without the module/.test(await page.textContent('[data-testid=note]')));
  await page.close();
}

await checkModule();
await checkSolids();
await checkDemo();
await checkWithout();
await browser.close();
console.log(failures === 0 ? 'all good' : `${failures} failed`);
process.exit(failures === 0 ? 0 : 1);
