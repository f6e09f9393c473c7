/// Normal impulses of one step, summed over the contact points of each pair.
export class Touches {
  #sums = new Map();
  #lowest;

  /// Floor, walls and lid of a box are one; without one what is < 0 is the substrate or a surface.
  constructor({ box } = { box: true }) {
    this.#lowest = box ? -1 : -Infinity;
  }

  /// Two bodies, in any order, or a body and something < 0.
  add(first, second, impulse) {
    if (!(impulse > 0)) return;
    const other = Math.max(second, this.#lowest);
    const [low, high] = other >= 0 && other < first ? [other, first] : [first, other];
    const key = `${low} ${high}`;
    const sum = this.#sums.get(key);
    if (sum) sum[2] += impulse;
    else this.#sums.set(key, [low, high, impulse]);
  }

  /// [first, second, impulse] of each pair, by `scale`.
  pushTo(touches, scale) {
    for (const [first, second, impulse] of this.#sums.values())
      touches.push([first, second, impulse * scale]);
  }
}
