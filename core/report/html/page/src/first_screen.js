// The first screen, told anew for what the filter shows.
import { make } from './dom.js';
import { counted, kSymbols, label_of, told_counts } from './summary.js';

const kMostScores = 8;
const kSvg = 'http://www.w3.org/2000/svg';

/** Finding, counts, scores and worst deviations of a summary (summary.js). */
export function tell_summary(summary) {
  const finding = document.getElementById('finding');
  if (finding) finding.textContent = summary.finding;
  document.getElementById('counts')?.replaceChildren(make('span', { class: 'what' }, `${counted(summary.scenes, 'scene')}:`), ' ',
    ...told_counts(summary).flatMap(([verdict, text]) => [make('span', { class: `verdict ${verdict}` }, `${kSymbols[verdict]} ${text}`), ' ']));
  document.getElementById('scores')?.replaceChildren(...summary.scores.slice(0, kMostScores).map((score) => score_item(score, summary.has_engines)));
  const list = document.querySelector('#worst ol');
  list?.replaceChildren(...summary.worst.map(({ scene, run, text }) =>
    make('li', {}, make('a', { href: `#${scene.id}` }, scene.name), `: ${text} `, make('span', { class: 'faint' }, run.label))));
  document.getElementById('worst')?.classList.toggle('filtered', summary.worst.length === 0);
}

function score_item(score, with_engine) {
  const known = Number.isFinite(score.share), percent = known ? 100 * score.share : 0;
  const grade = !known ? 'none' : score.share >= 0.9 ? 'high' : score.share >= 0.5 ? 'middle' : 'low';
  return make('li', { class: `score ${grade}${score.naive ? ' naive' : ''}` },
    make('span', { class: 'share' }, known ? `${percent.toFixed(0)} %` : '–'), ' ', make('span', { class: 'whose' }, label_of(score, with_engine)), ' ',
    bar(percent), ' ', make('span', { class: 'of' }, `within in ${score.within} of ${counted(score.judged, 'run')}`));
}

function bar(percent) {
  const svg = document.createElementNS(kSvg, 'svg');
  for (const [name, value] of Object.entries({ class: 'bar', viewBox: '0 0 100 6', preserveAspectRatio: 'none', 'aria-hidden': 'true' })) svg.setAttribute(name, value);
  for (const [name, width] of [['all', 100], ['part', percent.toFixed(1)]]) {
    const rect = document.createElementNS(kSvg, 'rect');
    rect.setAttribute('class', name);
    rect.setAttribute('width', width);
    rect.setAttribute('height', 6);
    svg.append(rect);
  }
  return svg;
}
