// How do numbers run over the frames: contacts, near pairs, times by stage, distances of the selection?

import uPlot from 'uplot';
import { h, short } from './dom';
import { STAGES } from '../data/head';
import { isDark, palette, STAGE_COLOURS } from '../palette';
import type { Viewer } from '../viewer';

interface Line { label: string; colour: string; values: (number | null)[] }
interface Plot { title: string; id: string; lines: Line[] }

export class Plots {
  readonly element = h('div', { id: 'plots', 'data-testid': 'plots' });
  private charts: uPlot[] = [];
  private isSetting = false;

  constructor(private readonly viewer: Viewer) {
    viewer.on(['page', 'theme'], () => this.make());
    viewer.on(['frame'], () => this.mark());
    viewer.on(['history'], () => this.showBounds());
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  private plots(): Plot[] {
    const { head } = this.viewer.page!;
    const series = (name: Exclude<keyof typeof head.series, 'deepest'>) => head.series[name] ?? [];
    const { neutral } = palette();
    const green = isDark() ? '#19c795' : '#009e73';
    return [
      { title: 'Contacts', id: 'contacts', lines: [
        { label: 'contacts', colour: palette().warning, values: series('contacts') },
        ...(series('impacts').length > 0 ? [{ label: 'impacts', colour: palette().way, values: series('impacts') }] : [])] },
      { title: 'Pairs', id: 'pairs', lines: [
        { label: 'near', colour: neutral, values: series('near') },
        { label: 'in contact', colour: green, values: series('in_contact') },
        ...(['inside', 'crossing'] as const).map((name) => ({ label: name, colour: palette()[name], values: series(name) }))
          .filter((line) => line.values.some((n) => n > 0))] },
      { title: 'ms', id: 'ms', lines: [
        { label: 'step', colour: neutral, values: series('step_ms') },
        ...STAGES.map((stage, i) => ({ label: stage.replace('_ms', ''), colour: STAGE_COLOURS[i]!, values: series(stage) }))] },
      this.pairPlot(),
    ];
  }

  /** The last plot is that of the selection. Without one it has the deepest separation of each frame. */
  private pairPlot(): Plot {
    const { history, page } = this.viewer;
    const { selected, second, way } = palette();
    const title = history ? (history.of === 'pair' ? 'Pair' : 'Object') : 'All';
    return { title, id: 'bounds', lines: [
      { label: 'lower', colour: selected, values: history?.lower ?? [] },
      { label: 'upper', colour: second, values: history?.upper ?? [] },
      { label: 'deepest', colour: way, values: history?.deepest ?? page!.head.series.deepest ?? [] }] };
  }

  /** What the last plot shows. */
  last(): { title: string; lines: Record<string, (number | null)[]> } {
    const chart = this.charts.at(-1)!;
    const title = this.element.lastElementChild!.querySelector('.u-legend .u-label')!.textContent!;
    return { title, lines: Object.fromEntries(chart.series.slice(1).map((line, i) => [String(line.label), Array.from(chart.data[i + 1]!, (value) => value ?? null)])) };
  }

  private make(): void {
    if (!this.viewer.page) return;
    for (const chart of this.charts) chart.destroy();
    this.charts = [];
    this.element.replaceChildren();
    const frames = this.viewer.page.head.frame_numbers.map((_, f) => f);
    for (const plot of this.plots()) {
      const box = h('div', { class: 'plot', 'data-testid': `plot-${plot.id}` });
      if (plot.id === 'bounds') {
        box.append(h('p', { class: 'hint' }, 'Select a pair or a contact'));
        this.showSubject(box, plot);
      }
      this.element.append(box);
      this.charts.push(this.chart(plot, frames, box));
    }
    this.mark();
  }

  private chart(plot: Plot, frames: number[], box: HTMLElement): uPlot {
    const style = getComputedStyle(document.documentElement);
    const [ink, grid] = [style.getPropertyValue('--quiet'), style.getPropertyValue('--line')];
    const font = `10px ${style.getPropertyValue('--font')}`;
    const axis = { stroke: ink, font, grid: { stroke: grid, width: 1 }, ticks: { show: false } };
    const options: uPlot.Options = {
      ...this.size(box), padding: [4, 8, 0, 0],
      cursor: { sync: { key: 'graze' }, y: false, points: { size: 5 }, drag: { x: false, y: false } },
      legend: { live: true },
      scales: { x: { time: false }, y: { range: (_, low, high) => range(low, high, plot.id === 'bounds') } },
      axes: [{ ...axis, size: 18, gap: 2 }, { ...axis, size: 42, gap: 3, space: 16, values: (_, ticks) => ticks.map((x) => String(Number(x.toPrecision(4)))) }],
      series: [{ label: plot.title, value: (_, frame) => frame === null ? '' : String(frame) }, ...plot.lines.map((line) => ({
        label: line.label, stroke: line.colour, width: 1.25, points: { show: false },
        // Six values do not fit; those of the stages are in the inspector.
        value: (_: uPlot, value: number | null) => value === null || (plot.id === 'ms' && line.label !== 'step') ? '' :
          plot.id === 'ms' || plot.id === 'bounds' ? String(Number(value.toPrecision(3))) : short(value) }))],
      hooks: { ready: [(chart) => this.listen(chart)] },
    };
    const data = [frames, ...plot.lines.map(({ values }) => this.filled(values))];
    return new uPlot(options, data as uPlot.AlignedData, box);
  }

  /** A click or a drag in a plot goes to the frame there. */
  private listen(chart: uPlot): void {
    const go = (event: PointerEvent) => {
      const box = chart.over.getBoundingClientRect();
      void this.viewer.goTo(chart.posToVal(event.clientX - box.left, 'x'));
    };
    chart.over.addEventListener('pointerdown', go);
    chart.over.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) go(event);
    });
    chart.over.addEventListener('pointerleave', () => requestAnimationFrame(() => this.mark()));
  }

  private size(box: HTMLElement): { width: number; height: number } {
    return { width: Math.max(80, box.clientWidth), height: Math.max(40, box.clientHeight - 18) };
  }

  private resize(): void {
    this.charts.forEach((chart, i) => chart.setSize(this.size(this.element.children[i] as HTMLElement)));
    this.mark();
  }

  /** The cursor of all plots stands at the frame that is shown. */
  private mark(): void {
    const first = this.charts[0];
    if (!first || this.isSetting) return;
    this.isSetting = true;
    for (const chart of this.charts)
      chart.setCursor({ left: chart.valToPos(this.viewer.frame, 'x'), top: 4 }, false);
    this.isSetting = false;
  }

  /** A value for each frame, where a line has none. */
  private filled(values: (number | null)[]): (number | null)[] {
    return values.length ? values : this.viewer.page!.head.frame_numbers.map(() => null);
  }

  private showBounds(): void {
    const chart = this.charts.at(-1);
    if (!chart) return;
    const plot = this.pairPlot();
    chart.setData([chart.data[0]!, ...plot.lines.map(({ values }) => this.filled(values))] as uPlot.AlignedData);
    const box = this.element.lastElementChild!;
    box.querySelector('.u-legend .u-label')!.textContent = plot.title;
    this.showSubject(box, plot);
    this.mark();
  }

  /** Without a selection there are no bounds, and in older data no depths either. */
  private showSubject(box: Element, { lines }: Plot): void {
    const isOfAll = this.viewer.history === null;
    box.classList.toggle('ofall', isOfAll);
    box.classList.toggle('unasked', isOfAll && lines.every(({ values }) => values.every((value) => value === null)));
  }
}

function range(low: number | null, high: number | null, isFree: boolean): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const bottom = isFree ? Math.max(Math.min(0, low), low - 0.1 * (high - low)) : Math.min(0, low);
  const top = high + 0.08 * (high - bottom);
  return top > bottom ? [bottom, top] : [bottom, bottom + 1];
}
