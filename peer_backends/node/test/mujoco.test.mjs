import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { dampingRatioOf } from '../kit/contact_spring.mjs';
import { Refused } from '../kit/faults.mjs';
import { load } from '../kit/packages.mjs';
import { folderOf, openEngine, profile, runHere } from './support/engines.mjs';
import { GRAVITY, bouncingBall, scene, slideToRoll, steel, symmetric } from './support/scenes.mjs';
import { WorkerClient } from './support/worker_client.mjs';

const mujoco = await (await load(folderOf('mujoco'), '@mujoco/mujoco'))({ print: console.error });
const worker = await WorkerClient.start('mujoco', folderOf('mujoco'));
after(() => worker.quit());
const engine = await openEngine('mujoco');

const RATE = 240;
const BOUNCE = '-2499.9999999999995 -7.628671998936889'; // of e = 0.8
const REBOUND = '-2499.9999999999995 -3.5155357663293687'; // of e = 0.9
const hasSurfaceVelocity = Number(engine.version.split('.')[1]) >= 11;
const PHYSICAL = profile('mujoco', 'physical');

/// A model stepped by MuJoCo's own API: place, velocity, and the angular velocity turned out of the
/// frame of its body by MuJoCo's own rotation of a vector.
function bare(xml, velocities, steps) {
  const model = mujoco.MjModel.from_xml_string(xml);
  const data = new mujoco.MjData(model);
  data.qvel.set(velocities.flat());
  const turned = new mujoco.DoubleBuffer(3);
  const frames = Array.from({ length: steps }, () => {
    mujoco.mj_step(model, data);
    return velocities.flatMap((_, i) => {
      mujoco.mju_rotVecQuat(
        turned,
        data.qvel.slice(6 * i + 3, 6 * i + 6),
        data.qpos.slice(7 * i + 3, 7 * i + 7),
      );
      return [
        ...data.qpos.slice(7 * i, 7 * i + 3),
        ...data.qvel.slice(6 * i, 6 * i + 3),
        ...turned.GetView(),
      ];
    });
  });
  for (const each of [turned, data, model]) each.delete();
  return frames;
}

function ball(name, radius, place, attributes = '') {
  const inertia = 0.4 * steel(radius) * radius * radius;
  return (
    `<body pos="${place}"><freejoint/><inertial pos="0 0 0" mass="${steel(radius)}" ` +
    `diaginertia="${inertia} ${inertia} ${inertia}"/><geom name="${name}" type="sphere" size="${radius}" ${attributes}/></body>`
  );
}

const world = (bodies, pairs) =>
  `<mujoco><option timestep="${1 / RATE}" gravity="0 0 -9.81"/><worldbody>` +
  `<geom name="plane" type="plane" size="0 0 1" contype="0" conaffinity="0"/>${bodies}</worldbody>` +
  `<contact>${pairs}</contact></mujoco>`;

/// To the last bit but for the sign of a zero.
function agree(seen, expected) {
  seen.forEach((states, n) =>
    states.forEach((value, k) =>
      assert.ok(
        value === expected[n][k],
        `step ${n + 1}, number ${k}: ${value}, bare ${expected[n][k]}`,
      ),
    ),
  );
}

test('slide-to-roll: as a bare program of MuJoCo', async () => {
  const expected = bare(
    world(
      ball('ball', 0.005, '0 0 0.005'),
      '<pair geom1="ball" geom2="plane" condim="3" friction="0.2 0.2"/>',
    ),
    [[0.5, 0, 0, 0, 0, 0]],
    RATE,
  );
  agree(await worker.run(slideToRoll, {}, 1 / RATE, RATE), expected);
});

test('bouncing-ball: as a bare program of MuJoCo', async () => {
  // -k d = -1/0.02² and -b d = -2 ζ ω with ω = 1/(0.02 √0.95) and the ζ of e = 0.8, 0.0746.
  const expected = bare(
    world(
      ball('ball', 0.01, '0 0 0.06'),
      `<pair geom1="ball" geom2="plane" condim="3" friction="0.3 0.3" solref="${BOUNCE}"/>`,
    ),
    [[0, 0, 0, 0, 0, 0]],
    RATE,
  );
  agree(await worker.run(bouncingBall, {}, 1 / RATE, RATE), expected);
});

test('symmetric-30cms: as a bare program of MuJoCo', async () => {
  const own = `condim="1" solref="${REBOUND}"`;
  const expected = bare(
    world(
      ball('i', 0.002, '-0.0095 0 0.002', own) + ball('j', 0.002, '0.0095 0 0.002', own),
      '<pair geom1="i" geom2="plane" condim="3" friction="0.1 0.1"/><pair geom1="j" geom2="plane" condim="3" friction="0.1 0.1"/>',
    ),
    [
      [0.15, 0, 0, 0, 75, 0],
      [-0.15, 0, 0, 0, -75, 0],
    ],
    RATE,
  );
  agree(await worker.run(symmetric, {}, 1 / RATE, RATE), expected);
});

test('solref in force is that of the map, to rounding', () => {
  for (const [text, e] of [
    [BOUNCE, 0.8],
    [REBOUND, 0.9],
  ]) {
    const [k, b] = text.split(' ').map(Number);
    assert.ok(Math.abs(k + 1 / 0.02 ** 2) < 1e-9);
    assert.ok(Math.abs(b + (2 * dampingRatioOf(e)) / (0.02 * Math.sqrt(0.95))) < 1e-12);
  }
});

test('coefficients that are typed alike into ball and plane are those of the pair', () => {
  const [typed, exact] = ['naive', 'default'].map(
    (name) => runHere(engine, slideToRoll, profile('mujoco', name), 1 / RATE, 100).frames,
  );
  assert.deepEqual(typed, exact);
});

test('the same states give the same frames', () => {
  const [first, second] = [0, 1].map(() => runHere(engine, symmetric, {}, 1 / RATE, 100).frames);
  assert.deepEqual(first, second);
});

const bounceOf = (settings, height, rate, e = 0.8) => {
  const radius = 0.01;
  const dropped = scene({
    radius,
    states: [[0, 0, radius + height, 0, 0, 0, 0, 0, 0]],
    substrate: { static_friction: 0.3, kinetic_friction: 0.3, restitution: e },
  });
  const speed = Math.sqrt(2 * GRAVITY * height);
  const { frames } = runHere(
    engine,
    dropped,
    settings,
    1 / rate,
    Math.ceil((speed / GRAVITY + 0.1) * rate),
  );
  return { frames, speed };
};

test('one step turns v into -e v in every phase', () => {
  // Of what gravity adds in a step, (1 - d) is left, and overlap_push = 0.001 of the overlap, at
  // most v dt, comes on top.
  for (const height of [0.05, 0.0512, 0.0537, 0.0561]) {
    const { frames } = bounceOf(PHYSICAL, height, RATE);
    const n = frames.findIndex(({ states }) => states[5] > 0);
    const before = frames[n - 1].states[5];
    const ratio = -frames[n].states[5] / before;
    assert.ok(ratio > 0.7999 && ratio < 0.8011, `from ${height} m: ${ratio}`);
  }
});

test('a damping ratio makes the rebound', () => {
  // At impedance 0.9999 the spring is that of the map; gravity over the contact's 25 ms changes e
  // by g t/v² h = 0.0007 of itself (measured 0.0005), Euler's steps by less.
  const { frames, speed } = bounceOf({ impedance_at_touch: 0.9999, impedance: 0.9999 }, 0.05, 10000);
  const fastest = Math.max(...frames.map(({ states }) => states[5]));
  assert.ok(Math.abs(fastest / speed - 0.8) < 0.001, `${fastest / speed}`);
});

test('rolling friction is μ_r g, alike in all headings', () => {
  // The cone's share of friction takes (μ_r/μ)²/2 = 0.2 % off; hops of the lifted contact add some
  // of theirs.
  for (const heading of [0, 22.5, 45]) {
    const [x, y] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
    const rolling = scene({
      radius: 0.01,
      states: [[0, 0, 0.01, 0.5 * x, 0.5 * y, 0, -50 * y, 50 * x, 0]],
      substrate: { static_friction: 0.3, kinetic_friction: 0.3, rolling: [[0, 0.02]] },
    });
    const { last } = runHere(engine, rolling, PHYSICAL, 1 / 1000, 1000);
    const lost = 0.5 - Math.hypot(last[3], last[4]);
    assert.ok(Math.abs(lost / (0.02 * GRAVITY) - 1) < 0.01, `${heading}°: ${lost}`);
    assert.ok(Math.abs((Math.atan2(last[4], last[3]) * 180) / Math.PI - heading) < 0.2, `${heading}°`);
  }
});

test('drilling friction is drilling_length times the normal force', () => {
  const drilling = scene({
    radius: 0.01,
    states: [[0, 0, 0.01, 0, 0, 0, 0, 0, 50]],
    substrate: { static_friction: 0.3, kinetic_friction: 0.3, drilling_length: 1e-3 },
  });
  const { last } = runHere(engine, drilling, PHYSICAL, 1 / 1000, 100);
  const expected = 50 - ((1e-3 * GRAVITY) / (0.4 * 0.01 ** 2)) * 0.1;
  assert.ok(Math.abs(last[8] - expected) < 0.02 * expected, `${last[8]}, ${expected}`);
});

test('a ball that sticks to a shaken substrate has 2/7 of its velocity', () => {
  const shaken = scene({
    radius: 0.01,
    states: [[0, 0, 0.01, 0, 0, 0, 0, 0, 0]],
    substrate: { static_friction: 0.5, kinetic_friction: 0.5 },
    motion: { kind: 'oscillation', amplitude: [0.01, 0], frequency: 5, phase: Math.PI / 2 },
  });
  if (!hasSurfaceVelocity) {
    assert.throws(
      () => runHere(engine, shaken, PHYSICAL, 1 / 1000, 1),
      (error) => error instanceof Refused && /has no surfacevel \(from 3\.11 on\)/.test(error.message),
    );
    return;
  }
  // V = -0.314 m/s sin(2π 5 t). Hops of the lifted contact and round-off: a hundredth of the
  // amplitude.
  const { frames } = runHere(engine, shaken, PHYSICAL, 1 / 1000, 1000);
  for (const n of [250, 500, 750, 1000]) {
    const velocity = -0.01 * 10 * Math.PI * Math.sin(10 * Math.PI * (n / 1000));
    assert.ok(
      Math.abs(frames[n - 1].states[3] - (2 / 7) * velocity) < 0.0031,
      `${n}: ${frames[n - 1].states[3]}`,
    );
  }
});

test('a normal impulse for each step, together the weight', () => {
  const { frames } = runHere(engine, slideToRoll, PHYSICAL, 1 / 1000, 500);
  const sum = frames
    .flatMap(({ touches }) => touches)
    .reduce((total, [, , impulse]) => total + impulse, 0);
  // A ball in the middle of a hop owes m v.
  assert.ok(Math.abs(sum / (steel(0.005) * GRAVITY * 0.5) - 1) < 0.02, `${sum}`);
});

test('restitution by the speed of each impact', () => {
  const meeting = scene({
    radius: 0.002,
    states: [
      [-0.003, 0, 0.002, 0.15, 0, 0, 0, 0, 0],
      [0.003, 0, 0.002, -0.15, 0, 0, 0, 0, 0],
    ],
    pair: { restitution: { coefficient: 0.8, exponent: 0.2, speed: 0.1 } },
  });
  const { told, last } = runHere(engine, meeting, PHYSICAL, 1 / 1000, 30);
  const e = 0.8 * 3 ** -0.2;
  assert.ok(-last[3] / 0.15 > e - 1e-4 && -last[3] / 0.15 < e + 1.1e-3, `${-last[3] / 0.15}, ${e}`);
  assert.deepEqual(
    told.not_represented.filter(({ kind }) => kind.startsWith('restitution')),
    [],
  );
});

test('tangential restitution within the cone', () => {
  // A ball without gravity drops on the plane with slip u: u' = -β0 u where the friction suffices.
  // Of two balls: pair.
  const spinning = scene({
    radius: 0.01,
    gravity: 0,
    states: [
      [-0.0105, 0, 0.01, 0.1, 0, 0, 0, 0, 1],
      [0.0105, 0, 0.01, -0.1, 0, 0, 0, 0, 1],
    ],
    pair: { restitution: 0.9, friction: 5, tangential_restitution: 0.5 },
  });
  const { last } = runHere(engine, spinning, PHYSICAL, 1 / 1000, 30);
  const slip = (s) => s[4] + 0.01 * s[8] - (s[13] - 0.01 * s[17]);
  const start = 0.02;
  assert.ok(Math.abs(slip(last) / start + 0.5) < 0.002, `${slip(last) / start}`);
});

test('elastic ball between walls keeps its energy', () => {
  const elastic = [{ restitution: 1, friction: 0, tangential_restitution: -1 }];
  const box = {
    width: 0.005,
    floor: { amplitude: 0, frequency: 0 },
    moving_walls: false,
    on_floor: elastic,
    on_wall: elastic,
    on_lid: elastic,
  };
  const boxed = scene({ radius: 0.0005, states: [[0.002, 0, 0.01, 0.03, 0, 0, 0, 0, 0]], box });
  const { last } = runHere(engine, boxed, PHYSICAL, 1 / 4000, 4000);
  const energy = 0.5 * (last[3] ** 2 + last[5] ** 2) + GRAVITY * last[2];
  // Each of 11 bounces adds up to 0.001 of its speed, and Euler's step g dt v/2.
  assert.ok(Math.abs(energy / (0.5 * 0.03 ** 2 + GRAVITY * 0.01) - 1) < 0.02, `${energy}`);
  assert.equal(last[1], 0);
});

test('what it cannot run is refused with the reason', () => {
  assert.throws(
    () => runHere(engine, { ...slideToRoll, periodic: [1, 0] }, {}, 1 / RATE, 1),
    (error) => error instanceof Refused && /no periodic boundaries/.test(error.message),
  );
  assert.throws(
    () => runHere(engine, slideToRoll, { restitution: 'one_step' }, 1 / RATE, 1),
    (error) => error instanceof Refused && /needs the elliptic cone/.test(error.message),
  );
});

test('what it cannot express is told', () => {
  const kinds = (settings, of = symmetric) =>
    runHere(engine, of, settings, 1 / RATE, 1).told.not_represented.map(({ kind }) => kind);
  assert.deepEqual(kinds({}), [
    'static friction',
    'friction alike in all headings',
    'sliding without being lifted',
    'contacts without a rebound',
  ]);
  assert.deepEqual(kinds(PHYSICAL), ['static friction', 'sliding without being lifted']);
  assert.ok(kinds({ coefficients: 'fields' }).includes('restitution'));
});
