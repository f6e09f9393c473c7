// What a vibrated box showed at each sample, with the mean and the interval that holds the true one.
import { add_chart, axis_of, mark_line, tooltip_of } from './chart.js';
import { count_of, values_of } from './data.js';
import { largest_of, number_text, prefixed, quantity_text } from './dom.js';

const kHeight = 210;  // [px]

export function add_series_chart(parent, series) {
  const mean = series.mean === null ? null : series.mean / series.factor;
  const half = series.uncertainty === null || series.uncertainty === undefined ? null
    : series.uncertainty / series.factor;
  const caption = mean === null ? null
    : `Mean ${number_text(mean, 5)}${half === null ? '' : ` ± ${number_text(half, 2)}`} ${series.unit}`.trim();
  return add_chart(parent, {
    title: series.unit ? `${series.title} [${series.unit}]` : series.title,
    name: `${series.title} over time. ${caption ?? ''}`,
    caption,
    height: kHeight,
    option_of: (view) => option_of(series, mean, half, view),
  });
}

function option_of(series, mean, half, { colours, width }) {
  const count = Math.max(count_of(series.time), count_of(series.values));
  const times = values_of(series.time, count);
  const values = values_of(series.values, count).map((value) => value / series.factor);
  const clock = prefixed('s', largest_of(times));
  const points = times.map((time, k) => [time / clock.factor, values[k]]);
  const from = Math.min(series.averaged_from ?? 0, count - 1);
  const trace = (name, data, colour) => ({
    type: 'line', name, data, showSymbol: false, symbol: 'circle', lineStyle: { width: 1.2, color: colour },
    itemStyle: { color: colour }, sampling: 'minmax',
  });
  const begin = points[from]?.[0], end = points[count - 1]?.[0];
  return {
    height: kHeight,
    grid: { left: 62, right: 16, top: 10, bottom: 42 },
    xAxis: axis_of(colours, { name: `time [${clock.unit}]`, min: 'dataMin', max: 'dataMax',
      splitNumber: Math.max(2, Math.round(width / 110)),
      axisLabel: { formatter: (value) => number_text(value) } }),
    yAxis: axis_of(colours, { scale: true, splitNumber: 4,
      axisLabel: { formatter: (value) => number_text(value) } }),
    tooltip: tooltip_of(colours, {
      trigger: 'axis',
      formatter: ([{ data }]) => `${quantity_text(data[0], clock.unit)}<br><b>${quantity_text(data[1], series.unit)}</b>`,
    }),
    dataZoom: [{ type: 'inside', zoomOnMouseWheel: 'ctrl', moveOnMouseMove: 'ctrl' }],
    series: [
      { ...trace('not averaged', points.slice(0, from + 1), colours.faint), z: 1 },
      {
        ...trace('averaged', points.slice(from), colours.within),
        markArea: half === null ? undefined : {
          silent: true, itemStyle: { color: colours.band, opacity: 0.2 },
          data: [[{ coord: [begin, mean - half] }, { coord: [end, mean + half] }]],
        },
        markLine: mean === null ? undefined
          : mark_line(colours.truth, { data: [[{ coord: [begin, mean] }, { coord: [end, mean] }]] }),
      },
    ],
  };
}
