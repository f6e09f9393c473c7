// Ranges and borders on axes: numbers only.

/**
 * What the axis shows: what must be seen, and most of the values; a few that are far off do not
 * squeeze the others, but are drawn at its ends.
 */
export function range_of(values, landmarks) {
  const known = landmarks.filter((value) => value !== null && Number.isFinite(value));
  const sorted = values.filter((value) => value !== null && Number.isFinite(value)).sort((a, b) => a - b);
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  let low = Math.min(...known, ...(sorted.length ? [at(0.04)] : []));
  let high = Math.max(...known, ...(sorted.length ? [at(0.96)] : []));
  if (!Number.isFinite(low)) return { low: 0, high: 1 };
  const middle = high - low;
  if (sorted.length && sorted[0] > low - 0.6 * middle) low = Math.min(low, sorted[0]);
  if (sorted.length && sorted[sorted.length - 1] < high + 0.6 * middle) {
    high = Math.max(high, sorted[sorted.length - 1]);
  }
  const margin = high > low ? 0.06 * (high - low) : Math.max(Math.abs(low) * 1e-3, 1e-12);
  return { low: low - margin, high: high + margin };
}

/** Borders of cells around their centres, half way between neighbours on the axis. */
export function borders_of(values, logarithmic) {
  const to = logarithmic ? Math.log : (value) => value;
  const from = logarithmic ? Math.exp : (value) => value;
  const at = values.map(to);
  if (at.length === 1) return [from(at[0] - 0.5), from(at[0] + 0.5)];
  const inner = at.slice(1).map((value, k) => (value + at[k]) / 2);
  return [at[0] - (inner[0] - at[0]), ...inner, 2 * at[at.length - 1] - inner[inner.length - 1]].map(from);
}

/** Where "no error at all" is drawn: a decade below the least error there is. */
export function floor_of(errors) {
  const known = errors.filter((error) => error !== null && error > 0);
  return known.length ? 10 ** (Math.floor(Math.log10(Math.min(...known))) - 1) : 1e-16;
}

/**
 * Where the bar of a limit changes: half way between the last good and the first bad value on a
 * logarithmic axis, else at the end of the range that is searched last. `above`: it works there.
 */
export function border_of({ good, bad, low, high }, above) {
  if (good !== null && bad !== null) return Math.sqrt(good * bad);
  return (good !== null) === above ? low : high;
}
