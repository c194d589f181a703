// Is the page light or dark?

import type { Viewer } from './viewer';

const THEMES = ['system', 'light', 'dark'] as const;
const KEY = 'graze-theme';

/** Pages from disk may be without storage; then the choice lasts as long as the page. */
function stored(value?: string): string | null {
  try {
    if (value !== undefined) localStorage.setItem(KEY, value);
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

export function startTheme(viewer: Viewer): void {
  document.documentElement.dataset.theme = stored() ?? 'system';
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => viewer.emit('theme'));
}

export function nextTheme(viewer: Viewer): string {
  const root = document.documentElement;
  const theme = THEMES[(THEMES.indexOf(root.dataset.theme as 'light') + 1) % THEMES.length]!;
  root.dataset.theme = theme;
  stored(theme);
  viewer.emit('theme');
  return theme;
}
