// Those parts of the page's script that need no browser: node --test parts_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { count_of, read_data, values_of } from '../../core/report/html/page/src/data.js';
import { escaped, number_text, prefixed, quantity_text } from '../../core/report/html/page/src/dom.js';
import { read_address, write_address } from '../../core/report/html/page/src/address.js';
import { empty_filter, looked_at, name_passes, run_passes } from '../../core/report/html/page/src/filter.js';
import { first_lines } from '../../core/report/html/page/src/lines.js';
import { between, between_periodic, end_of, frame_at, orientations, turned } from '../../core/report/html/page/src/motion.js';
import { shown, tell, unpacked } from '../../core/report/html/page/src/panels.js';
import { sorted_order } from '../../core/report/html/page/src/sort.js';
import { scene_verdict, summarize, told_counts, verdict_name } from '../../core/report/html/page/src/summary.js';

const close = (a, b, tolerance = 1e-12) => assert(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);

test('a channel is a running sum; null holds no value but the sum goes on', () => {
  assert.deepEqual(values_of({ o: 10, s: 0.5, q: [2, 4, null, -6] }, 4), [11, 13, NaN, 10]);
  assert.deepEqual(values_of(3, 2), [3, 3]);
  assert.deepEqual(values_of(null, 2), [NaN, NaN]);
  assert.equal(count_of({ o: 0, s: 1, q: [1, 1, 1] }), 3);
  assert.equal(count_of(5, 7), 7);
});

test('data come deflated, in base64', async () => {
  const textContent = `\n${deflateSync('{"name": "Kügelchen"}').toString('base64')}\n`;
  assert.deepEqual(await read_data({ textContent }), { name: 'Kügelchen' });
  assert.equal(await read_data(null), null);
});

test('rows are ordered by their values; cells without value or words stay last', () => {
  const cells = [{ text: '1 ms', value: '0.001' }, { text: '–' }, { text: '20 µs', value: '2e-05' }, { text: 'none' },
    { text: '3 ns', value: '3e-09' }, { text: '' }];
  assert.deepEqual(sorted_order(cells, false), [4, 2, 0, 3, 1, 5]);
  assert.deepEqual(sorted_order(cells, true), [0, 2, 4, 3, 1, 5]);
  const words = (...texts) => texts.map((text) => ({ text }));
  assert.deepEqual(sorted_order(words('b10', 'b9', 'a'), false), [2, 1, 0]);
  assert.deepEqual(sorted_order(words('same', 'same'), true), [0, 1]);
});

test('numbers as people write them', () => {
  assert.equal(number_text(0.357142857), '0.3571');
  assert.equal(number_text(-12), '−12');
  assert.equal(number_text(0), '0');
  assert.equal(number_text(2.05e-4, 3), '2.05·10⁻⁴');
  assert.equal(number_text(1e-10), '10⁻¹⁰');
  assert.equal(number_text(NaN), '–');
  assert.equal(quantity_text(2.5, 'mm'), '2.5 mm');
  assert.deepEqual(prefixed('m/s', 0.3), { factor: 1e-3, unit: 'mm/s' });
  assert.deepEqual(prefixed('s', 2), { factor: 1, unit: 's' });
  assert.deepEqual(prefixed('J', 0), { factor: 1, unit: 'J' });
  assert.equal(escaped('<b a="1">&\''), '&lt;b a=&quot;1&quot;&gt;&amp;&#39;');
});

const run_of = (profile, rate, verdict, more = {}) => ({ label: `bullet double ${profile} ${rate} Hz`, engine: 'bullet', version: '3.24', precision: 'double',
  profile, rate, verdict, naive: profile === 'naive', expected: false, skipped: false, error: null, ...more });

test('the filter', () => {
  const run = run_of('tuned', 240, 'within');
  const filter = empty_filter();
  assert(run_passes(filter, run));
  assert(run_passes({ ...filter, rate: '240' }, run));
  assert(!run_passes({ ...filter, rate: '24' }, run));
  assert(name_passes({ ...filter, name: ' 30CMS sym' }, 'symmetric-30cms'));
  assert(!name_passes({ ...filter, name: 'sym box' }, 'symmetric-30cms'));
  const alone = { name: 'alone', topic: 'Slopes', reached: true, runs: [] };
  assert(looked_at(filter, alone));
  assert.equal(looked_at({ ...filter, engine: 'bullet' }, alone), null);
  assert.equal(looked_at({ ...filter, topic: 'Collisions' }, alone), null);
  const scene = { name: 'one', topic: 'Collisions', reached: true, runs: [run, run_of('default', 240, 'deviates')] };
  assert.deepEqual(looked_at({ ...filter, profile: 'tuned' }, scene).runs, [run]);
  // The verdict is that of the runs which are looked at.
  assert(looked_at({ ...filter, profile: 'tuned', verdicts: new Set(['within']) }, scene));
  assert.equal(looked_at({ ...filter, verdicts: new Set(['within']) }, scene), null);
});

test('naive runs decide a scene only where there are no others', () => {
  const scene = { reached: true };
  const naive = run_of('naive', 240, 'deviates'), good = run_of('tuned', 240, 'within');
  assert.equal(scene_verdict(scene, [naive, good]), 'within');
  assert.equal(scene_verdict(scene, [naive]), 'deviates');
  assert.equal(scene_verdict({ reached: false }, [good]), 'undecided');
  assert.equal(scene_verdict({ reached: false }, [{ ...good, expected: true }]), 'within');
  assert.equal(verdict_name(scene, [{ ...good, expected: true }]), 'as expected');
  assert.equal(verdict_name(scene, []), 'reference alone');
});

test('counts, scores and the sentence of what is looked at', () => {
  const off = (severity) => ({ error: severity, worst: { text: `x off by up to ${severity} %, tolerance 1 %`, severity } });
  const scene = { name: 'one', reached: true, runs: [run_of('default', 240, 'deviates', off(5)), run_of('tuned', 240, 'within', { error: 0.5 }),
    run_of('naive', 240, 'deviates', off(500)), run_of('tuned', 1000, 'undecided', { skipped: true })] };
  const alone = { name: 'two', reached: true, runs: [] };
  const summary = summarize([scene, alone].map((one) => ({ scene: one, runs: one.runs })));
  assert.equal(summary.finding, 'tuned is within all tolerances in 1 of 1 run, default in 0 of 1; worst: one, x off by up to 5 %, tolerance 1 % ' +
    '(bullet double default 240 Hz).');
  assert.deepEqual(told_counts(summary).map(([, text]) => text), ['0 within', '1 deviates', '0 undecided', '0 failed', '1 of the reference alone']);
  assert.deepEqual(summary.scores.map(({ profile, share }) => [profile, share]), [['tuned', 1], ['default', 0], ['naive', 0]]);
  const tuned = summarize([{ scene, runs: [scene.runs[1]] }]);
  assert.equal(tuned.finding, 'tuned is within all tolerances in 1 of 1 run.');
  assert.equal(summarize([{ scene: alone, runs: [] }]).finding, 'nothing was judged');
  // Of many the best three and the last.
  const many = { name: 'many', reached: true, runs: ['a', 'b', 'c', 'd', 'e'].map((profile, k) => run_of(profile, 240, k < 3 ? 'within' : 'undecided', { error: k })) };
  assert.equal(summarize([{ scene: many, runs: many.runs }]).finding,
    'a is within all tolerances in 1 of 1 run, b in 1 of 1, c in 1 of 1, last of 5 e in 0 of 1.');
});

test('what is looked at stands in the address by name, and comes back', () => {
  const filter = { ...empty_filter(), profile: 'tuned', topic: 'Walls, belts & more', verdicts: new Set(['deviates', 'failed']) };
  const address = write_address(filter, 'symmetric-30cms');
  assert.equal(address, '#scene=symmetric-30cms&topic=Walls,+belts+%26+more&profile=tuned&verdict=deviates,failed');
  assert.deepEqual(read_address(address), { filter, scene: 'symmetric-30cms' });
  assert.equal(write_address(empty_filter(), ''), '');
  assert.equal(read_address('#scene-symmetric'), null);
  assert.deepEqual(read_address(''), { filter: empty_filter(), scene: '' });
  assert.equal(read_address('#verdict=none').filter.verdicts.has('within'), false);
});

test('a chart shows at most five runs at first, one of each profile before a second, naive ones only if asked for', () => {
  const all = [60, 240, 1000, 4000, 16000].map((rate) => run_of('default', rate, 'within'))
    .concat(run_of('naive', 240, 'deviates'), run_of('tuned', 240, 'within'), run_of('tuned', 1000, 'within'));
  const every = all.map((_, k) => k);
  assert.deepEqual(first_lines(all, every, empty_filter()), [0, 1, 2, 6, 7]);
  assert.deepEqual(first_lines(all, [5], empty_filter()), [5]);
  assert.deepEqual(first_lines(all, [0, 5], { ...empty_filter(), profile: 'naive' }), [0, 5]);
  assert.deepEqual(first_lines(all, [0, 5], empty_filter()), [0]);
});

test('frames and what is between them', () => {
  const times = [1, 2, 4];
  assert.deepEqual(frame_at(times, 0), [0, 0]);
  assert.deepEqual(frame_at(times, 3), [1, 0.5]);
  assert.deepEqual(frame_at(times, 2), [1, 0]);
  assert.deepEqual(frame_at(times, 9), [2, 0]);
  assert.deepEqual(frame_at([5], 9), [0, 0]);
  assert.equal(between([10, 20, 40], [1, 0.25]), 25);
  assert.equal(between([10, NaN], [0, 0.5]), 10);
  close(between_periodic([0.9, 0.1], [0, 0.5], 1), 1.0);
});

test('a run that goes on far beyond the reference is cut off', () => {
  const run = (number, end) => ({ run: number, time: [0, end] });
  assert.equal(end_of([run(-1, 10), run(0, 100)]), 14);
  assert.equal(end_of([run(-1, 10), run(0, 12)]), 12);
  assert.equal(end_of([run(0, 3), run(1, 100)]), 100);
});

test('a ball that rolls a quarter of its circumference along x has turned by 90° about y', () => {
  // Ω = v/R about +y carries the top towards +x: what was on top now points along x.
  const quarter = Math.PI / 2, count = 10;
  const time = Array.from({ length: count + 1 }, (_, k) => k / count);
  const q = orientations(time, [time.map(() => 0), time.map(() => quarter), time.map(() => 0)])[count];
  const s = Math.sin(quarter / 2), c = Math.cos(quarter / 2);
  [0, s, 0, c].forEach((part, k) => close(q[k], part));
});

test('turns about different axes are of the laboratory, the later one last', () => {
  // 90° about z, then 90° about x, as matrices on (1, 0, 0): to (0, 1, 0), to (0, 0, 1).
  const q = turned(turned([0, 0, 0, 1], [0, 0, Math.PI / 2]), [Math.PI / 2, 0, 0]);
  const [x, y, z, w] = q;
  const image = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)];
  [0, 0, 1].forEach((part, k) => close(image[k], part));
  assert.deepEqual(turned([0, 0, 0, 1], [0, 0, 0]), [0, 0, 0, 1]);
});

test('spin that grows evenly: the angle is half of Ω t', () => {
  const time = [0, 0.5, 1], w = time.map((t) => 3 * t);
  const [, , z, cosine] = orientations(time, [[0, 0, 0], [0, 0, 0], w])[2];
  close(2 * Math.atan2(z, cosine), 1.5);
});

const rows = () => ({ panels: [{
  x: { label: 'time [ms]' }, y: { names: ['a', 'b', 'c'], runs: [4, 5, 7] }, truth: { value: 2, tolerance: 0.5 },
  curves: [{ label: 'reference', x: [2, 2], y: [-0.5, 2.5] },
    { label: 'outside', x: [1, 2, 3], y: [-0.2, 1.1, 2.3], notes: ['phase 1', 'phase 2', 'phase 3'] }],
}] });

test('rows of runs that are not shown go, and the others move up', () => {
  const { panels: [{ y, curves: [reference, points] }] } = shown(rows(), (run) => run !== 5);
  assert.deepEqual(y.names, ['a', 'c']);
  assert.equal(y.high, 1.5);
  assert.deepEqual(reference.y, [-0.5, 1.5]);
  assert.deepEqual(points.x, [1, 3]);
  assert.deepEqual(points.notes, ['phase 1', 'phase 3']);
  points.y.forEach((value, k) => close(value, [-0.2, 1.3][k]));
  assert.deepEqual(shown(rows(), () => false).panels[0].curves[1].x, []);
});

test('a point says its run, its phase, its value and its error, escaped', () => {
  const { panels: [panel] } = rows();
  assert.equal(tell(panel, panel.curves[1], 2), '<b>c</b><br>phase 3<br>time [ms]: <b>3</b><br>error 1, 2 tolerances');
  const curve = { label: '<b>', x: [1], y: [1], notes: ['1 Hz\n<i>'] };
  assert.equal(tell({ x: {}, y: {} }, curve, 0), '<b>&lt;b&gt;</b><br>1 Hz<br>&lt;i&gt;');
});

test('curves come as lists or as channels', () => {
  const [curve] = unpacked({ panels: [{ curves: [{ x: { o: 0, s: 1, q: [1, 1, null] }, y: 4 }] }] }).panels[0].curves;
  assert.deepEqual(curve.x, [1, 2, NaN]);
  assert.deepEqual(curve.y, [4, 4, 4]);
  const [plain] = unpacked({ panels: [{ curves: [{ x: [1, 2], y: [3, null] }] }] }).panels[0].curves;
  assert.deepEqual([plain.x, plain.y], [[1, 2], [3, null]]);
});

test('an axis follows points that all lie beyond it', () => {
  const chart = rows();
  chart.panels[0].x = { label: 'time', low: 10, high: 20 };
  const [panel] = shown(chart, () => true).panels;
  assert(panel.x.low < 1 && panel.x.high > 3 && panel.x.high < 10);
  chart.panels[0].x = { label: 'time', low: 0, high: 20 };
  assert.equal(shown(chart, () => true).panels[0].x.high, 20);
});
