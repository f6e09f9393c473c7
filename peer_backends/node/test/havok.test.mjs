import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Refused } from '../kit/faults.mjs';
import { folderOf, openEngine, profile, runHere } from './support/engines.mjs';
import { GRAVITY, bouncingBall, scene, slideToRoll, steel, symmetric } from './support/scenes.mjs';
import { WorkerClient } from './support/worker_client.mjs';

const worker = await WorkerClient.start('havok', folderOf('havok'));
after(() => worker.quit());
const engine = await openEngine('havok');
const { hp } = engine;

const RATE = 240;
const PHYSICAL = profile('havok', 'physical');

function value([result, value]) {
  assert.equal(result, hp.Result.RESULT_OK);
  return value;
}

/// Balls on a box by Havok's own API, all as it ships.
function bare({ ground, ball, radius, states }, steps) {
  const world = value(hp.HP_World_Create());
  hp.HP_World_SetGravity(world, [0, 0, -GRAVITY]);
  const body = (shape, { material, mask }, motion) => {
    hp.HP_Shape_SetMaterial(shape, material);
    hp.HP_Shape_SetFilterInfo(shape, mask);
    const made = value(hp.HP_Body_Create());
    hp.HP_Body_SetShape(made, shape);
    hp.HP_Body_SetMotionType(made, motion);
    return made;
  };
  const thick = 32 * radius;
  const plane = value(hp.HP_Shape_CreateBox([0, 0, -thick / 2], [0, 0, 0, 1], [200, 200, thick]));
  hp.HP_World_AddBody(
    world,
    body(plane, { material: ground, mask: [2, 1] }, hp.MotionType.STATIC),
    false,
  );
  const balls = states.map((state) => {
    const made = body(
      value(hp.HP_Shape_CreateSphere([0, 0, 0], radius)),
      { material: ball, mask: [1, 3] },
      hp.MotionType.DYNAMIC,
    );
    const inertia = 0.4 * radius * radius;
    hp.HP_Body_SetMassProperties(made, [
      [0, 0, 0],
      steel(radius),
      [inertia, inertia, inertia],
      [0, 0, 0, 1],
    ]);
    hp.HP_Body_SetPosition(made, state.slice(0, 3));
    hp.HP_World_AddBody(world, made, false);
    hp.HP_Body_SetLinearVelocity(made, state.slice(3, 6));
    hp.HP_Body_SetAngularVelocity(made, state.slice(6, 9));
    return made;
  });
  const frames = Array.from({ length: steps }, () => {
    hp.HP_World_Step(world, 1 / RATE);
    return balls.flatMap((made) => [
      ...value(hp.HP_Body_GetPosition(made)),
      ...value(hp.HP_Body_GetLinearVelocity(made)),
      ...value(hp.HP_Body_GetAngularVelocity(made)),
    ]);
  });
  hp.HP_World_Release(world);
  return frames;
}

const { MINIMUM, MAXIMUM } = hp.MaterialCombine;

test('slide-to-roll: as a bare program of Havok', async () => {
  const expected = bare(
    {
      ground: [0.2, 0.2, 0, MAXIMUM, MINIMUM],
      ball: [0, 0, 0, MINIMUM, MINIMUM],
      radius: 0.005,
      states: [[0, 0, 0.005, 0.5, 0, 0, 0, 0, 0]],
    },
    RATE,
  );
  assert.deepEqual(await worker.run(slideToRoll, {}, 1 / RATE, RATE), expected);
});

test('bouncing-ball: as a bare program of Havok', async () => {
  const expected = bare(
    {
      ground: [0.3, 0.3, 0.8, MAXIMUM, MAXIMUM],
      ball: [0, 0, 0, MINIMUM, MINIMUM],
      radius: 0.01,
      states: [[0, 0, 0.06, 0, 0, 0, 0, 0, 0]],
    },
    RATE,
  );
  assert.deepEqual(await worker.run(bouncingBall, {}, 1 / RATE, RATE), expected);
});

test('symmetric-30cms: as a bare program of Havok', async () => {
  const expected = bare(
    {
      ground: [0.1, 0.1, 0, MAXIMUM, MINIMUM],
      ball: [0, 0, 0.9, MINIMUM, MINIMUM],
      radius: 0.002,
      states: [
        [-0.0095, 0, 0.002, 0.15, 0, 0, 0, 75, 0],
        [0.0095, 0, 0.002, -0.15, 0, 0, 0, -75, 0],
      ],
    },
    RATE,
  );
  assert.deepEqual(await worker.run(symmetric, {}, 1 / RATE, RATE), expected);
});

test('coefficients that are typed alike into ball and substrate are those of the pair', () => {
  const [typed, exact] = ['naive', 'default'].map(
    (name) => runHere(engine, slideToRoll, profile('havok', name), 1 / RATE, 100).frames,
  );
  assert.deepEqual(typed, exact);
});

test('the same states give the same frames', () => {
  const [first, second] = [0, 1].map(() => runHere(engine, symmetric, {}, 1 / RATE, 100).frames);
  assert.deepEqual(first, second);
});

test('a ball that slid rolls with 5/7 of its speed', () => {
  const { last } = runHere(engine, slideToRoll, PHYSICAL, 1 / 1000, 200);
  assert.ok(
    Math.abs(last[3] / 0.5 - 5 / 7) < 0.002 && Math.abs((0.005 * last[7]) / last[3] - 1) < 0.002,
    `${last}`,
  );
});

test('a ball that rolls slower than 0.1 m/s is braked, unless units make it fast', () => {
  const slow = scene({
    radius: 0.01,
    states: [[0, 0, 0.01, 0.05, 0, 0, 0, 5, 0]],
    substrate: { static_friction: 0.2, kinetic_friction: 0.2 },
  });
  const awake = { ...PHYSICAL, scale_radius_to: 0 };
  assert.equal(runHere(engine, slow, awake, 1 / RATE, RATE).last[3], 0);
  const { last } = runHere(engine, slow, PHYSICAL, 1 / RATE, RATE);
  assert.ok(Math.abs(last[3] / 0.05 - 1) < 0.001, `${last[3]}`);
});

test('a belt carries a ball along to 2/7 of its speed', () => {
  const belt = scene({
    radius: 0.01,
    states: [[0, 0, 0.01, 0, 0, 0, 0, 0, 0]],
    substrate: { static_friction: 0.3, kinetic_friction: 0.3 },
    motion: { kind: 'constant', velocity: [0.3, 0] },
  });
  const { last } = runHere(engine, belt, PHYSICAL, 1 / 1000, 500);
  assert.ok(Math.abs(last[3] / 0.3 - 2 / 7) < 0.002, `${last[3]}`);
});

test('the rebound falls short of e v by what gravity adds in a few steps', () => {
  const { frames } = runHere(engine, bouncingBall, PHYSICAL, 1 / 1000, 150);
  const speed = Math.sqrt(2 * GRAVITY * 0.05);
  const fastest = Math.max(...frames.map(({ states }) => states[5]));
  assert.ok(
    fastest < 0.8 * speed && fastest > 0.8 * speed - (3 * GRAVITY) / 1000,
    `${fastest / speed}`,
  );
});

test('a normal impulse for each step, together the weight', () => {
  const { frames } = runHere(engine, slideToRoll, PHYSICAL, 1 / RATE, RATE);
  const sum = frames
    .flatMap(({ touches }) => touches)
    .reduce((total, [, , impulse]) => total + impulse, 0);
  // Within the step or two that a first contact takes.
  assert.ok(Math.abs(sum / (steel(0.005) * GRAVITY) - 1) < 0.01, `${sum}`);
});

test('two materials have their own restitution', () => {
  const pair = (restitution) => ({ restitution, friction: 0, tangential_restitution: -1 });
  const along = (x, v) => [x, 0, 0.002, v, 0, 0, 0, 0, 0];
  const ground = slideToRoll.substrate[0];
  const run = (pairs, second) => {
    const mixed = {
      ...scene({ radius: 0.002, states: [along(-0.003, 0.15), along(0.003, -0.15)] }),
      substrate: [ground, { ...ground, restitution: 0.5 }],
      pairs: pairs.map(pair),
      gravity: 0,
    };
    mixed.bodies[1].material = second;
    return -runHere(engine, mixed, PHYSICAL, 1 / 1000, 30).last[3] / 0.15;
  };
  for (const [second, e] of [
    [0, 0.1],
    [1, 0.6],
  ]) {
    const found = run([0.1, 0.6, 0.6, 0.3], second);
    assert.ok(Math.abs(found - e) < 0.02, `${found}, ${e}`);
  }
});

test('boxes and periodic substrates are refused', () => {
  const refused = (of, reason) =>
    assert.throws(
      () => runHere(engine, of, {}, 1 / RATE, 1),
      (error) => error instanceof Refused && reason.test(error.message),
    );
  refused({ ...slideToRoll, periodic: [1, 0] }, /no periodic boundaries/);
  refused({ ...slideToRoll, box: {} }, /locks no directions/);
});
