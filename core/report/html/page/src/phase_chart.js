// Where inside a step a collision falls changes what an engine returns: every phase of each run as
// a point, beside the reference's value and the tolerance around it.
import { add_chart, axis_of, mark_line, tooltip_of } from './chart.js';
import { escaped, number_text, quantity_text } from './dom.js';
import { range_of } from './scales.js';

const kRow = 30, kLabel = 18;  // [px]

/** `passes(run)` tells whether a run is shown. */
export function add_phase_chart(parent, scene, phases, passes) {
  return add_chart(parent, {
    title: phases.unit ? `${phases.observable} [${phases.unit}]` : phases.observable,
    name: `${phases.observable} in every phase of each run. ${phases.caption ?? ''}`,
    caption: phases.caption,
    height: height_of(phases.values.filter((values) => values?.length).length, kRow),
    option_of: (view) => option_of(scene, phases, passes, view),
  });
}

function height_of(rows, row_height) {
  return 30 + row_height * Math.max(1, rows);
}

function option_of(scene, phases, passes, { colours, width, narrow }) {
  const scaled = (value) => (value === null ? null : value / phases.factor);
  const reference = scaled(phases.reference);
  const low = scaled(phases.low), high = scaled(phases.high);
  const rows = scene.runs.map((run, k) => ({ run, values: phases.values[k] }))
    .filter(({ run, values }) => values && values.length && passes(run));
  const range = range_of(rows.flatMap(({ values }) => values.map(scaled)), [reference, low, high]);

  // Of a row, what its points take up; where names stand above them, its lower part.
  const [centre, spread] = narrow ? [0.16, 0.46] : [0, 0.62];
  const inside = [], outside = [];
  rows.forEach(({ run, values }, row) => values.forEach((raw, phase) => {
    const value = scaled(raw);
    if (value === null) return;
    const depth = values.length > 1 ? centre + (phase / (values.length - 1) - 0.5) * spread : centre;
    const beyond = value < range.low ? -1 : value > range.high ? 1 : 0;
    const is_inside = low === null || (value >= low && value <= high);
    (is_inside ? inside : outside).push({
      value: [Math.min(range.high, Math.max(range.low, value)), row + depth],
      exact: value, run, phase, phases: values.length,
      ...(beyond && { symbol: 'triangle', symbolRotate: beyond < 0 ? 90 : -90, symbolSize: 9 }),
    });
  }));

  const left = narrow ? 8 : Math.min(250, 30 + 6.6 * Math.max(4, ...rows.map(({ run }) => run.label.length)));
  const row_height = narrow ? kRow + kLabel : kRow;
  const tell = ({ data }) => {
    const off = data.exact - reference;
    const half = low === null ? null : (high - low) / 2;
    const share = half > 0 ? `, ${number_text(Math.abs(off) / half, 3)} tolerances` : '';
    const error = reference === null ? '' : `<br>error ${quantity_text(off, phases.unit, 3)}${share}`;
    return `${escaped(data.run.label)}<br>phase ${data.phase + 1} of ${data.phases}: ` +
      `<b>${escaped(quantity_text(data.exact, phases.unit, 6))}</b>${error}`;
  };
  const points = (name, data, style) => ({
    type: 'scatter', name, data, symbolSize: 7, cursor: 'default', emphasis: { scale: 1.6 }, ...style,
  });

  return {
    height: height_of(rows.length, row_height),
    grid: { left, right: 16, top: 6, bottom: 24 },
    xAxis: axis_of(colours, {
      min: range.low, max: range.high,
      splitNumber: Math.max(2, Math.round((width - left) / 130)),
      axisLabel: { formatter: (value) => number_text(value), showMinLabel: false, showMaxLabel: false },
    }),
    yAxis: axis_of(colours, {
      min: -0.5, max: Math.max(1, rows.length) - 0.5, interval: 1, inverse: true,
      axisTick: { show: false }, axisLine: { show: false },
      splitLine: { lineStyle: { color: colours.line } },
      axisLabel: { show: false },
    }),
    tooltip: tooltip_of(colours, { trigger: 'item', formatter: tell }),
    series: [
      {
        ...points('reference', [], {}),
        markArea: low === null ? undefined : {
          silent: true, itemStyle: { color: colours.band, opacity: 0.2 },
          data: [[{ xAxis: Math.max(low, range.low) }, { xAxis: Math.min(high, range.high) }]],
        },
        markLine: reference === null ? undefined
          : mark_line(colours.truth, { data: [{ xAxis: reference }] }),
      },
      points('within the tolerance', inside, {
        symbol: 'circle', itemStyle: { color: colours.within, opacity: 0.8 } }),
      points('outside', outside, {
        symbol: 'diamond', symbolSize: 9,
        itemStyle: { color: 'transparent', borderColor: colours.deviates, borderWidth: 1.6 } }),
      row_names(rows, colours, narrow, left),
    ],
  };
}

// Beside the rows, or above their points where the window is narrow. An axis would name ticks.
function row_names(rows, colours, narrow, left) {
  return {
    type: 'custom', silent: true, clip: false, animation: false,
    data: rows.map((_, row) => [0, row]),
    encode: { x: -1, y: 1 },
    renderItem: (params, api) => {
      const row = params.dataIndex;
      const [, y] = api.coord([0, row]);
      const { x, height } = params.coordSys;
      const top = y - height / rows.length / 2;
      return {
        type: 'text', silent: true,
        style: {
          text: rows[row].run.label, fill: colours.text, font: '12px system-ui, sans-serif',
          x: narrow ? x + 2 : left - 10, y: narrow ? top + 9 : y,
          align: narrow ? 'left' : 'right', verticalAlign: 'middle',
          width: narrow ? undefined : left - 16, overflow: 'truncate',
        },
      };
    },
  };
}
