// What the runs that are looked at come to: the same words and counts as the program's own
// (core/report/rows/summary.cpp), which a test holds against each other on every page.

export const kVerdicts = ['not-judged', 'within', 'undecided', 'deviates', 'failed'];  // from good to bad
export const kSymbols = { within: '✓', deviates: '✗', undecided: '?', failed: '⚠', 'not-judged': '–' };
const kTold = ['within', 'deviates', 'undecided', 'failed', 'not-judged'];
const kMostNamed = 4, kMostWorst = 5;

export const rank = (verdict) => kVerdicts.indexOf(verdict);
export const counted = (count, noun) => `${count} ${noun}${count === 1 ? '' : 's'}`;
const worse = (a, b) => (rank(b) > rank(a) ? b : a);

/** The runs that decide a scene's verdict: naive ones only where there are no others. */
export function deciding(runs) {
  const others = runs.filter((run) => !run.naive);
  return others.length ? others : runs;
}

/** What people are told of a scene of which these runs are looked at. */
export function scene_verdict(scene, runs) {
  const by_reference = !runs.length || !runs.every((run) => run.expected);
  const least = scene.reached || !by_reference ? 'not-judged' : 'undecided';
  return deciding(runs).reduce((worst, run) => worse(worst, run.verdict), least);
}

/** "within", "as expected", "reference alone". */
export function verdict_name(scene, runs) {
  const verdict = scene_verdict(scene, runs);
  if (!runs.length && verdict === 'not-judged') return 'reference alone';
  if (runs.length && runs.every((run) => run.expected)) {
    if (verdict === 'within') return 'as expected';
    if (verdict === 'deviates') return 'NOT AS EXPECTED';
  }
  return verdict === 'not-judged' ? 'not judged' : verdict;
}

/** The worst deviation among the runs that decide: {run, text, severity}, or null. */
export function worst_of(runs) {
  let worst = null;
  for (const run of deciding(runs)) {
    if (run.worst && (!worst || run.worst.severity > worst.severity)) worst = { run, ...run.worst };
  }
  return worst;
}

function median(values) {
  const sorted = values.map((value) => (value === 'infinite' ? Infinity : value)).sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/** By engine, version and profile: {engine, version, profile, naive, within, judged, share, median_error}. */
export function scores_of(shown) {
  const scores = new Map();
  for (const { runs } of shown) {
    for (const run of runs) {
      if (run.expected) continue;
      const key = [run.engine, run.version, run.profile].join('\u0000');
      const score = scores.get(key) ?? { key, engine: run.engine, version: run.version, profile: run.profile, naive: run.naive,
        within: 0, judged: 0, errors: [] };
      scores.set(key, score);
      if (run.verdict === 'within') ++score.within;
      if (run.verdict !== 'not-judged' && !run.skipped) ++score.judged;
      if (run.error !== null) score.errors.push(run.error);
    }
  }
  const all = [...scores.values()].map((score) => ({ ...score, share: score.judged ? score.within / score.judged : NaN,
    median_error: score.errors.length ? median(score.errors) : NaN }));
  all.sort((a, b) => (a.key < b.key ? -1 : 1));
  const share = (score) => (score.judged ? score.share : -1);
  const error = (score) => (Number.isNaN(score.median_error) ? Infinity : score.median_error);
  return all.map((score, k) => [score, k]).sort(([a, i], [b, j]) => Number(a.naive) - Number(b.naive) || share(b) - share(a) ||
    (error(a) === error(b) ? 0 : error(a) - error(b)) || i - j).map(([score]) => score);
}

export function label_of(score, with_engine) {
  return with_engine ? `${score.engine} ${score.version ? `${score.version} ` : ''}${score.profile}` : score.profile;
}

function standings(scores, with_engine) {
  const judged = scores.filter((score) => !score.naive && score.judged);
  const named = judged.length > kMostNamed ? kMostNamed - 1 : judged.length;
  const standing = (score, first) => `${label_of(score, with_engine)} ${first ? 'is within all tolerances ' : ''}in ${score.within} of ` +
    (first ? counted(score.judged, 'run') : score.judged);
  const parts = judged.slice(0, named).map((score, k) => standing(score, k === 0));
  if (named < judged.length) parts.push(`last of ${judged.length} ${standing(judged.at(-1), false)}`);
  return parts.join(', ');
}

/**
 * Of `shown`, [{scene, runs}] with the runs that are looked at: counts by verdict, alone, scores, worst,
 * has_engines and the finding in a sentence.
 */
export function summarize(shown) {
  const counts = Object.fromEntries(kVerdicts.map((verdict) => [verdict, 0]));
  let alone = 0;
  for (const { scene, runs } of shown) {
    if (!scene.runs.length && scene.reached) ++alone;
    else ++counts[scene_verdict(scene, runs)];
  }
  const scores = scores_of(shown);
  const has_engines = scores.some(({ engine, version }) => engine !== scores[0].engine || version !== scores[0].version);
  const worst = shown.map(({ scene, runs }) => ({ scene, found: worst_of(runs) })).filter(({ found }) => found)
    .map(({ scene, found }) => ({ scene, ...found })).sort((a, b) => b.severity - a.severity).slice(0, kMostWorst);
  const parts = [];
  const text = standings(scores, has_engines);
  if (text) parts.push(text);
  const expected = shown.flatMap(({ runs }) => runs.filter((run) => run.expected));
  if (expected.length) {
    parts.push(`${expected.filter((run) => run.verdict === 'within').length} of ${counted(expected.length, 'run')} of which something is expected do as expected`);
  }
  if (worst.length) parts.push(`worst: ${worst[0].scene.name}, ${worst[0].text} (${worst[0].run.label})`);
  const bad = counts.undecided + counts.deviates + counts.failed;
  const heading = bad ? `${bad} of ${counted(shown.length, 'scene')} not within tolerance`
    : counts.within ? 'all within tolerance' : 'nothing was judged';
  return { scenes: shown.length, counts, alone, scores, has_engines, worst, finding: parts.length ? `${parts.join('; ')}.` : heading };
}

/** [[verdict, "3 deviate"], …] as the counts are told. */
export function told_counts({ counts, alone }) {
  const told = kTold.filter((verdict) => verdict !== 'not-judged' || counts[verdict])
    .map((verdict) => [verdict, `${counts[verdict]} ${verdict === 'deviates' && counts[verdict] !== 1 ? 'deviate' : verdict.replace('-', ' ')}`]);
  if (alone) told.push(['not-judged', `${alone} of the reference alone`]);
  return told;
}
