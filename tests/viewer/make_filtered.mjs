// Writes a scene for the tests: balls that sink into a floor, and calls that leave out some of that. One ball is ignored whole,
// the lower half of one is ignored against the top of the floor, and one has a rule. A side of the floor is hidden.
//   node tests/viewer/make_filtered.mjs FOLDER

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { boxMesh, objText, sphereMesh } from './make_page.mjs';

const ball = sphereMesh(8, 12, 0.3, 1);
const down = (x, y) => [{ frame: 0, translate: [x, y, 1.6] }, { frame: 12, translate: [x, y, 0.9] }];
const lowerHalf = ball.faces.map((_, face) => (2 * face >= ball.faces.length ? 1 : 0));

const scene = {
  graze: 1, contact_distance: 0.1, range: 1, detail: 'features',
  rules: [{ kinds: [3, 1], contact_distance: 0.45 }],
  ignore: [['ghost', 'floor'], ['half', 1, 'floor', 1]],
  objects: [
    { name: 'floor', mesh: 'floor.obj', motion: 'fixed', kind: 3, face_groups: [0, 1, 0, 2, 0, 0], hidden_groups: [2] },
    { name: 'plain', mesh: 'ball.obj', poses: down(-0.6, -0.6) },
    { name: 'ghost', mesh: 'ball.obj', poses: down(0.6, -0.6) },
    { name: 'half', mesh: 'ball.obj', poses: down(-0.6, 0.6), face_groups: lowerHalf },
    { name: 'ruled', mesh: 'ball.obj', poses: down(0.4, 0.4), kind: 1 },
    { name: 'at the side', mesh: 'ball.obj', poses: [{ frame: 0, translate: [1.35, 0, 0.9] }] },
  ],
};

const folder = process.argv[2];
writeFileSync(join(folder, 'ball.obj'), objText(ball));
writeFileSync(join(folder, 'floor.obj'), objText(boxMesh(1, 1, 1)));
writeFileSync(join(folder, 'filtered.json'), JSON.stringify(scene));
