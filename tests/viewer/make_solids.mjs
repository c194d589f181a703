// Writes a scene of solids for the tests: a pebble and a marble that go into a crate, one from each side.
//   node tests/viewer/make_solids.mjs FOLDER
// The pebble is added before the crate and the marble after it, so that reports have all four values of `inside`.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { boxMesh, objText, sphereMesh } from './make_page.mjs';

const along = (from, to) => [{ frame: 0, translate: from }, { frame: 24, translate: to }];

const scene = {
  graze: 1, contact_distance: 0.2, range: 1, detail: 'nearest', ways_out: true,
  objects: [
    { name: 'pebble', mesh: 'ball.obj', solid: true, poses: along([-2.4, 0.1, 0.2], [-0.3, 0.15, 0.2]) },
    { name: 'crate', mesh: 'crate.obj', solid: true, motion: 'fixed' },
    { name: 'marble', mesh: 'ball.obj', solid: true, poses: along([2.3, -0.2, 0.1], [0.5, -0.1, 0]) },
  ],
};

const folder = process.argv[2];
writeFileSync(join(folder, 'ball.obj'), objText(sphereMesh(8, 12, 0.3, 1)));
writeFileSync(join(folder, 'crate.obj'), objText(boxMesh(1, 1, 1)));
writeFileSync(join(folder, 'solids.json'), JSON.stringify(scene));
