// Scenes by engines: columns and verdicts follow the filter; a click on a cell opens the scene.
import { run_passes } from './filter.js';
import { kSymbols, rank, scene_verdict, verdict_name } from './summary.js';

/** Columns, verdicts and shares of the matrix, and the verdicts of the sections, for what is looked at. */
export function tell_index(filter, scenes, methods, shown) {
  for (const cell of document.querySelectorAll('.matrix [data-method]')) {
    cell.classList.toggle('filtered', !run_passes(filter, methods[Number(cell.dataset.method)]));
  }
  const runs_of = new Map(shown.map(({ scene, runs }) => [scene, runs]));
  for (const element of document.querySelectorAll('.scene[data-scene]')) {
    const scene = scenes[Number(element.dataset.scene)], runs = runs_of.get(scene);
    if (!runs) continue;
    const verdict = scene_verdict(scene, runs);
    element.className = `scene ${verdict}${element.classList.contains('filtered') ? ' filtered' : ''}`;
    if (element.dataset.verdict) element.dataset.verdict = verdict;
    const label = element.querySelector('.verdict');
    label.className = `verdict ${verdict}`;
    label.textContent = `${kSymbols[verdict]} ${verdict_name(scene, runs)}`;
    if (!element.matches('tr')) continue;
    element.cells[1].dataset.value = rank(verdict);
    const within = runs.filter((run) => run.verdict === 'within').length;
    element.cells[2].textContent = runs.length ? `${within}/${runs.length}` : '';
    if (runs.length) element.cells[2].dataset.value = within / runs.length;
  }
  for (const topic of document.querySelectorAll('section.topic, .matrix tbody')) {
    const here = [...topic.querySelectorAll('.scene[data-scene]:not(.filtered)')].map((one) => scenes[Number(one.dataset.scene)]);
    const verdicts = here.map((scene) => scene_verdict(scene, runs_of.get(scene)));
    const judged = verdicts.filter((verdict) => verdict !== 'not-judged').length;
    const parts = [];
    if (judged) parts.push(`${verdicts.filter((verdict) => verdict === 'within').length} of ${judged} within`);
    if (judged < here.length) parts.push(`${here.length - judged} not judged`);
    const told = topic.querySelector('h2 .faint, tr.topic .faint');
    if (told) told.textContent = parts.join(', ');
  }
}

/** Cells of the matrix open their scene. */
export function listen_to_index(open) {
  const matrix = document.querySelector('.matrix');
  matrix?.addEventListener('click', (event) => {
    const row = event.target.closest('td')?.closest('tr[data-scene]');
    if (row) open(Number(row.dataset.scene));
  });
  if (matrix) matrix.classList.add('opens');
}
