// A page with made-up results, as the program would write it: for work on the script without a
// build, and for tests of it.
//   node fixture.mjs page.js OUT.html [page.css]
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { deflateSync } from 'node:zlib';
import { pathToFileURL } from 'node:url';

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

const runs = [
  ['default', 'double', 240, 'deviates'], ['default', 'single', 240, 'deviates'],
  ['tuned', 'double', 240, 'within'], ['tuned', 'double', 1000, 'undecided'],
].map(([profile, precision, rate, verdict]) => ({ label: `bullet ${precision} ${profile} ${rate} Hz`, engine: 'bullet',
  precision, profile, rate, verdict }));

function pair_scene() {
  const phases = (observable, unit, factor, reference, tolerance, spread) => ({ observable, unit, factor, reference,
    uncertainty: 1e-12, low: reference - tolerance, high: reference + tolerance,
    caption: 'bullet double default 240 Hz: 27 of 32 phases outside the tolerance.',
    values: runs.map((run, r) => (observable.startsWith('j') && r === 1 ? null
      : series_of(32, (k) => (r === 0 && k === 7 ? null
        : reference + (run.profile === 'tuned' ? 0.3 * tolerance * noise(k + r) : spread * (0.5 + 0.5 * noise(k + r))))))) });
  return {
    id: 'scene-1', name: 'symmetric-30cms', runs,
    phases: [phases('i-j.effective_restitution', '', 1, 0.357143, 0.01, 0.13),
      phases('i.sliding_time', 'ms', 1e-3, 0.0277, 0.0003, 0.002), phases('j.sliding_distance', 'mm', 1e-3, 0.004, 0.00004, 0.0006)],
    series: [],
    motion: { bodies: [{ name: 'i', radius: 0.002 }, { name: 'j', radius: 0.002 }], tilt: 0, substrate: true, periodic: null, gravity: 9.81,
      runs: [pair_motion(-1, 'reference', 0, 1),
        ...[0, 1, 2, 3].flatMap((run) => ['nearest', 'median', 'worst'].map((role, n) => pair_motion(run, role,
          0.0007 * (n + 1), run > 1 ? 1 + 0.01 * n : 1.02 + 0.14 * n)))] },
  };
}

function box_scene() {
  const time = series_of(400, (k) => 0.02 * k);
  const series = (title, unit, factor, mean, amplitude) => ({ title, unit, factor, time: channel(time),
    values: channel(time.map((t, k) => mean * (1 - Math.exp(-t)) + amplitude * noise(k))), mean, uncertainty: 0.1 * amplitude, averaged_from: 150 });
  return { id: 'scene-2', name: 'box-rough', runs: [runs[0], { ...runs[2], verdict: 'failed' }], phases: [],
    series: [series('H, height of the centre of mass', 'mm', 1e-3, 0.012, 0.002), series('K, kinetic energy', 'µJ', 1e-6, 3e-6, 8e-7)], motion: null };
}

function slope_scene() {
  return { id: 'scene-3', name: 'slope-rolls <&>', runs: runs.slice(2), phases: [], series: [],
    motion: { bodies: [{ name: 'ball', radius: 0.01 }], tilt: 5, substrate: true, periodic: null, gravity: 9.81,
      runs: [slope_motion(-1, 'reference', 1), slope_motion(0, 'median', 0.99), slope_motion(1, 'median', 1.002)] } };
}

function precision_scene() {
  const rates = [120, 240, 480, 960, 1920, 3840, 7680];
  const engine = (profile, precision, cost, error, order) => ({ label: `bullet ${precision} ${profile}`, kind: 'engine', engine: 'bullet',
    precision, profile, knob: 'rate', points: rates.map((rate, k) => ({ setting: `${rate} Hz, 10 iterations`, cost: cost * rate, spread: 0.02,
      errors: [error * (240 / rate) ** order * (1 + 0.4 * noise(k)), k === 2 ? null : 2 * error], front: [profile === 'tuned' && k > 2, false] })) });
  return { id: 'precision-1', name: 'symmetric-30cms',
    quantities: [{ name: 'i-j.effective_restitution', label: 'worst error of e_eff' }, { name: 'i.sliding_time', label: 'worst error of i.sliding_time [s]' }],
    curves: [engine('default', 'double', 4e-6, 0.14, 0), engine('default', 'single', 3.4e-6, 0.14, 0), engine('tuned', 'double', 5e-6, 1e-4, 1),
      { label: 'contacts in time', kind: 'contact', engine: '', precision: 'double', profile: '', knob: 'tolerance',
        points: series_of(6, (k) => ({ setting: `relative tolerance 1e-${2 * k + 2}`, cost: 2e-3 * (1 + k), spread: 0.05, errors: [10 ** (-2 * k - 2), 10 ** (-2 * k - 3)], front: [true, true] })) },
      { label: 'event-driven', kind: 'event', engine: '', precision: 'double', profile: '', knob: '',
        points: [{ setting: 'exact', cost: 1e-5, spread: 0.1, errors: [0, 0], front: [true, true] }] }] };
}

function stability() {
  const names = ['accurate', 'degraded', 'drifting', 'energy growing', 'tunnelled', 'exploded', 'NaN', 'timed out', 'crashed', 'refused'];
  const letters = ['A', 'd', '~', 'E', 'T', 'X', 'N', 'H', 'C', '–'];
  const fills = ['#0072b2', '#a9d6f0', '#f0e442', '#e69f00', '#cc79a7', '#d55e00', '#1b1b1b', '#6b5b4b', '#5c2a6b', '#e4e4e0'];
  const speeds = series_of(14, (k) => 10 ** (-2 + k / 3)), restitutions = series_of(9, (k) => 0.1 + 0.1 * k);
  const cells = restitutions.flatMap((e, r) => speeds.map((v, c) => (c > 11 ? 4 : c > 9 ? 3 : c + r > 12 ? 1 : 0)));
  return { outcomes: names.map((name, k) => ({ name, letter: letters[k], usable: k < 2, fill: fills[k], ink: 'AENHC'.includes(letters[k]) ? '#ffffff' : '#1b1b1b' })),
    maps: [{ id: 'map-1', title: 'Speed and restitution, bullet double default', x: { label: 'speed [m/s]', logarithmic: true, values: speeds },
      y: { label: 'restitution [-]', logarithmic: false, values: restitutions }, cells, errors: cells.map((cell, k) => (cell > 3 ? null : 1e-3 * k)),
      error_label: '|e − e_ref|', theory: [[3, 0.05], [5, 0.4], [9, 0.95]], theory_name: 'one radius a step' }],
    limits: [{ id: 'limits-1', title: 'largest stable step', unit: 's', works: 'below', rows: [
      { label: 'bullet double tuned, symmetric-30cms', good: 0.01, bad: 0.0101, low: 1e-5, high: 1, beyond: 3, theory: null },
      { label: 'semi-implicit Euler, steel-pair', good: 2e-4, bad: 2.1e-4, low: 1e-5, high: 1, beyond: 5, theory: 2.2e-4 },
      { label: 'bullet single default, spinning', good: null, bad: 1e-5, low: 1e-5, high: 1, beyond: 4, theory: null },
      { label: 'velocity Verlet, spring', good: 1, bad: null, low: 1e-5, high: 1, beyond: null, theory: 0.3 }] }] };
}

export function fixture_data() {
  return { schema: 'slipcheck-page/1', scenes: [pair_scene(), box_scene(), slope_scene(),
    { id: 'scene-4', name: 'reference-only', runs: [], phases: [], series: [], motion: null }],
  precision: [precision_scene()], stability: stability() };
}

const escaped = (text) => text.replace(/[&<>]/g, (letter) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[letter]);
const verdict_of = ({ runs: all }) => ['failed', 'deviates', 'undecided'].find((one) => all.some(({ verdict }) => verdict === one)) ?? 'within';

function scene_html(scene, k) {
  const verdict = verdict_of(scene);
  const run_html = (run, r) => `<section class="run" data-run="${r}" data-engine="${run.engine}" data-precision="${run.precision}" data-profile="${run.profile}" data-rate="${run.rate}" data-verdict="${run.verdict}">
<h4>${run.label} <span class="${run.verdict === 'within' ? 'good' : 'bad'}">${run.verdict}</span></h4>
<div class="table" tabindex="0"><table><thead><tr><th>observable</th><th>reference</th><th>median</th></tr></thead>
<tbody><tr><th>i.sliding_time</th><td data-value="0.0277">27.7 ms</td><td data-value="9.3e-06">9.3 µs</td></tr><tr><th>j.sliding_time</th><td data-value="2.1">2.1 s</td><td data-value="0.028">28 ms</td></tr>
<tr><th>i-j.effective_restitution</th><td data-value="0.357">0.357</td><td>–</td></tr></tbody></table></div></section>`;
  return `<section class="scene ${verdict}" id="${scene.id}" data-scene="${k}" data-name="${escaped(scene.name)}" data-verdict="${verdict}">
<h2>${escaped(scene.name)} <span class="verdict ${verdict}">${verdict}</span></h2><p>What happens here.</p>
<div class="plots" data-scene="${k}"></div>${scene.runs.map(run_html).join('\n')}</section>`;
}

/** The whole page. */
export function fixture_page(script, css) {
  const data = fixture_data();
  const hash = createHash('sha256').update(script).digest('base64');
  const choices = ['all', 'deviates', 'undecided', 'failed', 'within'].map((choice) => `<span><input type="radio" name="show" id="show-${choice}"${choice === 'all' ? ' checked' : ''}><label for="show-${choice}">${choice}</label></span>`);
  return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-${hash}'; img-src data: blob:">
<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark">
<title>Slipcheck report</title><style>${css}</style></head><body>
<header><h1>Slipcheck</h1><div id="toolbar" class="toolbar"></div></header><main><h2>Scenes</h2>
<fieldset class="filter"><legend>Show scenes</legend>${choices.join('')}</fieldset>
<nav aria-label="Scenes"><ul class="contents">${data.scenes.map((scene, k) => `<li class="scene ${verdict_of(scene)}" data-scene="${k}"><span class="verdict ${verdict_of(scene)}">${verdict_of(scene)}</span> <a href="#${scene.id}">${escaped(scene.name)}</a></li>`).join('')}</ul></nav>
${data.scenes.map(scene_html).join('\n')}
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
