// Slip, speed and energy over time: the reference's line, and one phase of each engine run over it.
import { add_chart, axis_of, legend_of, tooltip_of } from './chart.js';
import { escaped, largest_of, make_select, number_text, prefixed, quantity_text } from './dom.js';
import { add_lines_button } from './figure.js';
import { Lines } from './lines.js';
import { look_of } from './look.js';
import { end_of, kRoles } from './motion.js';

// [px]
const kLegend = 34, kPanel = 190, kRow = kPanel + 66, kZoom = 36;
const kNarrow = 760;     // below which panels stand one below the other
const kMarks = 9;        // symbols along a line

/** `motions()` gives the scene's, unpacked, the reference's first; `view()` what is looked at now. */
export function add_time_chart(parent, scene, motions, view) {
  const { bodies, runs } = scene.motion;
  const roles = kRoles.filter((role) => runs.some((run) => run.role === role));
  const choice = { body: 0, role: roles[0] };
  const lines = new Lines(scene.runs, [...new Set(runs.map(({ run }) => run).filter((run) => run >= 0))], view);
  const chart = add_chart(parent, {
    title: 'Over time',
    name: `Slip speed, speed and kinetic energy of ${scene.name} over time`,
    caption: 'Full line: the reference; dashed: a phase of an engine’s ensemble. The slider zooms all panels; a click on a name hides its line.',
    height: kLegend + kRow + kZoom,
    option_of: (canvas) => option_of(scene, motions(), choice, new Set(lines.shown().first), canvas),
  });
  const choices = document.createElement('div');
  choices.className = 'chart-choices';
  if (bodies.length > 1) {
    choices.append(make_select('Body', bodies.map((body, k) => [k, body.name]), (value) => {
      choice.body = Number(value);
      chart.redraw();
    }).label);
  }
  if (roles.length > 1) {
    choices.append(make_select('Phase', [...roles, 'all'].map((role) => [role, role]), (value) => {
      choice.role = value;
      chart.redraw();
    }).label);
  }
  chart.head.append(choices);
  add_lines_button(chart, lines);
  return chart;
}

// [title, unit, the column of a motion]
function panels_of(body) {
  return [
    ['Slip speed', 'm/s', (motion) => motion.bodies[body].slip[0].map(
      (x, k) => Math.hypot(x, motion.bodies[body].slip[1][k]))],
    ['Speed', 'm/s', (motion) => motion.bodies[body].speed],
    ['Kinetic energy, all bodies', 'J', (motion) => motion.energy],
  ];
}

function option_of(scene, motions, choice, first, { colours, width }) {
  const shown = motions.filter((motion) => motion.run < 0 ||
    ((choice.role === 'all' || motion.role === choice.role) && first.has(motion.run)));
  const name_of = (motion) => (motion.run < 0 ? 'reference'
    : `${scene.runs[motion.run].label}${choice.role === 'all' ? `, ${motion.role}` : ''}`);
  if (!shown.length) return { height: kLegend, series: [] };
  const columns = panels_of(choice.body)
    .map(([title, unit, column]) => ({ title, unit, values: shown.map(column) }))
    .filter(({ values }) => values.some((one) => one.some(Number.isFinite)));
  for (const panel of columns) panel.scale = prefixed(panel.unit, largest_of(panel.values.flat()));
  const clock = prefixed('s', end_of(shown));
  const [begin, end] = [Math.min(...shown.map((motion) => motion.time[0])), end_of(shown)].map((time) => time / clock.factor);

  const across = width < kNarrow ? 1 : columns.length;
  const cell = (k) => ({ column: k % across, row: Math.floor(k / across) });
  const share = 100 / across;
  const grids = columns.map((_, k) => ({
    left: `${cell(k).column * share + (across > 1 ? 0.5 : 0)}%`,
    width: `${share - (across > 1 ? 2 : 2.5)}%`,
    top: kLegend + 24 + cell(k).row * kRow, height: kPanel,
    containLabel: true,
  }));
  const rows = Math.ceil(columns.length / across);
  const axis_indices = columns.map((_, k) => k);

  return {
    height: kLegend + rows * kRow + kZoom,
    grid: grids,
    legend: legend_of(colours, { top: 0, left: 0, right: 0, data: shown.map(name_of) }),
    xAxis: columns.map((_, k) => axis_of(colours, { gridIndex: k, name: `time [${clock.unit}]`, min: 'dataMin',
      max: 'dataMax', splitNumber: 4, axisLabel: { formatter: (value) => number_text(value), showMaxLabel: false } })),
    yAxis: columns.map(({ title, scale }, k) => axis_of(colours, { gridIndex: k, splitNumber: 4,
      name: `${title} [${scale.unit}]`, nameLocation: 'end', nameGap: 10,
      nameTextStyle: { color: colours.text, align: 'left', padding: [0, 0, 0, -18] },
      axisLabel: { formatter: (value) => number_text(value) } })),
    axisPointer: { link: [{ xAxisIndex: 'all' }] },
    tooltip: tooltip_of(colours, { trigger: 'axis', formatter: (items) => tip(items, columns, clock) }),
    dataZoom: [
      { type: 'slider', startValue: begin, endValue: end, xAxisIndex: axis_indices, bottom: 8, height: 22, left: 40, right: 40,
        textStyle: { color: colours.faint }, borderColor: colours.line, fillerColor: `${colours.band}30`,
        labelFormatter: (value) => number_text(value, 3), brushSelect: false,
        dataBackground: { lineStyle: { opacity: 0 }, areaStyle: { opacity: 0 } },
        selectedDataBackground: { lineStyle: { opacity: 0 }, areaStyle: { opacity: 0 } } },
      { type: 'inside', startValue: begin, endValue: end, xAxisIndex: axis_indices, zoomOnMouseWheel: 'ctrl', moveOnMouseMove: 'ctrl',
        moveOnMouseWheel: false },
    ],
    series: columns.flatMap(({ values, scale }, k) => shown.map((motion, m) => {
      const is_reference = motion.run < 0;
      const look = is_reference ? { colour: colours.truth, symbol: 'none', dash: 'solid' } : look_of(scene.runs[motion.run].look);
      const marked = Math.max(1, Math.ceil(motion.count / kMarks));
      const faint = choice.role === 'all' ? { median: 1, worst: 0.55, nearest: 0.55 }[motion.role] : 1;
      return {
        type: 'line', name: name_of(motion), xAxisIndex: k, yAxisIndex: k, z: is_reference ? 2 : 3,
        data: motion.time.map((time, n) => ({ value: [time / clock.factor, values[m][n] / scale.factor],
          symbolSize: (n + m) % marked === 0 ? 6 : 0 })),
        symbol: look.symbol, showSymbol: !is_reference,
        itemStyle: { color: look.colour, opacity: faint ?? 1 },
        lineStyle: { color: look.colour, width: is_reference ? 2.4 : 1.7, type: look.dash, opacity: faint ?? 1 },
        emphasis: { focus: 'series' },
      };
    })),
  };
}

function tip(items, columns, clock) {
  if (!items.length) return '';
  const lines = [`<b>${quantity_text(items[0].axisValue, clock.unit)}</b>`];
  let last = -1;
  for (const item of items) {
    if (item.axisIndex !== last) lines.push(escaped(columns[item.axisIndex].title));
    last = item.axisIndex;
    lines.push(`${item.marker}${escaped(item.seriesName)}: ` +
      `<b>${quantity_text(item.data[1], columns[item.axisIndex].scale.unit)}</b>`);
  }
  return lines.join('<br>');
}
