// Draws the charts that the page's data describe (core/report/charts/chart.h): panels side by side,
// curves, tinted bands and cells, with one legend.
import { add_chart, axis_of, legend_of, log_axis_of, tooltip_of } from './chart.js';
import { escaped, make, make_select, number_text } from './dom.js';
import { Lines } from './lines.js';
import { look_of } from './look.js';
import { shown, tell, unpacked } from './panels.js';

// [px]
const kLegend = 34, kTitle = 24, kBelow = 50, kRow = 30, kName = 18;
const kNarrow = 760;    // below which panels stand one below the other
const kLong = 100;      // points of a line that is read along its axis, not point by point

/**
 * Adds a figure that shows one of `charts`, the first unless the reader chooses. Of a scene: its `runs`, of which the
 * chart has rows, and view(), what is looked at now.
 */
export function add_figure(parent, charts, { runs = [], view = null } = {}) {
  let chosen = unpacked(charts[0]);
  const rows = [...new Set(chosen.panels.flatMap(({ y }) => y.runs ?? []))];
  const lines = view && rows.length ? new Lines(runs, rows, view) : null;
  const now = () => {
    if (!lines) return chosen;
    const first = new Set(lines.shown().first);
    return shown(chosen, (k) => first.has(k));
  };
  const figure = add_chart(parent, {
    title: chosen.title, name: `${chosen.title}. ${chosen.caption}`, caption: chosen.caption,
    height: layout_of(now(), { width: 1000 }).height,
    option_of: (canvas) => option_of(now(), canvas),
  });
  if (lines) add_lines_button(figure, lines);
  if (charts.length > 1) {
    const { label } = make_select('Show', charts.map(({ title }, k) => [k, title]), (value) => {
      chosen = unpacked(charts[Number(value)]);
      figure.redraw();
    });
    figure.head.append(make('div', { class: 'chart-choices' }, label));
  }
  const looks = chosen.panels.flatMap(({ looks: all, cells }) => all.filter((_, k) => cells.some((cell) => cell.look === k)));
  if (looks.length) {
    figure.figure.append(make('ul', { class: 'outcomes' }, ...looks.map(({ label, letter, fill, ink }) =>
      make('li', {}, make('span', { style: `background:${fill};color:${ink}`, 'aria-hidden': 'true' }, letter), ` ${label}`))));
  }
  return figure;
}

/** The button that shows all runs of a chart, or few again. */
export function add_lines_button(figure, lines) {
  const button = make('button', { type: 'button', class: 'show-lines', onclick: () => {
    lines.all = !lines.all;
    figure.redraw();
  } });
  const name = () => {
    button.textContent = lines.text();
    button.hidden = !button.textContent;
  };
  figure.on_draw(name);
  name();
  figure.head.append(make('div', { class: 'chart-choices' }, button));
}

// Where the panels' frames lie.
function layout_of(chart, { width }) {
  const labels = new Set(chart.panels.flatMap(({ curves, bands }) => [...curves, ...bands].map(({ label }) => label)).filter(Boolean));
  const across = width < kNarrow ? 1 : Math.min(chart.columns, chart.panels.length);
  const narrow = width < 560, cell = width / across;
  let top = labels.size ? kLegend : 8, height = 0;
  const frames = chart.panels.map((panel, k) => {
    if (k > 0 && k % across === 0) top += height;
    const names = panel.y.names;
    const longest = Math.max(0, ...(names ?? []).map((name) => name.length));
    const left = !names ? 70 : narrow ? 8 : Math.min(0.45 * cell, 24 + 6.6 * longest);
    const title = chart.panels.length > 1 && panel.title ? kTitle : 6;
    const plot = names ? (kRow + (narrow ? kName : 0)) * Math.max(1, names.length) : chart.height;
    height = title + plot + (panel.x.label ? kBelow : 26);
    return { left: (k % across) * cell + left, width: cell - left - 16, top: top + title, height: plot, narrow };
  });
  return { frames, height: top + height, labels: [...labels] };
}

const at = (axis, value) => (value === null || !axis.log ? value : value > 0 ? Math.log10(value) : null);
const clamped = (axis, value) => (value === null ? null : Math.min(axis.high, Math.max(axis.low, value)));

function option_of(chart, view) {
  const { colours } = view, { frames, height, labels } = layout_of(chart, view);
  const is_long = chart.panels.every(({ curves, cells }) => !cells.length && curves.some(({ x, look }) => !look.marker && x.length > kLong));
  const axis = (panel, name, k) => {
    const spec = panel[name], across = name === 'x', frame = frames[k];
    const more = { gridIndex: k, name: spec.label, nameGap: across ? 30 : 50, splitLine: { show: !panel.cells.length, lineStyle: { color: colours.line } } };
    if (spec.names) {
      return axis_of(colours, { gridIndex: k, min: -0.5, max: Math.max(1, spec.names.length) - 0.5, interval: 1, inverse: true,
        axisLabel: { show: false }, axisTick: { show: false }, axisLine: { show: false }, splitLine: { lineStyle: { color: colours.line } } });
    }
    const count = Math.max(2, across ? frame.width / 90 : frame.height / 45);
    if (spec.log) return log_axis_of(colours, spec.low, spec.high, count, more);
    return axis_of(colours, { ...more, min: spec.low, max: spec.high, splitNumber: Math.round(count),
      axisLabel: { formatter: (value) => number_text(value), showMinLabel: false, showMaxLabel: false } });
  };
  return {
    height,
    grid: frames.map(({ left, width, top, height: plot }) => ({ left, width, top, height: plot })),
    title: chart.panels.length > 1 ? chart.panels.map(({ title }, k) => ({ text: title, left: frames[k].left, top: frames[k].top - 20,
      textStyle: { color: colours.text, fontSize: 12, fontWeight: 600 } })) : [],
    legend: legend_of(colours, { top: 0, left: 0, right: 0, data: labels }),
    xAxis: chart.panels.map((panel, k) => axis(panel, 'x', k)),
    yAxis: chart.panels.map((panel, k) => axis(panel, 'y', k)),
    axisPointer: is_long ? { link: [{ xAxisIndex: 'all' }] } : undefined,
    tooltip: tooltip_of(colours, is_long ? { trigger: 'axis', formatter: (items) => tell_along(chart, items) }
      : { trigger: 'item', formatter: ({ data }) => data?.tell ?? '' }),
    dataZoom: is_long ? [{ type: 'inside', xAxisIndex: chart.panels.map((_, k) => k), zoomOnMouseWheel: 'ctrl', moveOnMouseMove: 'ctrl' }] : [],
    series: chart.panels.flatMap((panel, k) => series_of(panel, k, frames[k], colours)),
  };
}

function series_of(panel, k, frame, colours) {
  const on = { xAxisIndex: k, yAxisIndex: k };
  const range = (axis, [low, high]) => [at(axis, low === null ? axis.low : clamped(axis, low)), at(axis, high === null ? axis.high : clamped(axis, high))];
  const bands = panel.bands.map(({ label, x, y }) => {
    const [left, right] = range(panel.x, x), [low, high] = panel.y.names ? [-0.5, panel.y.high ?? panel.y.names.length - 0.5] : range(panel.y, y);
    return { ...on, type: 'line', name: label, data: [], symbol: 'none', itemStyle: { color: colours.band, opacity: 0.2 },
      markArea: { silent: true, itemStyle: { color: colours.band, opacity: 0.2 }, data: [[{ coord: [left, low] }, { coord: [right, high] }]] } };
  });
  const names = panel.y.names ? [row_names(panel.y.names, frame, colours, on)] : [];
  const cells = panel.cells.length ? [cell_series(panel, frame, colours, on)] : [];
  return [...bands, ...cells, ...names, ...panel.curves.flatMap((curve) => curve_series(panel, curve, colours, on))];
}

function curve_series(panel, curve, colours, on) {
  const { line: has_line, marker } = curve.look, { colour, symbol, dash } = look_of(curve.look);
  const edge = (axis, value) => at(axis, curve.edge ? clamped(axis, value) : value);
  const is_ring = marker === 'ring';
  const data = curve.x.map((x, n) => {
    const y = curve.y[n], beyond = curve.edge && !has_line && (x < panel.x.low || x > panel.x.high);
    return { value: [edge(panel.x, x), edge(panel.y, y)], tell: tell(panel, curve, n),
      ...(beyond && { symbolRotate: x < panel.x.low ? 90 : -90 }) };
  });
  const common = { ...on, name: curve.label, data, symbol, cursor: 'default',
    itemStyle: is_ring ? { color: 'transparent', borderColor: colour, borderWidth: 1.6 } : { color: colour, opacity: 0.9 } };
  if (!has_line) return [{ ...common, type: 'scatter', silent: is_ring, symbolSize: is_ring ? 15 : 7, emphasis: { scale: 1.6 } }];
  const line = { ...common, type: 'line', showSymbol: Boolean(marker), showAllSymbol: true, symbolSize: 8, emphasis: { focus: 'series' }, z: 4,
    sampling: curve.x.length > kLong ? 'minmax' : undefined, clip: true,
    lineStyle: { color: colour, width: 1.7, type: dash }, silent: !curve.notes };
  if (!curve.halo) return [line];
  // White about black shows on every colour.
  return [{ ...line, name: undefined, z: 3, lineStyle: { color: '#ffffff', width: 5 } },
    { ...line, itemStyle: { color: '#1b1b1b' }, lineStyle: { ...line.lineStyle, color: '#1b1b1b', width: 2.2 } }];
}

function tell_along(chart, items) {
  const lines = items.length ? [`${escaped(chart.panels.at(-1).x.label)}: ${number_text(items[0].axisValue)}`] : [];
  for (const { marker, data, axisIndex } of items) {
    lines.push(`${marker}${escaped(chart.panels[axisIndex].y.label)}: <b>${number_text(data.value[1])}</b>`);
  }
  return lines.join('<br>');
}

function cell_series(panel, frame, colours, on) {
  const cells = panel.cells.map((cell) => {
    const look = panel.looks[cell.look], name = panel.y.names?.[Math.round((cell.y[0] + cell.y[1]) / 2)] ?? look.label;
    const middle = (axis, [low, high]) => (at(axis, low) + at(axis, high)) / 2;
    return { value: [middle(panel.x, cell.x), middle(panel.y, cell.y)], tell: [`<b>${escaped(name)}</b>`, ...cell.note.split('\n').map(escaped)].join('<br>') };
  });
  return { ...on, type: 'custom', data: cells, clip: true, animation: false, encode: { x: 0, y: 1 },
    renderItem: ({ dataIndex }, api) => {
      const { x, y, look } = panel.cells[dataIndex], { fill, ink, letter } = panel.looks[look];
      const [xa, ya] = api.coord([at(panel.x, x[0]), at(panel.y, y[0])]), [xb, yb] = api.coord([at(panel.x, x[1]), at(panel.y, y[1])]);
      const [top, bottom] = [Math.min(ya, yb), Math.max(ya, yb)], size = Math.min(12, 0.8 * (bottom - top), 1.1 * (xb - xa));
      const children = [{ type: 'rect', shape: { x: xa, y: top, width: xb - xa, height: bottom - top }, style: { fill, stroke: colours.card, lineWidth: 0.6 } }];
      if (size >= 6) {
        children.push({ type: 'text', style: { text: letter, x: (xa + xb) / 2, y: (top + bottom) / 2, align: 'center', verticalAlign: 'middle',
          fill: ink, font: `${size}px system-ui, sans-serif` } });
      }
      return { type: 'group', children };
    } };
}

// Beside the rows, or above their points where the window is narrow. An axis would name ticks.
function row_names(names, { narrow, left }, colours, on) {
  return { ...on, type: 'custom', silent: true, clip: false, animation: false, data: names.map((_, row) => [0, row]), encode: { x: -1, y: 1 },
    renderItem: ({ dataIndex, coordSys }, api) => {
      const [, y] = api.coord([0, dataIndex]), top = y - coordSys.height / names.length / 2;
      return { type: 'text', silent: true, style: { text: names[dataIndex], fill: colours.text, font: '12px system-ui, sans-serif',
        x: narrow ? left + 2 : left - 10, y: narrow ? top + 9 : y, align: narrow ? 'left' : 'right', verticalAlign: 'middle',
        width: narrow ? undefined : left - 16, overflow: 'truncate' } };
    } };
}
