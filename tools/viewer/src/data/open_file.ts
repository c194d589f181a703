// How does a .grazeview file get into the page?

import { FileChunks } from './chunks';
import { button, byId, h, note } from '../panels/dom';
import type { Viewer } from '../viewer';

export class FileOpener {
  private readonly input = h('input', {
    type: 'file', accept: '.grazeview', class: 'hidden', 'data-testid': 'file', 'aria-label': 'File to open',
    change: () => void this.open(this.input.files?.[0]) }) as HTMLInputElement;

  constructor(private readonly viewer: Viewer) {
    document.body.append(this.input);
    addEventListener('dragover', (event) => {
      event.preventDefault();
      document.body.classList.add('dropping');
    });
    addEventListener('dragleave', (event) => {
      if (!event.relatedTarget) document.body.classList.remove('dropping');
    });
    addEventListener('drop', (event) => {
      event.preventDefault();
      document.body.classList.remove('dropping');
      void this.open(event.dataTransfer?.files[0]);
    });
  }

  ask(): void {
    this.input.value = '';
    this.input.click();
  }

  async open(file: File | undefined): Promise<void> {
    if (!file) return;
    try {
      await this.viewer.open(await FileChunks.open(file));
      note(`Opened ${file.name}`);
    } catch (error) {
      note(`${file.name}: ${(error as Error).message}`, true);
    }
  }

  /** What stands in the middle of a page without data. */
  showEmpty(): void {
    byId('empty').replaceChildren(
      h('p', {}, 'Drop a .grazeview file here'),
      button('Open a file', 'open-empty', 'Open a .grazeview file (Ctrl+O is the browser’s; use Shift+O)', () => this.ask()));
  }
}
