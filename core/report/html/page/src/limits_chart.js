// How far each method works: a bar over the range that was searched, blue where it works, in the
// colour of what happens beyond.
import { add_chart, axis_of, log_axis_of, tooltip_of } from './chart.js';
import { escaped, number_text, quantity_text } from './dom.js';
import { border_of } from './scales.js';

const kRow = 26;  // [px]
// What is stable need not be accurate.
const kWorks = { fill: '#0072b2', ink: '#ffffff', letter: '✓' };
const kFails = { fill: '#e4e4e0', ink: '#1b1b1b', letter: '✗' };

export function add_limits_chart(parent, limits, outcomes) {
  const beyond = outcomes.filter((_, k) => limits.rows.some((row) => row.beyond === k));
  return add_chart(parent, {
    title: limits.unit ? `${limits.title} [${limits.unit}]` : limits.title,
    name: `${limits.title}: where each method works`,
    caption: `Blue ✓: works. ${beyond.length ? `Beyond: ${beyond.map(({ letter, name }) => `${letter} ${name}`).join(', ')}. ` : ''}` +
      (limits.rows.some((row) => row.theory !== null) ? 'Upright line: where theory puts the limit.' : ''),
    height: height_of(limits.rows.length, kRow),
    option_of: (view) => option_of(limits, outcomes, view),
  });
}

function height_of(rows, row_height) {
  return 32 + row_height * rows;
}

function option_of(limits, outcomes, { colours, width, narrow }) {
  const { rows, unit } = limits;
  const longest = Math.max(...rows.map(({ label }) => label.length));
  const left = narrow ? 8 : Math.min(0.45 * width, 24 + 6.6 * longest);
  const right = 92;
  const row_height = narrow ? kRow + 16 : kRow;
  const low = Math.min(...rows.map((row) => row.low).filter((value) => value > 0));
  const high = Math.max(...rows.map((row) => row.high));
  const value_text = ({ good, bad }) => {
    if (good !== null && bad !== null) return quantity_text(Math.sqrt(good * bad), unit, 3);
    return good !== null ? 'all' : bad !== null ? 'none' : 'no answer';
  };

  const draw = (params, api) => {
    const k = params.dataIndex, row = rows[k];
    const [, y] = api.coord([0, k]);
    const top = narrow ? y : y - 7, height = 14;
    const x_of = (value) => api.coord([Math.log10(Math.min(high, Math.max(low, value))), k])[0];
    const children = [];
    const text = (content, x, at, align, style) => children.push({ type: 'text', style: { text: content, x, y: at, align,
      verticalAlign: 'middle', fill: colours.text, font: '12px system-ui, sans-serif', ...style } });
    const bar = (from, to, { fill, ink, letter }) => {
      const [x0, x1] = [x_of(from), x_of(to)];
      if (!(x1 > x0)) return;
      children.push({ type: 'rect', shape: { x: x0, y: top, width: x1 - x0, height }, style: { fill } });
      if (x1 - x0 > 14) text(letter, (x0 + x1) / 2, top + height / 2, 'center', { fill: ink, font: '10px system-ui, sans-serif' });
    };
    if (row.good !== null || row.bad !== null) {
      const above = limits.works === 'above', border = border_of(row, above);
      const fails = outcomes[row.beyond] ?? kFails;
      bar(row.low, border, above ? fails : kWorks);
      bar(border, row.high, above ? kWorks : fails);
    }
    if (row.theory !== null && row.theory !== undefined && row.theory >= low && row.theory <= high) {
      const x = x_of(row.theory);
      children.push({ type: 'rect', shape: { x: x - 2.5, y: top - 3, width: 5, height: height + 6 }, style: { fill: colours.card } },
        { type: 'rect', shape: { x: x - 1, y: top - 3, width: 2, height: height + 6 }, style: { fill: colours.truth } });
    }
    if (narrow) text(row.label, params.coordSys.x, top - 9, 'left');
    else text(row.label, left - 10, y, 'right');
    text(value_text(row), params.coordSys.x + params.coordSys.width + 8, top + height / 2, 'left');
    return { type: 'group', children };
  };
  const tell = ({ dataIndex }) => {
    const row = rows[dataIndex];
    const part = (name, value) => (value === null || value === undefined ? '' : `<br>${name}: ${quantity_text(value, unit, 4)}`);
    return `<b>${escaped(row.label)}</b><br>limit: ${escaped(value_text(row))}${part('last good', row.good)}` +
      `${part('first bad', row.bad)}${outcomes[row.beyond] ? `, ${escaped(outcomes[row.beyond].name)}` : ''}${part('theory', row.theory)}<br>searched ${number_text(row.low)} to ${quantity_text(row.high, unit)}`;
  };
  return {
    height: height_of(rows.length, row_height),
    grid: { left, right, top: 6, bottom: 26 },
    xAxis: log_axis_of(colours, low, high, Math.max(2, (width - left - right) / 80)),
    yAxis: axis_of(colours, { min: -0.5, max: rows.length - 0.5, interval: 1, inverse: true, axisLabel: { show: false },
      axisTick: { show: false }, axisLine: { show: false }, splitLine: { show: false } }),
    tooltip: tooltip_of(colours, { trigger: 'item', formatter: tell }),
    series: [{ type: 'custom', data: rows.map((row, k) => [Math.log10(low), k]), renderItem: draw,
      encode: { x: -1, y: 1 }, clip: false, animation: false }],
  };
}
