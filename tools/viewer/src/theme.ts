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

const systemIsDark = matchMedia('(prefers-color-scheme: dark)');
let choice: string = stored() ?? 'system';

/** The page has the theme that is shown, so that styles and the picture ask one thing. */
function show(viewer: Viewer): void {
  const isDark = choice === 'dark' || (choice !== 'light' && systemIsDark.matches);
  document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
  viewer.emit('theme');
}

export function startTheme(viewer: Viewer): void {
  show(viewer);
  systemIsDark.addEventListener('change', () => show(viewer));
}

export function nextTheme(viewer: Viewer): string {
  choice = THEMES[(THEMES.indexOf(choice as 'light') + 1) % THEMES.length]!;
  stored(choice);
  show(viewer);
  return choice;
}
