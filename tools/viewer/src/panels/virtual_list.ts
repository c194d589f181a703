// How does a long list scroll fast? Only rows in sight are elements.

const ROW = 24;

export class VirtualList<T> {
  readonly element: HTMLElement;
  private readonly inner: HTMLElement;
  private items: T[] = [];
  private isAsked = false;

  constructor(id: string, private readonly row: (item: T, index: number) => HTMLElement) {
    this.element = document.createElement('div');
    this.element.className = 'list';
    this.element.dataset.testid = id;
    this.element.tabIndex = 0;
    this.element.setAttribute('role', 'listbox');
    this.inner = document.createElement('div');
    this.inner.className = 'rows';
    this.element.append(this.inner);
    this.element.addEventListener('scroll', () => this.ask());
    new ResizeObserver(() => this.ask()).observe(this.element);
  }

  show(items: T[]): void {
    this.items = items;
    this.inner.style.height = `${ROW * items.length}px`;
    this.draw();
  }

  scrollTo(index: number): void {
    const top = index * ROW;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop || top + ROW > scrollTop + clientHeight) this.element.scrollTop = top - clientHeight / 2;
    this.draw();
  }

  private ask(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.draw();
    });
  }

  private draw(): void {
    const first = Math.max(0, Math.floor(this.element.scrollTop / ROW) - 4);
    const end = Math.min(this.items.length, Math.ceil((this.element.scrollTop + this.element.clientHeight) / ROW) + 4);
    const rows: HTMLElement[] = [];
    for (let i = first; i < end; ++i) {
      const element = this.row(this.items[i]!, i);
      element.style.top = `${ROW * i}px`;
      rows.push(element);
    }
    this.inner.replaceChildren(...rows);
  }
}
