// Those parts of the page's script that need no browser: node --test parts_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { count_of, read_data, values_of } from '../../core/report/html/page/src/data.js';
import { escaped, number_text, prefixed, quantity_text } from '../../core/report/html/page/src/dom.js';
import { empty_filter, name_passes, run_passes, scene_passes } from '../../core/report/html/page/src/filter.js';
import { between, between_periodic, end_of, frame_at, orientations, turned } from '../../core/report/html/page/src/motion.js';
import { shown, tell, unpacked } from '../../core/report/html/page/src/panels.js';
import { sorted_order } from '../../core/report/html/page/src/sort.js';

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

test('the filter', () => {
  const run = { engine: 'bullet', precision: 'double', profile: 'tuned', rate: 240, verdict: 'within' };
  const filter = empty_filter();
  assert(run_passes(filter, run));
  assert(run_passes({ ...filter, rate: '240' }, run));
  assert(!run_passes({ ...filter, rate: '24' }, run));
  assert(!run_passes({ ...filter, verdicts: new Set(['failed']) }, run));
  assert(name_passes({ ...filter, name: ' 30CMS sym' }, 'symmetric-30cms'));
  assert(!name_passes({ ...filter, name: 'sym box' }, 'symmetric-30cms'));
  assert(scene_passes(filter, { name: 'alone', runs: [] }));
  assert(!scene_passes({ ...filter, engine: 'bullet' }, { name: 'alone', runs: [] }));
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
