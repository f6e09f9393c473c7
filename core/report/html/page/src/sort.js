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

/** Puts a button into each head of a table with more than one row; rows stay in their groups. */
export function make_sortable(table) {
  const groups = [...table.tBodies];
  const rows_of = (body) => [...body.rows].filter((row) => !row.classList.contains('topic'));
  if (!table.tHead || !groups.some((body) => rows_of(body).length > 1)) return;
  // A cell that spans rows or columns belongs to more than one place.
  if (groups.some((body) => rows_of(body).some((row) => row.querySelector('[rowspan], [colspan]')))) return;
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
      for (const body of groups) {
        const rows = rows_of(body);
        const cells = rows.map((row) => ({ text: row.cells[column]?.textContent ?? '', value: row.cells[column]?.dataset.value }));
        body.append(...sorted_order(cells, descending).map((k) => rows[k]));
      }
    });
  });
}
