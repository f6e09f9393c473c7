// A page with made-up results, as the program would write it: for work on the script without a
// build, and for tests of it.
//   node fixture.mjs page.js OUT.html [page.css]
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { deflateSync } from 'node:zlib';
import { pathToFileURL } from 'node:url';
import { kSymbols, scene_verdict, summarize, verdict_name } from '../../core/report/html/page/src/summary.js';

const kSteps = 4000;  // of a channel's range

/** A channel as the page's data hold it; null for NaN. */
export function channel(values) {
  const known = values.filter(Number.isFinite);
  const low = Math.min(...known), range = Math.max(...known) - low;
  if (!known.length || !(range > 0)) return known.length === values.length && known.length ? low : { o: 0, s: 1, q: values.map(() => null) };
  const scale = range / kSteps;
  let sum = 0;
  return { o: low, s: scale, q: values.map((value) => {
    if (!Number.isFinite(value)) return null;
    const step = Math.round((value - low) / scale) - sum;
    sum += step;
    return step;
  }) };
}

const series_of = (count, value) => Array.from({ length: count }, (_, k) => value(k));
const noise = (k) => 0.5 * Math.sin(12.9898 * k) + 0.5 * Math.sin(78.233 * k + 1);

// Two balls that roll at each other, part, slide and roll; late by `late` [s], faster by `gain`.
function pair_motion(run, role, late, gain) {
  const R = 0.002, v = 0.3, meet = 0.02 + late, after = 0.357 * v * gain, end = 0.1, count = 64;
  const time = series_of(count, (k) => (end * k) / (count - 1));
  const start = 2 * R * 0.5 + v * meet;
  const slide = 0.02;
  const speed = (t) => (t < meet ? v : after * Math.max(0.72, 1 - (0.28 * (t - meet)) / slide));
  const spin = (t) => (t < meet ? v / R : (v / R) * Math.max(-0.72 * after / v, 1 - ((1 + (0.72 * after) / v) * (t - meet)) / slide));
  const way = (t) => {
    let x = -start;
    for (let n = 0; n < 200; ++n) {
      const at = (t * (n + 0.5)) / 200;
      x += (t / 200) * (at < meet ? v : -speed(at));
    }
    return x;
  };
  const body = (sign) => ({
    p: [channel(time.map((t) => sign * way(t))), 0, R],
    w: [0, channel(time.map((t) => sign * spin(t))), 0],
    speed: channel(time.map(speed)),
    slip: [channel(time.map((t) => sign * ((t < meet ? v : -speed(t)) - R * spin(t)))), 0],
  });
  return { run, role, phase: role === 'worst' ? 5 : 2, error: run < 0 ? null : { nearest: 0.4, median: 3.1, worst: 14 }[role],
    time: channel(time), substrate: [0, 0], bodies: [body(1), body(-1)],
    energy: channel(time.map((t) => 2.6e-4 * 0.7 * (speed(t) ** 2 + 0.4 * (R * spin(t)) ** 2))),
    touches: [[time.findIndex((t) => t >= meet), 0, 1]] };
}

// A ball that rolls down a slope.
function slope_motion(run, role, factor) {
  const count = 40, a = (5 / 7) * 9.81 * Math.sin((5 * Math.PI) / 180) * factor, R = 0.01;
  const time = series_of(count, (k) => k / (count - 1));
  return { run, role, phase: 0, error: run < 0 ? null : 0.2, time: channel(time), substrate: [0, 0],
    bodies: [{ p: [0, channel(time.map((t) => -0.5 * a * t * t)), R], w: [channel(time.map((t) => (a * t) / R)), 0, 0],
      speed: channel(time.map((t) => a * t)), slip: [0, 0] }],
    energy: channel(time.map((t) => 0.7 * 0.03 * (a * t) ** 2)), touches: [] };
}

// [profile, precision, rate, verdict, the worst phase's error in tolerances]
const runs = [
  ['default', 'double', 240, 'deviates', 14], ['default', 'single', 240, 'deviates', 12.5], ['default', 'double', 1000, 'deviates', 9],
  ['tuned', 'double', 240, 'within', 0.4], ['tuned', 'double', 1000, 'undecided', null], ['default', 'double', 4000, 'deviates', 8],
  ['naive', 'double', 240, 'deviates', 300],
].map(([profile, precision, rate, verdict, error]) => ({ label: `bullet ${precision} ${profile} ${rate} Hz`, engine: 'bullet', version: '3.24',
  precision, profile, rate, verdict, error, naive: profile === 'naive', expected: false, skipped: false,
  ...(verdict === 'deviates' && { worst: { text: `i.sliding_time off by up to ${error} %, tolerance 1 %`, severity: error } }),
  look: { ink: profile === 'tuned' ? 'vermilion' : 'blue', line: 'dashed', marker: rate > 240 ? 'square' : 'circle' } }));
const methods = runs.map(({ engine, version, precision, profile, rate }) => ({ engine, version, precision, profile, rate }));

const axis = (label, low, high, log = false) => ({ label, low, high, log });
const panel_of = (x, y, more) => ({ title: '', x, y, curves: [], bands: [], looks: [], cells: [], ...more });
const curve_of = (label, ink, line, marker, x, y, more) => ({ label, look: { ink, line, marker }, halo: false, edge: false, x, y, ...more });

// Each phase of each run in its row, and one that is far beyond the axis.
function phases_chart(observable, reference, tolerance, spread) {
  const rows = runs.map((_, k) => k).filter((r) => !(observable.startsWith('j') && r === 1));
  const inside = curve_of('within the tolerance', 'blue', null, 'circle', [], [], { notes: [] });
  const outside = curve_of('outside', 'vermilion', null, 'diamond', [], [], { notes: [] });
  const beyond = curve_of('beyond the axis', 'vermilion', null, 'triangle', [1e6], [0.2], { notes: ['phase 8 of 32'], edge: true });
  rows.forEach((r, row) => series_of(32, (k) => k).filter((k) => !(r === 0 && k === 7)).forEach((k) => {
    const value = reference + (runs[r].profile === 'tuned' ? 0.3 * tolerance * noise(k + r) : spread * (0.5 + 0.5 * noise(k + r)));
    const curve = Math.abs(value - reference) <= tolerance ? inside : outside;
    curve.x.push(value);
    curve.y.push(row + 0.7 * ((k + 0.5) / 32 - 0.5));
    curve.notes.push(`phase ${k + 1} of 32`);
  }));
  const y = { ...axis('', -0.5, rows.length - 0.5), names: rows.map((r) => runs[r].label), runs: rows };
  return { title: observable, caption: 'bullet double default 240 Hz: 27 of 32 phases outside the tolerance.', columns: 1, height: 100,
    panels: [panel_of(axis(observable, reference - 2 * tolerance, reference + 1.1 * spread), y, {
      bands: [{ label: 'tolerance', x: [reference - tolerance, reference + tolerance], y: [null, null] }],
      truth: { value: reference, tolerance },
      curves: [curve_of('reference', 'black', 'solid', null, [reference, reference], [-0.5, rows.length - 0.5]), inside, outside, beyond] })] };
}

function pair_scene() {
  return {
    id: 'scene-symmetric-30cms', name: 'symmetric-30cms', topic: 'Collisions', reached: true, runs,
    charts: [phases_chart('i-j.effective_restitution', 0.357143, 0.01, 0.13),
      phases_chart('i.sliding_time [ms]', 27.7, 0.3, 2), phases_chart('j.sliding_distance [mm]', 4, 0.04, 0.6)],
    motion: { bodies: [{ name: 'i', radius: 0.002 }, { name: 'j', radius: 0.002 }], tilt: 0, substrate: true, periodic: null, gravity: 9.81,
      runs: [pair_motion(-1, 'reference', 0, 1),
        ...runs.map((_, run) => run).flatMap((run) => ['nearest', 'median', 'worst'].map((role, n) => pair_motion(run, role,
          0.0007 * (n + 1), run > 1 ? 1 + 0.01 * n : 1.02 + 0.14 * n)))] },
  };
}

function box_scene() {
  const time = series_of(400, (k) => 0.02 * k);
  const strip = (label, mean, amplitude, time_label) => panel_of(axis(time_label, 0, 8), axis(label, 0, mean + 2 * amplitude), {
    title: label, bands: [{ label: 'its 95 % interval', x: [3, 8], y: [mean - 0.1 * amplitude, mean + 0.1 * amplitude] }],
    curves: [curve_of('averaged', 'blue', 'solid', null, channel(time), channel(time.map((t, k) => mean * (1 - Math.exp(-t)) + amplitude * noise(k)))),
      curve_of('mean', 'black', 'solid', null, [3, 8], [mean, mean])] });
  return { id: 'scene-box-rough', name: 'box-rough', topic: 'Many grains', reached: true, runs: [runs[0], { ...runs[3], verdict: 'failed', error: 'infinite' }], motion: null,
    charts: [{ title: 'box-rough over time', caption: 'mean 12 mm', columns: 1, height: 110,
      panels: [strip('H [mm]', 12, 2, ''), strip('K [µJ]', 3, 0.8, 'time [s]')] }] };
}

function slope_scene() {
  return { id: 'scene-slope-rolls', name: 'slope-rolls <&>', topic: 'Slopes', reached: true, runs: runs.slice(3, 5), charts: [],
    motion: { bodies: [{ name: 'ball', radius: 0.01 }], tilt: 5, substrate: true, periodic: null, gravity: 9.81,
      runs: [slope_motion(-1, 'reference', 1), slope_motion(0, 'median', 0.99), slope_motion(1, 'median', 1.002)] } };
}

function precision_scene() {
  const rates = [120, 240, 480, 960, 1920, 3840, 7680];
  const notes = rates.map((rate) => `${rate} Hz, 10 iterations\nCPU 0.001 s per simulated s ± 2 %\nworst error: 0.14`);
  const engine = (label, ink, line, cost, error, order) => curve_of(label, ink, line, 'circle', rates.map((rate) => cost * rate),
    rates.map((rate, k) => (k === 2 ? null : error * (240 / rate) ** order)), { notes, edge: true });
  const chart = (title) => ({ title, caption: 'Down and left is better.', columns: 2, height: 220, panels: ['CPU time [s]', 'step [s]'].map((label) =>
    panel_of(axis(label, 1e-5, 1, true), axis('worst error [-]', 1e-12, 1, true), { title, curves: [engine('default', 'blue', 'solid', 4e-6, 0.14, 0),
      engine('tuned', 'vermilion', 'dashed', 5e-6, 1e-4, 1), curve_of('nothing is cheaper and no worse', 'black', null, 'ring', [6e-4], [1e-4])] })) });
  return { id: 'precision-1', name: 'symmetric-30cms', charts: [chart('e_eff'), chart('i.sliding_time')] };
}

function stability() {
  const looks = [['accurate', 'A', '#0072b2', '#ffffff'], ['degraded', 'd', '#a9d6f0', '#1b1b1b'], ['tunnelled', 'T', '#cc79a7', '#1b1b1b'],
    ['works', '✓', '#0072b2', '#ffffff']].map(([label, letter, fill, ink]) => ({ label, letter, fill, ink }));
  const cells = series_of(9, (r) => series_of(14, (c) => ({ x: [10 ** (c / 3 - 2), 10 ** ((c + 1) / 3 - 2)], y: [r, r + 1],
    look: c > 11 ? 2 : c + r > 12 ? 1 : 0, note: 'speed [m/s]: 1\n|e − e_ref|: 0.1' }))).flat();
  const bars = [0.01, 2e-4].flatMap((border, row) => [[1e-5, border, 3], [border, 1, 2]].map(([low, high, look]) => ({
    x: [low, high], y: [row - 0.35, row + 0.35], look, note: `limit: ${border} s` })));
  const rows = { ...axis('', -0.5, 1.5), names: ['bullet double tuned: 10 ms', 'semi-implicit Euler: 0.2 ms'] };
  const theory = (x, y) => curve_of('theory', 'black', 'dashed', null, x, y, { halo: true });
  return { maps: [{ title: 'Speed and restitution', caption: 'How it comes out.', columns: 2, height: 250,
    panels: [panel_of(axis('speed [m/s]', 0.01, 10 ** (14 / 3 - 2), true), axis('restitution [-]', 0, 9), { looks, cells, curves: [theory([3, 5, 9], [1, 4, 9])] })] }],
    limits: [{ title: 'largest stable step', caption: 'Bars: where each method works.', columns: 1, height: 44,
      panels: [panel_of(axis('step [s]', 1e-5, 1, true), rows, { looks, cells: bars, curves: [theory([2.2e-4, 2.2e-4], [0.55, 1.45])] })] }] };
}

const palette = Object.fromEntries([['black', '#1b1b1b', '#e8e8e6'], ['blue', '#0072b2', '#56b4e9'], ['vermilion', '#d55e00', '#f08a3c']]
  .map(([ink, light, dark]) => [ink, [light, dark]]));

export function fixture_data() {
  const scenes = [pair_scene(), box_scene(), slope_scene(),
    { id: 'scene-reference-only', name: 'reference-only', topic: 'Slopes', reached: true, runs: [], charts: [], motion: null }];
  for (const scene of scenes) scene.html = scene.runs.map(run_html).join('\n');
  return { schema: 'slipcheck-page/3', palette, methods, scenes,
  precision: [precision_scene()], stability: stability() };
}

const escaped = (text) => text.replace(/[&<>]/g, (letter) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[letter]);
const run_html = (run, r) => `<section class="run" data-run="${r}" data-engine="${run.engine}" data-precision="${run.precision}" data-profile="${run.profile}" data-rate="${run.rate}" data-verdict="${run.verdict}">
<details${run.verdict === 'within' ? '' : ' open=""'}><summary><h5>${run.label} <span class="${run.verdict === 'within' ? 'good' : 'bad'}">${run.verdict}</span></h5></summary>
<div class="table" tabindex="0"><table><thead><tr><th scope="col">observable</th><th scope="col">reference</th><th scope="col">median</th></tr></thead>
<tbody><tr><th scope="row">i.sliding_time</th><td data-value="0.0277">27.7 ms</td><td data-value="9.3e-06">9.3 µs</td></tr><tr><th scope="row">j.sliding_time</th><td data-value="2.1">2.1 s</td><td data-value="0.028">28 ms</td></tr>
<tr><th scope="row">i-j.effective_restitution</th><td data-value="0.357">0.357</td><td>–</td></tr></tbody></table></div></details></section>`;

function label_html(scene) {
  const verdict = scene_verdict(scene, scene.runs);
  return `<span class="verdict ${verdict}">${kSymbols[verdict]} ${verdict_name(scene, scene.runs)}</span>`;
}

function scene_html(scene, k) {
  const verdict = scene_verdict(scene, scene.runs);
  return `<section class="scene ${verdict}" id="${scene.id}" data-scene="${k}" data-name="${escaped(scene.name)}" data-verdict="${verdict}">
<details><summary><h3>${escaped(scene.name)}</h3> ${label_html(scene)} <span class="title">A title</span> <span class="says">What was found.</span></summary>
<div class="plots" data-scene="${k}"></div><h4>Engine by engine</h4><div class="runs" data-runs="${k}"><noscript><table><tbody><tr><td>runs</td></tr></tbody></table></noscript></div></details></section>`;
}

const topics_of = (scenes) => [...new Set(scenes.map(({ topic }) => topic))].map((topic, n) => ({ topic, id: `topic-${n + 1}`,
  scenes: scenes.map((scene, k) => [scene, k]).filter(([scene]) => scene.topic === topic) }));

function index_html(scenes) {
  const cell = (scene, method, k) => {
    const run = scene.runs.find((one) => Object.keys(method).every((field) => one[field] === method[field]));
    const text = !run ? '' : run.error === 'infinite' ? '✗' : run.error === null ? '·' : `${run.error}`;
    return `<td data-method="${k}"${run ? ' class="m2"' : ''}${run && run.error !== null ? ` data-value="${run.error === 'infinite' ? 1e300 : run.error}"` : ''}>${text}</td>`;
  };
  const row = ([scene, k]) => {
    const within = scene.runs.filter(({ verdict }) => verdict === 'within').length;
    return `<tr class="scene ${scene_verdict(scene, scene.runs)}" data-scene="${k}"><th scope="row"><a href="#${scene.id}">${escaped(scene.name)}</a></th><td class="of-scene" data-value="1">${label_html(scene)}</td><td class="share">${scene.runs.length ? `${within}/${scene.runs.length}` : ''}</td>${methods.map((method, n) => cell(scene, method, n)).join('')}</tr>`;
  };
  return `<section id="index"><h2>Scenes by engines</h2><fieldset class="filter"><legend>Show scenes</legend>${['all', 'deviates', 'undecided', 'failed', 'within'].map((choice) => `<span><input type="radio" name="show" id="show-${choice}"${choice === 'all' ? ' checked' : ''}><label for="show-${choice}">${choice}</label></span>`).join('')}</fieldset>
<div class="table matrix" tabindex="0" role="region" aria-label="Scenes by engines"><table><caption>Errors</caption><thead><tr><th scope="col">scene</th><th scope="col">verdict</th><th scope="col">within</th>${methods.map((method, k) => `<th scope="col" data-method="${k}"><span>${method.engine} ${method.version} ${method.precision}</span> <span>${method.profile}</span> <span>${method.rate} Hz</span></th>`).join('')}</tr></thead>
${topics_of(scenes).map(({ topic, id, scenes: here }) => `<tbody><tr class="topic"><th scope="rowgroup" colspan="${3 + methods.length}"><a href="#${id}">${topic}</a> <span class="faint"></span></th></tr>${here.map(row).join('')}</tbody>`).join('')}</table></div></section>`;
}

const summary_html = (scenes) => {
  const summary = summarize(scenes.map((scene) => ({ scene, runs: scene.runs })));
  return `<p class="finding" id="finding">${escaped(summary.finding)}</p><p class="counts" id="counts"></p><ol class="scores" id="scores"></ol>`;
};

/** The whole page. */
export function fixture_page(script, css) {
  const data = fixture_data();
  const hash = createHash('sha256').update(script).digest('base64');
  return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-${hash}'; img-src data: blob:">
<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark">
<title>Slipcheck report</title><style>${css}</style></head><body>
<a class="skip" href="#scenes">Skip to the scenes</a><header><h1>Slipcheck</h1>${summary_html(data.scenes)}</header><main><div id="toolbar"></div>
${index_html(data.scenes)}<section id="worst"><h2>Worst deviations</h2><ol class="worst"></ol></section>
<div id="scenes" tabindex="-1">${topics_of(data.scenes).map(({ topic, id, scenes }) => `<section class="topic" id="${id}"><h2>${topic} <span class="faint"></span></h2>${scenes.map(([scene, k]) => scene_html(scene, k)).join('\n')}</section>`).join('\n')}</div>
<h2>Error against run time</h2><section class="precision" id="precision-1" data-precision="0"><h3>symmetric-30cms</h3><div class="plots" data-precision="0"></div></section>
<h2>Where it gets stiff</h2><div class="plots" data-map="0"></div><div class="plots" data-limits="0"></div></main>
<script type="application/octet-stream" id="slipcheck-data">${deflateSync(JSON.stringify(data)).toString('base64')}</script>
<script>${script}</script></body></html>
`;
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [script, out, css] = process.argv.slice(2);
  writeFileSync(out, fixture_page(readFileSync(script, 'utf8'), css ? readFileSync(css, 'utf8') : ''));
}
