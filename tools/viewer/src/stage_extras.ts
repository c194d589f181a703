// What stands over the picture: quick switches, names of objects, axes, and the tip at the pointer?

import * as THREE from 'three';
import { button, byId, h, short } from './panels/dom';
import { pairNames, pairText } from './data/pair_names';
import { KINDS, SIDES } from './data/report';
import { pick, Screen } from './view3d/picking';
import type { Stage } from './view3d/scene3d';
import type { PickMode, Viewer } from './viewer';

const PICKS: [PickMode, string][] = [['auto', 'Any'], ['object', 'Object'], ['pair', 'Pair'], ['contact', 'Contact'], ['feature', 'Feature']];

export class StageExtras {
  private hover = 0;
  private downAt = [0, 0];

  constructor(private readonly viewer: Viewer, private readonly stage: Stage) {
    viewer.on(['display', 'page'], () => this.showBar());
    stage.afterRender.push(() => {
      this.showAxes();
      this.showNames();
    });
    this.listen();
  }

  private listen(): void {
    const { canvas } = this.stage;
    canvas.addEventListener('pointerdown', (event) => (this.downAt = [event.clientX, event.clientY]));
    canvas.addEventListener('click', (event) => {
      if (Math.hypot(event.clientX - this.downAt[0]!, event.clientY - this.downAt[1]!) > 4) return;
      const mode = event.shiftKey ? 'feature' : this.viewer.display.pick;
      this.viewer.select(pick(this.stage, event.offsetX, event.offsetY, mode));
    });
    canvas.addEventListener('dblclick', () => {
      if (this.viewer.selection) this.stage.fitSelection();
    });
    canvas.addEventListener('pointermove', (event) => {
      cancelAnimationFrame(this.hover);
      byId('tip').className = '';
      if (event.buttons === 0 && event.pointerType === 'mouse')
        this.hover = requestAnimationFrame(() => this.showTip(event.offsetX, event.offsetY));
    });
    canvas.addEventListener('pointerleave', () => (byId('tip').className = ''));
  }

  /** Only contacts and lines have tips: they are quick to find. */
  private showTip(x: number, y: number): void {
    if (!this.viewer.report || this.stage.contacts.shown.length > 20000) return;
    const found = pick(this.stage, x, y, 'contact') ?? pick(this.stage, x, y, 'pair');
    this.stage.canvas.style.cursor = found ? 'pointer' : '';
    if (!found || (found.type !== 'contact' && found.type !== 'pair')) return;
    const { head } = this.viewer.page!;
    const report = this.viewer.report;
    const { block } = report;
    const row = report.rowOf(found.a, found.b);
    const names = pairText(pairNames(head, found.a, found.b, block.insideOf(row)));
    let text = `${names} · ${short(block.lower[row]!)}`;
    if (found.type === 'contact') {
      const contact = report.contactOf(row, found.kind, found.features);
      text = `${KINDS[found.kind]} · ${short(report.separation(contact))} · ` +
        `${SIDES[report.sideA(contact)]}/${SIDES[report.sideB(contact)]} · age ${report.age(contact)} · ${names}`;
    }
    const tip = byId('tip');
    tip.textContent = text;
    tip.className = 'shown';
    tip.style.left = `${Math.min(x + 14, this.stage.canvas.clientWidth - tip.offsetWidth - 6)}px`;
    tip.style.top = `${y + 16}px`;
  }

  private showBar(): void {
    const { display } = this.viewer;
    const flag = (name: 'edges' | 'surfaces' | 'clip' | 'contacts' | 'pushes' | 'lines', text: string, key: string) => {
      const element = button(text, `quick-${name}`, `${text} (${key})`, () => {
        display[name] = !display[name];
        this.viewer.changed();
      });
      element.setAttribute('aria-pressed', String(display[name]));
      return element;
    };
    const picks = PICKS.map(([mode, text]) => {
      const element = button(text, `pick-${mode}`, `A click selects: ${text.toLowerCase()} (P for the next)`, () => {
        display.pick = mode;
        this.viewer.changed();
      });
      element.setAttribute('aria-pressed', String(display.pick === mode));
      return element;
    });
    byId('stagebar').replaceChildren(
      h('span', { class: 'choice' }, flag('surfaces', 'Faces', 'W'), flag('edges', 'Edges', 'E'), flag('contacts', 'Contacts', 'K'),
        flag('pushes', 'Pushes', 'M'), flag('lines', 'Lines', 'L'), flag('clip', 'Clip', 'C')),
      h('span', { class: 'choice', title: 'What a click selects' }, ...picks),
      h('span', { class: 'choice' },
        button('Fit', 'fit', 'Fit the selection (F), or all (A)', () => this.stage.fitSelection())));
  }

  private showAxes(): void {
    const turn = new THREE.Matrix4().extractRotation(this.stage.eye.camera.matrixWorldInverse);
    const parts = ['x', 'y', 'z'].map((name, k) => {
      const v = new THREE.Vector3().setComponent(k, 22).applyMatrix4(turn);
      const [x, y] = [v.x.toFixed(1), (-v.y).toFixed(1)];
      const [tx, ty] = [(v.x * 1.25).toFixed(1), (-v.y * 1.25).toFixed(1)];
      return { z: v.z, svg: `<line class="axis-${name}" x2="${x}" y2="${y}"/><text x="${tx}" y="${ty}">${name}</text>` };
    });
    byId('axes').innerHTML = parts.sort((p, q) => p.z - q.z).map((p) => p.svg).join('');
  }

  /** Names of the objects in sight and where they stand: the selected ones, then the nearest first. */
  private namesByDistance(screen: Screen): [name: string, x: number, y: number][] {
    const { page } = this.viewer;
    const chosen = this.viewer.selectedObjects();
    const found: { rank: number; label: [string, number, number] }[] = [];
    for (const object of page!.objects) {
      if (!this.stage.isDrawn(object.index) || !object.hasBox) continue;
      const p = screen.at(this.stage.local(object.centre()));
      if (!p || p[0] < 0 || p[1] < 0 || p[0] > this.stage.canvas.clientWidth || p[1] > this.stage.canvas.clientHeight) continue;
      found.push({ rank: chosen.includes(object.index) ? -1 : p[2], label: [page!.head.objects[object.index]!.name, p[0], p[1]] });
    }
    return found.sort((p, q) => p.rank - q.rank).map(({ label }) => label);
  }

  /** A name that would cover one before it is left out. */
  private showNames(): void {
    const box = byId('names');
    const { page, display } = this.viewer;
    if (!page || !display.names) {
      if (box.childElementCount) box.replaceChildren();
      return;
    }
    const screen = new Screen(this.stage);
    const labels: HTMLElement[] = [];
    const taken: [x: number, y: number, halfWidth: number][] = [];
    for (const [name, x, y] of this.namesByDistance(screen)) {
      const half = 4 * name.length + 6;
      if (taken.some(([tx, ty, other]) => Math.abs(tx - x) < half + other && Math.abs(ty - y) < 17)) continue;
      taken.push([x, y, half]);
      labels.push(h('span', { style: `left:${x.toFixed(0)}px;top:${y.toFixed(0)}px` }, name));
      if (labels.length >= 300) break;
    }
    box.replaceChildren(...labels);
  }
}
