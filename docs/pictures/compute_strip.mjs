#!/usr/bin/env node
// Drags the ring of the demonstration in the page that computes, and puts pictures of it into one strip.
//
//   tools/demo.sh                                  with Emscripten, so that the page has the module
//   docs/pictures/compute_strip.mjs out/demo/view.html docs/compute_strip.png
//
// GRAZE_VIEWER_FOLDER is where the viewer was built, which has playwright-core; CHROMIUM names the browser.

import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [path, out] = process.argv.slice(2);
const viewer = process.env.GRAZE_VIEWER_FOLDER ?? 'build/demo/tools/graze/viewer/work/source';
const { chromium } = await import(pathToFileURL(join(viewer, 'node_modules/playwright-core/index.mjs')).href);
const browser = await chromium.launch({
  timeout: 300_000, executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const context = await browser.newContext({ viewport: { width: 1000, height: 780 }, colorScheme: 'light', offline: true });
context.setDefaultTimeout(300_000);
const page = await context.newPage();
await page.goto(`${pathToFileURL(path).href}#f=52`);
await page.evaluate(() => window.graze.ready);
const ring = 1;
await page.evaluate((object) => {
  window.graze.select(`object:${object}`);
  for (const id of ['legend', 'axes']) document.getElementById(id).style.visibility = 'hidden';
}, ring);
await page.keyboard.press('f');
await page.waitForTimeout(600);
await page.evaluate(() => window.graze.select(null));
await page.keyboard.press('z');
await page.waitForFunction(() => window.graze.computing.isOn);

const box = await page.locator('[data-testid=view]').boundingBox();
const { x, y } = await page.evaluate((object) => window.graze.objectAt(object), ring);
const clip = { x: box.x + 20, y: box.y + 130, width: box.width - 40, height: box.height - 130 };
await page.mouse.move(box.x + x, box.y + y);
await page.mouse.down();
const frames = [];
for (let step = 0; step < 5; ++step) {
  await page.mouse.move(box.x + x + 12 * step, box.y + y - 12 * step);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const { contacts } = await page.evaluate(() => window.graze.drawn());
  frames.push({ contacts, png: (await page.screenshot({ clip })).toString('base64') });
}
await page.mouse.up();

const strip = await context.newPage();
await strip.setViewportSize({ width: 1300, height: 260 });
const cells = frames.map(({ contacts, png }) =>
  `<figure><img src="data:image/png;base64,${png}"><figcaption>${contacts} contacts</figcaption></figure>`);
await strip.setContent(`<style>
  body { margin: 0; background: white } div { display: inline-flex; gap: 4px; font: 15px sans-serif }
  figure { margin: 0 } img { width: 252px; display: block } figcaption { text-align: center; padding: 3px }
</style><div>${cells.join('')}</div>`);
await strip.locator('div').screenshot({ path: out });
await browser.close();
