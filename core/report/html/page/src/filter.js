// Which scenes and runs are shown.
import { make, make_select } from './dom.js';

const kVerdicts = [['within', '✓'], ['deviates', '✗'], ['undecided', '?'], ['failed', '⚠'],
                   ['not-judged', '–']];
const kFields = [['engine', 'Engine'], ['precision', 'Precision'], ['profile', 'Profile'], ['rate', 'Rate']];

/** A filter lets everything pass that it says nothing about. */
export function empty_filter() {
  return { name: '', engine: '', precision: '', profile: '', rate: '', verdicts: null };
}

export function run_passes(filter, run) {
  if (filter.verdicts && !filter.verdicts.has(run.verdict)) return false;
  return kFields.every(([field]) => !filter[field] || String(run[field]) === filter[field]);
}

/** Every word of the search box must be in the name. */
export function name_passes(filter, name) {
  const lower = name.toLowerCase();
  return filter.name.toLowerCase().split(/\s+/).every((word) => lower.includes(word));
}

/** A scene without any run passes unless the filter asks something of runs. */
export function scene_passes(filter, scene) {
  if (!name_passes(filter, scene.name)) return false;
  if (scene.runs.length) return scene.runs.some((run) => run_passes(filter, run));
  return !filter.verdicts && kFields.every(([field]) => !filter[field]);
}

/** Fills the toolbar; `changed(filter)` is called when the reader has chosen. */
export function make_filter_form(scenes, changed) {
  const filter = empty_filter();
  const runs = scenes.flatMap((scene) => scene.runs);
  const count = make('output', { class: 'count', 'aria-live': 'polite' });
  const form = make('form', { class: 'filters', role: 'search', 'aria-label': 'Filter scenes and runs',
    onsubmit: (event) => event.preventDefault() });
  const search = make('input', { type: 'search', placeholder: 'name of a scene', oninput: read,
    autocomplete: 'off', spellcheck: 'false' });
  form.append(make('label', {}, 'Scene ', search));

  const selects = {};
  for (const [field, text] of kFields) {
    const values = [...new Set(runs.map((run) => run[field]))]
      .filter((value) => value !== undefined && value !== null && value !== '')
      .sort((a, b) => (field === 'rate' ? a - b : String(a).localeCompare(b)));
    if (values.length < 2) continue;
    const { label, select } = make_select(text, [['', 'all'],
      ...values.map((value) => [value, field === 'rate' ? `${value} Hz` : value])], read);
    selects[field] = select;
    form.append(label);
  }

  const present = kVerdicts.filter(([verdict]) => runs.some((run) => run.verdict === verdict));
  const boxes = present.map(([verdict]) => make('input', { type: 'checkbox', value: verdict,
    checked: true, onchange: read }));
  if (boxes.length > 1) {
    form.append(make('fieldset', {}, make('legend', {}, 'Verdict of a run'),
      ...boxes.map((box, k) => make('label', {}, box, ` ${present[k][1]} ${box.value}`))));
  }
  form.append(make('button', { type: 'button', class: 'show-all', onclick: () => { form.reset(); read(); } }, 'Show all'), count);

  function read() {
    filter.name = search.value;
    for (const [field, select] of Object.entries(selects)) filter[field] = select.value;
    const chosen = boxes.filter((box) => box.checked).map((box) => box.value);
    filter.verdicts = chosen.length === boxes.length ? null : new Set(chosen);
    changed(filter);
  }
  return { form, filter, tell: (text) => { count.textContent = text; } };
}

/** Hides what does not pass; returns how many scenes are left. */
export function apply_filter(filter, scenes) {
  const passing = scenes.map((scene) => scene_passes(filter, scene));
  for (const element of document.querySelectorAll('.scene[data-scene]')) {
    element.classList.toggle('filtered', !passing[Number(element.dataset.scene)]);
  }
  for (const element of document.querySelectorAll('.run[data-run]')) {
    const scene = scenes[Number(element.closest('[data-scene]').dataset.scene)];
    const run = scene?.runs[Number(element.dataset.run)];
    element.classList.toggle('filtered', Boolean(run) && !run_passes(filter, run));
  }
  return passing.filter(Boolean).length;
}
