// How does the address hold the frame, the camera and the selection?

import * as THREE from 'three';
import { KINDS, FEATURE_KINDS } from './data/report';
import type { Stage } from './view3d/scene3d';
import type { Selection, Viewer } from './viewer';

const places = (v: THREE.Vector3): string => v.toArray().map((x) => Number(x.toPrecision(7))).join(',');

/** Objects are named by serial, so that a link holds in another page of the same run. */
export function selectionText(viewer: Viewer, s: Selection): string {
  const serial = (object: number) => viewer.page!.head.objects[object]!.serial;
  const feature = (kind: number, index: number) => `${FEATURE_KINDS[kind]}.${index}`;
  if (s.type === 'object') return `object:${serial(s.object)}`;
  if (s.type === 'pair') return `pair:${serial(s.a)}:${serial(s.b)}`;
  if (s.type === 'feature') return `feature:${serial(s.object)}:${feature(s.kind, s.index)}`;
  const [ka, ia, kb, ib] = s.features as [number, number, number, number];
  return `contact:${serial(s.a)}:${serial(s.b)}:${KINDS[s.kind]}:${feature(ka, ia)}:${feature(kb, ib)}`;
}

export function parseSelection(viewer: Viewer, text: string): Selection | null {
  const [type, ...parts] = text.split(':');
  const objects = viewer.page!.head.objects;
  const object = (part: string | undefined) => objects.findIndex((o) => String(o.serial) === part);
  const feature = (part: string | undefined): number[] => {
    const [kind, index] = (part ?? '').split('.');
    return [FEATURE_KINDS.indexOf(kind as 'vertex'), Number(index ?? -1)];
  };
  const a = object(parts[0]);
  if (a < 0) return null;
  if (type === 'object') return { type, object: a };
  if (type === 'feature') {
    const [kind, index] = feature(parts[1]) as [number, number];
    return isFeature(viewer, a, kind, index) ? { type, object: a, kind, index } : null;
  }
  const b = object(parts[1]);
  if (b < 0) return null;
  if (type === 'pair') return { type, a, b };
  const features = [...feature(parts[3]), ...feature(parts[4])];
  const kind = KINDS.indexOf(parts[2] as 'VV');
  const isGood = kind >= 0 && isFeature(viewer, a, features[0]!, features[1]!) && isFeature(viewer, b, features[2]!, features[3]!);
  return type === 'contact' && isGood ? { type, a, b, kind, features } : null;
}

function isFeature(viewer: Viewer, object: number, kind: number, index: number): boolean {
  const { mesh } = viewer.page!.objects[object]!;
  const count = [mesh.vertexCount, mesh.edgeCount, mesh.faceCount][kind];
  return count !== undefined && Number.isInteger(index) && index >= 0 && index < count;
}

export class Link {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private written = '';

  constructor(private readonly viewer: Viewer, private readonly stage: Stage) {
    viewer.on(['frame', 'selection', 'camera'], () => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.write(), 300);
    });
    addEventListener('hashchange', () => {
      if (location.hash !== this.written) void this.read();
    });
  }

  text(): string {
    const { viewer, stage } = this;
    const { camera, controls } = stage.eye;
    const parts = [`f=${viewer.frame}`, `c=${places(camera.position)},${places(controls.target)}`];
    if (viewer.selection) parts.push(`s=${selectionText(viewer, viewer.selection)}`);
    parts.push(`u=${viewer.display.up}`);
    return `#${parts.join('&')}`;
  }

  private write(): void {
    if (!this.viewer.page) return;
    this.written = this.text();
    try {
      history.replaceState(null, '', this.written);
    } catch {
      // Some browsers refuse this for pages from disk. The button that copies the link still works.
    }
  }

  namesFrame(): boolean {
    return /[#&]f=/.test(location.hash);
  }

  /** Goes where the address says. Parts that make no sense are left out. */
  async read(): Promise<void> {
    const { viewer, stage } = this;
    if (!viewer.page) return;
    const parts = new Map(location.hash.slice(1).split('&').map((part): [string, string] => {
      const at = part.indexOf('=');
      return [part.slice(0, at), decodeURIComponent(part.slice(at + 1))];
    }));
    const up = parts.get('u');
    if (up === 'y' || up === 'z') {
      viewer.display.up = up;
      stage.eye.setUp(up);
      viewer.changed();
    }
    const frame = Number(parts.get('f'));
    if (parts.has('f') && Number.isFinite(frame)) await viewer.goTo(frame);
    if (parts.has('s')) viewer.select(parseSelection(viewer, parts.get('s')!));
    const camera = (parts.get('c') ?? '').split(',').map(Number);
    if (camera.length === 6 && camera.every(Number.isFinite)) {
      const [px, py, pz, tx, ty, tz] = camera as [number, number, number, number, number, number];
      stage.eye.place(new THREE.Vector3(px, py, pz), new THREE.Vector3(tx, ty, tz));
    }
  }
}
