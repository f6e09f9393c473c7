// Jolt Physics, package jolt-physics: single precision, no rolling or drilling friction. A contact
// listener sets friction, restitution and the velocity of moving surfaces contact by contact.

import {
  FLOOR, LID, WALL, contactOf, dependsOnSpeed, frictionOf, groundOf, materialPairs, naiveBall,
  naiveSurface, onSurface, restitutionAt, surfaceNames, touchedSurface, whoseOn,
} from '../kit/contacts.mjs';
import { explainedImpulses } from '../kit/explained_impulses.mjs';
import { Refused } from '../kit/faults.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { count, flag, number, word } from '../kit/settings.mjs';
import { besideSurfaces, farthest, hasSubstrate, planeEnds } from '../kit/surfaces.mjs';
import { rounded } from '../kit/text.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

const PACKAGE = 'jolt-physics';
const LAYER = 0; // everything meets everything

/// The principal moments of a sphere are taken for zero where the length of their vector is below
/// 1e-6 (MotionProperties::SetMassProperties, Vec3::IsNearZero).
const LEAST_INERTIA = 1e-6 / Math.sqrt(3);

/// Rows that are members of PhysicsSettings, which has their values.
const WORLD_SETTINGS = {
  mBaumgarte: (shipped) => number('baumgarte', '', shipped,
    'part of an overlap that a step pushes out, without a velocity', { high: 1, candidates: [0, 0.2, 0.8] }),
  mSpeculativeContactDistance: (shipped) => number('speculative_contact_distance', 'm', shipped,
    'gap at which there is a contact', { candidates: [0, 0.0001, 0.02] }),
  mPenetrationSlop: (shipped) => number('penetration_slop', 'm', shipped,
    'overlap that is left in peace', { candidates: [0, 0.0001, 0.02] }),
  mNumVelocitySteps: (shipped) => count('velocity_steps', shipped, 'iterations of the velocities',
    { low: 2, high: 1000, candidates: [2, 10, 40] }),
  mNumPositionSteps: (shipped) => count('position_steps', shipped, 'iterations of the positions',
    { high: 1000, candidates: [0, 2, 10] }),
  mMinVelocityForRestitution: (shipped) => number('min_velocity_for_restitution', 'm/s', shipped,
    'approach below which nothing rebounds', { candidates: [0, 0.01, 1] }),
  mConstraintWarmStart: (shipped) => flag('warm_starting', shipped,
    'the solver begins with the impulses of the step before'),
  mUseBodyPairContactCache: (shipped) => flag('body_pair_contact_cache', shipped,
    'a contact of bodies that have hardly moved (1 mm, 2 degrees) is not looked at again'),
  mAllowSleeping: (shipped) => flag('sleeping', shipped, 'a body that is slow for a while stops'),
  mTimeBeforeSleep: (shipped) => number('time_before_sleep', 's', shipped, 'that while', { candidates: [] }),
  mPointVelocitySleepThreshold: (shipped) => number('point_velocity_sleep_threshold', 'm/s', shipped,
    'speed of the fastest point below which a body is slow', { candidates: [] }),
};

/// Rows that are members of BodyCreationSettings.
const BODY_SETTINGS = {
  mLinearDamping: (shipped) => number('linear_damping', '1/s', shipped, 'of each body', { candidates: [0, 0.05] }),
  mAngularDamping: (shipped) => number('angular_damping', '1/s', shipped, 'of each body', { candidates: [0, 0.05] }),
  mMaxLinearVelocity: (shipped) => number('max_linear_velocity', 'm/s', shipped,
    'at which a velocity is cut', { high: 1e18, candidates: [] }),
  mMaxAngularVelocity: (shipped) => number('max_angular_velocity', 'rad/s', shipped,
    'at which an angular velocity is cut', { high: 1e18, candidates: [47.123889, 1e9] }),
};

const OWN_SETTINGS = [
  word('coefficients', ['fields', 'pair'], 'pair',
    "the scene's coefficients straight in the bodies' fields, of which Jolt takes the geometric mean " +
    '(friction) and the larger (restitution); or exactly, contact by contact, by a listener'),
  count('collision_steps', 1, "equal steps of Jolt's in each step", { low: 1, high: 10000, candidates: [1, 2, 4] }),
  flag('linear_cast', false, 'bodies are swept'),
  word('surface_velocity', ['this_step', 'step_end'], 'this_step',
    'velocity of a moving substrate, floor or wall as contacts feel it: the mean over the step, or ' +
    'that at its end'),
  ...unitSettings,
];

/// The shortest decimal number that is this one in single precision.
function shortest(single) {
  if (typeof single !== 'number') return single;
  for (let digits = 1; digits < 9; ++digits) {
    const candidate = Number(single.toPrecision(digits));
    if (Math.fround(candidate) === single) return candidate;
  }
  return single;
}

const rowsOf = (made, from) =>
  Object.entries(made).map(([member, make]) => ({ member, row: make(shortest(from[member])) }));

export async function open(folder) {
  const start = await load(folder, PACKAGE);
  return new JoltEngine(await start(), versionOf(folder, PACKAGE));
}

class JoltEngine {
  constructor(jolt, version) {
    this.jolt = jolt;
    this.version = version;
    this.precision = 'single';
    this.takes = ['surfaces'];
    const world = new jolt.PhysicsSettings();
    const body = new jolt.BodyCreationSettings();
    this.worldRows = rowsOf(WORLD_SETTINGS, world);
    this.bodyRows = rowsOf(BODY_SETTINGS, body);
    jolt.destroy(world);
    jolt.destroy(body);
    this.settings = [OWN_SETTINGS[0], ...this.worldRows.map(({ row }) => row),
      ...this.bodyRows.map(({ row }) => row), ...OWN_SETTINGS.slice(1)];
  }

  configure(scene, settings, timeStep) {
    if (scene.periodic.some((length) => length > 0))
      throw new Refused(
        'jolt: the substrate repeats itself, and a Jolt world has no periodic boundaries');
    this.units = new Units(scene, settings);
    this.chosen = settings;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.asTyped = settings.coefficients === 'fields';
    this.start(scene.initial, 0);
    return {
      settings: this.#applied(scene, timeStep),
      not_represented: [
        ...lacks(scene, timeStep, {
          threshold: settings.min_velocity_for_restitution / this.units.speed,
          bounceLaw: !this.asTyped,
          surfaceVelocity: settings.surface_velocity === 'step_end',
          sweeps: settings.linear_cast,
        }),
        ...this.#ownLacks(scene),
      ],
      left_out: [],
    };
  }

  start(states, time) {
    this.#leave();
    const { jolt, scene, units } = this;
    this.#makeWorld();
    this.startTime = time * units.time;
    this.steps = 0;
    this.indexOf = new Map(); // by a body's pointer: a body's index, or a surface
    this.motion = surfaceMotion(scene);
    this.moving = [];
    this.#addSurfaces();
    const factors = units.ofState;
    this.before = states.map((value, k) => value * factors[k % 9]);
    this.balls = scene.bodies.map((_, i) => this.#addBall(i, this.before.subarray(9 * i, 9 * i + 9)));
    this.contacts = [];
    this.surfaceSlip = new jolt.Vec3(0, 0, 0);
  }

  step() {
    this.contacts.length = 0;
    this.#moveSurfaces();
    this.world.Step(this.timeStep, this.chosen.collision_steps);
    ++this.steps;
  }

  read(states, touches) {
    const now = this.#look();
    const factors = this.units.ofState;
    now.forEach((value, k) => (states[k] = value / factors[k % 9]));
    const found = new Touches(this.scene);
    for (const [i, j, impulse] of this.#impulses(now)) found.add(i, j, impulse);
    found.pushTo(touches, 1 / this.units.impulse);
    this.before = now;
  }

  #leave() {
    if (!this.world) return;
    this.jolt.destroy(this.world);
    this.jolt.destroy(this.listener);
    this.jolt.destroy(this.surfaceSlip);
    this.world = undefined;
  }

  #makeWorld() {
    const { jolt, scene, chosen } = this;
    const settings = new jolt.JoltSettings();
    const count = scene.bodies.length;
    settings.mMaxBodies = count + 16;
    settings.mMaxBodyPairs = Math.max(1024, 64 * count);
    settings.mMaxContactConstraints = Math.max(1024, 32 * count);
    if ('mMaxWorkerThreads' in settings) settings.mMaxWorkerThreads = 0;
    const pairs = new jolt.ObjectLayerPairFilterTable(1);
    pairs.EnableCollision(LAYER, LAYER);
    const phase = new jolt.BroadPhaseLayer(0);
    const phases = new jolt.BroadPhaseLayerInterfaceTable(1, 1);
    phases.MapObjectToBroadPhaseLayer(LAYER, phase);
    jolt.destroy(phase);
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = phases;
    settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(phases, 1, pairs, 1);
    this.world = new jolt.JoltInterface(settings);
    jolt.destroy(settings);
    const system = this.world.GetPhysicsSystem();
    const own = system.GetPhysicsSettings();
    for (const { member, row } of this.worldRows) own[member] = chosen[row.name];
    system.SetPhysicsSettings(own);
    this.#withVector(gravityOf(scene), (gravity) => system.SetGravity(gravity));
    this.#listen(system);
    this.bodies = system.GetBodyInterface();
  }

  #withVector([x, y, z], use, Vector = this.jolt.Vec3) {
    const vector = new Vector(x, y, z);
    const result = use(vector);
    this.jolt.destroy(vector);
    return result;
  }

  #listen(system) {
    const { jolt } = this;
    const listener = new jolt.ContactListenerJS();
    const meet = (first, second, manifold, settings) => this.#meet(first, second, manifold, settings);
    listener.OnContactValidate = () => jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
    listener.OnContactAdded = meet;
    listener.OnContactPersisted = meet;
    listener.OnContactRemoved = () => {};
    system.SetContactListener(listener);
    this.listener = listener;
  }

  /// Two bodies in a contact that the step will solve, as pointers.
  #meet(firstPointer, secondPointer, manifoldPointer, settingsPointer) {
    const { jolt } = this;
    const a = this.indexOf.get(firstPointer);
    const b = this.indexOf.get(secondPointer);
    const manifold = jolt.wrapPointer(manifoldPointer, jolt.ContactManifold);
    const normal = manifold.mWorldSpaceNormal;
    // From the first body to the second.
    const along = [normal.GetX(), normal.GetY(), normal.GetZ()];
    const isFirst = a >= 0;
    const [i, j] = isFirst ? [a, b] : [b, a];
    const towards = isFirst ? along.map((value) => -value) : along;
    const gap = -manifold.mPenetrationDepth;
    this.contacts.push({ i, j, normal: towards, gap });
    const settings = jolt.wrapPointer(settingsPointer, jolt.ContactSettings);
    if (!this.asTyped) {
      settings.mCombinedFriction = this.#friction(i, j);
      settings.mCombinedRestitution = this.#restitution(i, j, towards);
    }
    const slips = this.#slips(i, j, towards);
    if (slips) {
      // Of the second body relative to the first.
      this.surfaceSlip.Set(...(isFirst ? slips : slips.map((value) => -value)));
      settings.mRelativeLinearSurfaceVelocity = this.surfaceSlip;
    }
  }

  /// How matter moves where a body touches it that passes by while its shape stays.
  #slips(i, j, normal) {
    if (j === FLOOR) return this.slides;
    if (j >= 0 || this.scene.box) return undefined;
    const { surface, slides } = this.beside[touchedSurface(j)];
    if (!slides) return undefined;
    return surface.turns ? this.#surfaceVelocity(i, j, normal) : slides;
  }

  #friction(i, j) {
    if (j < 0 && !this.scene.box) return onSurface(this.scene, i, j).friction;
    return frictionOf(contactOf(this.scene, i, j));
  }

  #restitution(i, j, normal) {
    if (j === FLOOR && !this.scene.box) return groundOf(this.scene, i).restitution;
    const contact = contactOf(this.scene, i, j);
    if (!dependsOnSpeed(contact)) return contact.restitution;
    return restitutionAt(contact.restitution, Math.max(0, this.#approach(i, j, normal)));
  }

  /// Velocity with which two bodies approach each other, without what gravity has added in this step
  /// to the one that meets a surface.
  #approach(i, j, normal) {
    const first = this.balls[i].GetLinearVelocity();
    const v = [first.GetX(), first.GetY(), first.GetZ()];
    let other = [0, 0, 0];
    if (j >= 0) {
      const second = this.balls[j].GetLinearVelocity();
      other = [second.GetX(), second.GetY(), second.GetZ()];
    } else {
      other = this.#surfaceVelocity(i, j, normal);
      const length = this.timeStep / this.chosen.collision_steps;
      gravityOf(this.scene).forEach((g, axis) => (v[axis] -= Math.min(0, g * normal[axis]) * length * normal[axis]));
    }
    return -v.reduce((sum, value, axis) => sum + (value - other[axis]) * normal[axis], 0);
  }

  /// Where a body touches it.
  #surfaceVelocity(i, j, normal) {
    if (this.#isMoving(j)) return this.velocityNow;
    if (j === FLOOR || this.scene.box) return [0, 0, 0];
    const { surface } = this.beside[touchedSurface(j)];
    const at = this.balls[i].GetPosition();
    const { radius } = this.scene.bodies[i];
    const point = [at.GetX(), at.GetY(), at.GetZ()].map((x, axis) => x - radius * normal[axis]);
    return surface.velocity(this.startTime + (this.steps + 1) * this.timeStep, point);
  }

  #isMoving(surface) {
    return !this.motion.isStill && Boolean(this.scene.box) && (surface === FLOOR || this.scene.box.moving_walls);
  }

  #addBall(i, [x, y, z, vx, vy, vz, wx, wy, wz]) {
    const { jolt, scene, chosen } = this;
    const { radius, mass, shape_factor } = scene.bodies[i];
    const settings = this.#creation(new jolt.SphereShape(radius), [x, y, z], jolt.EMotionType_Dynamic);
    for (const { member, row } of this.bodyRows) settings[member] = chosen[row.name];
    settings.mOverrideMassProperties = jolt.EOverrideMassProperties_CalculateInertia;
    settings.mMassPropertiesOverride.mMass = mass;
    if (shape_factor !== 0.4) settings.mInertiaMultiplier = shape_factor / 0.4;
    if (chosen.linear_cast) settings.mMotionQuality = jolt.EMotionQuality_LinearCast;
    if (scene.box)
      settings.mAllowedDOFs = jolt.EAllowedDOFs_TranslationX | jolt.EAllowedDOFs_TranslationZ |
        jolt.EAllowedDOFs_RotationY;
    this.#withVector([vx, vy, vz], (velocity) => (settings.mLinearVelocity = velocity));
    this.#withVector([wx, wy, wz], (velocity) => (settings.mAngularVelocity = velocity));
    if (this.asTyped) this.#setFields(settings, naiveBall(scene, i));
    return this.#addBody(settings, i);
  }

  #creation(shape, [x, y, z], motion) {
    const { jolt } = this;
    const place = new jolt.RVec3(x, y, z);
    const turn = new jolt.Quat(0, 0, 0, 1);
    const settings = new jolt.BodyCreationSettings(shape, place, turn, motion, LAYER);
    jolt.destroy(place);
    jolt.destroy(turn);
    return settings;
  }

  #setFields(settings, { friction, restitution }) {
    settings.mFriction = friction;
    settings.mRestitution = restitution;
  }

  #addBody(settings, index) {
    const { jolt } = this;
    const body = this.bodies.CreateBody(settings);
    jolt.destroy(settings);
    this.indexOf.set(jolt.getPointer(body), index);
    this.bodies.AddBody(body.GetID(), jolt.EActivation_Activate);
    return body;
  }

  #addSurfaces() {
    const { box } = this.scene;
    if (hasSubstrate(this.scene)) this.#addSurface(FLOOR, [0, 0, 1], [0, 0, 0]);
    this.beside = besideSurfaces(this.scene).map((surface) => this.#addBeside(surface));
    if (!box) return;
    this.#addSurface(WALL, [1, 0, 0], [0, 0, 0]);
    this.#addSurface(WALL, [-1, 0, 0], [box.width, 0, 0]);
    if (box.lid) this.#addSurface(LID, [0, 0, -1], [0, 0, box.lid]);
  }

  /// A plane where it stays; planes cannot move, and so a thick box where it does. The substrate,
  /// which moves along itself, stays.
  #addSurface(surface, normal, place) {
    const moves = this.#isMoving(surface);
    const settings = moves ? this.#movingSurface(normal, place) : this.#stillSurface(normal, place);
    if (this.asTyped) this.#setFields(settings, naiveSurface(this.scene, surface));
    const body = this.#addBody(settings, surface);
    if (moves) this.moving.push({ id: body.GetID(), place: behind(normal, place, this.#thickness()) });
  }

  #stillSurface(normal, place) {
    const { jolt } = this;
    const plane = this.#withVector(normal, (n) => new jolt.Plane(n, 0));
    const settings = this.#creation(new jolt.PlaneShape(plane), place, jolt.EMotionType_Static);
    jolt.destroy(plane);
    return settings;
  }

  #movingSurface(normal, place) {
    const { jolt } = this;
    const wide = this.#width();
    const half = normal.map((value) => (value === 0 ? wide : this.#thickness()));
    const shape = this.#withVector(half, (extent) => new jolt.BoxShape(extent, 0));
    const centre = added(behind(normal, place, this.#thickness()), this.motion.position(this.startTime));
    return this.#creation(shape, centre, jolt.EMotionType_Kinematic);
  }

  /// A plane or a box, a cylinder along y or a sphere, without a convex radius. A plane that moves
  /// away is a thick box, as the floor of a box is.
  #shapeOfSurface({ shape, extent, stays }) {
    const { jolt } = this;
    const box = (half) => this.#withVector(half, (vector) => new jolt.BoxShape(vector, 0));
    switch (shape.kind) {
      case 'plane': {
        if (!stays) return box([this.#reach(), this.#reach(), this.#thickness()]);
        const plane = this.#withVector([0, 0, 1], (n) => new jolt.Plane(n, 0));
        const made = new jolt.PlaneShape(plane);
        jolt.destroy(plane);
        return made;
      }
      case 'rectangle': return box(extent);
      case 'rod': return new jolt.CylinderShape(extent[2], shape.radius, 0);
      default: return new jolt.SphereShape(shape.radius);
    }
  }

  #addBeside(surface) {
    const { jolt } = this;
    const depth = surface.shape.kind === 'plane' && !surface.stays ? this.#thickness() : 0;
    const motion = surface.stays ? jolt.EMotionType_Static : jolt.EMotionType_Kinematic;
    const settings = this.#creation(this.#shapeOfSurface(surface), surface.behind(this.startTime, depth), motion);
    const turn = new jolt.Quat(...surface.quaternion(this.startTime, 'y'));
    settings.mRotation = turn;
    jolt.destroy(turn);
    if (this.asTyped) this.#setFields(settings, naiveSurface(this.scene, surface.touch));
    return { surface, depth, id: this.#addBody(settings, surface.touch).GetID() };
  }

  /// Half the width of what stands in for a plane that moves away: Jolt finds the places where a wide
  /// box is touched less well than those of a narrow one.
  #reach() {
    return 10 * farthest(this.scene, this.units.length);
  }

  #moveBeside(now) {
    const { jolt, bodies, timeStep } = this;
    const isMean = this.chosen.surface_velocity === 'this_step';
    for (const each of this.beside) {
      const { surface, depth, id } = each;
      if (surface.isStill) continue;
      const centre = surface.behind(now, depth);
      const velocity = surface.stepVelocity(now, timeStep, centre, isMean);
      if (surface.stays) {
        each.slides = velocity;
        continue;
      }
      const turn = new jolt.Quat(...surface.quaternion(now, 'y'));
      this.#withVector(centre, (at) => bodies.SetPositionAndRotation(id, at, turn, jolt.EActivation_Activate), jolt.RVec3);
      jolt.destroy(turn);
      this.#withVector(velocity, (v) => this.#withVector(surface.rate, (w) => bodies.SetLinearAndAngularVelocity(id, v, w)));
    }
  }

  #thickness() {
    return 20 * this.scene.bodies.reduce((most, { radius }) => Math.max(most, radius), 0);
  }

  #width() {
    const { box, bodies } = this.scene;
    const highest = bodies.reduce((most, _, i) => Math.max(most, this.scene.initial[9 * i + 2]), 0);
    return 10 * Math.max(box.width, box.lid ?? 0, highest);
  }

  #moveSurfaces() {
    this.slides = undefined;
    const now = this.startTime + this.steps * this.timeStep;
    this.#moveBeside(now);
    if (this.motion.isStill) return;
    const then = now + this.timeStep;
    const mean = this.motion.position(then).map((value, k) => (value - this.motion.position(now)[k]) / this.timeStep);
    this.velocityNow = this.chosen.surface_velocity === 'this_step' ? mean : this.motion.velocity(then);
    if (!this.scene.box) this.slides = this.velocityNow;
    for (const { id, place } of this.moving) {
      const at = added(place, this.motion.position(now));
      this.#withVector(at, (where) => this.bodies.SetPosition(id, where, this.jolt.EActivation_Activate), this.jolt.RVec3);
      this.#withVector(this.velocityNow, (velocity) => this.bodies.SetLinearVelocity(id, velocity));
    }
  }

  /// In the world's units.
  #look() {
    const states = new Float64Array(9 * this.balls.length);
    this.balls.forEach((body, i) => {
      const parts = [() => body.GetPosition(), () => body.GetLinearVelocity(), () => body.GetAngularVelocity()];
      parts.forEach((part, p) => {
        const vector = part(); // overwritten by the next one
        states.set([vector.GetX(), vector.GetY(), vector.GetZ()], 9 * i + 3 * p);
      });
    });
    return states;
  }

  /// Whether a contact can have acted in the step: the gap at its beginning is no larger than what the
  /// bodies' approach, before or after, closes in it. Jolt tells of contacts far ahead.
  #acted({ i, j, normal, gap: told }, now) {
    if (j < 0 && this.scene.box) return true;
    const { before } = this;
    const { bodies } = this.scene;
    if (j < FLOOR) return this.#metBeside(i, j, normal, told, now);
    const other = (states, k) => (j < 0 ? 0 : states[9 * j + k]);
    const along = (states, first) => normal.reduce(
      (sum, n, axis) => sum + n * (states[9 * i + first + axis] - other(states, first + axis)), 0);
    const gap = along(before, 0) - bodies[i].radius - (j < 0 ? 0 : bodies[j].radius);
    const fall = this.scene.gravity * this.timeStep; // of the one over the plane
    const approach = Math.max(-along(before, 3) + (j < 0 ? fall : 0), -along(now, 3));
    return approach * this.timeStep >= gap - 1e-4 * bodies[i].radius;
  }

  #metBeside(i, j, normal, gap, now) {
    const surface = this.#surfaceVelocity(i, j, normal);
    const approach = (states) => -normal.reduce(
      (sum, n, axis) => sum + n * (states[9 * i + 3 + axis] - surface[axis]), 0);
    const fall = Math.hypot(...gravityOf(this.scene)) * this.timeStep;
    const fastest = Math.max(approach(this.before) + fall, approach(now));
    return fastest * this.timeStep >= gap - 1e-4 * this.scene.bodies[i].radius;
  }

  /// A body as Jolt has it, which may not have the inertia that it was given.
  #asTaken({ radius, mass, shape_factor }) {
    const inertia = shape_factor * mass * radius * radius;
    return { radius, mass, shape_factor: inertia < LEAST_INERTIA ? 0.4 / (radius * radius) : shape_factor };
  }

  /// Jolt tells no impulses: those that explain what is not gravity, damping and the limits of speed.
  #impulses(now) {
    const contacts = distinct(this.contacts).filter((contact) => this.#acted(contact, now));
    if (contacts.length === 0) return [];
    const bodies = this.scene.bodies.map((body) => this.#asTaken(body));
    const { linear_damping, angular_damping, collision_steps } = this.chosen;
    const length = this.timeStep / collision_steps;
    const gravity = gravityOf(this.scene);
    const kept = [1 - linear_damping * length, 1 - angular_damping * length].map((x) => Math.max(0, x));
    const changes = new Float64Array(6 * bodies.length);
    const { max_linear_velocity, max_angular_velocity } = this.chosen;
    bodies.forEach((_, i) => {
      let v = Array.from(this.before.subarray(9 * i + 3, 9 * i + 6));
      let w = Array.from(this.before.subarray(9 * i + 6, 9 * i + 9));
      for (let n = 0; n < collision_steps; ++n) {
        v = cut(v.map((value, axis) => (value + gravity[axis] * length) * kept[0]), max_linear_velocity);
        w = cut(w.map((value) => value * kept[1]), max_angular_velocity);
      }
      for (let axis = 0; axis < 3; ++axis) {
        changes[6 * i + axis] = now[9 * i + 3 + axis] - v[axis];
        changes[6 * i + 3 + axis] = now[9 * i + 6 + axis] - w[axis];
      }
    });
    const rounding = (i) => {
      const [vx, vy, vz, wx, wy, wz] = now.subarray(9 * i + 3, 9 * i + 9);
      const speed = Math.hypot(vx, vy, vz) + bodies[i].radius * Math.hypot(wx, wy, wz);
      return 1e-5 * bodies[i].mass * (speed + this.scene.gravity * this.timeStep);
    };
    const least = (i, j) => Math.max(rounding(i), j >= 0 ? rounding(j) : 0);
    return explainedImpulses(bodies, contacts, changes, least);
  }

  #ownLacks(scene) {
    const { length, mass, time } = this.units;
    const own = [];
    const inertia = LEAST_INERTIA / (mass * length * length);
    const least = scene.bodies.reduce((low, b) => Math.min(low, b.shape_factor * b.mass * b.radius ** 2), Infinity);
    if (least < inertia)
      own.push({
        text: `moments of inertia below ${rounded(inertia, 2)} kg m² (that of a sphere of 1 m is taken)`,
        kind: 'moments of inertia below … kg m²',
      });
    own.push(...planeEnds(this.beside.map(({ surface }) => surface), this.#reach() / length));
    const limit = this.chosen.max_angular_velocity * time;
    const turns = scene.bodies.map(({ radius }, i) => {
      const [vx, vy, vz, wx, wy, wz] = scene.initial.subarray(9 * i + 3, 9 * i + 9);
      return Math.max(Math.hypot(wx, wy, wz), Math.hypot(vx, vy, vz) / radius);
    });
    if (turns.some((turn) => turn > limit))
      own.push({
        text: `angular velocities above ${rounded(limit, 3)} rad/s`,
        kind: 'angular velocities above … rad/s',
      });
    return own;
  }

  #applied(scene, timeStep) {
    const gathered = new Gathered();
    if (!this.asTyped) {
      scene.bodies.forEach((_, i) => {
        if (scene.box) return;
        for (const [surface, name] of surfaceNames(scene)) {
          const { friction, restitution } = onSurface(scene, i, surface);
          const isLaw = surface !== FLOOR && dependsOnSpeed(contactOf(scene, i, surface));
          gathered.add(name === 'substrate' ? 'friction' : `${name}_friction`, whoseOn(name, i, surface), friction);
          gathered.add(`${name}_restitution`, whoseOn(name, i, surface), isLaw ? 'by speed' : restitution);
        }
      });
      for (const [i, j] of materialPairs(scene)) {
        const contact = contactOf(scene, i, j);
        gathered.add('restitution', `${i}-${j}`, dependsOnSpeed(contact) ? 'by speed' : contact.restitution);
        gathered.add('pair_friction', `${i}-${j}`, frictionOf(contact));
      }
    }
    const [x, y] = scene.downhill;
    return {
      ...this.chosen,
      ...gathered.settings(),
      ...this.units.applied(),
      time_step: timeStep,
      gravity: scene.gravity,
      ...(x !== 0 || y !== 0 ? { downhill_x: x, downhill_y: y } : {}),
    };
  }
}

/// A vector no longer than a limit.
function cut(vector, limit) {
  const size = Math.hypot(...vector);
  return size > limit ? vector.map((value) => (value * limit) / size) : vector;
}

const added = (a, b) => a.map((value, k) => value + b[k]);
const behind = (normal, place, depth) => place.map((value, k) => value - depth * normal[k]);

/// One contact for each pair: with several steps in a step it is met several times.
function distinct(contacts) {
  const last = new Map();
  for (const contact of contacts) last.set(`${contact.i} ${contact.j} ${contact.j < 0 ? contact.normal : ''}`, contact);
  return [...last.values()];
}
