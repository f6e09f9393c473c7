// What of a scene an engine cannot express, in the words that all engines use for it.

import {
  FLOOR, LID, WALL, contactOf, dependsOnSpeed, groundOf, lastingOf, materialPairs, surfaceTouch,
} from './contacts.mjs';
import { rounded } from './text.mjs';

const bounces = (contact) => dependsOnSpeed(contact) || contact.restitution > 0;

/// Slip is neither kept (β0 = -1) nor just stopped (β0 = 0).
const reversesSlip = ({ friction, tangential_restitution }) =>
  friction > 0 && tangential_restitution !== 0 && tangential_restitution !== -1;

/// Each body with each surface beside the substrate.
const contactsBeside = (scene) =>
  scene.bodies.flatMap((_, i) => (scene.surfaces ?? []).map((__, k) => [i, surfaceTouch(k)]));

/// What bodies have while they lie somewhere.
function groundsOf(scene) {
  if (scene.box) return [];
  const below = scene.has_substrate === false ? [] : scene.bodies.map((_, i) => groundOf(scene, i));
  return [...new Set([...below, ...contactsBeside(scene).map(([i, touch]) => lastingOf(scene, i, touch))])];
}

const SWINGS = ['oscillation', 'table'];

/// Whether a body may go further than its radius in a step, by its speed at the start or after a fall
/// to the lowest plate, so that its centre passes a plate before the engine looks again.
function canPassAPlate(scene, timeStep) {
  const plates = (scene.surfaces ?? []).filter(({ shape }) => shape.kind === 'rectangle');
  return plates.some(({ shape }) => {
    const lowest = shape.centre[2] - Math.abs(shape.half_length[2]) - Math.abs(shape.half_width[2]);
    return scene.bodies.some(({ radius }, i) => {
      const state = scene.initial.subarray(9 * i, 9 * i + 9);
      const fall = 2 * scene.gravity * Math.max(0, state[2] - lowest);
      return Math.sqrt(state[3] ** 2 + state[4] ** 2 + state[5] ** 2 + fall) * timeStep > radius;
    });
  });
}

/// All contacts there are in a scene, of one body or two for each kind.
function* contactsOf(scene) {
  for (const [i, j] of materialPairs(scene)) yield contactOf(scene, i, j);
  for (const [body, touch] of contactsBeside(scene)) yield contactOf(scene, body, touch);
  if (!scene.box) return;
  const surfaces = scene.box.lid ? [FLOOR, WALL, LID] : [FLOOR, WALL];
  for (let i = 0; i < scene.bodies.length; ++i)
    for (const surface of surfaces) yield contactOf(scene, i, surface);
}

/// Whether a body may go further than its radius in a step, so that it can be on the far side of
/// another before the engine looks again: by its speed at the start, after a fall to the floor, or on
/// being hit by the floor.
function canPassInAStep(scene, timeStep) {
  const { amplitude, frequency } = scene.box.floor;
  return scene.bodies.some(({ radius }, i) => {
    const state = scene.initial.subarray(9 * i, 9 * i + 9);
    const fall = Math.max(0, 2 * scene.gravity * state[2]);
    const own = Math.sqrt(state[3] ** 2 + state[4] ** 2 + state[5] ** 2 + fall);
    return Math.max(own, 2 * Math.PI * frequency * amplitude) * timeStep > radius;
  });
}

/// What the scene's bodies need of the engine, each found on any of them.
function needsOf(scene, timeStep) {
  const contacts = [...contactsOf(scene)];
  const grounds = groundsOf(scene);
  const rolls = ({ rolling }) => rolling.some(([, mu]) => mu > 0);
  return {
    staticFriction: grounds.some((each) => each.static_friction !== each.kinetic_friction),
    rolling: grounds.some(rolls),
    rollingOnly: grounds.some((each) => rolls(each) && !each.rolling_while_sliding),
    rollingTable: grounds.some(({ rolling }) => rolling.some(([, mu]) => mu !== rolling[0][1])),
    drilling: grounds.some((each) => each.drilling_length > 0),
    coupledDrilling: grounds.some((each) => each.coupled_radius > 0),
    bounce: grounds.some((each) => each.restitution > 0) || contacts.some(bounces),
    bounceLaw: contacts.some(dependsOnSpeed),
    reversedSlip: contacts.some(reversesSlip),
    movingFloor: Boolean(scene.box) && scene.box.floor.amplitude > 0 && scene.box.floor.frequency > 0,
    movingSubstrate: scene.motion.kind !== 'still',
    swingingSurface: (scene.surfaces ?? []).some(({ motion }) => SWINGS.includes(motion.course?.kind)),
    throughInAStep: canPassAPlate(scene, timeStep),
    farInAStep: Boolean(scene.box) && canPassInAStep(scene, timeStep),
  };
}

/// Texts and kinds of what is lacking. Abilities that an engine has not are left out:
///   rolling, drilling, coupledDrilling   friction of that sort
///   rollingOnly      rolling friction that spares what slides
///   rollingTable     rolling friction that depends on the speed
///   staticFriction   a coefficient of its own for what sticks
///   bounceLaw        restitution that depends on the impact speed
///   tangentialRestitution, confinement
///   surfaceVelocity  that of a moving surface is the one at the end of the step
///   sweeps           bodies are found that pass each other within a step
/// and `threshold` is the approach below which nothing rebounds [m/s].
export function lacks(scene, timeStep, abilities) {
  const needs = needsOf(scene, timeStep);
  const missing = [];
  const note = (condition, kind, why) => {
    if (condition) missing.push({ text: why ? `${kind} (${why})` : kind, kind });
  };
  const can = abilities;
  note(needs.staticFriction && !can.staticFriction, 'static friction',
    'one coefficient for sticking and sliding');
  note(needs.rolling && !can.rolling, 'rolling friction', 'the engine has none');
  note(needs.drilling && !can.drilling, 'drilling friction', 'the engine has none');
  if (can.drilling && !can.coupledDrilling)
    note(needs.coupledDrilling, 'coupled drilling', 'torque and friction are full, each by itself');
  if (can.rolling && !can.rollingOnly)
    note(needs.rollingOnly, 'rolling friction only while rolling', 'it acts while sliding too');
  if (needs.bounce && can.threshold > 0)
    missing.push({
      text: `restitution below ${rounded(can.threshold, 3)} m/s of approach`,
      kind: 'restitution below … m/s of approach',
    });
  note(needs.reversedSlip && !can.tangentialRestitution, 'tangential restitution',
    'friction only stops the slip');
  note(scene.confined && !can.confinement, 'confinement to the plane');
  note(needs.movingFloor && !can.surfaceVelocity, "the floor's velocity at the contact",
    'it is the mean over the step');
  note(needs.movingSubstrate && !can.surfaceVelocity,
    "the substrate's velocity at the end of a step", 'it is the mean over the step');
  note(needs.swingingSurface && !can.surfaceVelocity, "a surface's velocity at the end of a step",
    'it is the mean over the step');
  note(needs.throughInAStep && !can.sweeps, 'plates that a body passes within a step');
  note(needs.farInAStep && !can.sweeps, 'collisions of bodies that pass each other within a step');
  if (can.rolling && !can.rollingTable)
    note(needs.rollingTable, 'rolling friction that depends on the speed');
  note(needs.bounceLaw && !can.bounceLaw, 'restitution that depends on the impact speed');
  return missing;
}
