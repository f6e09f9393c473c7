// PhysX 5, package physx-js-webidl: single precision, no rolling friction, drilling friction with
// TGS alone. Coefficients belong to the materials of shapes and are combined by modes; contact
// modification cannot be reached from JavaScript.

import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { FLOOR, LID, WALL } from '../kit/contacts.mjs';
import { Refused } from '../kit/faults.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { pairShapes, typedShapes } from '../kit/pair_shapes.mjs';
import { count, flag, number, search, word } from '../kit/settings.mjs';
import { halfOf, inertiaOf, isSphere, turnOf } from '../kit/solids.mjs';
import { besideSurfaces, hasSubstrate, quaternionOf } from '../kit/surfaces.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

const PACKAGE = 'physx-js-webidl';
const FILTER_BITS = 31;
const MOST_POINTS = 64; // of one pair of shapes, in a report
const LARGEST = 3e38; // of a single

const SETTINGS = [
  word(
    'coefficients',
    ['fields', 'pair'],
    'pair',
    "the scene's coefficients straight in the materials, which PhysX averages; or exactly, pair by pair, through " +
      'combine modes and collision filters',
  ),
  word('solver', ['PGS', 'TGS'], 'PGS', 'PxSolverType'),
  count('position_iterations', 4, 'of the solver', { low: 1, high: 255, candidates: [1, 4, 16] }),
  count('velocity_iterations', 1, 'of the solver, without the push on overlaps', {
    high: 255,
    candidates: [0, 1, 4],
  }),
  number(
    'bounce_threshold',
    'm/s',
    2,
    'bounceThresholdVelocity: approach below which nothing rebounds',
    {
      candidates: [0, 0.2, 2],
    },
  ),
  number('contact_offset', 'm', 0.02, 'of each shape: gap at which there is a contact', {
    low: 1e-9,
    high: 1e6,
    candidates: [0.02, 1e-3],
    ...search(1e-6, 0.02, true),
  }),
  number('max_depenetration_velocity', 'm/s', 1e32, 'at which an overlap is pushed out, at most', {
    low: 1e-9,
    high: 1e32,
    candidates: [1e32, 1, 0.001],
  }),
  number('friction_offset_threshold', 'm', 0.04, 'gap from which on there is no friction', {
    low: 1e-9,
    high: 1e6,
  }),
  number(
    'friction_correlation_distance',
    'm',
    0.025,
    'patches of contact closer than this share a friction',
    {
      high: 1e6,
    },
  ),
  flag('friction_every_iteration', false, 'PxSceneFlag::eENABLE_FRICTION_EVERY_ITERATION, of PGS'),
  flag('stabilization', false, 'PxSceneFlag::eENABLE_STABILIZATION: what is slow is slowed more'),
  flag('ccd', false, 'bodies are swept'),
  flag('enhanced_determinism', false, 'PxSceneFlag::eENABLE_ENHANCED_DETERMINISM', { candidates: [] }),
  flag('sleeping', true, 'a body that is slow stops after wake_counter'),
  number('sleep_threshold', 'm2/s2', 0.005, 'kinetic energy over mass that is slow'),
  number('linear_damping', '1/s', 0, 'of each body', { candidates: [] }),
  number('angular_damping', '1/s', 0.05, 'of each body', { candidates: [0, 0.05] }),
  number('max_angular_velocity', 'rad/s', 100, 'at which the spin is cut', {
    high: 1e16,
    candidates: [100, 1e16],
  }),
  word(
    'surface_velocity',
    ['this_step', 'step_end'],
    'this_step',
    'velocity of a moving substrate, floor or wall as contacts feel it: the mean over the step, or that at its end',
  ),
  ...unitSettings,
];

/// Where a plane's normal, PhysX's x axis, is turned to.
const ROOT = Math.SQRT1_2;
const SURFACES = [
  { surface: FLOOR, normal: [0, 0, 1], turn: [0, -ROOT, 0, ROOT] },
  { surface: WALL, normal: [1, 0, 0], turn: [0, 0, 0, 1] },
  { surface: WALL, normal: [-1, 0, 0], turn: [0, 0, 1, 0] },
  { surface: LID, normal: [0, 0, -1], turn: [0, ROOT, 0, ROOT] },
];

/// The package is built for the web alone and takes Node for nothing it knows: while it starts it
/// finds what a browser has.
async function asInABrowser(start) {
  const hidden = Object.getOwnPropertyDescriptor(globalThis, 'process');
  Object.defineProperty(globalThis, 'process', { value: undefined, configurable: true });
  globalThis.window = globalThis;
  try {
    return await start();
  } finally {
    delete globalThis.window;
    Object.defineProperty(globalThis, 'process', hidden);
  }
}

export async function open(folder) {
  const place = join(resolve(folder), 'node_modules', PACKAGE);
  const wasmBinary = readFileSync(join(place, `${PACKAGE}.wasm`));
  const { version } = JSON.parse(readFileSync(join(place, 'package.json'), 'utf8'));
  const module = pathToFileURL(join(place, `${PACKAGE}.mjs`)).href;
  const physx = await asInABrowser(async () =>
    (await import(module)).default({ wasmBinary, print: console.error, printErr: console.error }),
  );
  return new PhysxEngine(physx, version);
}

class PhysxEngine {
  constructor(physx, version) {
    this.px = physx;
    this.version = version;
    this.precision = 'single';
    this.takes = ['block', 'surfaces'];
    this.settings = SETTINGS;
    this.top = physx.PxTopLevelFunctions.prototype;
    const foundation = this.top.CreateFoundation(
      physx.PHYSICS_VERSION,
      new physx.PxDefaultAllocator(),
      new physx.PxDefaultErrorCallback(),
    );
    this.tolerances = new physx.PxTolerancesScale();
    this.physics = this.top.CreatePhysics(physx.PHYSICS_VERSION, foundation, this.tolerances);
    this.threads = this.top.DefaultCpuDispatcherCreate(0);
    this.points = new physx.PxArray_PxContactPairPoint(MOST_POINTS);
    this.still = new physx.PxTransform(physx.PxIDENTITYEnum.PxIdentity);
    this.reports = this.#makeReports();
  }

  configure(scene, settings, timeStep) {
    if (scene.periodic.some((length) => length > 0))
      throw new Refused(
        'physx: the substrate repeats itself, and a PhysX world has no periodic boundaries',
      );
    this.#leave();
    this.units = new Units(scene, settings);
    this.chosen = settings;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.motion = surfaceMotion(this.scene);
    this.isTyped = settings.coefficients === 'fields';
    this.shapes = this.isTyped ? typedShapes(this.scene) : pairShapes(this.scene, 'physx', FILTER_BITS);
    this.start(scene.initial, 0);
    return {
      settings: this.#applied(scene, timeStep),
      not_represented: [
        ...lacks(scene, timeStep, {
          staticFriction: !this.isTyped,
          drilling: settings.solver === 'TGS' && !this.isTyped,
          surfaceVelocity: settings.surface_velocity === 'step_end',
          threshold: settings.bounce_threshold / this.units.speed,
          sweeps: settings.ccd,
        }),
        ...this.#ownLacks(),
      ],
      left_out: [],
    };
  }

  start(states, time) {
    this.#leave();
    const factors = this.units.ofState;
    this.startTime = time * this.units.time;
    this.steps = 0;
    this.found = new Touches(this.scene);
    this.materials = [];
    this.bodyOf = new Map(); // by an actor's address: a body's index, or a surface
    this.world = this.#makeWorld();
    this.moving = [];
    this.actors = [];
    this.#addSurfaces();
    this.balls = this.scene.bodies.map((_, i) =>
      this.#addBall(
        i,
        Array.from(states.subarray(9 * i, 9 * i + 9), (value, k) => value * factors[k]),
      ),
    );
  }

  step() {
    this.#moveSurfaces();
    this.found = new Touches(this.scene);
    this.world.simulate(this.timeStep);
    this.world.fetchResults(true);
    ++this.steps;
  }

  read(states, touches) {
    const factors = this.units.ofState;
    this.balls.forEach((ball, i) => {
      const parts = [ball.getGlobalPose().p, ball.getLinearVelocity(), ball.getAngularVelocity()];
      parts.forEach((part, p) => {
        [part.x, part.y, part.z].forEach((value, axis) => {
          states[9 * i + 3 * p + axis] = value / factors[3 * p];
        });
      });
    });
    this.found.pushTo(touches, 1 / this.units.impulse);
  }

  #leave() {
    if (!this.world) return;
    for (const actor of this.actors) actor.release();
    this.world.release();
    for (const material of this.materials) material.release();
    this.world = undefined;
  }

  #makeWorld() {
    const { px, chosen } = this;
    const desc = new px.PxSceneDesc(this.tolerances);
    const gravity = this.#vector(gravityOf(this.scene));
    desc.gravity = gravity;
    desc.cpuDispatcher = this.threads;
    desc.filterShader = this.top.DefaultFilterShader();
    desc.simulationEventCallback = this.reports;
    desc.solverType = px.PxSolverTypeEnum[`e${chosen.solver}`];
    desc.bounceThresholdVelocity = chosen.bounce_threshold;
    desc.frictionOffsetThreshold = chosen.friction_offset_threshold;
    desc.frictionCorrelationDistance = chosen.friction_correlation_distance;
    const flags = {
      friction_every_iteration: 'eENABLE_FRICTION_EVERY_ITERATION',
      stabilization: 'eENABLE_STABILIZATION',
      ccd: 'eENABLE_CCD',
      enhanced_determinism: 'eENABLE_ENHANCED_DETERMINISM',
    };
    for (const [name, bit] of Object.entries(flags))
      if (chosen[name]) desc.flags.raise(px.PxSceneFlagEnum[bit]);
    const world = this.physics.createScene(desc);
    px.destroy(desc);
    px.destroy(gravity);
    return world;
  }

  #vector([x, y, z]) {
    return new this.px.PxVec3(x, y, z);
  }

  /// Calls `use` with a pose that lasts so long.
  #withPose(place, turn, use) {
    const { px } = this;
    const position = this.#vector(place);
    const rotation = new px.PxQuat(...turn);
    const pose = new px.PxTransform(position, rotation);
    const result = use(pose);
    for (const each of [pose, rotation, position]) px.destroy(each);
    return result;
  }

  #addBall(i, state) {
    const { px, chosen, scene } = this;
    const body = scene.bodies[i];
    const turn = isSphere(body) ? [0, 0, 0, 1] : turnOf(body);
    const ball = this.#withPose(state.slice(0, 3), turn, (pose) =>
      this.physics.createRigidDynamic(pose),
    );
    const geometry = isSphere(body) ? new px.PxSphereGeometry(body.radius)
      : new px.PxBoxGeometry(...halfOf(body));
    this.#attach(ball, geometry, this.shapes.ofBall(i));
    px.destroy(geometry);
    ball.setMass(body.mass);
    this.#give(ball, 'setMassSpaceInertiaTensor', inertiaOf(body));
    this.#give(ball, 'setLinearVelocity', state.slice(3, 6));
    ball.setMaxAngularVelocity(Math.min(chosen.max_angular_velocity, LARGEST));
    this.#give(ball, 'setAngularVelocity', state.slice(6, 9));
    ball.setLinearDamping(chosen.linear_damping);
    ball.setAngularDamping(chosen.angular_damping);
    ball.setSolverIterationCounts(chosen.position_iterations, chosen.velocity_iterations);
    ball.setMaxDepenetrationVelocity(chosen.max_depenetration_velocity);
    ball.setSleepThreshold(chosen.sleeping ? chosen.sleep_threshold : 0);
    if (chosen.ccd) ball.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eENABLE_CCD, true);
    if (scene.box) this.#lockToPlane(ball);
    this.#enter(ball, i);
    return ball;
  }

  #give(ball, setter, numbers) {
    const vector = this.#vector(numbers);
    ball[setter](vector);
    this.px.destroy(vector);
  }

  #lockToPlane(ball) {
    for (const axis of ['LINEAR_Y', 'ANGULAR_X', 'ANGULAR_Z'])
      ball.setRigidDynamicLockFlag(this.px.PxRigidDynamicLockFlagEnum[`eLOCK_${axis}`], true);
  }

  #enter(actor, body) {
    this.bodyOf.set(this.px.getPointer(actor), body);
    this.actors.push(actor);
    this.world.addActor(actor);
  }

  #attach(actor, geometry, contacts) {
    const { px, physics, chosen } = this;
    const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE);
    for (const contact of contacts) {
      const shape = physics.createShape(geometry, this.#material(contact), true, flags);
      const data = new px.PxFilterData(contact.member, contact.filter, this.#pairFlags(), 0);
      shape.setSimulationFilterData(data);
      px.destroy(data);
      shape.setContactOffset(chosen.contact_offset);
      if (contact.drilling > 0 && contact.friction > 0)
        shape.setMinTorsionalPatchRadius(contact.drilling / contact.friction);
      actor.attachShape(shape);
      shape.release();
    }
    px.destroy(flags);
  }

  #material({ friction, staticFriction, restitution, rule }) {
    const { PxCombineModeEnum: modes } = this.px;
    const material = this.physics.createMaterial(staticFriction, friction, restitution);
    if (rule !== 'as shipped') {
      const mode = { smaller: modes.eMIN, larger: modes.eMAX };
      material.setFrictionCombineMode(mode[rule.friction]);
      material.setRestitutionCombineMode(mode[rule.restitution]);
    }
    this.materials.push(material);
    return material;
  }

  #pairFlags() {
    const flags = this.px.PxPairFlagEnum;
    return (
      flags.eNOTIFY_TOUCH_FOUND |
      flags.eNOTIFY_TOUCH_PERSISTS |
      flags.eNOTIFY_CONTACT_POINTS |
      (this.chosen.ccd ? flags.eDETECT_CCD_CONTACT | flags.eNOTIFY_TOUCH_CCD : 0)
    );
  }

  #ownLacks() {
    const rods = this.beside.some(({ surface }) => surface.shape.kind === 'rod');
    return rods ? [{ text: 'flat ends of cylinders (capsules, round ones)', kind: 'flat ends of cylinders' }] : [];
  }

  #addSurfaces() {
    const { box } = this.scene;
    const moves = !this.motion.isStill;
    this.beside = besideSurfaces(this.scene).map((surface) => this.#addBeside(surface));
    for (const { surface, normal, turn } of SURFACES) {
      if (surface !== FLOOR && !box) continue;
      if (surface === FLOOR && !hasSubstrate(this.scene)) continue;
      if (surface === LID && !box.lid) continue;
      const place = [normal[0] < 0 ? box.width : 0, 0, surface === LID ? box.lid : 0];
      if (moves && (surface === FLOOR || box.moving_walls))
        this.#addMovingSurface(surface, normal, place);
      else this.#addPlane(surface, place, turn);
    }
  }

  #addPlane(surface, place, turn) {
    const { px } = this;
    const plane = this.#withPose(place, turn, (pose) => this.physics.createRigidStatic(pose));
    const geometry = new px.PxPlaneGeometry();
    this.#attach(plane, geometry, this.shapes.ofSurface(surface));
    px.destroy(geometry);
    this.#enter(plane, surface);
  }

  /// A box, since a plane cannot move; so thin that single precision tells where its face is.
  #addMovingSurface(surface, normal, place) {
    const { px } = this;
    const { wide, thick } = this.#plane();
    const half = normal.map((n) => (n === 0 ? wide : thick));
    const middle = place.map((p, axis) => p - half[axis] * normal[axis]);
    const at = added(middle, this.motion.position(this.startTime));
    const actor = this.#withPose(at, [0, 0, 0, 1], (pose) => this.physics.createRigidDynamic(pose));
    actor.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eKINEMATIC, true);
    const geometry = new px.PxBoxGeometry(...half);
    this.#attach(actor, geometry, this.shapes.ofSurface(surface));
    px.destroy(geometry);
    this.moving.push({ actor, middle });
    this.#enter(actor, surface);
  }

  /// Half sizes of a box in the place of a plane.
  #plane() {
    const thick = 16 * this.scene.bodies.reduce((most, { radius }) => Math.max(most, radius), 0);
    return { wide: 100 * this.units.length, thick };
  }

  /// A plane, or where it moves a box as for the substrate; a box, a capsule along x, a sphere.
  #addBeside(surface) {
    const { px, physics } = this;
    const { shape, extent, isStill } = surface;
    const { wide, thick } = this.#plane();
    const isPlane = shape.kind === 'plane';
    const depth = isPlane && !isStill ? thick : 0;
    const placed = {
      surface,
      centre: (t) => surface.behind(t, depth),
      turn: (t) => (isPlane && isStill ? normalAlongX(surface.axes(t)) : surface.quaternion(t, 'x')),
    };
    const geometry = {
      plane: () => (isStill ? new px.PxPlaneGeometry() : new px.PxBoxGeometry(wide, wide, thick)),
      rectangle: () => new px.PxBoxGeometry(...extent),
      rod: () => new px.PxCapsuleGeometry(shape.radius, extent[2]),
      ball: () => new px.PxSphereGeometry(shape.radius),
    }[shape.kind]();
    placed.actor = this.#withPose(placed.centre(this.startTime), placed.turn(this.startTime), (pose) =>
      (isStill ? physics.createRigidStatic(pose) : physics.createRigidDynamic(pose)),
    );
    if (!isStill) placed.actor.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eKINEMATIC, true);
    this.#attach(placed.actor, geometry, this.shapes.ofSurface(surface.touch));
    px.destroy(geometry);
    this.#enter(placed.actor, surface.touch);
    return placed;
  }

  /// What stays, as a belt does, begins each step where it is and ends it elsewhere.
  #moveBeside(now) {
    const isMean = this.chosen.surface_velocity === 'this_step';
    for (const { surface, actor, centre, turn } of this.beside) {
      if (surface.isStill) continue;
      const here = centre(now);
      const velocity = surface.stepVelocity(now, this.timeStep, here, isMean);
      this.#withPose(here, turn(now), (pose) => actor.setGlobalPose(pose));
      this.#withPose(
        added(here, velocity.map((v) => v * this.timeStep)),
        turn(now + this.timeStep),
        (pose) => actor.setKinematicTarget(pose),
      );
    }
  }

  #moveSurfaces() {
    const now = this.startTime + this.steps * this.timeStep;
    const then = now + this.timeStep;
    this.#moveBeside(now);
    for (const { actor, middle } of this.moving) {
      let target = added(middle, this.motion.position(then));
      if (this.chosen.surface_velocity === 'step_end') {
        const here = added(middle, this.motion.position(now));
        this.#withPose(here, [0, 0, 0, 1], (pose) => actor.setGlobalPose(pose));
        target = added(
          here,
          this.motion.velocity(then).map((v) => v * this.timeStep),
        );
      }
      this.#withPose(target, [0, 0, 0, 1], (pose) => actor.setKinematicTarget(pose));
    }
  }

  /// What PhysX reports of contacts while a step ends.
  #makeReports() {
    const { px } = this;
    const helpers = px.NativeArrayHelpers.prototype;
    const reports = new px.PxSimulationEventCallbackImpl();
    for (const name of ['onConstraintBreak', 'onWake', 'onSleep', 'onTrigger'])
      reports[name] = () => {};
    reports.onContact = (headerAddress, pairsAddress, pairs) => {
      const header = px.wrapPointer(headerAddress, px.PxContactPairHeader);
      const [a, b] = [0, 1].map((k) => this.bodyOf.get(px.getPointer(header.get_actors(k))));
      const [first, second] = a >= 0 ? [a, b] : [b, a];
      if (this.scene.box && second < FLOOR) return;
      const list = px.wrapPointer(pairsAddress, px.PxContactPair);
      for (let k = 0; k < pairs; ++k)
        this.#addImpulses(helpers.getContactPairAt(list, k), first, second);
    };
    return reports;
  }

  #addImpulses(pair, first, second) {
    const points = pair.extractContacts(this.points.begin(), MOST_POINTS);
    for (let k = 0; k < points; ++k) {
      const { x, y, z } = this.points.get(k).impulse;
      this.found.add(first, second, Math.hypot(x, y, z));
    }
  }

  #applied(scene, timeStep) {
    const [x, y] = scene.downhill;
    return {
      ...this.chosen,
      ...this.shapes.applied,
      ...this.units.applied(),
      time_step: timeStep,
      gravity: scene.gravity,
      ...(x !== 0 || y !== 0 ? { downhill_x: x, downhill_y: y } : {}),
    };
  }
}

/// A plane of PhysX's has its normal along x.
const normalAlongX = ([x, y, z]) => quaternionOf([z, x, y]);
const added = (a, b) => a.map((value, k) => value + b[k]);
