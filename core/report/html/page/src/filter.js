// Which scenes and runs are looked at.
import { make, make_select } from './dom.js';
import { kSymbols, scene_verdict } from './summary.js';

export const kRunFields = [['engine', 'Engine'], ['version', 'Version'], ['profile', 'Profile'], ['rate', 'Rate'], ['precision', 'Precision']];
const kVerdicts = ['within', 'deviates', 'undecided', 'failed', 'not-judged'];

/** A filter lets everything pass that it says nothing about; verdicts: null for all, else a set. */
export function empty_filter() {
  return { name: '', topic: '', engine: '', version: '', profile: '', rate: '', precision: '', verdicts: null };
}

export function run_passes(filter, run) {
  return kRunFields.every(([field]) => !filter[field] || String(run[field]) === filter[field]);
}

/** Every word of the search box must be in the name. */
export function name_passes(filter, name) {
  const lower = name.toLowerCase();
  return filter.name.toLowerCase().split(/\s+/).every((word) => lower.includes(word));
}

/**
 * {scene, runs} with the runs that are looked at; null where the scene is not. Its verdict is that of these runs.
 * A scene without any run passes unless the filter asks something of runs.
 */
export function looked_at(filter, scene) {
  if (!name_passes(filter, scene.name) || (filter.topic && scene.topic !== filter.topic)) return null;
  const runs = scene.runs.filter((run) => run_passes(filter, run));
  if (!runs.length && (scene.runs.length || kRunFields.some(([field]) => filter[field]))) return null;
  if (filter.verdicts && !filter.verdicts.has(scene_verdict(scene, runs))) return null;
  return { scene, runs };
}

/** The values of a field over runs, numbers by size. */
function values_of(runs, field) {
  return [...new Set(runs.map((run) => run[field]))].filter((value) => value !== undefined && value !== null && value !== '')
    .sort((a, b) => (field === 'rate' ? a - b : String(a).localeCompare(b, 'en', { numeric: true })));
}

/** Fills the toolbar; `changed(filter)` is called when the reader has chosen. */
export function make_filter_form(scenes, changed) {
  const filter = empty_filter();
  const runs = scenes.flatMap((scene) => scene.runs);
  const count = make('output', { class: 'count', 'aria-live': 'polite' });
  const form = make('form', { class: 'filters', role: 'search', 'aria-label': 'Filter scenes and runs',
    onsubmit: (event) => event.preventDefault() });
  const search = make('input', { type: 'search', placeholder: 'name of a scene', oninput: read, autocomplete: 'off', spellcheck: 'false' });
  form.append(make('label', {}, 'Scene ', search));

  const selects = {};
  const add = (field, text, values) => {
    if (values.length < 2) return;
    const { label, select } = make_select(text, [['', 'all'], ...values.map((value) => [value, field === 'rate' ? `${value} Hz` : value])], read);
    selects[field] = select;
    select.name = field;
    form.append(label);
  };
  add('topic', 'Topic', [...new Set(scenes.map(({ topic }) => topic))]);
  for (const [field, text] of kRunFields) add(field, text, values_of(runs, field));

  const present = kVerdicts.filter((verdict) => scenes.some((scene) => scene_verdict(scene, scene.runs) === verdict));
  const boxes = present.map((verdict) => make('input', { type: 'checkbox', value: verdict, checked: true, onchange: read }));
  if (boxes.length > 1) {
    form.append(make('fieldset', {}, make('legend', {}, 'Verdict'),
      ...boxes.map((box) => make('label', {}, box, ` ${kSymbols[box.value]} ${box.value.replace('-', ' ')}`))));
  }
  form.append(make('button', { type: 'button', class: 'show-all', onclick: () => set(empty_filter()) }, 'Show all'), count);

  function read() {
    filter.name = search.value;
    for (const [field, select] of Object.entries(selects)) filter[field] = select.value;
    const chosen = boxes.filter((box) => box.checked).map((box) => box.value);
    filter.verdicts = chosen.length === boxes.length ? null : new Set(chosen);
    changed(filter);
  }
  /** Takes what is written in an address; what the page does not have is as if it were not there. */
  function set(wanted) {
    search.value = wanted.name;
    for (const [field, select] of Object.entries(selects)) {
      select.value = [...select.options].some(({ value }) => value === wanted[field]) ? wanted[field] : '';
    }
    for (const box of boxes) box.checked = !wanted.verdicts || wanted.verdicts.has(box.value);
    read();
  }
  return { form, filter, set, tell: (text) => { count.textContent = text; } };
}

/** Hides what does not pass; `shown` are those of looked_at() that do. */
export function apply_filter(filter, scenes, shown) {
  const passing = new Set(shown.map(({ scene }) => scene));
  for (const element of document.querySelectorAll('.scene[data-scene]')) {
    element.classList.toggle('filtered', !passing.has(scenes[Number(element.dataset.scene)]));
  }
  hide_runs(filter, scenes, document);
  for (const part of document.querySelectorAll('section.topic, .matrix tbody')) {
    part.classList.toggle('filtered', !part.querySelector('.scene[data-scene]:not(.filtered)'));
  }
}

/** The runs of scenes that are open. */
export function hide_runs(filter, scenes, parent) {
  for (const element of parent.querySelectorAll('.run[data-run]')) {
    const scene = scenes[Number(element.closest('section.scene').dataset.scene)];
    const run = scene?.runs[Number(element.dataset.run)];
    element.classList.toggle('filtered', Boolean(run) && !run_passes(filter, run));
  }
}
