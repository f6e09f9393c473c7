// Error against run time: one line for each method over its rates or tolerances; down and left is
// better.
import { add_chart, legend_of, log_axis_of, mark_line, tooltip_of } from './chart.js';
import { escaped, make_select, number_text } from './dom.js';
import { look_of } from './look.js';
import { floor_of } from './scales.js';

const kHeight = 420;  // [px]
const kCeiling = 1e4;  // what is worse has left the scene

/** `passes(curve)` tells whether an engine's curve is shown. */
export function add_precision_chart(parent, scene, passes) {
  const choice = { quantity: 0 };
  const chart = add_chart(parent, {
    title: 'Error against run time',
    name: `Worst error against run time of ${scene.name}`,
    caption: 'Worst error of all phases against CPU time for a second of simulated time: down and left is better. Open symbols: nothing is cheaper and no worse.',
    height: kHeight,
    option_of: (view) => option_of(scene, choice.quantity, passes, view),
  });
  if (scene.quantities.length > 1) {
    const { label } = make_select('Quantity', scene.quantities.map((one, k) => [k, label_of(one)]),
      (value) => {
        choice.quantity = Number(value);
        chart.redraw();
      });
    const choices = document.createElement('div');
    choices.className = 'chart-choices';
    choices.append(label);
    chart.head.append(choices);
  }
  return chart;
}

const label_of = ({ label, name }) => label ?? name;

// A logarithmic axis over the data, with some air.
function axis_over(values, colours, count, more) {
  const known = values.length ? values : [0];
  return log_axis_of(colours, 10 ** Math.min(...known) / 2, 2 * 10 ** Math.max(...known), count, more);
}

// Curves of one profile share a colour; the symbol tells the profile, the dash the precision.
function looks_of(curves, colours) {
  const profiles = [];
  return curves.map((curve) => {
    if (curve.kind !== 'engine') {
      const symbol = { contact: 'diamond', fixed_step: 'triangle' }[curve.kind] ?? 'pin';
      return { colour: colours.truth, symbol, dash: curve.kind === 'fixed_step' ? [8, 3, 2, 3] : 'solid' };
    }
    const profile = `${curve.engine} ${curve.profile}`;
    if (!profiles.includes(profile)) profiles.push(profile);
    const dash = /iterations/.test(curve.label) ? [2, 3] : curve.precision === 'single' ? [7, 4] : 'solid';
    return { ...look_of(profiles.indexOf(profile)), dash };
  });
}

function option_of(scene, quantity, passes, { colours, narrow }) {
  const looks = looks_of(scene.curves, colours);
  const curves = scene.curves.map((curve, k) => ({ curve, look: looks[k] }))
    .filter(({ curve }) => curve.kind !== 'engine' || passes(curve));
  const floor = floor_of(scene.curves.flatMap((curve) => curve.points.map((point) => point.errors[quantity])));
  const has_floor = curves.some(({ curve }) => curve.points.some((point) => point.errors[quantity] === 0));
  const series = [];
  for (const { curve, look } of curves) {
    const data = curve.points
      .filter((point) => point.cost > 0 && point.errors[quantity] !== null)
      .map((point) => ({
        value: [Math.log10(point.cost), Math.log10(Math.min(kCeiling, Math.max(floor, point.errors[quantity])))],
        point, curve,
        symbolSize: point.front?.[quantity] ? 13 : 8,
        itemStyle: point.front?.[quantity]
          ? { color: colours.card, borderColor: look.colour, borderWidth: 3.5 } : { color: look.colour },
      }));
    if (!data.length) continue;
    series.push({
      type: 'line', name: curve.label, data, symbol: look.symbol, showAllSymbol: true, cursor: 'default',
      itemStyle: { color: look.colour }, lineStyle: { color: look.colour, width: 1.6, type: look.dash },
      emphasis: { focus: 'series' },
    });
  }
  if (series.length && has_floor) {
    series.push({ type: 'line', data: [], markLine: mark_line(colours.faint, {
      lineStyle: { color: colours.faint, type: 'dotted' }, data: [{ yAxis: Math.log10(floor) }],
      label: { formatter: 'exact', position: 'insideStartTop', color: colours.faint },
    }) });
  }
  const drawn = series.flatMap(({ data }) => data.map(({ value }) => value));
  const tell = ({ data: { point, curve } }) => [
    `<b>${escaped(curve.label)}</b>`, escaped(point.setting),
    `CPU ${number_text(point.cost, 3)} s per simulated s${point.spread ? ` ± ${number_text(100 * point.spread, 2)} %` : ''}`,
    ...scene.quantities.map((one, k) => {
      const error = point.errors[k];
      const text = error === 0 ? 'exact' : number_text(error, 3);
      return `${k === quantity ? '▸ ' : ''}${escaped(label_of(one))}: <b>${error === null ? '–' : text}</b>`;
    }),
    ...(point.front?.[quantity] ? ['nothing is cheaper and no worse'] : []),
  ].join('<br>');
  return {
    height: narrow ? 360 : kHeight,
    grid: { left: 70, right: 18, top: 42, bottom: 52 },
    legend: legend_of(colours, { top: 0, left: 0, right: 0 }),
    xAxis: axis_over(drawn.map(([x]) => x), colours, narrow ? 4 : 8,
      { name: 'CPU time for a simulated second [s]', nameGap: 30 }),
    yAxis: axis_over(drawn.map(([, y]) => y), colours, 9,
      { name: label_of(scene.quantities[quantity]), nameGap: 50 }),
    tooltip: tooltip_of(colours, { trigger: 'item', formatter: tell }),
    series,
  };
}
