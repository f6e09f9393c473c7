// How a method comes out over two parameters: a colour and a letter in each cell.
import { add_chart, axis_of, log_axis_of, tooltip_of } from './chart.js';
import { escaped, make, number_text } from './dom.js';
import { borders_of } from './scales.js';

export function add_map_chart(parent, map, outcomes) {
  const present = outcomes.filter((_, k) => map.cells.includes(k));
  const legend = make('ul', { class: 'outcomes' }, ...present.map(({ name, letter, fill, ink }) =>
    make('li', {}, make('span', { style: `background:${fill};color:${ink}`, 'aria-hidden': 'true' }, letter), ` ${name}`)));
  if (map.theory?.length) {
    legend.append(make('li', {}, make('span', { 'aria-hidden': 'true' }, '╌╌'), ` ${map.theory_name || 'theory'}`));
  }
  const chart = add_chart(parent, {
    name: `Outcome over ${map.x.label} and ${map.y.label}: ${map.title}`,
    height: 340,
    option_of: (view) => option_of(map, outcomes, view),
  });
  chart.figure.append(legend);
  return chart;
}

function option_of(map, outcomes, { colours, width, narrow }) {
  const columns = map.x.values.length, rows = map.y.values.length;
  const across = borders_of(map.x.values, map.x.logarithmic);
  const up = borders_of(map.y.values, map.y.logarithmic);
  const left = 68, plot = width - left - 20;
  const height = Math.min(560, Math.max(220, rows * Math.min(30, Math.max(15, plot / columns))));
  const axis = (spec, borders, count, more) => {
    const all = { name: spec.label, splitLine: { show: false }, z: 5, ...more };
    const [low, high] = [borders[0], borders[borders.length - 1]];
    if (spec.logarithmic) return log_axis_of(colours, low, high, count, all);
    return axis_of(colours, { ...all, min: low, max: high, splitNumber: count,
      axisLabel: { formatter: (value) => number_text(value, 3), showMinLabel: false, showMaxLabel: false } });
  };
  const at = (x, y) => [map.x.logarithmic ? Math.log10(x) : x, map.y.logarithmic ? Math.log10(y) : y];
  const cells = map.cells.map((outcome, k) =>
    [...at(map.x.values[k % columns], map.y.values[Math.floor(k / columns)]), outcome, k]);

  const draw = (params, api) => {
    const k = api.value(3), column = k % columns, row = Math.floor(k / columns);
    const [x0, y1] = api.coord(at(across[column], up[row]));
    const [x1, y0] = api.coord(at(across[column + 1], up[row + 1]));
    const { fill, ink, letter } = outcomes[api.value(2)];
    const size = Math.min(12, 0.8 * (y1 - y0), 1.1 * (x1 - x0));
    const group = [{ type: 'rect', shape: { x: x0, y: y0, width: x1 - x0, height: y1 - y0 },
      style: { fill, stroke: colours.card, lineWidth: 0.6 } }];
    if (size >= 6) {
      group.push({ type: 'text', style: { text: letter, x: (x0 + x1) / 2, y: (y0 + y1) / 2,
        align: 'center', verticalAlign: 'middle', fill: ink, font: `${size}px system-ui, sans-serif` } });
    }
    return { type: 'group', children: group };
  };
  const tell = ({ data }) => {
    const error = map.errors?.[data[3]];
    return `<b>${escaped(outcomes[data[2]].name)}</b><br>${escaped(map.x.label)}: ${number_text(map.x.values[data[3] % columns])}` +
      `<br>${escaped(map.y.label)}: ${number_text(map.y.values[Math.floor(data[3] / columns)])}` +
      (error === null || error === undefined ? '' : `<br>${escaped(map.error_label)}: ${number_text(error, 3)}`);
  };
  const border = (colour, line_width, dash) => ({
    type: 'line', data: (map.theory ?? []).map(([x, y]) => at(x, y)), symbol: 'none', silent: true, clip: true, z: 4, tooltip: { show: false },
    lineStyle: { color: colour, width: line_width, type: dash },
  });
  return {
    height: height + 62,
    grid: { left, right: 20, top: 8, bottom: 54 },
    xAxis: axis(map.x, across, narrow ? 4 : 8, { nameGap: 30 }),
    yAxis: axis(map.y, up, 6, { nameGap: 50 }),
    tooltip: tooltip_of(colours, { trigger: 'item', formatter: tell }),
    series: [
      { type: 'custom', data: cells, renderItem: draw, encode: { x: 0, y: 1 }, clip: true, animation: false },
      // White below black, so that it shows on every colour.
      border('#ffffff', 5, 'solid'), border('#1b1b1b', 2.2, [7, 4]),
    ],
  };
}
