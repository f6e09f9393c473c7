// Surfaces in one installed engine: the worker's numbers are those of a bare program of the engine's
// own API, and closed forms hold on what lies askew and moves.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { load } from '../kit/packages.mjs';
import { SURFACE_STEP, SURFACE_STEPS, surfaceScene } from './bare/surface_scene.mjs';
import { profile } from './support/engines.mjs';
import { ball, engine, folder, framesOf, framesOfStarts, packed, replies, sceneOf } from './support.mjs';

const catalog = JSON.parse(readFileSync(new URL('../catalog.json', import.meta.url)));
const [, minor] = folder.split('@')[1].split('.').map(Number);
const PHYSICAL = profile(engine, 'physical');
const STILL = { kind: 'still' };
const moving = (kind, [vx, vy, vz]) => {
  const speed = Math.hypot(vx, vy, vz);
  const first = [vx, vy, vz].map((v) => v / speed);
  const second = Math.abs(first[1]) < 0.5 ? [-first[2], 0, first[0]] : [first[1], -first[0], 0];
  return { kind, course: { kind: 'constant', velocity: [speed, 0] }, first, second };
};

/// A ball of 2 cm and surfaces alone, alike in friction and restitution.
function sceneWith(surfaces, states, { friction = 0, restitution = 0, radius = 0.02 }) {
  const scene = sceneOf(states.map(() => ball(radius)), states, { friction, restitution });
  scene.has_substrate = false;
  scene.surfaces = surfaces;
  const impact = { restitution, friction, tangential_restitution: friction > 0 ? 0 : -1 };
  scene.on_surfaces = surfaces.map(() => ({ lasting: scene.substrate[0], impact }));
  return scene;
}

const plane = (point, normal, motion = STILL) => ({ shape: { kind: 'plane', point, normal }, motion });
const plate = (centre, half_length, half_width, motion = STILL) =>
  ({ shape: { kind: 'rectangle', centre, half_length, half_width }, motion });

/// What a bare program has in hand.
const api = async () => (['physx', 'havok', 'mujoco'].includes(engine)
  ? (await import('./support/engines.mjs')).openEngine(engine) : load(folder, catalog[engine].package));

test('a plate, a peg and a belt: the numbers of a bare program, to the last bit', async () => {
  const { radius, friction, restitution, plate: board, peg, belt, state } = surfaceScene;
  const [a, b] = board.half;
  const scene = sceneWith([
    plate(board.centre, [a, 0, 0], [0, b, 0]),
    { shape: { kind: 'ball', ...peg }, motion: STILL },
    plane([0, 0, belt.height], [0, 0, 1], moving('belt', [belt.velocity, 0, 0])),
  ], [state], { friction, restitution, radius });
  const frames = framesOf(scene, {}, SURFACE_STEP, SURFACE_STEPS, { warm: true });
  const { runSurfaces } = await import(`./bare/${engine}.mjs`);
  const { mass } = ball(radius);
  const expected = await runSurfaces(await api(), { ...surfaceScene, mass }, SURFACE_STEP, SURFACE_STEPS);
  const seen = frames.flatMap(({ states }) => [...states]);
  assert.equal(seen.length, expected.length);
  seen.forEach((value, k) => {
    // A zero's sign is not looked at.
    if (value !== expected[k]) assert.fail(`number ${k}: ${value} is not ${expected[k]}`);
  });
  const touched = new Set(frames.flatMap(({ touches }) => touches.map(([, second]) => 0xfffffffe - second)));
  const told = engine === 'rapier' ? [0, 1] : [0, 1, 2]; // Rapier tells no forces of what is put back
  for (const surface of told) assert.ok(touched.has(surface), `surface ${surface} of ${[...touched]}`);
});

test('a ball rolls down a plate with 5/7 g sin θ, which carries m g cos θ', () => {
  const surfaces = [plane([0, 0, -5], [0, 0, 1]), plate([0, 0, 0], [0.48, 0, -0.14], [0, 0.2, 0])];
  const scene = sceneWith(surfaces, [[0.0056, 0, 0.0192, 0, 0, 0, 0, 0, 0]], { friction: 0.4 });
  const frames = framesOf(scene, PHYSICAL, 0.001, 300);
  const { states } = frames.at(-1);
  const exact = (5 / 7) * 9.81 * 0.28 * 0.3;
  // Softness of the contact: Rapier's roll slips by 1e-3, and its velocity across the plate is that of
  // half a step's fall. PhysX's and MuJoCo's hop by up to three steps' fall.
  const [down, across] = [0.96 * states[3] - 0.28 * states[5], 0.28 * states[3] + 0.96 * states[5]];
  assert.ok(Math.abs(down / exact - 1) < 5e-3 && Math.abs(across) < 9.81 * 0.003, `${down / exact} ${across}`);
  const touches = frames.flatMap((each) => each.touches);
  assert.ok(touches.every(([, second]) => second === 0xfffffffd));
  const carried = touches.reduce((sum, [, , impulse]) => sum + impulse, 0);
  // Rapier up to 0.20 miscounts its small steps, here as on the substrate; Havok rounds impulses.
  const most = engine === 'rapier' && minor < 21 ? 0.3 : engine === 'havok' ? 0.03 : 0.01;
  const part = carried / (scene.bodies[0].mass * 9.81 * 0.96 * 0.3);
  assert.ok(Math.abs(part - 1) < most, `${part}`);
});

test('a ball at rest on a belt rolls in the end with 2/7 of its velocity', () => {
  for (const kind of ['belt', 'moving']) {
    const surfaces = [plane([0, 0, 0], [0, 0, 1], moving(kind, [0.6, 0.8, 0]))];
    const scene = sceneWith(surfaces, [[0, 0, 0.02, 0, 0, 0, 0, 0, 0]], { friction: 0.3 });
    // It slides for 2 V/(7 μ g) = 97 ms.
    const { states } = framesOf(scene, PHYSICAL, 0.001, 200).at(-1);
    const off = Math.hypot(states[3] - (2 / 7) * 0.6, states[4] - (2 / 7) * 0.8);
    assert.ok(off < 0.01, `${kind}: ${states.slice(3, 6)}`);
  }
});

test('a wall that comes with V throws a ball at rest off with (1 + e) V', () => {
  for (const make of [plane, (at, normal, motion) => plate(at, [0, 0.3, 0], [0, 0, 0.3], motion)]) {
    const surfaces = [make([-0.1, 0, 0], [1, 0, 0], moving('moving', [0.5, 0, 0]))];
    const scene = sceneWith(surfaces, [[0, 0, 0, 0, 0, 0, 0, 0, 0]], { restitution: 0.6 });
    scene.gravity = 0;
    const { states } = framesOf(scene, PHYSICAL, 0.001, 300).at(-1);
    assert.ok(Math.abs(states[3] / 0.8 - 1) < 0.01, `${states.slice(3, 6)}`);
  }
});

test('a plate that turns throws a ball off with (1 + e) ω L, in every phase of the step', () => {
  const [rate, step, phases, e, arm] = [2, 0.001, 64, 0.6, 0.1];
  const reach = Math.sqrt(arm ** 2 + 0.05 ** 2 - 0.02 ** 2); // of the point that is hit
  const spin = { kind: 'turning', pivot: [0, 0, 0], rate: [0, 0, rate] };
  const starts = Array.from({ length: phases }, (_, k) => {
    // Farther off by a part of what the plate turns in a step.
    const [c, s] = [Math.cos((k / phases) * rate * step), Math.sin((k / phases) * rate * step)];
    return [0.1 * c - 0.05 * s, 0.05 * c + 0.1 * s, 0, 0, 0, 0, 0, 0, 0];
  });
  const scene = sceneWith([plate([arm, 0, 0], [0.1, 0, 0], [0, 0, 0.1], spin)], [starts[0]], { restitution: e });
  scene.gravity = 0;
  const speeds = framesOfStarts(scene, PHYSICAL, step, 300, starts.map((start) => packed([start])))
    .map((frames) => Math.hypot(frames.at(-1).states[3], frames.at(-1).states[4]));
  // Restitution of cannon-es is of the centres' velocities, not of what turning adds to them.
  const expected = rate * (reach + e * (engine === 'cannon-es' ? arm : reach));
  // Havok throws with e only what is nearer than 95 % of the way of a step; the rest lacks the gap.
  const short = engine === 'havok' ? 0.05 / (1 + e) : 0;
  for (const speed of speeds) {
    assert.ok(speed / expected < 1 + 2e-3, speeds.join(' '));
    assert.ok(speed / expected > 1 - 2e-3 - short, speeds.join(' '));
  }
  const exact = speeds.filter((speed) => Math.abs(speed / expected - 1) < 2e-3);
  assert.ok(exact.length >= (engine === 'havok' ? 0.9 : 1) * phases, speeds.join(' '));
});

test('it tells what is applied on each surface', () => {
  const scene = sceneWith([plane([0, 0, 0], [0, 0, 1]), plate([0, 0, 1], [1, 0, 0], [0, 1, 0])],
    [[0, 0, 0.02, 0, 0, 0, 0, 0, 0]], { friction: 0.3, restitution: 0.5 });
  const [one, other] = scene.on_surfaces;
  scene.on_surfaces = [one, { lasting: other.lasting, impact: { ...other.impact, restitution: 0.25 } }];
  const { found: [{ settings }] } = replies([{ type: 'configure', scene, settings: {}, time_step: 0.001 }]);
  assert.equal(settings['surface_restitution[0-0]'], 0.5);
  assert.equal(settings['surface_restitution[0-1]'], 0.25);
});
