// Tables that are sorted by a click on a column's head.
import { make } from './dom.js';

// Each kind of unit by its base, so that "3 µs" comes before "1 ms".
const kUnits = new Map(Object.entries({
  '': 1, '%': 0.01, 's': 1, 'ms': 1e-3, 'µs': 1e-6, 'us': 1e-6, 'ns': 1e-9, 'ps': 1e-12, 'min': 60, 'h': 3600,
  'm': 1, 'cm': 1e-2, 'mm': 1e-3, 'µm': 1e-6, 'um': 1e-6, 'nm': 1e-9, 'km': 1e3,
  'J': 1, 'mJ': 1e-3, 'µJ': 1e-6, 'nJ': 1e-9, 'pJ': 1e-12,
  'Hz': 1, 'kHz': 1e3, 'MHz': 1e6, 'kg': 1, 'g': 1e-3,
  'm/s': 1, 'cm/s': 1e-2, 'mm/s': 1e-3, 'µm/s': 1e-6, 'nm/s': 1e-9, 'km/s': 1e3,
}));
const kNumber = /^([±≤≥<>~]?)\s*([+−-]?(?:\d+(?:[.,]\d+)?|\.\d+)(?:(?:e|·10\^?|×10\^?)[+−-]?\d+)?)\s*(.*)$/i;

/** The number that a cell begins with, in base units; NaN where it does not begin with one. */
export function number_of(text) {
  const found = kNumber.exec(text.trim());
  if (!found) return NaN;
  const digits = found[2].replaceAll('−', '-').replace(/[·×]10\^?/, 'e').replace(',', '.');
  const unit = found[3].split(/[\s([…,;±]/)[0];
  return Number(digits) * (kUnits.get(unit) ?? 1);
}

/** The rows' order by `texts`: numbers before words, cells without either last in both directions. */
export function sorted_order(texts, descending) {
  const keys = texts.map((text) => {
    const trimmed = text.trim();
    const number = number_of(trimmed);
    return { number, text: trimmed, empty: trimmed === '' || /^[–—-]$/.test(trimmed) };
  });
  const numeric = keys.filter((key) => !Number.isNaN(key.number)).length;
  const by_number = numeric > 0 && numeric >= keys.filter((key) => !key.empty).length / 2;
  const sign = descending ? -1 : 1;
  return texts.map((_, k) => k).sort((a, b) => {
    const left = keys[a], right = keys[b];
    if (left.empty || right.empty) return left.empty - right.empty || a - b;
    if (by_number) {
      const no_left = Number.isNaN(left.number), no_right = Number.isNaN(right.number);
      if (no_left !== no_right) return no_left ? 1 : -1;
      if (!no_left && left.number !== right.number) return sign * (left.number - right.number);
    }
    return sign * left.text.localeCompare(right.text, 'en', { numeric: true }) || a - b;
  });
}

/** Puts a button into each head of a table with more than one row. */
export function make_sortable(table) {
  const body = table.tBodies[0];
  if (!table.tHead || !body || body.rows.length < 2) return;
  // A cell that spans rows or columns belongs to more than one place.
  if (table.querySelector('[rowspan], [colspan]')) return;
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  // A grid of two parameters is no list.
  if (heads.slice(1).every((head) => head.textContent && Number.isFinite(Number(head.textContent)))) return;
  heads.forEach((head, column) => {
    if (!head.textContent.trim()) return;
    const button = make('button', { type: 'button', class: 'sort' }, ...head.childNodes);
    head.append(button);
    button.addEventListener('click', () => {
      const descending = head.getAttribute('aria-sort') === 'ascending';
      for (const other of heads) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
      const rows = [...body.rows];
      const texts = rows.map((row) => row.cells[column]?.dataset.value ?? row.cells[column]?.textContent ?? '');
      body.append(...sorted_order(texts, descending).map((k) => rows[k]));
    });
  });
}
