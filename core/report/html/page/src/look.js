// How curves look (core/report/charts/chart.h), in the colours of the page's data.
import { ink_colour } from './theme.js';

const kSymbols = { square: 'rect', triangle: 'triangle', diamond: 'diamond' };
const kDashes = { dashed: [7, 4], dotted: [2, 3], dash_dot: [9, 3, 2, 3] };

/** {colour, symbol, dash} of {ink, line, marker}. */
export function look_of({ ink, line, marker }) {
  return { colour: ink_colour(ink), symbol: kSymbols[marker] ?? 'circle', dash: kDashes[line] ?? 'solid' };
}
