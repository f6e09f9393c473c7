// How runs look: colours of Okabe and Ito, which colour-blind people can tell apart, and with them
// symbols and dashes, so that colour is never all that tells two runs apart.
import { is_dark } from './theme.js';

const kInks = [
  ['#0072b2', '#56b4e9'], ['#d55e00', '#f08a3c'], ['#009e73', '#2fc79a'], ['#b4568f', '#e39bc4'],
  ['#b07900', '#e9b23a'], ['#4a8db7', '#9ad4f2'],
];
const kSymbols = ['circle', 'rect', 'triangle', 'diamond', 'pin', 'roundRect'];
const kDashes = [[6, 3], [2, 2], [10, 3, 2, 3], [12, 4], [4, 2, 1, 2], [1, 3]];

/** {colour, symbol, dash} of the k-th run or method. */
export function look_of(k) {
  const ink = kInks[k % kInks.length][is_dark() ? 1 : 0];
  const shifted = k + Math.floor(k / kInks.length);  // so that no two of 36 look alike
  return { colour: ink, symbol: kSymbols[shifted % kSymbols.length], dash: kDashes[shifted % kDashes.length] };
}
