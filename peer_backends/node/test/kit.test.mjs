// The protocol's bytes and rules, and the parts that all engines share. Needs an engine's folder for
// its cbor-x alone, but for what a whole worker answers.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Connection, decodeBody, frame } from '../kit/connection.mjs';
import { restitutionAt, rollingAt, rollingLength } from '../kit/contacts.mjs';
import { explainedImpulses } from '../kit/explained_impulses.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { substrateMotion } from '../kit/motion.mjs';
import { readScene } from '../kit/packing.mjs';
import { count, flag, number, refuseBadSettings, word } from '../kit/settings.mjs';
import { inertiaOf, turnFromY, turnFromZ, turnOf } from '../kit/solids.mjs';
import { besideSurfaces, farthest, planeEnds } from '../kit/surfaces.mjs';
import { exactText, rounded } from '../kit/text.mjs';
import { Units } from '../kit/units.mjs';
import { ball, codec, packed, replies, sceneOf } from './support.mjs';

const hex = (text) => Buffer.from(text.replace(/\s/g, ''), 'hex');
/// The request `step` for one step, as docs/engine-protocol.md has it.
const STEP = hex('12000000 a2 65 636f756e74 01 64 74797065 64 73746570');

const scene = () => sceneOf([ball(0.1), ball(0.1)],
  [[0, 0, 0.1, 0, 0, 0, 0, 0, 0], [1, 0, 0.1, 0, 0, 0, 0, 0, 0]], { friction: 0.2 });

test("the documented request's bytes are read and written", () => {
  assert.deepEqual(decodeBody(codec, STEP.subarray(4)), { count: 1, type: 'step' });
  assert.deepEqual(frame(codec, { count: 1, type: 'step' }), STEP);
});

test('bytes go over as a byte string without a tag, numbers as they are', () => {
  const bytes = frame(codec, { a: Buffer.from([1, 2]), b: 0.1, c: -3, d: [true, 'ä'] });
  assert.deepEqual(bytes.subarray(4), hex('a4 6161 42 0102 6162 fb3fb999999999999a 6163 22 6164 82 f5 62 c3a4'));
});

test('messages come in pieces and end in the middle', () => {
  const input = Buffer.concat([STEP, STEP, STEP.subarray(0, 9)]);
  let at = 0;
  const read = (bytes, offset, length) => {
    const n = Math.min(length, 3, input.length - at);
    input.copy(bytes, offset, at, at + n);
    at += n;
    return n;
  };
  const connection = new Connection(codec, undefined, read);
  assert.equal(connection.receive().type, 'step');
  assert.equal(connection.receive().type, 'step');
  assert.equal(connection.receive(), undefined);
});

test('what is no request ends the worker with a reason', () => {
  const nothing = frame(codec, { type: 'quit' });
  const faults = [
    [hex('05000000 ff00000000'), /not CBOR|must be a map/],
    [hex('ffffffff'), /a message of 4294967295 bytes, more than 67108864/],
    [frame(codec, [1]), /request must be a map/],
    [frame(codec, { type: 'nonsense' }), /request.type must be a type of message/],
    [frame(codec, { type: 'constructor' }), /request.type must be a type of message/],
    [frame(codec, { type: 'step', count: 0 }), /request.count must be from 1 to 67108864/],
    [frame(codec, { type: 'configure', scene: {}, settings: {}, time_step: 0 }), /request.time_step must be > 0/],
    [frame(codec, { type: 'configure', scene: {}, settings: {}, time_step: 1 }), /request.scene.bodies must be a list/],
  ];
  for (const [bytes, reason] of faults) {
    const { found, status } = replies([bytes, nothing]);
    assert.equal(found.length, 1);
    assert.equal(found[0].type, 'failed');
    assert.match(found[0].reason, reason);
    assert.equal(status, 1);
  }
});

test('requests in the wrong order fail, and the worker goes on', () => {
  const states = scene().initial;
  const { found, status } = replies([{ type: 'step', count: 1 }, { type: 'start', states, time: 0 },
    { type: 'configure', scene: scene(), settings: {}, time_step: 0.01 },
    { type: 'start', states: states.subarray(0, 72), time: 0 }, { type: 'start', states, time: 0 },
    { type: 'time', states, time: 0, steps: 3, repeats: 2 }, { type: 'step', count: 1 }, { type: 'quit' }]);
  assert.deepEqual(found.map(({ type, reason }) => reason ?? type), ['step before start',
    'start before configure', 'configured', 'wrong number of states', 'started', 'timed', 'step before start']);
  assert.equal(found[5].cpu_seconds.length, 2);
  assert.ok(found[5].cpu_seconds.every((seconds) => seconds >= 0));
  assert.equal(status, 0);
});

test('settings that an engine does not take are refused, all in one reason', () => {
  const table = [flag('on', true, 'a flag'), number('part', 'm', 0.5, 'a number', { high: 1 }),
    count('n', 4, 'a count', { low: 1 }), word('kind', ['a', 'b'], 'a', 'a word')];
  refuseBadSettings(table, { on: false, part: 1, n: 7, kind: 'b' });
  assert.throws(() => refuseBadSettings(table, { on: 1, part: 2, n: 1.5, kind: 'c', other: 1 }), {
    message: 'on must be true or false, got 1; part must be a number >= 0 and <= 1 m, got 2; ' +
      'n must be a whole number >= 1, got 1.5; kind must be one of a, b, got c; other is no setting of this engine',
  });
});

test('a welcome keeps to its own table', () => {
  const { found: [welcome] } = replies([{ type: 'hello', protocol: 5 }]);
  assert.equal(welcome.protocol, 5);
  const names = welcome.settings.map(({ name }) => name);
  assert.equal(new Set(names).size, names.length);
  for (const row of welcome.settings) {
    assert.match(row.name, /^[a-z0-9_]+$/);
    assert.ok(row.about && !row.about.includes('\n'), row.name);
    refuseBadSettings([row], { [row.name]: row.shipped });
    for (const candidate of row.candidates) refuseBadSettings([row], { [row.name]: candidate });
    if (row.range) {
      refuseBadSettings([row], { [row.name]: row.range.low });
      refuseBadSettings([row], { [row.name]: row.range.high });
    }
  }
});

test('a scene without an entry for each of its parts is not taken', () => {
  const faults = [
    [(s) => s.pairs.pop(), /pairs must have an entry for each of 1 pairs of materials, has 0/],
    [(s) => (s.initial = s.initial.subarray(0, 72)), /initial must have an entry for each of 2 bodies, has 1/],
    [(s) => (s.initial = s.initial.subarray(0, 71)), /initial has 71 bytes, must be a multiple of 72/],
    [(s) => (s.bodies[1].material = 1), /bodies\[1\].material must be below 1/],
    [(s) => (s.bodies[0].mass = 0), /bodies\[0\].mass must be > 0/],
    [(s) => (s.gravity = -1), /gravity must be >= 0/],
  ];
  for (const [spoil, reason] of faults) {
    const spoilt = scene();
    spoil(spoilt);
    assert.throws(() => readScene(spoilt), { message: reason });
  }
});

test('restitution by laws over the speed', () => {
  assert.equal(restitutionAt(0.7, 3), 0.7);
  const bridges = { coefficient: 0.32, exponent: 0.234, speed: 0.01 };
  assert.ok(Math.abs(restitutionAt(bridges, 0.02) - 0.32 * 2 ** -0.234) < 1e-15);
  assert.equal(restitutionAt(bridges, 1e-6), 1);
  // ln(e/(1 - e)) = 1 - 2 ln g is a straight line, which a cubic keeps.
  const line = { log_first: -1, log_step: 1, log_odds: [3, 1, -1], slope: [-2, -2, -2] };
  for (const g of [0.5, 1, 2])
    assert.ok(Math.abs(restitutionAt(line, g) - 1 / (1 + Math.exp(-(1 - 2 * Math.log(g))))) < 1e-14);
  // Beyond the last point e is a power of g with the slope of the last point, -2 (1 - e).
  const e = 1 / (1 + Math.exp(1));
  assert.ok(Math.abs(restitutionAt(line, Math.exp(2)) - e * Math.exp(-2 * (1 - e))) < 1e-15);
});

test('rolling friction over the speed, and its length', () => {
  const table = [[0, 0.01], [1, 0.03], [2, 0.03]];
  for (const [speed, mu] of [[0, 0.01], [0.5, 0.02], [1.5, 0.03], [9, 0.03]])
    assert.ok(Math.abs(rollingAt(table, speed) - mu) < 1e-17, `${speed}`);
  assert.ok(Math.abs(rollingLength({ radius: 0.1, shape_factor: 0.4 }, 0.02) - 1.4 * 0.02 * 0.1) < 1e-18);
});

test("a substrate's velocity is the derivative of its position", () => {
  const motions = [{ kind: 'constant', velocity: [0.1, -0.2] },
    { kind: 'oscillation', amplitude: [0.01, 0.02], frequency: 3, phase: 0.4 },
    { kind: 'table', points: [[0, 0, 0], [1, 2, 0], [3, 2, 4]] }];
  for (const motion of motions.map(substrateMotion))
    for (const t of [0.3, 1.7, 5]) {
      const step = 1e-6;
      const [before, after] = [motion.position(t - step), motion.position(t + step)];
      motion.velocity(t).forEach((v, k) =>
        assert.ok(Math.abs((after[k] - before[k]) / (2 * step) - v) < 1e-6));
    }
});

test('units keep the physics: numbers without a dimension stay', () => {
  const original = readScene({ ...scene(), downhill: [0.5, 0] });
  const units = new Units(original, { scale_radius_to: 1, scale_mass_to: 2, scale_gravity_to: 4 });
  const scaled = units.scene(original);
  const froude = ({ gravity, bodies: [{ radius }] }, v) => (v * v) / (gravity * radius);
  assert.ok(Math.abs(froude(original, 0.3) / froude(scaled, 0.3 * units.speed) - 1) < 1e-12);
  assert.equal(scaled.bodies[0].radius, 1);
  assert.ok(Math.abs(scaled.bodies[0].mass - 2) < 1e-15);
  assert.ok(Math.abs(Math.hypot(scaled.gravity, scaled.downhill[0]) - 4) < 1e-12);
});

test('numbers are written as elsewhere', () => {
  assert.deepEqual([4, 0.1, 1e18, 1e-5, 0, -2.5e-7].map(exactText), ['4', '0.1', '1e+18', '1e-05', '0', '-2.5e-07']);
  assert.deepEqual([0.2, 0.123456, 1234, 1].map((x) => rounded(x, 3)), ['0.2', '0.123', '1.23e+03', '1']);
});

test('values that are all alike are told once', () => {
  const all = new Gathered();
  for (const [whose, value] of [[0, 1], [1, 1]]) all.add('same', whose, value);
  for (const [whose, value] of [[0, 1], [1, 2]]) all.add('other', whose, value);
  assert.deepEqual(all.settings(), { same: 1, 'other[0]': 1, 'other[1]': 2 });
});

test('what is lacking has the words that all engines use', () => {
  const poor = readScene(scene());
  Object.assign(poor.substrate[0], { static_friction: 0.5, restitution: 0.5, rolling: [[0, 0.1], [1, 0.2]],
    drilling_length: 0.01, coupled_radius: 0.01 });
  const texts = (abilities) => lacks({ ...poor, confined: true }, 0.01, abilities).map(({ text }) => text);
  assert.deepEqual(texts({ threshold: 0.2 }), ['static friction (one coefficient for sticking and sliding)',
    'rolling friction (the engine has none)', 'drilling friction (the engine has none)',
    'restitution below 0.2 m/s of approach', 'confinement to the plane']);
  assert.deepEqual(texts({ rolling: true, drilling: true, staticFriction: true, confinement: true }), [
    'coupled drilling (torque and friction are full, each by itself)',
    'rolling friction only while rolling (it acts while sliding too)',
    'rolling friction that depends on the speed']);
});

test('impulses that explain a change are those that made it', () => {
  // Ball 0 is pressed on the plane and hit by ball 1 along x, which is in the air.
  const bodies = [ball(0.1), ball(0.05)];
  const contacts = [{ i: 0, j: -1, normal: [0, 0, 1] }, { i: 0, j: 1, normal: [-1, 0, 0] }];
  const given = [[0.3, -0.1, 2], [-5, 0.4, 0.2]]; // on body 0
  const changes = new Float64Array(12);
  const act = (body, side, normal, impulse) => {
    const { mass, radius, shape_factor } = bodies[body];
    const [x, y, z] = normal.map((n) => -side * radius * n); // to the point of contact
    const [px, py, pz] = impulse.map((p) => side * p);
    const torque = [y * pz - z * py, z * px - x * pz, x * py - y * px];
    [px, py, pz].forEach((p, k) => (changes[6 * body + k] += p / mass));
    torque.forEach((t, k) => (changes[6 * body + 3 + k] += t / (shape_factor * mass * radius ** 2)));
  };
  act(0, 1, contacts[0].normal, given[0]);
  act(0, 1, contacts[1].normal, given[1]);
  act(1, -1, contacts[1].normal, given[1]);
  const found = explainedImpulses(bodies, contacts, changes, () => 1e-9);
  assert.equal(found.length, 2);
  assert.ok(Math.abs(found[0][2] - 2) < 1e-6 && Math.abs(found[1][2] - 5) < 1e-6, `${found}`);
});

test('a start needs as many states as bodies', () => {
  const { found } = replies([{ type: 'configure', scene: scene(), settings: {}, time_step: 0.01 },
    { type: 'start', states: packed([[0, 0, 0.1, 0, 0, 0, 0, 0, 0]]), time: 0 }]);
  assert.deepEqual([found[1].type, found[1].reason], ['failed', 'wrong number of states']);
});

/// v turned by a quaternion [x, y, z, w].
function turned([x, y, z, w], v) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const t = cross([x, y, z], v).map((value) => 2 * value);
  const u = cross([x, y, z], t);
  return v.map((value, k) => value + w * t[k] + u[k]);
}

test("a body's first axis comes to lie along its axis, whatever axis an engine lays a cylinder along", () => {
  const body = { axis: [0.6, 0.8] };
  for (const [turn, from] of [[turnOf, [1, 0, 0]], [turnFromY, [0, 1, 0]], [turnFromZ, [0, 0, 1]]])
    turned(turn(body), from).forEach((value, k) =>
      assert.ok(Math.abs(value - [0.6, 0.8, 0][k]) < 1e-15, turn.name));
});

test('moments of inertia are those of a sphere, a block and a cylinder', () => {
  assert.deepEqual(inertiaOf({ mass: 2, radius: 3, shape_factor: 0.4 }), Array(3).fill(0.4 * 2 * 3 * 3));
  const near = (found, expected) => found.forEach((value, k) => assert.ok(Math.abs(value / expected[k] - 1) < 1e-15));
  near(inertiaOf({ shape: 'block', mass: 12, size: [1, 2, 3] }), [4 + 9, 1 + 9, 1 + 4]);
  near(inertiaOf({ shape: 'cylinder', mass: 12, radius: 2, shape_factor: 0.5, size: [6, 4, 4] }),
    [24, 12 * (1 + 3), 12 * (1 + 3)]); // m R²/2, m (R²/4 + L²/12)
});

test('units count the edges of bodies too', () => {
  const block = { ...ball(0.1), shape: 'block', size: [0.2, 0.3, 0.2], axis: [1, 0] };
  const units = new Units({ ...scene(), bodies: [block] }, { scale_radius_to: 1, scale_mass_to: 0, scale_gravity_to: 0 });
  assert.deepEqual(units.scene({ ...readScene({ ...scene(), bodies: [block, block] }) }).bodies[0].size, [2, 3, 2]);
});

test('surfaces lie and move as the scene says', () => {
  const spin = { kind: 'turning', pivot: [1, 0, 0], rate: [0, 0, Math.PI / 2] };
  const course = { kind: 'constant', velocity: [0.5, 0] };
  const [plate, belt] = besideSurfaces({ surfaces: [
    { shape: { kind: 'rectangle', centre: [2, 0, 0], half_length: [0.5, 0, 0], half_width: [0, 0.2, 0] }, motion: spin },
    { shape: { kind: 'rod', begin: [0, 0, 0], end: [0, 2, 0], radius: 0.1 },
      motion: { kind: 'belt', course, first: [0, 0, 1], second: [1, 0, 0] } },
  ] });
  const near = (a, b) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < 1e-15, `${a} is not ${b}`));
  near(plate.centre(1), [1, 1, 0]); // a quarter turn about x = 1
  near(plate.quaternion(1), [0, 0, Math.SQRT1_2, Math.SQRT1_2]);
  near(plate.velocity(0, [3, 0, 0]), [0, Math.PI, 0]);
  near(belt.centre(4), [0, 1, 0]); // the shape stays
  near(belt.stepVelocity(1, 0.25, [0, 0, 0], true), [0, 0, 0.5]);
  near(belt.axes(0)[2], [0, 1, 0]);
  assert.deepEqual([plate.touch, belt.touch], [-2, -3]);
});

test('what the nearest place of a surface points to, and what stays where it is', () => {
  const still = { kind: 'still' };
  const along = (velocity) => ({ kind: 'moving', course: { kind: 'constant', velocity }, first: [1, 0, 0], second: [0, 0, 1] });
  const floor = { kind: 'plane', point: [0, 0, 1], normal: [0, 0, 1] };
  const scene = { bodies: [{}], initial: new Float64Array([3, 4, 0, 0, 0, 0, 0, 0, 0]), surfaces: [
    { shape: { kind: 'rectangle', centre: [0, 0, 0], half_length: [1, 0, 0], half_width: [0, 2, 0] }, motion: still },
    { shape: { kind: 'rod', begin: [0, 0, -1], end: [0, 0, 1], radius: 0.5 }, motion: still },
    { shape: { kind: 'ball', centre: [0, 0, 0], radius: 1 }, motion: still },
    { shape: floor, motion: along([2, 0]) },
    { shape: floor, motion: along([2, 1e-3]) },
    { shape: floor, motion: { kind: 'turning', pivot: [0, 0, 0], rate: [0, 0, 1] } },
  ] };
  const [plate, rod, round, sliding, rising, turning] = besideSurfaces(scene);
  const near = (a, b) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < 1e-15, `${a} is not ${b}`));
  near(plate.normalAt(0, [0.5, 0.5, -2]), [0, 0, -1]); // its other face
  near(plate.normalAt(0, [1.3, 0, 0.4]), [0.6, 0, 0.8]); // an edge
  near(rod.normalAt(0, [0, 2, 0.5]), [0, 1, 0]);
  near(rod.normalAt(0, [0.2, 0, 3]), [0, 0, 1]); // an end
  near(round.normalAt(0, [0, 3, 4]), [0, 0.6, 0.8]);
  near(sliding.behind(0, 0.25), [0, 0, 0.75]);
  assert.deepEqual([plate, sliding, rising, turning].map(({ stays }) => stays), [true, true, false, true]);
  assert.equal(farthest(scene, 0), 5);
  assert.equal(farthest(scene, 7), 7);
  assert.deepEqual(planeEnds([plate, sliding], 10), []);
  assert.match(planeEnds([rising], 10)[0].text, /^planes without end that move away \(boxes of ±10 m\)$/);
});
