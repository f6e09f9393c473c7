import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Refused } from '../kit/faults.mjs';
import { folderOf, openEngine, profile, runHere } from './support/engines.mjs';
import { GRAVITY, bouncingBall, scene, slideToRoll, steel, symmetric } from './support/scenes.mjs';
import { WorkerClient } from './support/worker_client.mjs';

const worker = await WorkerClient.start('physx', folderOf('physx'));
after(() => worker.quit());
const engine = await openEngine('physx');
const { px, top, physics, threads, tolerances } = engine; // PhysX has one foundation in a process

const RATE = 240;
const PHYSICAL = profile('physx', 'physical');

const vector = (numbers) => new px.PxVec3(...numbers);
const pose = (place, turn = [0, 0, 0, 1]) => new px.PxTransform(vector(place), new px.PxQuat(...turn));

function shapeOf(
  geometry,
  { friction, staticFriction = friction, restitution, mode = 'eMIN', bounceMode = mode },
) {
  const material = physics.createMaterial(staticFriction, friction, restitution);
  material.setFrictionCombineMode(px.PxCombineModeEnum[mode]);
  material.setRestitutionCombineMode(px.PxCombineModeEnum[bounceMode]);
  const shape = physics.createShape(
    geometry,
    material,
    true,
    new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE),
  );
  shape.setSimulationFilterData(new px.PxFilterData(1, 1, 0, 0));
  return shape;
}

/// Balls on a plane by PhysX's own API, all as it ships.
function bare({ plane, ball, radius, states }, steps) {
  const desc = new px.PxSceneDesc(tolerances);
  desc.gravity = vector([0, 0, -GRAVITY]);
  desc.cpuDispatcher = threads;
  desc.filterShader = top.DefaultFilterShader();
  const world = physics.createScene(desc);
  const ground = physics.createRigidStatic(pose([0, 0, 0], [0, -Math.SQRT1_2, 0, Math.SQRT1_2]));
  ground.attachShape(shapeOf(new px.PxPlaneGeometry(), plane));
  world.addActor(ground);
  const balls = states.map((state) => {
    const body = physics.createRigidDynamic(pose(state.slice(0, 3)));
    body.attachShape(shapeOf(new px.PxSphereGeometry(radius), ball));
    body.setMass(steel(radius));
    const inertia = 0.4 * steel(radius) * radius * radius;
    body.setMassSpaceInertiaTensor(vector([inertia, inertia, inertia]));
    body.setLinearVelocity(vector(state.slice(3, 6)));
    body.setAngularVelocity(vector(state.slice(6, 9)));
    world.addActor(body);
    return body;
  });
  const numbers = ({ x, y, z }) => [x, y, z];
  const frames = Array.from({ length: steps }, () => {
    world.simulate(1 / RATE);
    world.fetchResults(true);
    return balls.flatMap((body) => [
      ...numbers(body.getGlobalPose().p),
      ...numbers(body.getLinearVelocity()),
      ...numbers(body.getAngularVelocity()),
    ]);
  });
  world.release();
  return frames;
}

test('slide-to-roll: as a bare program of PhysX', async () => {
  const expected = bare(
    {
      plane: { friction: 0.2, restitution: 0, mode: 'eMAX', bounceMode: 'eMIN' },
      ball: { friction: 0, restitution: 0 },
      radius: 0.005,
      states: [[0, 0, 0.005, 0.5, 0, 0, 0, 0, 0]],
    },
    RATE,
  );
  assert.deepEqual(await worker.run(slideToRoll, {}, 1 / RATE, RATE), expected);
});

test('bouncing-ball: as a bare program of PhysX', async () => {
  const expected = bare(
    {
      plane: { friction: 0.3, restitution: 0.8, mode: 'eMAX' },
      ball: { friction: 0, restitution: 0 },
      radius: 0.01,
      states: [[0, 0, 0.06, 0, 0, 0, 0, 0, 0]],
    },
    RATE,
  );
  assert.deepEqual(await worker.run(bouncingBall, {}, 1 / RATE, RATE), expected);
});

test('symmetric-30cms: as a bare program of PhysX', async () => {
  const expected = bare(
    {
      plane: { staticFriction: 0.5, friction: 0.1, restitution: 0, mode: 'eMAX', bounceMode: 'eMIN' },
      ball: { friction: 0, restitution: 0.9 },
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
    (name) => runHere(engine, slideToRoll, profile('physx', name), 1 / RATE, 100).frames,
  );
  assert.deepEqual(typed, exact);
});

test('the same states give the same frames', () => {
  const [first, second] = [0, 1].map(() => runHere(engine, symmetric, {}, 1 / RATE, 100).frames);
  assert.deepEqual(first, second);
});

test('sliding ends after 2 v/(7 μ g) with 5/7 of the speed', () => {
  const { frames } = runHere(engine, slideToRoll, PHYSICAL, 1 / 1000, 100);
  const slips = frames.map(({ states }) => states[3] - 0.005 * states[7]);
  const n = slips.findIndex((slip) => slip < 1e-4);
  // The step in which it ends.
  assert.ok(Math.abs((n + 1) / 1000 - (2 * 0.5) / (7 * 0.2 * GRAVITY)) < 1e-3, `${n}`);
  assert.ok(Math.abs(frames.at(-1).states[3] / 0.5 - 5 / 7) < 1e-5);
});

test('the rebound is e times the speed with what gravity adds in a step', () => {
  // e (v + g dt); measured from the step before, so v is short of the impact by up to g dt.
  const { frames } = runHere(engine, bouncingBall, PHYSICAL, 1 / 1000, 150);
  const fastest = Math.max(...frames.map(({ states }) => states[5]));
  const speed = Math.sqrt(2 * GRAVITY * 0.05);
  assert.ok(fastest / speed > 0.8 - 0.01 && fastest / speed < 0.8 + 0.02, `${fastest / speed}`);
});

test('nothing rebounds below 2 m/s as it ships', () => {
  const { frames, told } = runHere(engine, bouncingBall, {}, 1 / RATE, 60);
  // Meets at 1 m/s. The step in which it lands ends at the plane, to single precision of its place
  // over the step.
  assert.ok(Math.max(...frames.map(({ states }) => states[5])) < 1e-4);
  assert.ok(told.not_represented.some(({ text }) => text === 'restitution below 2 m/s of approach'));
});

const drilling = scene({
  radius: 0.01,
  states: [[0, 0, 0.01, 0, 0, 0, 0, 0, 50]],
  substrate: { static_friction: 0.3, kinetic_friction: 0.3, drilling_length: 1e-3 },
});

test('drilling friction is drilling_length times the normal force with TGS, none with PGS', () => {
  const left = 50 - ((1e-3 * GRAVITY) / (0.4 * 0.01 ** 2)) * 0.1;
  const withTgs = runHere(engine, drilling, { ...PHYSICAL, solver: 'TGS' }, 1 / 1000, 100);
  assert.ok(Math.abs(withTgs.last[8] - left) < 1e-3 * left, `${withTgs.last[8]}, ${left}`);
  const withPgs = runHere(engine, drilling, PHYSICAL, 1 / 1000, 100);
  assert.ok(Math.abs(withPgs.last[8] - 50) < 1e-3, `${withPgs.last[8]}`);
  assert.ok(withPgs.told.not_represented.some(({ kind }) => kind === 'drilling friction'));
});

test('static friction holds a ball below its limit on a shaken substrate, kinetic friction above', () => {
  // It sticks while a_S < 7/2 μ_s g: 2/7 V; V = -A ω sin ω t, here a quarter of a period after the
  // start. At 1 kHz the velocity of the step's end is exact up to single precision of the place
  // that a step adds (1e-7 of 1.6e-3 m).
  const shaken = (mu_s, mu_k) =>
    scene({
      radius: 0.01,
      states: [[0, 0, 0.01, 0, 0, 0, 0, 0, 0]],
      substrate: { static_friction: mu_s, kinetic_friction: mu_k },
      motion: { kind: 'oscillation', amplitude: [0.01, 0], frequency: 5, phase: Math.PI / 2 },
    });
  const velocity = -0.01 * 10 * Math.PI;
  const held = runHere(engine, shaken(0.5, 0.1), PHYSICAL, 1 / 1000, 50).last[3];
  assert.ok(Math.abs(held / ((2 / 7) * velocity) - 1) < 0.002, `${held}`);
  const slips = runHere(engine, shaken(0.1, 0.1), PHYSICAL, 1 / 1000, 50).last[3];
  assert.ok(Math.abs(slips) < 0.1 * GRAVITY * 0.05 * 1.001, `${slips}`);
});

test('a normal impulse for each step, together the weight', () => {
  const { frames } = runHere(engine, slideToRoll, PHYSICAL, 1 / RATE, RATE);
  const sum = frames
    .flatMap(({ touches }) => touches)
    .reduce((total, [, , impulse]) => total + impulse, 0);
  assert.ok(Math.abs(sum / (steel(0.005) * GRAVITY) - 1) < 1e-4, `${sum}`);
});

test('three balls of two materials have their own restitution', () => {
  const pair = (restitution) => ({ restitution, friction: 0, tangential_restitution: -1 });
  const along = (x, v) => [x, 0, 0.002, v, 0, 0, 0, 0, 0];
  const ground = slideToRoll.substrate[0];
  const mixed = {
    ...scene({ radius: 0.002, states: [along(-0.003, 0.15), along(0.003, -0.15)] }),
    substrate: [ground, { ...ground, restitution: 0.5 }],
    pairs: [pair(0.1), pair(0.6), pair(0.6), pair(0.3)],
    gravity: 0,
  };
  mixed.bodies[1].material = 1;
  const { last } = runHere(engine, mixed, PHYSICAL, 1 / 1000, 30);
  // Single precision.
  assert.ok(Math.abs(-last[3] / 0.15 - 0.6) < 1e-6, `${-last[3] / 0.15}`);
});

test('bodies in a box stay in their plane', () => {
  const on = [{ restitution: 0.9, friction: 0.1, tangential_restitution: 0 }];
  const box = {
    width: 0.02,
    floor: { amplitude: 0.001, frequency: 20 },
    moving_walls: true,
    lid: 0.05,
    on_floor: on,
    on_wall: on,
    on_lid: on,
  };
  const states = [
    [0.005, 0, 0.01, 0.1, 0, 0, 0, 0, 0],
    [0.015, 0, 0.0101, -0.1, 0, 0, 0, 0, 0],
  ];
  const { last } = runHere(engine, scene({ radius: 0.002, states, box }), PHYSICAL, 1 / 1000, 1000);
  for (const i of [0, 1]) {
    const [x, y, z, , vy, , wx, , wz] = last.subarray(9 * i, 9 * i + 9);
    assert.deepEqual([y, vy, wx, wz].map(Math.abs), [0, 0, 0, 0]);
    // A step of overlap: 0.5 m/s in 1 ms.
    assert.ok(x > 0.0015 && x < 0.0185 && z > 0.0005 && z < 0.0495, `${x}, ${z}`);
  }
});

test('a periodic substrate is refused', () => {
  assert.throws(
    () => runHere(engine, { ...slideToRoll, periodic: [1, 0] }, {}, 1 / RATE, 1),
    (error) => error instanceof Refused && /no periodic boundaries/.test(error.message),
  );
});
