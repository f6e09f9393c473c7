/// Normal impulses of one step, summed over the contact points of each pair.
export class Touches {
  #sums = new Map();

  /// Two bodies, in any order, or a body and something < 0: floor, walls and lid of a box are one.
  add(first, second, impulse) {
    if (!(impulse > 0)) return;
    const other = Math.max(second, -1);
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
