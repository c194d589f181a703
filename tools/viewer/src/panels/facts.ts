// What are the numbers of what is selected?

import { INSIDES } from '../data/inside';
import { FEATURE_KINDS, IMPACT_STATUSES, KINDS, PHASES, SIDES } from '../data/report';
import type { Selection, Viewer } from '../viewer';

export type Fact = string | number | boolean | null | readonly Fact[] | { readonly [key: string]: Fact };
export type Facts = Record<string, Fact>;

const triple = (values: ArrayLike<number>, at: number): number[] => [values[at]!, values[at + 1]!, values[at + 2]!];

/** A number as JSON has it when it is finite; text where it is not. */
export function numberText(value: number): string {
  return Object.is(value, -0) ? '-0' : String(value);
}

function feature(viewer: Viewer, object: number, kind: number, index: number): Fact {
  const name = FEATURE_KINDS[kind] ?? String(kind);
  if (kind !== 1) return [name, index];
  return [name, index, viewer.page!.objects[object]!.mesh.featureCorners(1, index)];
}

export function objectFacts(viewer: Viewer, index: number): Facts {
  const { head, objects } = viewer.page!;
  const object = head.objects[index]!;
  const mesh = head.meshes[object.mesh]!;
  const state = objects[index]!;
  return {
    type: 'object', name: object.name, serial: object.serial, motion: object.motion,
    ...(object.solid === undefined ? {} : { solid: object.solid }), exists: state.isThere,
    frames: [object.first, object.last], user_data: object.user_data, position_error: object.position_error,
    vertices: mesh.vertices, edges: mesh.edges, triangles: mesh.triangles, quads: mesh.quads, levels: mesh.levels,
    ...(state.isThere && state.hasBox ? { box_low: [...state.low], box_high: [...state.high] } : {}),
    ...(state.notFinite.length ? { vertices_not_finite: state.notFinite.slice(0, 50) } : {}),
  };
}

export function pairFacts(viewer: Viewer, a: number, b: number): Facts {
  const { head } = viewer.page!;
  const report = viewer.report!;
  const row = report.rowOf(a, b);
  const names = { type: 'pair', a: head.objects[a]!.name, b: head.objects[b]!.name,
                  serial_a: head.objects[a]!.serial, serial_b: head.objects[b]!.serial };
  if (row < 0) return { ...names, listed: false };
  const { block } = report;
  const flags = block.flags[row]!;
  // Without a solid there is no inside, nor of an object with itself, and `none` would say nothing of surfaces that pierce each other.
  const hasSolid = a !== b && (head.objects[a]!.solid || head.objects[b]!.solid);
  const way = block.wayOutOf(row);
  const deepest = block.deepestOf(row);
  const features = block.witnessFeatures.subarray(4 * row, 4 * row + 4);
  const kinds: Record<string, number> = {};
  for (let c = block.contactBegin[row]!; c < block.contactEnd[row]!; ++c) {
    const kind = KINDS[block.kind[c]!] ?? '?';
    kinds[kind] = (kinds[kind] ?? 0) + 1;
  }
  const levels: Record<string, number> = {};
  for (let r = block.regionBegin[row]!; r < block.regionEnd[row]!; ++r) {
    const level = String(block.regionLevels[r]);
    levels[level] = (levels[level] ?? 0) + 1;
  }
  return {
    ...names, listed: true, phase: PHASES[block.phase[row]!] ?? '?',
    lower: block.lower[row]!, upper: block.upper[row]!,
    ...(hasSolid ? { inside: INSIDES[block.insideOf(row)] ?? '?' } : {}),
    incomplete: (flags & 1) !== 0, stale: (flags & 2) !== 0, contacts_cut: (flags & 4) !== 0,
    witness_a: feature(viewer, a, features[0]!, features[1]!), witness_b: feature(viewer, b, features[2]!, features[3]!),
    point_a: triple(block.witnessPoints, 6 * row), point_b: triple(block.witnessPoints, 6 * row + 3),
    contacts: block.contactEnd[row]! - block.contactBegin[row]!, contacts_by_kind: kinds,
    ...(deepest === null ? {} : { deepest_separation: deepest }),
    region_distances: block.regionEnd[row]! - block.regionBegin[row]!, region_distances_by_level: levels,
    ...(way ? { way_out: { ...way } } : {}),
    ...sweepFacts(viewer, row, a, b),
  };
}

/** What the pair met between the step before and this one; nothing where it met nothing and came near nothing. */
function sweepFacts(viewer: Viewer, row: number, a: number, b: number): Facts {
  const { block } = viewer.report!;
  const sweep = block.sweepOf(row);
  if (!sweep) return {};
  const impacts: Facts[] = [];
  for (let i = sweep.begin; i < sweep.end; ++i) {
    const features = block.impactFeatures.subarray(4 * i, 4 * i + 4);
    impacts.push({
      kind: KINDS[block.impactKind[i]!] ?? '?', status: IMPACT_STATUSES[block.impactStatus[i]!] ?? '?',
      lower: block.impactTimes[2 * i]!, upper: block.impactTimes[2 * i + 1]!,
      feature_a: feature(viewer, a, features[0]!, features[1]!), feature_b: feature(viewer, b, features[2]!, features[3]!),
    });
  }
  return { time_of_impact: sweep.timeOfImpact, time_of_gap: sweep.timeOfGap, impacts };
}

export function contactFacts(viewer: Viewer, s: Selection & { type: 'contact' }): Facts {
  const { head } = viewer.page!;
  const { block } = viewer.report!;
  const row = viewer.selectedContactRow();
  const names = {
    type: 'contact', kind: KINDS[s.kind] ?? '?', a: head.objects[s.a]!.name, b: head.objects[s.b]!.name,
    serial_a: head.objects[s.a]!.serial, serial_b: head.objects[s.b]!.serial,
    feature_a: feature(viewer, s.a, s.features[0]!, s.features[1]!),
    feature_b: feature(viewer, s.b, s.features[2]!, s.features[3]!),
  };
  if (row < 0) return { ...names, listed: false };
  const report = viewer.report!;
  return {
    ...names, listed: true, distance: block.distance[row]!, separation: report.separation(row),
    point_a: triple(block.points, 6 * row), point_b: triple(block.points, 6 * row + 3),
    normal: triple(block.normal, 3 * row), push: report.push(row),
    side_a: SIDES[report.sideA(row)] ?? '?', side_b: SIDES[report.sideB(row)] ?? '?',
    ...(KINDS[s.kind] === 'EE' ? { sunk: block.isSunk(row) } : {}),
    since: block.since[row]!, age: report.age(row),
  };
}

function featureFacts(viewer: Viewer, s: Selection & { type: 'feature' }): Facts {
  const { head, objects } = viewer.page!;
  const object = head.objects[s.object]!;
  const state = objects[s.object]!;
  const corners = state.mesh.featureCorners(s.kind, s.index);
  const facts: Facts = { type: 'feature', object: object.name, serial: object.serial,
                         kind: FEATURE_KINDS[s.kind] ?? '?', index: s.index, exists: state.isThere };
  if (s.kind > 0) facts.vertices = corners;
  if (!state.isThere) return facts;
  const places = corners.map((v) => state.vertex(v));
  if (s.kind === 0) facts.position = places[0]!;
  else facts.positions = places;
  if (s.kind === 1) facts.length = Math.hypot(...places[0]!.map((x, k) => x - places[1]![k]!));
  facts.position_error = object.position_error;
  facts.contacts_here = contactsAt(viewer, s);
  return facts;
}

function contactsAt(viewer: Viewer, s: Selection & { type: 'feature' }): number {
  const { block } = viewer.report!;
  let found = 0;
  for (const [c, pair] of viewer.report!.contacts()) {
    const isSide = (object: number, at: number) =>
      object === s.object && block.features[4 * c + at] === s.kind && block.features[4 * c + at + 1] === s.index;
    if (isSide(block.pairA[pair]!, 0) || isSide(block.pairB[pair]!, 2)) ++found;
  }
  return found;
}

/** The numbers of the selection in this frame, or null without one. */
export function selectionFacts(viewer: Viewer): Facts | null {
  const s = viewer.selection;
  if (!s || !viewer.page || !viewer.report) return null;
  if (s.type === 'object') return objectFacts(viewer, s.object);
  if (s.type === 'pair') return pairFacts(viewer, s.a, s.b);
  if (s.type === 'contact') return contactFacts(viewer, s);
  return featureFacts(viewer, s);
}

export function frameFacts(viewer: Viewer): Facts {
  const report = viewer.report!;
  const depths = [...report.pairs()].map((row) => report.block.deepestOf(row)).filter((depth) => depth !== null);
  return {
    type: 'frame', page_frame: viewer.frame, frame: report.info.frame, tag: report.info.tag,
    complete: report.info.complete, diverged: viewer.page!.head.diverged?.includes(viewer.frame) ?? false,
    ...(report.diagnostics.length ? { diagnostics: report.diagnostics.map((d) => diagnosticText(viewer, d)) } : {}),
    ...(depths.length ? { deepest_separation: Math.min(...depths) } : {}),
    statistics: report.info.statistics as Facts,
  };
}

export function diagnosticText(viewer: Viewer, d: { object: number | null; kind: string; message: string }): string {
  const name = d.object === null ? '' : `${viewer.page!.head.objects[d.object]?.name}: `;
  return `${name}${d.kind}: ${d.message}`;
}
