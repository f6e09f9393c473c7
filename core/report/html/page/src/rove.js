// A table is one tab stop: arrows, Home and End move between its buttons and links.

const kStops = 'button, a[href]';

/** For tables that scroll the place around them is no stop of its own then. */
export function rove(table) {
  const all = () => [...table.querySelectorAll(kStops)].filter((stop) => stop.getClientRects().length);
  let current = table.querySelector(kStops);
  if (!current) return;
  for (const stop of table.querySelectorAll(kStops)) stop.tabIndex = -1;
  current.tabIndex = 0;
  table.closest('.table')?.removeAttribute('tabindex');
  const move = (to) => {
    current.tabIndex = -1;
    current = to;
    current.tabIndex = 0;
  };
  table.addEventListener('focusin', ({ target }) => { if (target.matches(kStops)) move(target); });
  table.addEventListener('keydown', (event) => {
    const from = event.target.closest('th, td');
    if (!event.target.matches(kStops) || !from || event.ctrlKey || event.metaKey || event.altKey) return;
    const stops = all(), row = from.parentElement;
    const of_row = (one) => stops.filter((stop) => stop.closest('tr') === one);
    const here = of_row(row), at = here.indexOf(event.target);
    let to = null;
    if (event.key === 'ArrowRight') to = here[at + 1];
    else if (event.key === 'ArrowLeft') to = here[at - 1];
    else if (event.key === 'Home') [to] = stops;
    else if (event.key === 'End') to = stops.at(-1);
    else if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
      const rows = [...new Set(stops.map((stop) => stop.closest('tr')))];
      const next = rows[rows.indexOf(row) + (event.key === 'ArrowDown' ? 1 : -1)];
      const there = next ? of_row(next) : [];
      to = there[Math.min(at, there.length - 1)];
    } else return;
    event.preventDefault();
    to?.focus();
  });
}

/** When the filter has hidden the stop of a table another one takes its place. */
export function mend_stops() {
  for (const table of document.querySelectorAll('table')) {
    const stop = table.querySelector('[tabindex="0"]');
    if (!stop || stop.getClientRects().length || !table.getClientRects().length) continue;
    const other = [...table.querySelectorAll(kStops)].find((one) => one.getClientRects().length);
    if (!other) continue;
    stop.tabIndex = -1;
    other.tabIndex = 0;
  }
}
