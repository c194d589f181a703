// Makes the two pictures of docs/experiments.md that show the paper's figures 7 and 8 in graze's viewer.
//   node docs/experiments/make_pictures.mjs PROGRAM [FOLDER]
// PROGRAM is the program graze in its build folder, where the viewer was built. FOLDER is where the pictures go, by
// default this script's own. CHROMIUM names the browser. `graze_studies experiment` makes the meshes and the motion: this takes
// about a minute.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [, script, program, folder = dirname(fileURLToPath(import.meta.url))] = process.argv;
if (!program) {
  console.error(`usage: node ${script} PROGRAM [FOLDER]`);
  process.exit(2);
}
const browserModule = join(dirname(resolve(program)), 'viewer/work/source/node_modules/playwright-core/index.mjs');
const { chromium } = await import(pathToFileURL(browserModule));
const work = mkdtempSync(join(tmpdir(), 'graze-pictures-'));
const run = (path, words) => execFileSync(path, words, { stdio: ['ignore', 'ignore', 'inherit'] });
const graze = (...words) => run(program, words);
const experiment = (...words) => run(join(dirname(resolve(program)), '../studies/graze_studies'), ['experiment', ...words]);

/** Row 3 of the paper's table 2: ε of level 1, of level 2, and the last ε, below which two vertices are reported. */
const ROW_3 = [24, 14, 8];

/** Two pawns of experiment 1: one stands, the other comes from the side and leans over. */
function pawns() {
  experiment('1', '--frames', '1', '--runs', '1', '--out', work);
  const mesh = 'experiment_1/pawn_0.ply';
  const scene = join(work, 'pawns.json');
  writeFileSync(scene, JSON.stringify({
    graze: 1, contact_distance: ROW_3.at(-1), range: 'infinity', detail: 'regions', accuracy: { paper: ROW_3 }, frames: 12,
    objects: [
      { name: 'pawn 1', mesh, motion: 'fixed' },
      { name: 'pawn 2', mesh, motion: 'rigid', poses: [
        { frame: 0, translate: [45, 0, 0], rotate_degrees: [0, -25, 0] },
        { frame: 11, translate: [23, 0, 0], rotate_degrees: [0, -25, 0] }] }] }));
  return scene;
}

/** The scene file that experiment 2 writes for row 3 of the paper's table 3. */
function humans() {
  experiment('2', '--frames', '40', '--runs', '1', '--out', work);
  return join(work, 'experiment_2/row_3.json');
}

async function shoot(browser, scene, link, name) {
  const path = join(work, `${name}.html`);
  graze('run', scene, '--region-distances', '100000', '--no-times', '--html', path);
  const page = await browser.newPage({ viewport: { width: 1280, height: 700 }, colorScheme: 'light' });
  await page.goto(pathToFileURL(path).href + link);
  await page.evaluate(() => window.graze.ready);
  // Without plots, contacts and witnesses the lines between regions stand alone.
  for (const key of ['t', 'k', 'd']) await page.keyboard.press(key);
  await page.evaluate(() => window.graze.drawn());
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  await shoot(browser, pawns(), '#f=5&c=24,-132,66,13,0,-2', 'viewer_pawns');
  await shoot(browser, humans(), '#f=14&c=140,-178,50,0,-5,3', 'viewer_humans');
} finally {
  await browser.close();
  rmSync(work, { recursive: true });
}
