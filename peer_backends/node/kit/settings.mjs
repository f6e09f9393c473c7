// The settings that an engine takes: rows of its table, and the rules of a request's values.

import { Refused, Rubbish } from './faults.mjs';
import { exactText } from './text.mjs';

const row = (name, about, unit, shipped, more) => ({
  name, about, unit, shipped, whole: false, choices: [], candidates: [], ...more,
});

/// true or false.
export const flag = (name, shipped, about, more) =>
  row(name, about, '', shipped, { candidates: [true, false], ...more });

/// A number, >= 0 unless `more` says otherwise.
export const number = (name, unit, shipped, about, more) =>
  row(name, about, unit, shipped, { low: 0, ...more });

/// A whole number.
export const count = (name, shipped, about, more) =>
  number(name, '', shipped, about, { whole: true, ...more });

/// One of some words.
export const word = (name, choices, shipped, about, more) =>
  row(name, about, '', shipped, { choices, candidates: choices, ...more });

/// A range in which tuning searches.
export const search = (low, high, logarithmic = false) => ({ range: { low, high, logarithmic } });

/// "a whole number >= 1 and <= 4", "a number >= 0 m/s"
function numbersOf({ low, high, whole, unit }) {
  let text = whole ? 'a whole number' : 'a number';
  if (low !== undefined) text += ` >= ${exactText(low)}`;
  if (low !== undefined && high !== undefined) text += ' and';
  if (high !== undefined) text += ` <= ${exactText(high)}`;
  return unit ? `${text} ${unit}` : text;
}

function brokenRule(known, value) {
  const kind = typeof known.shipped;
  if (kind === 'boolean') return typeof value === 'boolean' ? '' : 'must be true or false';
  if (kind === 'number') {
    const { low = -Infinity, high = Infinity, whole } = known;
    const fits = Number.isFinite(value) && value >= low && value <= high && !(whole && value % 1 !== 0);
    return fits ? '' : `must be ${numbersOf(known)}`;
  }
  if (typeof value === 'string' && (known.choices.length === 0 || known.choices.includes(value))) return '';
  return known.choices.length === 0 ? 'must be a word' : `must be one of ${known.choices.join(', ')}`;
}

/// Throws Refused with all that is wrong with `chosen`, an object of values by name.
export function refuseBadSettings(table, chosen) {
  if (typeof chosen !== 'object' || chosen === null)
    throw new Rubbish('request.settings must be a map');
  const faults = [];
  for (const [name, value] of Object.entries(chosen)) {
    const known = table.find((each) => each.name === name);
    if (!known) faults.push(`${name} is no setting of this engine`);
    const rule = known ? brokenRule(known, value) : '';
    if (rule) faults.push(`${name} ${rule}, got ${exactText(value)}`);
  }
  if (faults.length > 0) throw new Refused(faults.join('; '));
}

/// All settings of the table by name: the chosen ones and else what ships.
export function inForce(table, chosen) {
  return Object.fromEntries(table.map(({ name, shipped }) => [name, chosen[name] ?? shipped]));
}
