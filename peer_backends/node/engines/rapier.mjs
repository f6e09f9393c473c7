// Rapier, package @dimforge/rapier3d-compat: single precision, no rolling or drilling friction.
// Coefficients belong to colliders and are combined by rules; nothing can be changed contact by
// contact from JavaScript. Versions differ in what IntegrationParameters has: the table of settings
// is made from what is there.

import {
  FLOOR, LID, WALL, contactOf, frictionOf, materialPairs, naiveBall, naiveSurface, onSurface,
  pairRestitution, surfaceNames, touchedSurface, whoseOn,
} from '../kit/contacts.mjs';
import { Refused } from '../kit/faults.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { count, flag, number, search, word } from '../kit/settings.mjs';
import { halfOf, isBlock, isSphere, turnFromY, turnOf } from '../kit/solids.mjs';
import { besideSurfaces, hasSubstrate } from '../kit/surfaces.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

const PACKAGE = '@dimforge/rapier3d-compat';

/// Rapier's own default; in versions that have no getter for it
/// (IntegrationParameters::contact_softness, contact_natural_frequency).
const NATURAL_FREQUENCY = 30;

/// A row for each property of IntegrationParameters, by the name that it has there.
const PARAMETERS = {
  erp: (shipped) => number('erp', '', shipped, 'part of an overlap that a step pushes out',
    { high: 1, candidates: [0, 0.1, 0.2, 0.6, 0.8] }),
  contact_natural_frequency: () => number('contact_natural_frequency', '1/s', NATURAL_FREQUENCY,
    'of the spring that pushes an overlap out', { high: 1e9, ...search(0.1, 1000, true) }),
  lengthUnit: (shipped) => number('length_unit', '', shipped,
    'lengths in a metre as Rapier sees it: a factor on all its thresholds that are lengths or speeds',
    { low: 1e-9, high: 1e9, ...search(1e-4, 100, true) }),
  allowedLinearError: (shipped) => number('allowed_linear_error', 'm', shipped,
    'overlap that is left in peace', { candidates: [0, 0.0001, 0.001] }),
  normalizedAllowedLinearError: (shipped) => number('allowed_linear_error', '', shipped,
    'overlap that is left in peace, times length_unit', { candidates: [0, 0.0001, 0.001, 0.005] }),
  predictionDistance: (shipped) => number('prediction_distance', 'm', shipped,
    'gap at which there is a contact', { candidates: [0, 0.0001, 0.002] }),
  normalizedPredictionDistance: (shipped) => number('prediction_distance', '', shipped,
    'gap at which there is a contact, times length_unit', { candidates: [0, 0.0001, 0.002, 0.02] }),
  maxVelocityIterations: (shipped) => count('velocity_iterations', shipped,
    'of contacts, friction among them', { low: 1, high: 1000, candidates: [4, 10, 40] }),
  maxVelocityFrictionIterations: (shipped) => count('velocity_friction_iterations', shipped,
    'of friction', { high: 1000, candidates: [0, 8, 40] }),
  maxStabilizationIterations: (shipped) => count('stabilization_iterations', shipped,
    'after the overlaps have been pushed out', { high: 1000, candidates: [0, 1, 4] }),
  numSolverIterations: (shipped) => count('solver_iterations', shipped,
    'small steps of the solver in a step', { low: 1, high: 1000, candidates: [1, 4, 16] }),
  numAdditionalFrictionIterations: (shipped) => count('additional_friction_iterations', shipped,
    'of friction in the last small step', { high: 1000, candidates: [0, 4, 16] }),
  numInternalPgsIterations: (shipped) => count('internal_pgs_iterations', shipped,
    'sweeps over the contacts in a small step', { low: 1, high: 1000, candidates: [1, 4] }),
  maxCcdSubsteps: (shipped) => count('ccd_substeps', shipped,
    'parts of a step, at most, where bodies are swept', { low: 0, high: 1000, candidates: [] }),
};

const OWN_SETTINGS = [
  word('coefficients', ['fields', 'pair'], 'pair',
    "the scene's coefficients straight in the colliders' fields, which Rapier averages; or exactly, " +
    'pair by pair, through combine rules and collision groups'),
  flag('sleeping', true, 'a body that is slow for two seconds stops'),
  flag('ccd', false, 'bodies are swept'),
  flag('rigid_contacts', false,
    'each small step pushes overlaps out whole: contact_natural_frequency 1e6, or erp 1 where there ' +
    'is none; from 0.20 on not at what is fixed, whose softness cannot be set'),
  flag('contact_recycling', true,
    'a contact of bodies that have hardly moved, by 5 cm times length_unit, is not looked at again ' +
    '(from 0.20 on); off: the colliders have a hook, for which Rapier leaves this out'),
  number('linear_damping', '1/s', 0, 'of each body', { candidates: [] }),
  number('angular_damping', '1/s', 0, 'of each body', { candidates: [] }),
  word('surface_velocity', ['this_step', 'step_end'], 'this_step',
    'velocity of a moving substrate, floor or wall as contacts feel it: the mean over the step ' +
    '(kinematicPositionBased), or that at its end (kinematicVelocityBased)'),
  ...unitSettings,
];

/// Whether this version keeps contacts over steps.
const recycles = (version) => {
  const [major, minor] = version.split('.').map(Number);
  return major > 0 || minor >= 20;
};

/// The settings with what rigid_contacts stands for.
function withRigidContacts(settings) {
  if (!settings.rigid_contacts) return settings;
  return 'erp' in settings ? { ...settings, erp: 1 } : { ...settings, contact_natural_frequency: 1e6 };
}

/// The properties of IntegrationParameters that this version has, each with its row.
function parametersOf(rapier) {
  const world = new rapier.World({ x: 0, y: 0, z: 0 });
  const own = world.integrationParameters;
  const rows = Object.entries(PARAMETERS)
    .filter(([property]) => property in own)
    .map(([property, make]) => ({ property, row: make(shortest(own[property])) }));
  world.free();
  return rows;
}

/// The shortest decimal number that is this one in single precision: 0.1 for 0.10000000149011612.
function shortest(single) {
  for (let digits = 1; digits < 9; ++digits) {
    const candidate = Number(single?.toPrecision(digits));
    if (Math.fround(candidate) === single) return candidate;
  }
  return single;
}

const vector = ([x, y, z]) => ({ x, y, z });
const turn = ([x, y, z, w]) => ({ x, y, z, w });
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };

export async function open(folder) {
  const rapier = await load(folder, PACKAGE);
  await rapier.init();
  return new RapierEngine(rapier, versionOf(folder, PACKAGE));
}

class RapierEngine {
  constructor(rapier, version) {
    this.rapier = rapier;
    this.version = version;
    this.precision = 'single';
    this.takes = ['block', 'cylinder', 'surfaces'];
    this.parameters = parametersOf(rapier);
    const own = OWN_SETTINGS.map((row) => (row.name === 'contact_recycling' && !recycles(version)
      ? { ...row, shipped: false, candidates: [] } : row));
    this.settings = [own[0], ...this.parameters.map(({ row }) => row), ...own.slice(1)];
    this.world = undefined;
  }

  configure(scene, settings, timeStep) {
    if (scene.periodic.some((length) => length > 0))
      throw new Refused(
        'rapier: the substrate repeats itself, and a Rapier world has no periodic boundaries');
    if (settings.contact_recycling && !recycles(this.version))
      throw new Refused(`rapier: contact_recycling is there from 0.20 on, and this is ${this.version}`);
    this.#leave();
    this.units = new Units(scene, settings);
    this.chosen = withRigidContacts(settings);
    this.hooks = recycles(this.version) && !settings.contact_recycling ? this.#hooks() : undefined;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.contacts = settings.coefficients === 'fields' ? asTyped(scene) : byPair(scene);
    this.start(scene.initial, 0);
    return {
      settings: this.#applied(scene, timeStep),
      not_represented: lacks(scene, timeStep, {
        surfaceVelocity: settings.surface_velocity === 'step_end',
        sweeps: settings.ccd,
      }),
      left_out: [],
    };
  }

  start(states, time) {
    this.#leave();
    const { rapier, scene, chosen, units } = this;
    const world = new rapier.World(vector(gravityOf(scene)));
    this.world = world;
    this.events = new rapier.EventQueue(true); // each step begins with an empty one
    world.timestep = this.timeStep;
    for (const { property, row } of this.parameters)
      world.integrationParameters[property] = chosen[row.name];
    this.startTime = time * units.time;
    this.steps = 0;
    this.bodyOf = new Map(); // by a collider's handle: a body's index, or a surface
    this.#addSurfaces();
    const factors = units.ofState;
    this.balls = scene.bodies.map((_, i) =>
      this.#addBall(i, Array.from(states.subarray(9 * i, 9 * i + 9), (value, k) => value * factors[k])));
  }

  step() {
    this.#moveSurfaces();
    this.world.step(this.events, this.hooks);
    ++this.steps;
  }

  read(states, touches) {
    const factors = this.units.ofState;
    this.balls.forEach((body, i) => {
      const parts = [body.translation(), body.linvel(), body.angvel()];
      parts.forEach(({ x, y, z }, p) => {
        const at = 9 * i + 3 * p;
        states[at] = x / factors[3 * p];
        states[at + 1] = y / factors[3 * p];
        states[at + 2] = z / factors[3 * p];
      });
    });
    const found = new Touches(this.scene);
    // Contacts cannot be asked: before 0.18 a step looks for those of the next step at its end.
    this.events.drainContactForceEvents((event) => {
      const [i, j] = [event.collider1(), event.collider2()].map((handle) => this.bodyOf.get(handle));
      const impulse = event.totalForceMagnitude() * this.timeStep;
      if (i >= 0) found.add(i, j, impulse);
      else found.add(j, i, impulse);
    });
    found.pushTo(touches, 1 / this.units.impulse);
  }

  /// Every contact is solved.
  #hooks() {
    const flags = this.rapier.SolverFlags.COMPUTE_IMPULSE;
    return { filterContactPair: () => flags, filterIntersectionPair: () => true };
  }

  #leave() {
    this.world?.free();
    this.events?.free();
    this.world = this.events = undefined;
  }

  #addBall(i, [x, y, z, vx, vy, vz, wx, wy, wz]) {
    const { rapier, world, scene, chosen, contacts } = this;
    const { radius, mass, shape_factor, material } = scene.bodies[i];
    const isRound = isSphere(scene.bodies[i]);
    const desc = rapier.RigidBodyDesc.dynamic()
      .setTranslation(x, y, z)
      .setLinvel(vx, vy, vz)
      .setAngvel({ x: wx, y: wy, z: wz })
      .setCanSleep(chosen.sleeping)
      .setCcdEnabled(chosen.ccd)
      .setLinearDamping(chosen.linear_damping)
      .setAngularDamping(chosen.angular_damping);
    if (scene.box) desc.enabledTranslations(true, false, true).enabledRotations(false, true, false);
    const body = world.createRigidBody(desc);
    contacts.balls(i, material).forEach((contact, k) => {
      const shape = this.#withContact(this.#shapeOf(scene.bodies[i]), contact);
      if (k > 0) shape.setMass(0);
      else if (!isRound || shape_factor === 0.4) shape.setMass(mass);
      else {
        const inertia = shape_factor * mass * radius * radius;
        shape.setMassProperties(mass, vector([0, 0, 0]), vector([inertia, inertia, inertia]), NO_TURN);
      }
      shape.setActiveEvents(rapier.ActiveEvents.CONTACT_FORCE_EVENTS).setContactForceEventThreshold(0);
      this.bodyOf.set(world.createCollider(shape, body).handle, i);
    });
    return body;
  }

  /// Turned in its body, whose axes are the world's at the start.
  #shapeOf(body) {
    const { ColliderDesc: desc } = this.rapier;
    if (isSphere(body)) return desc.ball(body.radius);
    const [x, y, z] = halfOf(body);
    const turned = (shape, [qx, qy, qz, qw]) => shape.setRotation({ x: qx, y: qy, z: qz, w: qw });
    return isBlock(body) ? turned(desc.cuboid(x, y, z), turnOf(body))
      : turned(desc.cylinder(x, y), turnFromY(body));
  }

  #addSurfaces() {
    const { box } = this.scene;
    this.motion = surfaceMotion(this.scene);
    this.moving = [];
    const moves = !this.motion.isStill;
    if (hasSubstrate(this.scene)) this.#addSurface(FLOOR, [0, 0, 1], [0, 0, 0], moves);
    this.beside = besideSurfaces(this.scene).map((surface) => this.#addBeside(surface));
    if (!box) return;
    this.#addSurface(WALL, [1, 0, 0], [0, 0, 0], moves && box.moving_walls);
    this.#addSurface(WALL, [-1, 0, 0], [box.width, 0, 0], moves && box.moving_walls);
    if (box.lid) this.#addSurface(LID, [0, 0, -1], [0, 0, box.lid], moves && box.moving_walls);
  }

  /// A half-space with a collider for each sort of contact on it.
  #addSurface(surface, normal, place, moves) {
    const { rapier, world } = this;
    const { RigidBodyDesc: desc } = rapier;
    const kinematic = this.#movesByPosition() ? 'kinematicPositionBased' : 'kinematicVelocityBased';
    const [x, y, z] = moves ? added(place, this.motion.position(this.startTime)) : place;
    const body = world.createRigidBody((moves ? desc[kinematic]() : desc.fixed()).setTranslation(x, y, z));
    if (moves) this.moving.push({ body, place });
    for (const contact of this.contacts.surfaces(surface)) {
      const shape = this.#withContact(new rapier.ColliderDesc(new rapier.HalfSpace(vector(normal))), contact);
      this.bodyOf.set(world.createCollider(shape, body).handle, surface);
    }
  }

  /// A half-space, a cuboid of as good as no thickness, a cylinder or a ball.
  #shapeOfSurface({ shape, extent }) {
    const { rapier } = this;
    switch (shape.kind) {
      case 'plane': return new rapier.HalfSpace(vector([0, 0, 1]));
      case 'rectangle': return new rapier.Cuboid(...extent);
      case 'rod': return new rapier.Cylinder(extent[2], shape.radius);
      default: return new rapier.Ball(shape.radius);
    }
  }

  #addBeside(surface) {
    const { rapier, world } = this;
    const { RigidBodyDesc: desc } = rapier;
    const kinematic = this.#movesByPosition() ? 'kinematicPositionBased' : 'kinematicVelocityBased';
    const body = world.createRigidBody(
      (surface.isStill ? desc.fixed() : desc[kinematic]())
        .setTranslation(...surface.centre(this.startTime))
        .setRotation(turn(surface.quaternion(this.startTime, 'y'))));
    for (const contact of this.contacts.surfaces(surface.touch)) {
      const shape = this.#withContact(new rapier.ColliderDesc(this.#shapeOfSurface(surface)), contact);
      this.bodyOf.set(world.createCollider(shape, body).handle, surface.touch);
    }
    return { surface, body };
  }

  /// A belt stays where it is, and so begins each step there.
  #moveBeside(now) {
    for (const { surface, body } of this.beside) {
      if (surface.isStill) continue;
      const centre = surface.centre(now);
      const mean = this.#movesByPosition();
      const velocity = surface.stepVelocity(now, this.timeStep, centre, mean);
      body.setTranslation(vector(centre), true);
      if (surface.turns) body.setRotation(turn(surface.quaternion(now, 'y')), true);
      if (mean) {
        body.setNextKinematicTranslation(vector(centre.map((x, k) => x + velocity[k] * this.timeStep)));
        if (surface.turns) body.setNextKinematicRotation(turn(surface.quaternion(now + this.timeStep, 'y')));
      } else {
        body.setLinvel(vector(velocity), true);
        body.setAngvel(vector(surface.rate), true);
      }
    }
  }

  #movesByPosition() {
    return this.chosen.surface_velocity === 'this_step';
  }

  #withContact(desc, { friction, restitution, frictionRule, restitutionRule, groups }) {
    const rules = this.rapier.CoefficientCombineRule;
    desc.setFriction(friction).setRestitution(restitution);
    if (frictionRule) desc.setFrictionCombineRule(rules[frictionRule]);
    if (restitutionRule) desc.setRestitutionCombineRule(rules[restitutionRule]);
    if (groups !== undefined) desc.setCollisionGroups(groups);
    if (this.hooks) desc.setActiveHooks(this.rapier.ActiveHooks.FILTER_CONTACT_PAIRS);
    return desc;
  }

  #moveSurfaces() {
    const now = this.startTime + this.steps * this.timeStep;
    this.#moveBeside(now);
    if (this.moving.length === 0) return;
    const then = now + this.timeStep;
    for (const { body, place } of this.moving) {
      if (this.#movesByPosition()) {
        body.setNextKinematicTranslation(vector(added(place, this.motion.position(then))));
      } else {
        body.setTranslation(vector(added(place, this.motion.position(now))), true);
        body.setLinvel(vector(this.motion.velocity(then)), true);
      }
    }
  }

  #applied(scene, timeStep) {
    const [x, y] = scene.downhill;
    return {
      ...this.chosen,
      ...this.contacts.applied,
      ...this.units.applied(),
      time_step: timeStep,
      gravity: scene.gravity,
      ...(x !== 0 || y !== 0 ? { downhill_x: x, downhill_y: y } : {}),
    };
  }
}

const added = (a, b) => a.map((value, k) => value + b[k]);

/// Coefficients as people type them: one pair of fields for each body and surface, averaged.
function asTyped(scene) {
  const balls = scene.bodies.map((_, i) => naiveBall(scene, i));
  const applied = new Gathered();
  balls.forEach(({ friction, restitution }, i) => {
    applied.add('body_friction', i, friction);
    applied.add('body_restitution', i, restitution);
  });
  for (const [surface, name] of surfaceNames(scene)) {
    const whose = name === 'surface' ? touchedSurface(surface) : surface;
    applied.add(`${name}_friction`, whose, naiveSurface(scene, surface).friction);
    applied.add(`${name}_restitution`, whose, naiveSurface(scene, surface).restitution);
  }
  return {
    balls: (i) => [balls[i]],
    surfaces: (surface) => [naiveSurface(scene, surface)],
    applied: applied.settings(),
  };
}

const alike = (a, b) => a.friction === b.friction && a.restitution === b.restitution;

/// The scene's coefficients exactly, from what colliders and their rules can do.
///
/// Two colliders with the same value v combine to v by each rule. A surface's collider has the value
/// s and the rule Min where s <= v, Max else; of two rules the later of Average, Min, Multiply, Max
/// is taken: it is s. Where pairs of materials differ a ball has a collider for each, and collision
/// groups let those meet that belong together.
function byPair(scene) {
  const pairs = materialPairs(scene).map(([i, j]) => ({
    a: scene.bodies[i].material,
    b: scene.bodies[j].material,
    friction: frictionOf(contactOf(scene, i, j)),
    restitution: pairRestitution(scene, i, j),
    name: `${i}-${j}`,
  }));
  const sorts = sortsOf(scene, pairs);
  const firstOf = scene.substrate.map((_, material) => scene.bodies.findIndex((b) => b.material === material));
  const applied = new Gathered();
  for (const { name, friction, restitution } of pairs) {
    applied.add('restitution', name, restitution);
    applied.add('pair_friction', name, friction);
  }
  for (const [surface, name] of surfaceNames(scene)) {
    for (const body of firstOf.filter((i) => i >= 0)) {
      const { friction, restitution } = onSurface(scene, body, surface);
      const whose = whoseOn(name, body, surface);
      applied.add(name === 'substrate' ? 'friction' : `${name}_friction`, whose, friction);
      applied.add(`${name}_restitution`, whose, restitution);
    }
  }
  return {
    balls: (_, material) => sorts.balls[material],
    surfaces: (surface) => sorts.surfaces(surface, firstOf),
    applied: applied.settings(),
  };
}

const GROUPS = 16;
const inGroups = (member, filter) => ((member << 16) | filter) >>> 0;

/// Colliders of each material's balls, and of surfaces.
function sortsOf(scene, pairs) {
  const materials = scene.substrate.length;
  const isUniform = pairs.every((pair) => alike(pair, pairs[0]));
  const groups = materials === 1 && isUniform ? undefined : allot(materials, pairs, isUniform);
  const balls = scene.substrate.map((_, material) => {
    if (isUniform) {
      const value = pairs[0] ?? { friction: 0, restitution: 0 };
      return [{ ...fieldsOf(value), groups: groups?.ball(material) }];
    }
    return groups.collidersOf(material);
  });
  // A ball's first collider is the one that meets surfaces.
  const surfaces = (surface, firstOf) => {
    const found = [];
    firstOf.forEach((body, material) => {
      if (body < 0) return;
      const value = fieldsOf(onSurface(scene, body, surface));
      const ball = balls[material][0];
      const contact = {
        ...value,
        frictionRule: value.friction <= ball.friction ? 'Min' : 'Max',
        restitutionRule: value.restitution <= ball.restitution ? 'Min' : 'Max',
      };
      const same = found.find((each) => alike(each, contact) &&
        each.frictionRule === contact.frictionRule && each.restitutionRule === contact.restitutionRule);
      if (same) same.materials.push(material);
      else found.push({ ...contact, materials: [material] });
    });
    return found.map(({ materials: those, ...contact }) => ({
      ...contact, groups: groups?.surface(those),
    }));
  };
  return { balls, surfaces };
}

const fieldsOf = ({ friction, restitution }) => ({ friction, restitution });

/// Collision groups: a bit for each material, by which its balls meet surfaces, and bits by which
/// balls meet balls: one in all where their contacts are uniform; else one for each material with
/// itself and two, one for each side, for two materials.
function allot(materials, pairs, isUniform) {
  const all = (1 << GROUPS) - 1;
  const surface = (those) => {
    const bits = those.reduce((sum, material) => sum | (1 << material), 0);
    return inGroups(bits, bits);
  };
  const sides = isUniform ? 1 : pairs.reduce((sum, { a, b }) => sum + (a === b ? 1 : 2), 0);
  if (materials + sides > GROUPS)
    throw new Refused(
      `rapier: contacts of ${materials} materials need ${materials + sides} collision groups, and ` +
      `Rapier has ${GROUPS}`);
  if (isUniform) {
    const common = 1 << materials;
    return { surface, ball: (material) => inGroups(common | (1 << material), (common | (1 << material)) & all) };
  }
  let next = materials;
  const colliders = Array.from({ length: materials }, () => []);
  for (const pair of pairs) {
    const one = 1 << next++;
    const other = pair.a === pair.b ? one : 1 << next++;
    colliders[pair.a].push({ ...fieldsOf(pair), bits: [one, other] });
    if (pair.a !== pair.b) colliders[pair.b].push({ ...fieldsOf(pair), bits: [other, one] });
  }
  return {
    surface,
    collidersOf: (material) => {
      const own = colliders[material].length > 0
        ? colliders[material] : [{ friction: 0, restitution: 0, bits: [0, 0] }];
      return own.map(({ bits: [member, filter], ...contact }, k) => {
        const meetsSurfaces = k === 0 ? 1 << material : 0;
        return { ...contact, groups: inGroups(member | meetsSurfaces, filter | meetsSurfaces) };
      });
    },
  };
}
