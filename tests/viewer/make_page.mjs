// Makes synthetic pages in the format of docs/page_format.md, for the tests and for work on the viewer.
//   node tests/viewer/make_page.mjs small|long|large|swept OUT.html|OUT.grazeview [TEMPLATE.html]

import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const BLOCK = 16;
const NOT_FINITE = -2147483648;
const TYPES = {
  u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i32: Int32Array, f32: Float32Array, f64: Float64Array,
};

// ---- Tables ----

/// One table as bytes: the length of the header, the header, then each array at a multiple of 8.
export function tableBytes(header, arrays) {
  const entries = {};
  let end = 0;
  for (const [name, [type, values]] of Object.entries(arrays)) {
    entries[name] = { type, offset: end, count: values.length };
    end += Math.ceil((values.length * TYPES[type].BYTES_PER_ELEMENT) / 8) * 8;
  }
  let text = Buffer.from(JSON.stringify({ ...header, arrays: entries }));
  text = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, 0x20)]);
  const bytes = Buffer.alloc(8 + text.length + end);
  bytes.writeUInt32LE(text.length, 0);
  text.copy(bytes, 8);
  for (const [name, [type, values]] of Object.entries(arrays)) {
    const typed = values instanceof TYPES[type] ? values : TYPES[type].from(values);
    Buffer.from(typed.buffer, typed.byteOffset, typed.byteLength).copy(bytes, 8 + text.length + entries[name].offset);
  }
  return bytes;
}

// ---- Meshes ----

/// The unique edges of faces in the order in which they first appear along the corners.
function edgesOf(faces) {
  const seen = new Set();
  const edges = [];
  for (const face of faces)
    face.forEach((v, i) => {
      const w = face[(i + 1) % face.length];
      const [low, high] = v < w ? [v, w] : [w, v];
      const key = low * 4294967296 + high;
      if (!seen.has(key)) {
        seen.add(key);
        edges.push(low, high);
      }
    });
  return edges;
}

/// Halves a list of vertices along its widest axis.
function halve(vertices, points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const v of vertices)
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], points[v][k]);
      high[k] = Math.max(high[k], points[v][k]);
    }
  let axis = 0;
  for (let k = 1; k < 3; ++k) if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const sorted = [...vertices].sort((p, q) => points[p][axis] - points[q][axis]);
  const middle = sorted.length >> 1;
  return [sorted.slice(0, middle), sorted.slice(middle)];
}

/// The vertex nearest to the mean of some vertices.
function middleOf(vertices, points) {
  const mean = [0, 0, 0];
  for (const v of vertices) for (let k = 0; k < 3; ++k) mean[k] += points[v][k] / vertices.length;
  let best = vertices[0];
  let least = Infinity;
  for (const v of vertices) {
    const d = Math.hypot(points[v][0] - mean[0], points[v][1] - mean[1], points[v][2] - mean[2]);
    if (d < least) [least, best] = [d, v];
  }
  return best;
}

/// Regions level by level: each has up to eight children, made by halving three times.
function regionsOf(points, levels) {
  const regions = [{ level: 0, parent: 0, vertices: points.map((_, i) => i) }];
  for (let i = 0; i < regions.length; ++i) {
    const region = regions[i];
    if (region.level + 1 >= levels || region.vertices.length < 8) continue;
    let parts = [region.vertices];
    for (let k = 0; k < 3; ++k) parts = parts.flatMap((part) => halve(part, points));
    for (const part of parts) regions.push({ level: region.level + 1, parent: i, vertices: part });
  }
  return regions.map((r) => ({ ...r, middle: middleOf(r.vertices, points) }));
}

/// A mesh of the page from rest points and faces of three or four corners.
export function makeMesh(points, faces, levels) {
  const triangles = [];
  const quads = [];
  for (const face of faces) (face.length === 3 ? triangles : quads).push(face);
  let nextTriangle = 0;
  let nextQuad = triangles.length;
  const order = faces.map((face) => (face.length === 3 ? nextTriangle++ : nextQuad++));
  const isMixed = triangles.length > 0 && quads.length > 0;
  return { points, faces, triangles, quads, order: isMixed ? order : null, edges: edgesOf(faces),
           regions: regionsOf(points, levels) };
}

function meshTable(mesh) {
  const regionVertices = [];
  const begin = [];
  const end = [];
  for (const region of mesh.regions) {
    begin.push(regionVertices.length);
    for (const v of region.vertices) regionVertices.push(v);
    end.push(regionVertices.length);
  }
  return tableBytes({}, {
    triangles: ['u32', mesh.triangles.flat()],
    quads: ['u32', mesh.quads.flat()],
    ...(mesh.order ? { face_order: ['u32', mesh.order] } : {}),
    edges: ['u32', mesh.edges],
    rest: ['f64', mesh.points.flat()],
    region_level: ['u8', mesh.regions.map((r) => r.level)],
    region_parent: ['u32', mesh.regions.map((r) => r.parent)],
    region_middle: ['u32', mesh.regions.map((r) => r.middle)],
    region_begin: ['u32', begin],
    region_end: ['u32', end],
    region_vertices: ['u32', regionVertices],
  });
}

/// A grid in the plane z = 0. Cells for which `isCut` says so are two triangles, others are quads.
export function gridMesh(cells, size, levels, isCut = () => false) {
  const points = [];
  const faces = [];
  for (let j = 0; j <= cells; ++j)
    for (let i = 0; i <= cells; ++i) points.push([(i / cells - 0.5) * size, (j / cells - 0.5) * size, 0]);
  for (let j = 0; j < cells; ++j)
    for (let i = 0; i < cells; ++i) {
      const a = j * (cells + 1) + i;
      const [b, c, d] = [a + 1, a + cells + 2, a + cells + 1];
      if (isCut(i, j)) faces.push([a, b, c], [a, c, d]);
      else faces.push([a, b, c, d]);
    }
  return makeMesh(points, faces, levels);
}

/// A sphere of rings of triangles.
export function sphereMesh(rings, segments, radius, levels) {
  const points = [[0, 0, radius]];
  for (let r = 1; r < rings; ++r)
    for (let s = 0; s < segments; ++s) {
      const [u, v] = [(Math.PI * r) / rings, (2 * Math.PI * s) / segments];
      points.push([radius * Math.sin(u) * Math.cos(v), radius * Math.sin(u) * Math.sin(v), radius * Math.cos(u)]);
    }
  points.push([0, 0, -radius]);
  const at = (r, s) => 1 + (r - 1) * segments + (s % segments);
  const faces = [];
  for (let s = 0; s < segments; ++s) faces.push([0, at(1, s), at(1, s + 1)]);
  for (let r = 1; r < rings - 1; ++r)
    for (let s = 0; s < segments; ++s) {
      faces.push([at(r, s), at(r + 1, s), at(r + 1, s + 1)], [at(r, s), at(r + 1, s + 1), at(r, s + 1)]);
    }
  for (let s = 0; s < segments; ++s) faces.push([at(rings - 1, s + 1), at(rings - 1, s), points.length - 1]);
  return makeMesh(points, faces, levels);
}

export function boxMesh(x, y, z) {
  const points = [[-x, -y, -z], [x, -y, -z], [x, y, -z], [-x, y, -z], [-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]];
  const faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
  return makeMesh(points, faces, 1);
}

/// A mesh as the text of an OBJ file.
export const objText = (mesh) => [
  ...mesh.points.map((point) => `v ${point.join(' ')}`),
  ...mesh.faces.map((face) => `f ${face.map((corner) => corner + 1).join(' ')}`), ''].join('\n');

// ---- Motion ----

/// Quantized coordinates of one frame: all x, all y, all z.
function quantize(flat, origin, step) {
  const n = flat.length / 3;
  const q = new Int32Array(3 * n);
  for (let v = 0; v < n; ++v)
    for (let k = 0; k < 3; ++k) {
      const isFinite = Number.isFinite(flat[3 * v]);
      q[k * n + v] = isFinite ? Math.round((flat[3 * v + k] - origin[k]) / step) : NOT_FINITE;
    }
  return q;
}

/// Differences from the frame before, zigzag-coded and split into four planes of bytes.
function planes(q, before) {
  const bytes = new Uint8Array(4 * q.length);
  for (let i = 0; i < q.length; ++i) {
    const v = before ? (q[i] - before[i]) | 0 : q[i];
    const z = ((v << 1) ^ (v >> 31)) >>> 0;
    for (let k = 0; k < 4; ++k) bytes[k * q.length + i] = z >>> (8 * k);
  }
  return bytes;
}

function concatBytes(parts) {
  return new Uint8Array(Buffer.concat(parts.map((p) => Buffer.from(p.buffer, p.byteOffset, p.byteLength))));
}

function motionTable(scene, first, end) {
  const tracks = [];
  const arrays = {};
  scene.objects.forEach((object, i) => {
    const from = Math.max(first, object.first);
    const to = Math.min(end, object.last + 1);
    if (from >= to) return;
    const frames = [];
    for (let f = from; f < to; ++f) if (f === from || object.moves(f)) frames.push(f);
    const name = `p${i}`;
    const track = { object: i, frames, array: name };
    if (object.motion === 'deformable') {
      let before = null;
      const parts = frames.map((f) => {
        const q = quantize(object.positions(f), scene.origin, scene.quantum);
        const part = planes(q, before);
        before = q;
        return part;
      });
      tracks.push({ ...track, kind: 'positions', origin: scene.origin, step: scene.quantum });
      arrays[name] = ['u8', concatBytes(parts)];
    } else {
      tracks.push({ ...track, kind: 'pose' });
      arrays[name] = ['f64', frames.flatMap((f) => object.pose(f))];
    }
  });
  return tableBytes({ tracks }, arrays);
}

// ---- Reports ----

const INSIDES = ['none', 'a_in_b', 'b_in_a', 'crossing'];
const PHASES = { near: 0, began: 1, touching: 2, ended: 3 };
const KINDS = { VV: 0, VE: 1, VF: 2, EE: 3, EF: 4, FF: 5 };
const STATUSES = ['certain', 'possible', 'at_start'];

/// Data of before pages knew of solids has no `pair_inside`. Data of version 1 says of no contact that it is sunk.
function reportTable(reports, first, end, isOld) {
  const a = {
    frame_pair_begin: ['u32', []], frame_pair_end: ['u32', []],
    pair_a: ['u32', []], pair_b: ['u32', []], pair_phase: ['u8', []], pair_flags: ['u8', []], pair_inside: ['u8', []],
    pair_lower: ['f64', []], pair_upper: ['f64', []], witness_features: ['u32', []], witness_points: ['f64', []],
    pair_contact_begin: ['u32', []], pair_contact_end: ['u32', []],
    pair_region_begin: ['u32', []], pair_region_end: ['u32', []],
    contact_kind: ['u8', []], contact_sides: ['u8', []], contact_features: ['u32', []], contact_points: ['f64', []],
    contact_normal: ['f64', []], contact_distance: ['f64', []], contact_since: ['u32', []],
    region_levels: ['u32', []], region_ids: ['u32', []], region_points: ['f64', []], region_distance: ['f64', []],
    way_pair: ['u32', []], way_direction: ['f64', []], way_point: ['f64', []], way_fullness: ['f64', []],
    way_thickness: ['f64', []], way_extent: ['f64', []],
    sweep_pair: ['u32', []], sweep_time_of_impact: ['f64', []], sweep_time_of_gap: ['f64', []],
    sweep_impact_begin: ['u32', []], sweep_impact_end: ['u32', []],
    impact_kind: ['u8', []], impact_status: ['u8', []], impact_features: ['u32', []], impact_times: ['f64', []],
  };
  const put = (name, ...values) => a[name][1].push(...values);
  const size = (name) => a[name][1].length;
  const diagnostics = [];
  const info = [];
  for (let f = first; f < end; ++f) {
    const report = reports[f];
    put('frame_pair_begin', size('pair_a'));
    for (const pair of report.pairs) {
      put('pair_a', pair.a);
      put('pair_b', pair.b);
      put('pair_phase', PHASES[pair.phase]);
      put('pair_flags', (pair.incomplete ? 1 : 0) | (pair.stale ? 2 : 0) | (pair.contacts_cut ? 4 : 0));
      put('pair_inside', INSIDES.indexOf(pair.inside));
      if (pair.way_out) {
        put('way_pair', size('pair_a') - 1);
        for (const [name, value] of Object.entries(pair.way_out)) put(`way_${name}`, ...[value].flat());
      }
      if (pair.sweep) {
        put('sweep_pair', size('pair_a') - 1);
        put('sweep_time_of_impact', pair.sweep.time_of_impact);
        put('sweep_time_of_gap', pair.sweep.time_of_gap);
        put('sweep_impact_begin', size('impact_kind'));
        for (const impact of pair.sweep.impacts) {
          put('impact_kind', KINDS[impact.kind]);
          put('impact_status', STATUSES.indexOf(impact.status));
          put('impact_features', ...impact.features);
          put('impact_times', impact.lower, impact.upper);
        }
        put('sweep_impact_end', size('impact_kind'));
      }
      put('pair_lower', pair.lower);
      put('pair_upper', pair.upper);
      put('witness_features', ...pair.witness.features);
      put('witness_points', ...pair.witness.points);
      put('pair_contact_begin', size('contact_kind'));
      for (const c of pair.contacts) {
        put('contact_kind', KINDS[c.kind]);
        put('contact_sides', c.side_a + 4 * c.side_b + (c.sunk && !isOld ? 16 : 0));
        put('contact_features', ...c.features);
        put('contact_points', ...c.points);
        put('contact_normal', ...c.normal);
        put('contact_distance', c.distance);
        put('contact_since', c.since);
      }
      put('pair_contact_end', size('contact_kind'));
      put('pair_region_begin', size('region_levels'));
      for (const r of pair.regions) {
        put('region_levels', r.level);
        put('region_ids', ...r.ids);
        put('region_points', ...r.points);
        put('region_distance', r.distance);
      }
      put('pair_region_end', size('region_levels'));
    }
    put('frame_pair_end', size('pair_a'));
    for (const d of report.diagnostics) diagnostics.push({ frame: f, ...d });
    info.push(report.info);
  }
  if (isOld) delete a.pair_inside;
  const without = (...starts) => {
    for (const name of Object.keys(a)) if (starts.some((start) => name.startsWith(start))) delete a[name];
  };
  if (isOld || size('way_pair') === 0) without('way_');
  if (isOld || size('sweep_pair') === 0) without('sweep_', 'impact_');
  return tableBytes({ diagnostics, frames_info: info }, a);
}

/// The distance of a contact, negative where it lies behind a surface.
export function separationOf({ kind, sunk, distance, side_a: a, side_b: b, features }) {
  const [isVertexA, isVertexB] = [features[0] === 0, features[2] === 0];
  const isBehind = kind === 'EE' ? sunk : distance !== 0 &&
    (isVertexA || isVertexB ? (isVertexB && a === 2) || (isVertexA && b === 2) : a === 2 && b === 2);
  return isBehind ? -distance : distance;
}

/// The smallest separation of some contacts, null where there are none.
export const deepestOf = (contacts) => contacts.reduce((least, contact) => Math.min(least ?? Infinity, separationOf(contact)), null);

/// Older data has no depths.
function seriesOf(reports, isOld) {
  const impacts = reports.map((r) => r.pairs.reduce((sum, p) => sum + (p.sweep?.impacts.length ?? 0), 0));
  const count = (test) => reports.map((r) => r.pairs.filter(test).length);
  const times = (name) => reports.map((r) => r.info.statistics[name]);
  return {
    contacts: reports.map((r) => r.pairs.reduce((sum, p) => sum + p.contacts.length, 0)),
    near: count(() => true),
    in_contact: count((p) => p.phase === 'began' || p.phase === 'touching'),
    began: count((p) => p.phase === 'began'),
    ended: count((p) => p.phase === 'ended'),
    incomplete: count((p) => p.incomplete),
    stale: count((p) => p.stale),
    contacts_cut: count((p) => p.contacts_cut),
    inside: count((p) => p.inside === 'a_in_b' || p.inside === 'b_in_a'),
    crossing: count((p) => p.inside === 'crossing'),
    diagnostics: reports.map((r) => r.diagnostics.length),
    ...(impacts.some((n) => n > 0) ? { impacts } : {}),
    ...(isOld ? {} : { deepest: reports.map((r) => deepestOf(r.pairs.flatMap((p) => p.contacts))) }),
    read_ms: times('read_ms'), pairs_ms: times('pairs_ms'), refit_ms: times('refit_ms'), jobs_ms: times('jobs_ms'),
    publish_ms: times('publish_ms'), step_ms: times('step_ms'),
  };
}

// ---- Answers of the synthetic scenes: near enough to the real ones to look at ----

const sub = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const length = (p) => Math.hypot(p[0], p[1], p[2]);

/// The vertices of one object that are within reach of the box of another.
function insideBox(points, other, reach) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < other.length; ++i)
    if (Number.isFinite(other[i])) {
      low[i % 3] = Math.min(low[i % 3], other[i] - reach);
      high[i % 3] = Math.max(high[i % 3], other[i] + reach);
    }
  const found = [];
  for (let v = 0; v < points.length / 3; ++v)
    if ([0, 1, 2].every((k) => points[3 * v + k] > low[k] && points[3 * v + k] < high[k])) found.push(v);
  return found;
}

/// The nearest vertex of b for each vertex of a that is within reach, found with a grid of cells.
function nearVertices(a, b, reach) {
  const cells = new Map();
  const cell = (x) => Math.floor(x / reach) + 1000;
  const key = (i, j, k) => (i * 4096 + j) * 4096 + k;
  for (const v of insideBox(b, a, reach)) {
    const k = key(cell(b[3 * v]), cell(b[3 * v + 1]), cell(b[3 * v + 2]));
    if (!cells.has(k)) cells.set(k, []);
    cells.get(k).push(v);
  }
  const found = [];
  for (const v of insideBox(a, b, reach)) {
    const [i, j, k] = [cell(a[3 * v]), cell(a[3 * v + 1]), cell(a[3 * v + 2])];
    let best = -1;
    let least = reach;
    for (let n = 0; n < 27; ++n)
      for (const w of cells.get(key(i + (n % 3) - 1, j + (Math.floor(n / 3) % 3) - 1, k + Math.floor(n / 9) - 1)) ?? []) {
        const d = Math.hypot(a[3 * v] - b[3 * w], a[3 * v + 1] - b[3 * w + 1], a[3 * v + 2] - b[3 * w + 2]);
        if (d < least) [least, best] = [d, w];
      }
    if (best >= 0) found.push({ va: v, vb: best, distance: least });
  }
  return found;
}

const KIND_CYCLE = ['VF', 'VF', 'EE', 'VE', 'VF', 'EF', 'VV', 'FF', 'EE'];
const FEATURES_OF_KIND = { VV: [0, 0], VE: [0, 1], VF: [2, 0], EE: [1, 1], EF: [1, 2], FF: [2, 2] };

/// A contact at two vertices. Its kind, features and sides go round, so that a page has all of them. Each other EF is an edge
/// that pierces.
function contactAt(scene, a, b, near, pa, pb, frameNumber, ages) {
  const kind = KIND_CYCLE[(near.va * 7 + near.vb) % KIND_CYCLE.length];
  const [ka, kb] = FEATURES_OF_KIND[kind];
  const limit = (object, k, v) => {
    const mesh = scene.objects[object].mesh;
    return v % [mesh.points.length, mesh.edges.length / 2, mesh.faces.length][k];
  };
  const features = [ka, limit(a, ka, near.va), kb, limit(b, kb, near.vb)];
  const points = [pa[3 * near.va], pa[3 * near.va + 1], pa[3 * near.va + 2],
                  pb[3 * near.vb], pb[3 * near.vb + 1], pb[3 * near.vb + 2]];
  if (kind === 'EF' && near.va % 2 === 0) points.splice(3, 3, ...points.slice(0, 3));
  const away = sub(points.slice(3), points.slice(0, 3));
  const distance = length(away);
  const normal = distance > 0 ? away.map((x) => x / distance) : [0, 0, 1];
  const key = [a, b, kind, ...features].join();
  const since = ages.before.get(key) ?? frameNumber;
  ages.now.set(key, since);
  const areBehind = kind === 'EE' && distance > 0 && near.va % 3 === 0;
  const side_a = areBehind ? 2 : [1, 1, 2, 1, 0][near.va % 5];
  const side_b = areBehind ? 2 : [1, 1, 2, 0][near.vb % 4];
  const sunk = areBehind && near.va % 2 === 0;
  return { kind, features, points, normal, distance, since, side_a, side_b, sunk };
}

/// The children of each region; a leaf is its own child.
function childrenOf(regions) {
  const children = regions.map(() => []);
  regions.forEach((r, i) => i > 0 && children[r.parent].push(i));
  return children.map((list, i) => (list.length ? list : [i]));
}

/// The nearest pairs of regions of each level from 1 on. A pair is looked for only below one that was found.
function regionLines(scene, a, b, pa, pb) {
  const lines = [];
  const [ra, rb] = [scene.objects[a].mesh.regions, scene.objects[b].mesh.regions];
  const [ca, cb] = [childrenOf(ra), childrenOf(rb)];
  let above = [[0, 0]];
  for (let level = 1; level <= scene.lineLevels; ++level) {
    const found = [];
    for (const [p, q] of above)
      for (const i of ca[p])
        for (const j of cb[q]) {
          if (Math.max(ra[i].level, rb[j].level) !== level) continue;
          const [u, v] = [3 * ra[i].middle, 3 * rb[j].middle];
          const points = [pa[u], pa[u + 1], pa[u + 2], pb[v], pb[v + 1], pb[v + 2]];
          const distance = Math.hypot(points[3] - points[0], points[4] - points[1], points[5] - points[2]);
          if (Number.isFinite(distance)) found.push({ level, ids: [i, j, ra[i].middle, rb[j].middle], points, distance });
        }
    found.sort((p, q) => p.distance - q.distance);
    const kept = found.slice(0, scene.linesPerLevel * level);
    lines.push(...kept);
    above = kept.map((line) => [line.ids[0], line.ids[1]]);
  }
  return lines;
}

function worldPositions(object, f) {
  if (object.motion === 'deformable') return object.positions(f);
  const m = object.pose(f);
  return object.mesh.points.flatMap(([x, y, z]) => [0, 1, 2].map(
    (r) => m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3]));
}

/// All reports of a scene. `scene.linesPerLevel` and `scene.mostContacts` keep large ones small.
export function makeReports(scene) {
  const reports = [];
  let touched = new Set();
  let ages = { before: new Map(), now: new Map() };
  for (let f = 0; f < scene.frames; ++f) {
    const frameNumber = f * scene.every;
    ages = { before: ages.now, now: new Map() };
    const positions = scene.objects.map((o) => (f >= o.first && f <= o.last ? worldPositions(o, f) : null));
    const pairs = scene.answers ? scene.answers(f) : [];
    const touching = new Set();
    for (const [a, b] of scene.pairs) {
      const key = `${a},${b}`;
      const [pa, pb] = [positions[a], positions[b]];
      const near = pa && pb ? nearVertices(pa, pb, scene.range).sort((p, q) => p.distance - q.distance) : [];
      if (near.length === 0 && !touched.has(key)) continue;
      const inContact = near.length > 0 && near[0].distance < scene.contactDistance;
      if (inContact) touching.add(key);
      const phase = inContact ? (touched.has(key) ? 'touching' : 'began') : touched.has(key) ? 'ended' : 'near';
      const list = near.filter((n) => n.distance < scene.contactDistance).slice(0, scene.mostContacts);
      const first = near[0] ?? { va: 0, vb: 0, distance: scene.range };
      const points = [0, 1, 2].map((k) => (pa ?? pb)[3 * first.va + k]).concat([0, 1, 2].map((k) => (pb ?? pa)[3 * first.vb + k]));
      pairs.push({
        a, b, phase, ...scene.flags(f, a, b), inside: scene.inside(f, a, b), way_out: scene.wayOut(f, a, b), sweep: scene.sweep(f, a, b),
        lower: first.distance, upper: first.distance * (1 + 2 ** -52),
        witness: { features: [0, first.va, 0, first.vb], points },
        contacts: list.map((n) => contactAt(scene, a, b, n, pa, pb, frameNumber, ages)),
        regions: pa && pb ? regionLines(scene, a, b, pa, pb) : [],
      });
    }
    touched = touching;
    reports.push({ pairs, diagnostics: scene.diagnostics(f), info: frameInfo(scene, f, frameNumber, pairs, positions) });
  }
  return reports;
}

function frameInfo(scene, f, frameNumber, pairs, positions) {
  const wave = (k) => 0.02 + 0.03 * (1 + Math.sin(f * 0.37 + k));
  const statistics = {
    objects: positions.filter((p) => p).length,
    pairs_total: (scene.objects.length * (scene.objects.length - 1)) / 2,
    pairs_near: pairs.length,
    pairs_in_contact: pairs.filter((p) => p.phase === 'began' || p.phase === 'touching').length,
    contacts: pairs.reduce((sum, p) => sum + p.contacts.length, 0),
    regions_expanded: [4, 12, 31],
    read_ms: wave(0), pairs_ms: wave(1) / 3, refit_ms: wave(2), jobs_ms: 3 * wave(3), publish_ms: wave(4) / 4,
  };
  statistics.step_ms = ['read_ms', 'pairs_ms', 'refit_ms', 'jobs_ms', 'publish_ms'].reduce((s, k) => s + statistics[k], 0);
  return { frame: frameNumber, tag: String(7 * f), complete: !pairs.some((p) => p.incomplete), statistics };
}

// ---- Scenes ----

/// Positions of a deforming sphere that falls, bounces at height 0 and flattens there.
function bouncing(mesh, radius, x, y, period, height) {
  return (f) => {
    const t = ((f % period) / period) * 2 - 1;
    const centre = radius * 0.9 + height * t * t;
    const squash = 1 - 0.18 * Math.max(0, 1 - Math.abs(t) * 4);
    const out = new Float64Array(3 * mesh.points.length);
    mesh.points.forEach((p, i) => {
      const wobble = 1 + 0.03 * Math.sin(5 * p[0] + 3 * p[1] + f * 0.3);
      out[3 * i] = x + (p[0] / Math.sqrt(squash)) * wobble;
      out[3 * i + 1] = y + (p[1] / Math.sqrt(squash)) * wobble;
      out[3 * i + 2] = Math.max(-0.02, centre + p[2] * squash);
    });
    return out;
  };
}

const deformable = (name, mesh, positions, more = {}) => ({
  name, mesh, positions, motion: 'deformable', moves: () => true, ...more });
const posed = (name, motion, mesh, pose, more = {}) => ({
  name, mesh, pose, motion, moves: () => motion !== 'fixed', ...more });
const STILL = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

function finish(scene) {
  scene.objects.forEach((o, i) => {
    o.first ??= 0;
    o.last ??= scene.frames - 1;
    o.serial = o.serial ?? i + 3;
  });
  return { every: 2, origin: [-4, -4, -1], flags: () => ({}), inside: () => 'none', wayOut: () => null, sweep: () => null, diagnostics: () => [], diverged: undefined, block: BLOCK,
           mostContacts: 400, linesPerLevel: 5, lineLevels: 3, ...scene };
}

/// Five objects with everything that a page can hold.
export function smallScene() {
  const table = gridMesh(24, 4, 3, (i, j) => i < 8 && j < 8);
  const ball = sphereMesh(18, 30, 0.6, 4);
  const drop = sphereMesh(10, 16, 0.3, 3);
  const cloth = gridMesh(26, 1.9, 4);
  const clothAt = (f) => {
    const out = new Float64Array(3 * cloth.points.length);
    cloth.points.forEach(([x, y], i) => {
      const lift = 1.45 - 0.28 * Math.sin((Math.PI * f) / 96);
      out[3 * i] = x - 0.7;
      out[3 * i + 1] = y + 0.3;
      out[3 * i + 2] = lift - 0.35 * (x * x + y * y) + 0.04 * Math.sin(6 * x + 0.25 * f) * Math.cos(5 * y);
    });
    if (f >= 40 && f <= 42) out.fill(NaN, 3 * 400, 3 * 401);
    if (f === 44) out.fill(NaN);
    return out;
  };
  const turn = (f) => {
    const [c, s] = [Math.cos(0.05 * f), Math.sin(0.05 * f)];
    return [c, -s, 0, 0.9 + 0.5 * Math.cos(0.03 * f), s, c, 0, -1.1, 0, 0, 1, 0.33];
  };
  return finish({
    title: 'synthetic drops', frames: 96, accuracy: { paper: [0.3, 0.2, 0.1] }, quantum: 2 ** -16, range: 0.4, contactDistance: 0.1,
    objects: [
      posed('table', 'fixed', table, () => STILL),
      deformable('ball', ball, bouncing(ball, 0.6, -0.7, 0.3, 48, 0.35), { solid: true }),
      posed('box', 'rigid', boxMesh(0.3, 0.3, 0.3), turn),
      deformable('drop', drop, bouncing(drop, 0.3, 0.9, 0.8, 25, 0.8), { first: 20, last: 70 }),
      deformable('cloth </script> é', cloth, clothAt, { serial: 90 }),
    ],
    pairs: [[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 3]],
    flags: (f, a, b) => ({ stale: f >= 40 && f <= 42 && b === 4, incomplete: f === 60 && b === 1,
                           contacts_cut: f === 61 && b === 1 }),
    inside: (f, a, b) => (a === 1 && b === 4 && { 52: 'crossing', 53: 'a_in_b', 54: 'b_in_a' }[f]) || 'none',
    // A way out at any place, one that is too thin to be seen, and a contour without a direction.
    wayOut: (f, a, b) => (a === 1 && b === 4 && {
      51: { direction: [0, 0, 1], point: [-0.7, 0.3, 1.25], fullness: 1, thickness: 1e-9, extent: 0.5 },
      52: { direction: [0.6, 0, 0.8], point: [-0.7, 0.3, 1.2], fullness: 0.625, thickness: 0.75, extent: 1.25 },
      53: { direction: [0, 0, 0], point: [-0.7, 0.3, 1.2], fullness: 0.0625, thickness: 0, extent: 0 },
    }[f]) || null,
    sweep: (f, a, b) => (a === 1 && b === 4 && f === 52
      ? { time_of_impact: 0.5, time_of_gap: 0.25, impacts: [
        { kind: 'VF', status: 'certain', features: [0, 400, 2, 300], lower: 0.5, upper: 0.5000001 }] } : null),
    diagnostics: (f) => (f >= 40 && f <= 42
      ? [{ object: 4, kind: 'not_finite', message: 'vertex 400 is not finite' }]
      : f === 44 ? [{ object: 4, kind: 'not_finite', message: 'vertex 0 is not finite' }]
      : f === 10 ? [{ object: null, kind: 'stale_id', message: 'the id names no object of this scene' }] : []),
    diverged: [77, 78, 79],
  });
}

/// 1,000 frames of 10,000 moving vertices.
export function longScene() {
  const sphere = sphereMesh(50, 102, 1, 4);
  const [left, right] = [0, 1].map((side) => (f) => {
    const out = new Float64Array(3 * sphere.points.length);
    const shift = (side ? 1 : -1) * (0.99 + 0.08 * Math.cos(0.05 * f));
    sphere.points.forEach((p, i) => {
      const wobble = 1 + 0.03 * Math.sin(3 * p[2] + 2 * p[1] + 0.1 * f + side);
      for (let k = 0; k < 3; ++k) out[3 * i + k] = p[k] * wobble + (k === 0 ? shift : 0);
    });
    return out;
  });
  return finish({
    title: '1,000 frames of 10,000 vertices', frames: 1000, quantum: 2 ** -14, range: 0.1, contactDistance: 0.05,
    objects: [deformable('left', sphere, left), deformable('right', sphere, right)], pairs: [[0, 1]], mostContacts: 60,
    lineLevels: 1,
  });
}

/// Two spheres of 100,000 vertices each.
export function largeScene() {
  const sphere = sphereMesh(224, 449, 1, 3);
  const [low, high] = [0, 1].map((side) => (f) => {
    const out = new Float64Array(3 * sphere.points.length);
    const shift = (side ? 1 : -1) * (1.0 - 0.002 * f);
    sphere.points.forEach((p, i) => {
      const wobble = 1 + 0.01 * Math.sin(9 * p[0] + 7 * p[1] + 0.2 * f + side);
      for (let k = 0; k < 3; ++k) out[3 * i + k] = p[k] * wobble + (k === 2 ? shift : 0);
    });
    return out;
  });
  return finish({
    title: '2 × 100,000 vertices', frames: 20, quantum: 2 ** -14, lineLevels: 2, range: 0.03, contactDistance: 0.02, mostContacts: 2000,
    objects: [deformable('low', sphere, low), deformable('high', sphere, high)], pairs: [[0, 1]],
  });
}

/// A strip that is folded like a U, and whose free end comes to `height` over its bottom.
export const STRIP_FACES = [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5]];
export const stripAt = (height) => [[2, 0, 0], [2, 1, 0], [3, 0, 0], [3, 1, 0], [3, 0.1, 0.6], [3, 0.9, 0.6], [2.4, 0.3, height], [2.4, 0.7, height]];

/// A tetrahedron on its tip.
export const dartMesh = () => makeMesh([[0.3, 0.4, 0], [-0.3, 0.4, 0.6], [0.9, 1, 0.6], [0.9, -0.2, 0.6]],
  [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], 1);

/// A dart that goes through a sheet between two steps, and a strip that goes through itself. Their numbers are known.
export function sweptScene() {
  const dart = dartMesh();
  const sheet = gridMesh(2, 2, 1);
  const strip = makeMesh(stripAt(0.4), STRIP_FACES, 1);
  const edge = (mesh, v, w) => {
    for (let e = 0; e < mesh.edges.length / 2; ++e) if (mesh.edges[2 * e] === v && mesh.edges[2 * e + 1] === w) return e;
    throw new Error(`no edge ${v}-${w}`);
  };
  const flat = (points) => Float64Array.from(points.flat());
  // The tip of the dart and the sheet, by frame. Both jump: the dart before 9 and 13, and the sheet before 12 and 13.
  const tip = (f) => (f < 5 ? 1 : f < 9 ? -1 : f < 12 ? 1 : f < 13 ? 0.25 : f < 16 ? 1 : -1);
  const level = (f) => (f === 12 ? 0.5 : 0);
  const end = (f) => (f < 5 ? 0.4 : 0.2);
  const through = (f) => (f === 7 ? -0.2 : end(f));
  const tipAndFace = (time) => ({ kind: 'VF', status: 'certain', features: [2, 3, 0, 0], lower: time, upper: time + 2 ** -20 });
  const edges = { kind: 'EE', status: 'possible', features: [1, edge(sheet, 4, 7), 1, edge(dart, 0, 1)], lower: 0.65, upper: 0.65 + 2 ** -20 };
  const sweeps = {
    5: { time_of_impact: 0.5, time_of_gap: 0.475, impacts: [tipAndFace(0.5), edges] },
    12: { time_of_impact: 2 / 3, time_of_gap: 0.625, impacts: [tipAndFace(2 / 3)] },
    14: { time_of_impact: 1, time_of_gap: 0.75, impacts: [] },
    16: { time_of_impact: 0.5, time_of_gap: 0.475, impacts: [tipAndFace(0.5), edges] },
  };
  const ofItself = { time_of_impact: 0.5, time_of_gap: 0.375, impacts: [6, 7].map((vertex) => (
    { kind: 'VF', status: 'certain', features: [0, vertex, 2, 0], lower: 0.5, upper: 0.5 + 2 ** -20 })) };
  const answers = (f) => {
    const away = Math.abs(tip(f) - level(f));
    const witness = (features, points) => ({ features, points });
    const base = { inside: 'none', way_out: null, contacts: [], regions: [] };
    const found = [{
      ...base, a: 0, b: 1, phase: 'near', lower: away, upper: away, sweep: sweeps[f] ?? null,
      witness: witness([2, 3, 0, 0], [0.3, 0.4, level(f), 0.3, 0.4, tip(f)]) }];
    if (f < 5) return found;
    const height = through(f);
    const contact = {
      kind: 'VF', features: [0, 6, 2, 0], points: [2.4, 0.3, height, 2.4, 0.3, 0], normal: [0, 0, -Math.sign(height)],
      distance: Math.abs(height), since: 5, side_a: 1, side_b: 1, sunk: false };
    found.push({
      ...base, a: 2, b: 2, phase: f === 5 ? 'began' : 'touching', lower: contact.distance, upper: contact.distance,
      witness: witness([0, 6, 2, 0], contact.points), contacts: [contact], sweep: f === 7 ? ofItself : null });
    return found;
  };
  return finish({
    title: 'what meets between two steps', frames: 20, quantum: 2 ** -16, range: 3, contactDistance: 0.25, every: 1, pairs: [], answers,
    objects: [
      deformable('sheet', sheet, (f) => flat(sheet.points.map(([x, y]) => [x, y, level(f)]))),
      posed('dart', 'rigid', dart, (f) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, tip(f)], { swept: true }),
      deformable('strip', strip, (f) => flat(stripAt(through(f))), { solid: true }),
    ],
  });
}

export const SCENES = { small: smallScene, long: longScene, large: largeScene, swept: sweptScene };

// ---- Pages ----

/// The chunks of a scene, gzipped, and its reports for comparison.
export function makePage(scene, level = 6) {
  const reports = makeReports(scene);
  const meshes = [...new Set(scene.objects.map((o) => o.mesh))];
  const head = {
    version: scene.isOld ? 1 : 2, graze: '0.2.0', title: scene.title, source: 'synthetic.json',
    settings: {
      contact_distance: scene.contactDistance, range: scene.range, detail: 'features', accuracy: scene.accuracy ?? 'exact',
      sweep_tolerance: 1e-6, swept_gap: 0.1 },
    frames: scene.frames, frame_numbers: reports.map((r) => r.info.frame), every: scene.every,
    source_frames: scene.frames * scene.every, block: scene.block,
    objects: scene.objects.map((o) => ({
      serial: o.serial, name: o.name, motion: o.motion, ...(scene.isOld ? {} : { solid: o.solid ?? false, swept: o.swept ?? false }), mesh: meshes.indexOf(o.mesh), first: o.first, last: o.last,
      user_data: String(1000 + o.serial), position_error: o.motion === 'deformable' ? scene.quantum / 2 : 0 })),
    meshes: meshes.map((m, i) => ({
      chunk: `mesh/${i}`, vertices: m.points.length, edges: m.edges.length / 2, triangles: m.triangles.length,
      quads: m.quads.length, levels: 1 + Math.max(...m.regions.map((r) => r.level)) })),
    series: seriesOf(reports, scene.isOld),
    ...(scene.diverged ? { diverged: scene.diverged } : {}),
  };
  const chunks = new Map();
  const put = (name, bytes) => chunks.set(name, gzipSync(bytes, { level }));
  put('head', Buffer.from(JSON.stringify(head)));
  meshes.forEach((m, i) => put(`mesh/${i}`, meshTable(m)));
  for (let k = 0; k * scene.block < scene.frames; ++k) {
    const [first, end] = [k * scene.block, Math.min((k + 1) * scene.block, scene.frames)];
    put(`motion/${k}`, motionTable(scene, first, end));
    put(`report/${k}`, reportTable(reports, first, end, scene.isOld));
  }
  return { chunks, head, reports };
}

export function pageHtml(template, chunks) {
  const scripts = [...chunks].map(([name, gzip]) =>
    `<script type="application/x-graze-chunk" data-name="${name}">${gzip.toString('base64')}</script>`);
  const parts = template.split('<!-- graze-data -->');
  if (parts.length !== 2) throw new Error('the template needs the line <!-- graze-data --> exactly once');
  return parts.join(scripts.join('\n'));
}

export function viewFile(chunks) {
  const parts = [Buffer.from('GRZVIEW1')];
  for (const [name, gzip] of chunks) {
    const text = Buffer.from(name);
    const sizes = Buffer.alloc(12);
    sizes.writeUInt32LE(text.length, 0);
    sizes.writeBigUInt64LE(BigInt(gzip.length), 4);
    parts.push(sizes, text, gzip);
  }
  return Buffer.concat(parts);
}

const here = fileURLToPath(import.meta.url);
if (process.argv[1] === here) {
  const [which, out, template] = process.argv.slice(2);
  const page = makePage(SCENES[which]());
  const path = template ?? here.replace('tests/viewer/make_page.mjs', 'tools/viewer/dist/viewer.html');
  writeFileSync(out, out.endsWith('.grazeview') ? viewFile(page.chunks) : pageHtml(readFileSync(path, 'utf8'), page.chunks));
}
