// Tables that are sorted by a click on a column's head.
import { make } from './dom.js';

/** The rows' order by their cells' values, else texts: numbers before words, cells without either last in both directions. */
export function sorted_order(cells, descending) {
  const keys = cells.map(({ text, value }) => {
    const words = text.trim().replace(/^[–—-]$/, '');
    const rank = value !== undefined ? 0 : words ? 1 : 2;
    return { number: Number(value), words, rank };
  });
  const sign = descending ? -1 : 1;
  return cells.map((_, k) => k).sort((a, b) => {
    const left = keys[a], right = keys[b];
    if (left.rank !== right.rank) return left.rank - right.rank;
    const difference = left.rank === 0 ? left.number - right.number
      : left.words.localeCompare(right.words, 'en', { numeric: true });
    return sign * difference || a - b;
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
      const cells = rows.map((row) => ({ text: row.cells[column]?.textContent ?? '', value: row.cells[column]?.dataset.value }));
      body.append(...sorted_order(cells, descending).map((k) => rows[k]));
    });
  });
}
