// What the program says of positions that a page shows: a scene of one frame whose objects stand there from the start.

import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const KINDS = ['VV', 'VE', 'VF', 'EE', 'EF', 'FF'];
const FEATURES = ['vertex', 'edge', 'face'];
const SIDES = ['none', 'front', 'back'];
const INSIDES = ['none', 'a_in_b', 'b_in_a', 'crossing'];

/// Writes the objects of a page where their vertices are now, with all digits, and lets `graze run` answer. Gives rows as
/// window.graze.rows() does. What the page says of pairs in the frame is said of these objects, too.
export function rowsOfProgram(graze, folder, head, frame, meshes, vertices) {
  const objects = head.objects.map((object, i) => {
    const mesh = `now_${i}.obj`;
    writeFileSync(join(folder, mesh), objText(meshes[object.mesh], vertices[i]));
    const { solid, settings } = object;
    return { name: nameOf(i), mesh, solid, motion: object.motion === 'fixed' ? 'fixed' : 'rigid', ...settings };
  });
  const scene = join(folder, 'now.json');
  const { sweep_tolerance: _, swept_gap: __, ...settings } = head.settings;
  writeFileSync(scene, JSON.stringify({ graze: 1, frames: 1, ...settings, ...filtersOf(head, frame), objects }));
  const report = join(folder, 'now.jsonl');
  execFileSync(graze, ['run', scene, '--report', report]);
  return JSON.parse(readFileSync(report, 'utf8').split('\n')[1]).pairs.map(rowOf);
}

const nameOf = (object) => `object ${object}`;

function filtersOf(head, frame) {
  const now = (list) => (list ?? []).filter((entry) => entry.at(-2) <= frame && frame <= entry.at(-1));
  return {
    ignore: [
      ...now(head.ignored).map(([a, b]) => [nameOf(a), nameOf(b)]),
      ...now(head.ignored_groups).map(([a, groupA, b, groupB]) => [nameOf(a), groupA, nameOf(b), groupB])],
    rules: (head.rules ?? []).filter(({ first, last }) => first <= frame && frame <= last).map(({ first: _, last: __, ...rule }) => rule) };
}

/// Vertices that no face uses have no place in a page, and anywhere is good for them.
function objText(mesh, vertices) {
  const lines = [];
  for (let v = 0; v < vertices.length; v += 3) lines.push(`v ${vertices.slice(v, v + 3).map((x) => x ?? 0).join(' ')}`);
  for (let face = 0; face < mesh.faceCount; ++face) lines.push(`f ${mesh.faceCorners(face).map((v) => v + 1).join(' ')}`);
  return `${lines.join('\n')}\n`;
}

function rowOf(pair) {
  const ofWay = ({ direction, point, fullness, thickness, extent }) => ({ direction, point, fullness, thickness, extent });
  return {
    a: pair.a, b: pair.b, lower: pair.distance[0], upper: pair.distance[1], inside: INSIDES.indexOf(pair.inside ?? 'none'),
    way: pair.way_out ? ofWay(pair.way_out) : null,
    contacts: pair.contacts.map((contact) => ({
      kind: KINDS.indexOf(contact.kind),
      sides: SIDES.indexOf(contact.side[0]) + 4 * SIDES.indexOf(contact.side[1]) + (contact.sunk ? 16 : 0),
      distance: contact.distance,
      features: [contact.a, contact.b].flatMap(([kind, index]) => [FEATURES.indexOf(kind), index]),
      points: [...contact.point_a, ...contact.point_b], normal: contact.normal })),
  };
}
