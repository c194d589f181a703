// What does the head of a page say?

export interface ObjectHead {
  serial: number;
  name: string;
  motion: 'deformable' | 'rigid' | 'fixed';
  /** Not in older data. */
  solid?: boolean;
  /** Not in older data. */
  swept?: boolean;
  mesh: number;
  first: number;
  last: number;
  user_data: string;
  /** Further settings of the object that are not as usual. Not in older data. */
  settings?: Record<string, unknown>;
  position_error: number;
}

export interface MeshHead {
  chunk: string;
  vertices: number;
  edges: number;
  triangles: number;
  quads: number;
  levels: number;
}

export const STAGES = ['read_ms', 'pairs_ms', 'refit_ms', 'jobs_ms', 'publish_ms'] as const;
export const COUNTS = [
  'contacts', 'near', 'in_contact', 'began', 'ended', 'incomplete', 'stale', 'contacts_cut', 'inside', 'crossing',
  'diagnostics', 'impacts',
] as const;
export type Stage = (typeof STAGES)[number];
export type Count = (typeof COUNTS)[number];

export interface Head {
  version: number;
  graze: string;
  title: string;
  source: string;
  settings: Record<string, unknown>;
  frames: number;
  frame_numbers: number[];
  every: number;
  source_frames: number;
  block: number;
  objects: ObjectHead[];
  meshes: MeshHead[];
  /** `impacts` is missing where no frame has any. */
  series: Partial<Record<Stage | Count | 'step_ms', number[]>> & {
    /** The smallest separation of a frame's contacts, null where it has none. Not in older data. */
    deepest?: (number | null)[];
  };
  diverged?: number[];
  /** Page frames, and how many frames of the source are missing before each. */
  dropped?: [number, number][];
  /** Pairs of objects that are ignored, with the first and the last page frame. Not in older data, as the next ones. */
  ignored?: [a: number, b: number, first: number, last: number][];
  /** Groups of faces of two objects that are ignored, with the first and the last page frame. */
  ignored_groups?: [a: number, groupA: number, b: number, groupB: number, first: number, last: number][];
  rules?: RuleHead[];
}

/** Thresholds of pairs of two kinds. */
export interface RuleHead {
  kinds: [number, number];
  contact_distance?: number;
  range?: number | 'infinity';
  epsilon?: number[];
  first: number;
  last: number;
}

/** How many frames of the source are missing right before a page frame, or after it where it is the last. */
export function droppedAt(head: Head, frame: number): { before: number; after: number } {
  const missing = (at: number) => head.dropped?.find(([before]) => before === at)?.[1] ?? 0;
  return { before: missing(frame), after: frame === head.frames - 1 ? missing(head.frames) : 0 };
}

const SWEEP_SETTINGS = ['sweep_tolerance', 'swept_gap'];

/** The settings of the scene. Those of sweeps are left out where nothing is swept. */
export function shownSettings({ settings, objects, series }: Head): [key: string, value: unknown][] {
  // Older data says only of what met that it was swept.
  const isSwept = objects.some((object) => object.swept ?? series.impacts !== undefined);
  return Object.entries(settings).filter(([key]) => isSwept || !SWEEP_SETTINGS.includes(key));
}

export function checkHead(value: unknown): Head {
  const head = value as Head;
  if (head.version !== 1 && head.version !== 2) throw new Error(`This data has version ${head.version}; this viewer reads versions 1 and 2.`);
  return head;
}
