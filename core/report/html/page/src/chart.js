// What all charts share: they are drawn when they come near the window, and again when colours,
// the window's size or the filter change; far from it they are let go, so that a page of hundreds
// stays light.
import * as echarts from 'echarts/core';
import { CustomChart, LineChart, ScatterChart } from 'echarts/charts';
import {
  AriaComponent, DataZoomInsideComponent, DataZoomSliderComponent, GridComponent,
  LegendScrollComponent, MarkAreaComponent, TitleComponent, TooltipComponent,
} from 'echarts/components';
import { SVGRenderer } from 'echarts/renderers';
import { make, number_text } from './dom.js';
import { on_theme, theme_colours } from './theme.js';

echarts.use([
  AriaComponent, CustomChart, DataZoomInsideComponent, DataZoomSliderComponent, GridComponent,
  LegendScrollComponent, LineChart, MarkAreaComponent, ScatterChart, SVGRenderer, TitleComponent,
  TooltipComponent,
]);

const kNarrow = 560;  // [px] below which labels move above what they name
const still = window.matchMedia('(prefers-reduced-motion: reduce)');
const charts = new Map();  // element -> chart

const near = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    const chart = charts.get(target);
    if (isIntersecting) chart?.show();
    else chart?.hide();
  }
}, { rootMargin: '800px 0px' });

const sized = new ResizeObserver((entries) => {
  for (const { target } of entries) charts.get(target)?.resize();
});

on_theme(() => redraw_charts());
// Printers get all charts, also those that were never looked at.
window.addEventListener('beforeprint', () => { for (const chart of charts.values()) chart.show(); });

/** Draws anew what is shown. */
export function redraw_charts() {
  for (const chart of charts.values()) chart.draw();
}

/**
 * Adds a figure to `parent`; its `title` may be left out. `option_of({colours, width, narrow})` gives ECharts' options, with
 * `height` [px] in them, of which `height` is a guess that keeps the page from jumping; `name` is
 * read out by screen readers. Returns {redraw, head, figure, on_draw(listener)}.
 */
export function add_chart(parent, { title, name, caption, height, option_of }) {
  const head = make('div', { class: 'chart-head' }, ...(title ? [make('p', { class: 'chart-title' }, title)] : []));
  const canvas = make('div', { class: 'chart-canvas', role: 'img', 'aria-label': name });
  const figure = make('figure', { class: 'chart' }, head, canvas);
  if (caption) figure.append(make('figcaption', {}, caption));
  parent.append(figure);

  let drawn = null, width = 0;
  const listeners = [];
  const chart = {
    show() {
      if (drawn || !canvas.isConnected || canvas.clientWidth === 0) return;
      const option = this.option();
      drawn = echarts.init(canvas, null, { renderer: 'svg', height: option.height });
      drawn.setOption(option);
      width = canvas.clientWidth;
      figure.dataset.drawn = '';
    },
    hide() {
      drawn?.dispose();
      drawn = null;
      delete figure.dataset.drawn;
    },
    option() {
      const option = option_of({ colours: theme_colours(), width: canvas.clientWidth,
        narrow: canvas.clientWidth < kNarrow });
      canvas.style.height = `${option.height}px`;
      for (const listener of listeners) listener();
      return { ...common_options(name), ...option };
    },
    draw() {
      if (!drawn || canvas.clientWidth === 0) return;
      const option = this.option();
      drawn.resize({ height: option.height });
      drawn.setOption(option, { notMerge: true });
    },
    resize() {
      if (!drawn || canvas.clientWidth === 0 || canvas.clientWidth === width) return;
      width = canvas.clientWidth;
      this.draw();
    },
  };
  canvas.style.height = `${height}px`;
  charts.set(canvas, chart);
  near.observe(canvas);
  sized.observe(canvas);
  return { redraw: () => chart.draw(), head, figure, on_draw: (listener) => listeners.push(listener) };
}

function common_options(name) {
  return {
    animation: !still.matches,
    animationDuration: 250,
    animationDurationUpdate: 250,
    backgroundColor: 'transparent',
    textStyle: { fontFamily: 'system-ui, sans-serif' },
    aria: { enabled: true, label: { description: name } },
  };
}

/** An axis of values in the page's colours; `more` wins. */
export function axis_of(colours, more = {}) {
  return {
    type: 'value',
    nameLocation: 'middle',
    nameGap: 28,
    nameTextStyle: { color: colours.faint, fontSize: 12 },
    axisLine: { show: true, onZero: false, lineStyle: { color: colours.faint } },
    axisTick: { lineStyle: { color: colours.faint } },
    splitLine: { lineStyle: { color: colours.line } },
    minorSplitLine: { show: false },
    ...more,
    axisLabel: { color: colours.faint, fontSize: 12, hideOverlap: true, ...more.axisLabel },
  };
}

/**
 * A logarithmic axis for data that are log10 of what they stand for: ECharts' own has labels at
 * powers of 10, 10^10, 10^100 alone. At most `count` labels.
 */
export function log_axis_of(colours, low, high, count, more = {}) {
  const min = Math.log10(low), max = Math.log10(high);
  const every = Math.max(1, Math.ceil((max - min) / count));
  const ticks = [];
  for (let power = every * Math.ceil(min / every - 1e-9); power <= max + 1e-9; power += every) ticks.push(power);
  // Less than a decade may hold no power of 10.
  const customValues = ticks.length > 1 ? ticks : [min, (min + max) / 2, max];
  const axis = axis_of(colours, more);
  return {
    ...axis, min, max,
    axisTick: { ...axis.axisTick, customValues },
    splitLine: { ...axis.splitLine, customValues },
    axisLabel: { ...axis.axisLabel, customValues, formatter: (value) => number_text(10 ** value, 3) },
  };
}

export function tooltip_of(colours, more = {}) {
  return {
    confine: true,
    transitionDuration: 0,
    backgroundColor: colours.page,
    borderColor: colours.line,
    textStyle: { color: colours.text, fontSize: 13 },
    ...more,
  };
}

export function legend_of(colours, more = {}) {
  return {
    type: 'scroll',
    textStyle: { color: colours.text, fontSize: 12 },
    pageTextStyle: { color: colours.text },
    pageIconColor: colours.text,
    pageIconInactiveColor: colours.line,
    inactiveColor: colours.faint,
    itemWidth: 26,
    ...more,
  };
}
