// How are elements of the page made?

type Child = Node | string | null | undefined | false;
type Props = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

/** Makes an element. Functions become listeners, true and false switch attributes. */
export function h(tag: string, props: Props = {}, ...children: Child[]): HTMLElement {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

export function byId(id: string): HTMLElement {
  return document.getElementById(id)!;
}

/** A button with a text or a sign, and its key in the tooltip. */
export function button(text: string, id: string, title: string, onClick: () => void): HTMLElement {
  return h('button', { type: 'button', 'data-testid': id, id, title, 'aria-label': title, click: () => onClick() }, text);
}

export function swatch(colour: string, shape = ''): HTMLElement {
  return h('i', { class: `swatch ${shape}`, style: `--c:${colour}` });
}

/** Tells the reader something for a few seconds. */
export function note(text: string, isBad = false): void {
  const element = byId('note');
  element.textContent = text;
  element.className = isBad ? 'shown bad' : 'shown';
  clearTimeout(Number(element.dataset.timer));
  element.dataset.timer = String(setTimeout(() => (element.className = ''), isBad ? 8000 : 1800));
}

export async function copy(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Pages from disk may not use the clipboard in some browsers; the old command still works there.
    const area = h('textarea', { class: 'hidden' }) as HTMLTextAreaElement;
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  note(text.length > 60 ? 'Copied' : `Copied ${text}`);
}

/** Numbers for lists and legends, where the width is small. The inspector has all digits. */
export function short(value: number): string {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0 || Number.isInteger(value)) return value.toLocaleString('en');
  const size = Math.abs(value);
  return size >= 1e-4 && size < 1e5 ? value.toPrecision(4) : value.toExponential(2);
}

export const count = (value: number): string => value.toLocaleString('en');
