// Writes a scene for the tests: a dart that goes through a sheet between two steps, and a strip that goes through itself.
//   node tests/viewer/make_swept.mjs FOLDER
// The sheet and the bottom of the strip lie in the plane z = 0, so that everything meets there.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { dartMesh, gridMesh, makeMesh, objText, STRIP_FACES, stripAt } from './make_page.mjs';

const folder = process.argv[2];
const write = (name, mesh) => writeFileSync(join(folder, name), objText(mesh));
write('dart.obj', dartMesh());
write('sheet.obj', gridMesh(2, 2, 1));
write('strip.obj', makeMesh(stripAt(0.4), STRIP_FACES, 1));
[0.4, -0.2, 0.3].forEach((height, frame) => write(`strip_${frame}.obj`, makeMesh(stripAt(height), STRIP_FACES, 1)));

const scene = {
  graze: 1, contact_distance: 0.05, range: 1, swept_gap: 0.1, frames: 3,
  objects: [
    { name: 'sheet', mesh: 'sheet.obj', motion: 'fixed' },
    { name: 'dart', mesh: 'dart.obj', swept: true, poses: [[0, 1], [1, -1], [2, 0.5]].map(([frame, z]) => ({ frame, translate: [0, 0, z] })) },
    { name: 'strip', mesh: 'strip.obj', positions: 'strip_#.obj', self: true, swept: true },
  ],
};
writeFileSync(join(folder, 'swept.json'), JSON.stringify(scene));
