// Bundles the viewer into one page: dist/viewer.html, with styles, script and licences inside. The module that computes in
// the page (tools/wasm) is in it, too, where it lies beside this file as module.wasm.

import { build } from 'esbuild';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const read = (path) => readFileSync(join(here, path), 'utf8');

const licences = ['three', 'uplot'].map((name) => {
  const { version } = JSON.parse(read(`node_modules/${name}/package.json`));
  return { name, version, text: read(`node_modules/${name}/LICENSE`).trim() };
});

const bundle = await build({
  entryPoints: [join(here, 'src/main.ts')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2022',
  charset: 'utf8',
  legalComments: 'none',
  define: { LICENCES: JSON.stringify(licences) },
});

// A script's text ends at "</script" wherever it stands, and "<!--" changes how the rest of it is read.
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const styles = read('node_modules/uplot/dist/uPlot.min.css') + read('src/theme.css');

const modulePath = join(here, 'module.wasm');
const moduleElement = existsSync(modulePath)
  ? `<script type="application/x-graze-module">${gzipSync(readFileSync(modulePath), { level: 9 }).toString('base64')}</script>`
  : '';

const page = read('src/template.html')
  .replace('<!-- graze-module -->', () => moduleElement)
  .replace('/* styles */', () => styles)
  .replace('/* script */', () => script);
mkdirSync(join(here, 'dist'), { recursive: true });
writeFileSync(join(here, 'dist/viewer.html'), page);
console.log(`dist/viewer.html: ${Math.round(page.length / 1024)} KiB, of which ${Math.round(moduleElement.length / 1024)} KiB compute`);
