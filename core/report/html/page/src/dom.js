// Small helpers for elements and numbers.

/** An element; `attributes` whose name begins with "on" are listeners. */
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, '');
    else if (value !== false && value !== null) element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** <label>text <select>…</select></label>; `options` are [value, text]. */
export function make_select(text, options, listener) {
  const select = make('select', { onchange: () => listener(select.value) },
    ...options.map(([value, name]) => make('option', { value }, name)));
  return { label: make('label', {}, `${text} `, select), select };
}

const kEntities = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;' };

/** For ECharts' tooltips, which are HTML. Names come from users' files. */
export function escaped(text) {
  return String(text).replace(/[&<>"']/g, (letter) => kEntities[letter]);
}

const kRaised = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };

/** Four significant digits unless told otherwise, as people write them. */
export function number_text(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const magnitude = Math.abs(value);
  if (magnitude >= 1e5 || magnitude < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const raised = exponent.replace('+', '').replace(/[-\d]/g, (sign) => kRaised[sign]);
    return Number(mantissa) === 1 ? `10${raised}` : `${minus(String(Number(mantissa)))}·10${raised}`;
  }
  return minus(String(Number(value.toPrecision(digits))));
}

/** With the unit behind it, where there is one. */
export function quantity_text(value, unit, digits = 4) {
  return unit && Number.isFinite(value) ? `${number_text(value, digits)} ${unit}`
    : number_text(value, digits);
}

/** A prefix that makes `largest` a readable number: {factor, unit}. */
export function prefixed(unit, largest) {
  const size = Math.abs(largest);
  if (!(size > 0) || size >= 1) return { factor: 1, unit };
  for (const [factor, prefix] of [[1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']]) {
    if (size >= factor * 0.9999) return { factor, unit: prefix + unit };
  }
  return { factor: 1, unit };
}

/** Largest magnitude of the finite ones; 0 if there is none. */
export function largest_of(values) {
  let largest = 0;
  for (const value of values) {
    if (Number.isFinite(value)) largest = Math.max(largest, Math.abs(value));
  }
  return largest;
}

function minus(text) {
  return text.replace('-', '−');
}
