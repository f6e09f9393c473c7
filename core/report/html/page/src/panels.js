// Charts of the page's data before they are drawn: numbers and words only.
import { count_of, values_of } from './data.js';
import { escaped, number_text } from './dom.js';

/** With plain arrays, one number for each point. */
export function unpacked(chart) {
  const curve_of = (curve) => {
    const count = Math.max(count_of(curve.x), count_of(curve.y), curve.x.length ?? 0);
    const column = (values) => (Array.isArray(values) ? values : values_of(values, count));
    return { ...curve, x: column(curve.x), y: column(curve.y) };
  };
  return { ...chart, panels: chart.panels.map((panel) => ({ ...panel, curves: panel.curves.map(curve_of) })) };
}

/**
 * Without the rows of runs that are not shown. Where all of those that are lie beyond the axis, as naive ones do that were
 * asked for, the axis follows them.
 */
export function shown(chart, passes) {
  return { ...chart, panels: rows_of(chart, passes).panels.map(widened) };
}

/** The panel with an axis that shows its points, where it shows none of them. */
function widened(panel) {
  const points = panel.curves.filter(({ notes }) => notes).flatMap(({ x }) => x);
  const { low, high } = panel.x;
  if (!panel.y.runs || !panel.truth || panel.x.log || !points.length || points.some((x) => x >= low && x <= high)) return panel;
  const all = [...points, panel.truth.value - panel.truth.tolerance, panel.truth.value + panel.truth.tolerance];
  const least = all.reduce((a, b) => Math.min(a, b)), most = all.reduce((a, b) => Math.max(a, b)), room = 0.04 * (most - least);
  return { ...panel, x: { ...panel.x, low: least - room, high: most + room } };
}

function rows_of(chart, passes) {
  return { ...chart, panels: chart.panels.map((panel) => {
    const { names, runs } = panel.y;
    if (!names || !runs) return panel;
    const rows = names.map((_, k) => k).filter((k) => passes(runs[k]));
    const high = Math.max(1, rows.length) - 0.5;
    const curves = panel.curves.map((curve) => {
      if (!curve.notes) return { ...curve, y: curve.y.map((y) => Math.min(y, high)) };
      const kept = curve.y.map((_, k) => k).filter((k) => rows.includes(Math.round(curve.y[k])));
      return { ...curve, x: kept.map((k) => curve.x[k]), notes: kept.map((k) => curve.notes[k]),
        y: kept.map((k) => rows.indexOf(Math.round(curve.y[k])) + curve.y[k] - Math.round(curve.y[k])) };
    });
    return { ...panel, curves, y: { ...panel.y, names: rows.map((k) => names[k]), high } };
  }) };
}

/** What is said of a point. */
export function tell(panel, curve, n) {
  const row = panel.y.names?.[Math.round(curve.y[n])];
  const lines = [`<b>${escaped(row ?? curve.label)}</b>`];
  if (curve.notes) lines.push(...curve.notes[n].split('\n').map(escaped));
  if (row !== undefined) lines.push(`${escaped(panel.x.label)}: <b>${number_text(curve.x[n], 6)}</b>`);
  if (panel.truth) {
    const off = curve.x[n] - panel.truth.value, share = Math.abs(off) / panel.truth.tolerance;
    lines.push(`error ${number_text(off, 3)}${Number.isFinite(share) ? `, ${number_text(share, 3)} tolerances` : ''}`);
  }
  return lines.join('<br>');
}
