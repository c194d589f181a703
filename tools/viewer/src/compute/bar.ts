// What stands in the page about computing: a button, and a line while the page computes.

import { button, byId, h, note } from '../panels/dom';
import type { Viewer } from '../viewer';
import type { Computing } from './computing';

export class ComputeBar {
  constructor(private readonly viewer: Viewer, private readonly computing: Computing) {
    viewer.on(['compute', 'frame', 'page'], () => this.show());
  }

  async toggle(): Promise<void> {
    try {
      await (this.computing.isOn ? this.computing.leave() : this.computing.start());
    } catch (error) {
      note((error as Error).message, true);
    }
  }

  toggleVertices(): void {
    this.computing.movesVertices = !this.computing.movesVertices;
    note(`A drag moves: ${this.computing.movesVertices ? 'a vertex' : 'an object'}`);
    this.viewer.emit('compute');
  }

  private show(): void {
    const { computing } = this;
    const box = byId('computing');
    const { page } = this.viewer;
    box.className = computing.isOn ? 'shown' : '';
    if (!computing.isOn || !page) return box.replaceChildren();
    const choice = (text: string, id: string, isVertex: boolean) => {
      const element = button(text, id, `A drag moves ${isVertex ? 'a vertex of a deformable object' : 'an object'} (Shift+Z for the other)`, () => {
        if (computing.movesVertices !== isVertex) this.toggleVertices();
      });
      element.setAttribute('aria-pressed', String(computing.movesVertices === isVertex));
      return element;
    };
    box.replaceChildren(
      h('b', {}, 'Computed in this page'),
      h('span', { 'data-testid': 'compute-time' }, `${computing.stepMs.toFixed(1)} ms a step`),
      h('span', { class: 'choice' }, choice('Objects', 'move-objects', false), choice('Vertices', 'move-vertices', true)),
      button('Back', 'compute-back', 'Back to the recorded frame (Z)', () => void this.toggle()),
      h('small', { 'data-testid': 'compute-words' }, `Drag to move. At first, ${computing.words.join('; ')}.`));
  }
}
