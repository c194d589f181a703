// Which colours mean what? They are Okabe and Ito's, which colour-blind readers can tell apart.

export const KIND_COLOURS = ['#e69f00', '#56b4e9', '#d55e00', '#009e73', '#cc79a7', '#f0e442'];
export const PHASE_COLOURS = ['#8a94a0', '#009e73', '#56b4e9', '#e69f00'];
export const STAGE_COLOURS = ['#56b4e9', '#e69f00', '#009e73', '#d55e00', '#cc79a7'];

const LEVELS = ['#d55e00', '#009e73', '#0072b2', '#e69f00', '#cc79a7', '#56b4e9', '#b8a800', '#7f7f7f'];
const LEVELS_ON_DARK = ['#ff7a2e', '#19c795', '#45a5ea', '#e69f00', '#e694c3', '#8fd0f7', '#f0e442', '#b5b5b5'];

export interface Palette {
  background: string;
  objects: string[];
  back: string;
  edge: string;
  selected: string;
  second: string;
  outline: string;
  neutral: string;
  warning: string;
  inside: string;
  crossing: string;
  /** The ways of vertices between two steps. */
  way: string;
  levels: string[];
}

const LIGHT: Palette = {
  background: '#f4f5f7',
  objects: ['#c3cedb', '#dccdb6', '#bfd4c6', '#d6c4d6', '#d3d2b8', '#b9d2d6'],
  back: '#8d8f96', edge: '#39424e', selected: '#0072b2', second: '#b35900', outline: '#16191d', neutral: '#5a6470',
  warning: '#d55e00', inside: '#0072b2', crossing: '#8a3ea8', way: '#0f7d8c', levels: LEVELS,
};

const DARK: Palette = {
  background: '#14171b',
  objects: ['#6b7d92', '#8d7b62', '#64806e', '#816c87', '#7d7c60', '#5f7d82'],
  back: '#3b3f47', edge: '#0b0d10', selected: '#6cc3f5', second: '#ffb454', outline: '#08090b', neutral: '#a4afbb',
  warning: '#ff7a2e', inside: '#6cc3f5', crossing: '#d39bea', way: '#4fd1e0', levels: LEVELS_ON_DARK,
};

export function isDark(): boolean {
  return document.documentElement.dataset.theme === 'dark';
}

export function palette(): Palette {
  return isDark() ? DARK : LIGHT;
}

export function levelColour(level: number): string {
  const { levels } = palette();
  return levels[Math.max(0, level - 1) % levels.length]!;
}

/** The channels of "#rrggbb", from 0 to 255. */
export function channels(colour: string): [number, number, number] {
  const value = parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}
