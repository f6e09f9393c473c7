// Which runs a chart shows at first: at most five, of each engine and profile one before a second,
// and naive ones only where there are no others or they were asked for.

export const kMostLines = 5;

/** Indices into `runs`, in their order, of those of `candidates` (indices) that are shown at first. */
export function first_lines(runs, candidates, filter) {
  const asked = filter.profile === 'naive' || candidates.every((k) => runs[k].naive);
  const groups = new Map();
  for (const k of candidates) {
    if (runs[k].naive && !asked) continue;
    const { engine, version, precision, profile } = runs[k];
    const key = [engine, version, precision, profile].join('\u0000');
    groups.set(key, [...(groups.get(key) ?? []), k]);
  }
  const chosen = [];
  for (let round = 0; chosen.length < kMostLines; ++round) {
    const before = chosen.length;
    for (const group of groups.values()) {
      if (round < group.length && chosen.length < kMostLines) chosen.push(group[round]);
    }
    if (chosen.length === before) break;
  }
  return chosen.sort((a, b) => a - b);
}

/** Which runs of a scene a chart shows: of those with the indices `of` that view() lets pass few at first, or `all`. */
export class Lines {
  constructor(runs, of, view) {
    this.runs = runs;
    this.of = of;
    this.view = view;
    this.all = false;
  }

  shown() {
    const { filter, passes } = this.view();
    const candidates = this.of.filter((k) => passes(this.runs[k]));
    return { candidates, first: this.all ? candidates : first_lines(this.runs, candidates, filter) };
  }

  /** What the button says that shows the others or hides them again; "" where there is nothing to choose. */
  text() {
    const { candidates, first } = this.shown();
    if (this.all) {
      const fewer = first_lines(this.runs, candidates, this.view().filter).length;
      return fewer < candidates.length ? `Show ${fewer} runs` : '';
    }
    return first.length < candidates.length ? `Show all ${candidates.length} runs` : '';
  }
}
