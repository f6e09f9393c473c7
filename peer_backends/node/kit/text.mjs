// Numbers as the rest of the program writes them.

const exponentOf = (text) => text.replace(/e([+-])(\d)$/, 'e$10$2');

/// The shortest text that reads back as the same number.
export function exactText(value) {
  if (typeof value !== 'number') return String(value);
  const size = Math.abs(value);
  if (value === 0 || !Number.isFinite(value) || (size >= 1e-4 && size < 1e16)) return String(value);
  return exponentOf(value.toExponential());
}

/// A number with so many significant digits, without zeros at its end.
export function rounded(value, digits) {
  const text = exactText(Number(value.toPrecision(digits)));
  const size = Math.abs(value);
  if (size < 10 ** digits || text.includes('e')) return text;
  return exponentOf(Number(value.toPrecision(digits)).toExponential());
}
