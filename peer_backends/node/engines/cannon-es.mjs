// cannon-es: double precision, no rolling or drilling friction. Coefficients belong to pairs of
// materials; the limit of friction is an impulse of μ m g in each step, whatever its length.

import {
  FLOOR, LID, WALL, contactOf, dependsOnSpeed, frictionOf, groundOf, lastingOf, materialPairs,
  naiveBall, naiveSurface, onSurface, pairRestitution, restitutionAt, surfaceNames, whoseOn,
} from '../kit/contacts.mjs';
import { Refused } from '../kit/faults.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { count, flag, number, search, word } from '../kit/settings.mjs';
import { halfOf, inertiaOf, isBlock, isSphere, turnFromY, turnOf } from '../kit/solids.mjs';
import { besideSurfaces, hasSubstrate } from '../kit/surfaces.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

/// Of a cylinder, which is a prism here.
const CYLINDER_FACES = 64;
/// Cosine of the slope beyond which a surface is a wall.
const STEEP = Math.SQRT1_2;
/// Steps over which an overlap is pushed out, beyond which it is as good as not.
const MOST_RELAXED = 1e3;

const PACKAGE = 'cannon-es';

const SETTINGS = [
  word('coefficients', ['fields', 'pair'], 'pair',
    "the scene's coefficients straight in the bodies' materials, which cannon multiplies, and the " +
    "inertia that it takes a sphere to have; or the scene's inertia and a contact material for each " +
    'pair, friction times the length of a step'),
  count('solver_iterations', 10, 'sweeps over the contacts, at most', { low: 1, high: 10000, candidates: [10, 50] }),
  number('solver_tolerance', '', 1e-7, 'sum of changes at which they end',
    { candidates: [0, 1e-7], ...search(1e-12, 1e-3, true) }),
  number('contact_stiffness', 'N/m', 1e7, 'of contacts', { low: 1e-9, high: 1e30, ...search(1e4, 1e12, true) }),
  number('contact_relaxation', '', 3, 'steps in which an overlap is pushed out',
    { high: 1e12, ...search(1, 1e9, true) }),
  number('friction_stiffness', 'N/m', 1e7, 'of friction', { low: 1e-9, high: 1e30, ...search(1e4, 1e12, true) }),
  number('friction_relaxation', '', 3, 'steps in which a slip is stopped', { high: 1e12, ...search(1, 1e9, true) }),
  flag('sleeping', false, 'a body that is slow for a second stops'),
  number('linear_damping', '', 0.01, 'part of the velocity lost in a unit of time', { high: 1, candidates: [0, 0.01] }),
  number('angular_damping', '', 0.01, 'part of the angular velocity lost in a unit of time',
    { high: 1, candidates: [0, 0.01] }),
  word('broadphase', ['naive', 'sap'], 'naive', 'NaiveBroadphase or SAPBroadphase'),
  word('surface_velocity', ['this_step', 'step_end'], 'this_step',
    'velocity of a moving substrate, floor or wall as contacts feel it: the mean over the step, or ' +
    'that at its end'),
  ...unitSettings,
];

export async function open(folder) {
  return new CannonEngine(await load(folder, PACKAGE), versionOf(folder, PACKAGE));
}

class CannonEngine {
  constructor(cannon, version) {
    this.cannon = cannon;
    this.version = version;
    this.precision = 'double';
    this.takes = ['block', 'cylinder', 'surfaces'];
    this.settings = SETTINGS;
  }

  configure(scene, settings, timeStep) {
    if (scene.periodic.some((length) => length > 0))
      throw new Refused(
        'cannon-es: the substrate repeats itself, and a cannon-es world has no periodic boundaries');
    this.units = new Units(scene, settings);
    this.chosen = settings;
    this.asTyped = settings.coefficients === 'fields';
    this.original = scene;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.start(scene.initial, 0);
    return {
      settings: this.#applied(scene, timeStep),
      not_represented: [
        ...lacks(scene, timeStep, {
          bounceLaw: !this.asTyped,
          surfaceVelocity: settings.surface_velocity === 'step_end',
        }),
        ...this.#ownLacks(scene),
      ],
      left_out: [],
    };
  }

  start(states, time) {
    const { cannon, scene, chosen, units } = this;
    const world = new cannon.World();
    this.world = world;
    world.gravity.set(...gravityOf(scene));
    // The limit of friction is by the weight on the plane, not by all of gravity.
    if (!this.asTyped) world.frictionGravity = new cannon.Vec3(0, 0, -scene.gravity);
    world.allowSleep = chosen.sleeping;
    if (chosen.broadphase === 'sap') world.broadphase = new cannon.SAPBroadphase(world);
    world.solver.iterations = chosen.solver_iterations;
    world.solver.tolerance = chosen.solver_tolerance;
    this.#setSprings(world.defaultContactMaterial);
    this.startTime = time * units.time;
    this.steps = 0;
    this.indexOf = new Map(); // by a body: its index, or a surface
    this.materialOf = new Map(); // by a name
    this.#addSurfaces();
    const factors = units.ofState;
    this.balls = scene.bodies.map((_, i) =>
      this.#addBall(i, Array.from(states.subarray(9 * i, 9 * i + 9), (value, k) => value * factors[k])));
    if (!this.asTyped) this.#addContactMaterials();
  }

  step() {
    this.#moveSurfaces();
    this.world.step(this.timeStep);
    ++this.steps;
  }

  read(states, touches) {
    const factors = this.units.ofState;
    this.balls.forEach(({ position, velocity, angularVelocity }, i) => {
      [position, velocity, angularVelocity].forEach(({ x, y, z }, p) => {
        const at = 9 * i + 3 * p;
        states[at] = x / factors[3 * p];
        states[at + 1] = y / factors[3 * p];
        states[at + 2] = z / factors[3 * p];
      });
    });
    const found = new Touches(this.scene);
    for (const contact of this.world.contacts) {
      const [i, j] = [contact.bi, contact.bj].map((body) => this.indexOf.get(body));
      const impulse = contact.multiplier * this.timeStep;
      if (i >= 0) found.add(i, j, impulse);
      else found.add(j, i, impulse);
    }
    found.pushTo(touches, 1 / this.units.impulse);
  }

  #material(name, options) {
    if (!this.materialOf.has(name)) this.materialOf.set(name, new this.cannon.Material(options));
    return this.materialOf.get(name);
  }

  #addBall(i, [x, y, z, vx, vy, vz, wx, wy, wz]) {
    const { cannon, scene, chosen } = this;
    const own = scene.bodies[i];
    const { mass, material } = own;
    const [shape, turn] = this.#shapeOf(own);
    const body = new cannon.Body({
      mass,
      shape,
      quaternion: new cannon.Quaternion(...turn),
      position: new cannon.Vec3(x, y, z),
      velocity: new cannon.Vec3(vx, vy, vz),
      angularVelocity: new cannon.Vec3(wx, wy, wz),
      linearDamping: chosen.linear_damping,
      angularDamping: chosen.angular_damping,
      material: this.asTyped ? this.#typed(naiveBall(this.original, i)) : this.#material(material),
    });
    if (!this.asTyped || !isSphere(own)) setInertia(body, this.#inertia(own));
    if (scene.box) {
      body.linearFactor.set(1, 0, 1);
      body.angularFactor.set(0, 1, 0);
    }
    this.world.addBody(body);
    this.indexOf.set(body, i);
    if (!this.asTyped) this.#followLaws(body, i);
    return body;
  }

  /// A shape and how it is turned: a cylinder, of plane faces, lies along y here.
  #shapeOf(body) {
    const { cannon } = this;
    if (isSphere(body)) return [new cannon.Sphere(body.radius), [0, 0, 0, 1]];
    const [x, y, z] = halfOf(body);
    if (isBlock(body)) return [new cannon.Box(new cannon.Vec3(x, y, z)), turnOf(body)];
    return [new cannon.Cylinder(y, y, 2 * x, CYLINDER_FACES), turnFromY(body)];
  }

  /// About the axes of that shape.
  #inertia(body) {
    const [along, across, vertical] = inertiaOf(body);
    return body.shape === 'cylinder' ? [across, along, vertical] : [along, across, vertical];
  }

  #typed({ friction, restitution }) {
    return new this.cannon.Material({ friction, restitution });
  }

  /// At the beginning of a contact a body is told of it before it is solved: where restitution
  /// depends on the approach, this is where it is known.
  #followLaws(body, i) {
    const { scene } = this;
    const laws = [...scene.pairs, ...(scene.on_surfaces ?? []).map(({ impact }) => impact), ...(scene.box ? [...scene.box.on_floor, ...scene.box.on_wall, ...scene.box.on_lid] : [])];
    if (!laws.some(dependsOnSpeed)) return;
    body.addEventListener('collide', ({ body: other, contact }) => {
      const j = this.indexOf.get(other);
      if (j === FLOOR && !scene.box) return;
      const law = contactOf(scene, i, j);
      if (!dependsOnSpeed(law)) return;
      contact.restitution = restitutionAt(law.restitution, Math.abs(contact.getImpactVelocityAlongNormal()));
    });
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

  #addSurface(surface, normal, place, moves) {
    const { cannon } = this;
    const body = new cannon.Body({
      mass: 0,
      type: moves ? cannon.Body.KINEMATIC : cannon.Body.STATIC,
      shape: new cannon.Plane(),
      material: this.asTyped ? this.#typed(naiveSurface(this.original, surface)) : this.#material(surface),
    });
    const centre = moves ? added(place, this.motion.position(this.startTime)) : place;
    body.position.set(...centre);
    if (normal[2] !== 1) // a plane's own normal is z
      body.quaternion.setFromVectors(new cannon.Vec3(0, 0, 1), new cannon.Vec3(...normal));
    this.world.addBody(body);
    this.indexOf.set(body, surface);
    if (moves) this.moving.push({ body, place });
  }

  /// A plane, a box, a prism along y or a sphere, in the surface's own frame.
  #shapeOfSurface({ shape, extent }) {
    const { cannon } = this;
    switch (shape.kind) {
      case 'plane': return new cannon.Plane();
      case 'rectangle': return new cannon.Box(new cannon.Vec3(...extent));
      case 'rod': return new cannon.Cylinder(shape.radius, shape.radius, 2 * extent[2], CYLINDER_FACES);
      default: return new cannon.Sphere(shape.radius);
    }
  }

  #addBeside(surface) {
    const { cannon } = this;
    const { touch } = surface;
    const body = new cannon.Body({
      mass: 0,
      type: surface.isStill ? cannon.Body.STATIC : cannon.Body.KINEMATIC,
      shape: this.#shapeOfSurface(surface),
      material: this.asTyped ? this.#typed(naiveSurface(this.original, touch)) : this.#material(touch),
    });
    body.position.set(...surface.centre(this.startTime));
    body.quaternion.set(...surface.quaternion(this.startTime, 'y'));
    body.updateAABB();
    this.world.addBody(body);
    this.indexOf.set(body, touch);
    return { surface, body };
  }

  /// What stays, as a belt does, begins each step where it is.
  #moveBeside(now) {
    const isMean = this.chosen.surface_velocity === 'this_step';
    for (const { surface, body } of this.beside) {
      if (surface.isStill) continue;
      const centre = surface.centre(now);
      body.position.set(...centre);
      body.quaternion.set(...surface.quaternion(now, 'y'));
      body.velocity.set(...surface.stepVelocity(now, this.timeStep, centre, isMean));
      body.angularVelocity.set(...surface.rate);
      body.aabbNeedsUpdate = true;
    }
  }

  #setSprings(material) {
    const { chosen } = this;
    material.contactEquationStiffness = chosen.contact_stiffness;
    material.contactEquationRelaxation = chosen.contact_relaxation;
    material.frictionEquationStiffness = chosen.friction_stiffness;
    material.frictionEquationRelaxation = chosen.friction_relaxation;
    return material;
  }

  #addContactMaterials() {
    const { cannon, original } = this;
    const pair = (a, b, friction, restitution) =>
      this.world.addContactMaterial(this.#setSprings(new cannon.ContactMaterial(
        this.#material(a), this.#material(b), { friction: friction * this.timeStep, restitution })));
    for (const [i, j] of materialPairs(original))
      pair(original.bodies[i].material, original.bodies[j].material,
        frictionOf(contactOf(original, i, j)), pairRestitution(original, i, j));
    original.substrate.forEach((_, material) => {
      const body = original.bodies.findIndex((each) => each.material === material);
      if (body < 0) return;
      for (const [surface] of surfaceNames(original)) {
        const { friction, restitution } = onSurface(original, body, surface);
        pair(material, surface, friction * this.#weightShare(surface), restitution);
      }
    });
  }

  /// Of the weight that cannon limits friction by, what a body presses on a plane or plate with that
  /// it lies on: the cosine of its slope.
  #weightShare(touch) {
    const surface = this.beside.find((each) => each.surface.touch === touch)?.surface;
    if (!surface || !isFlat(surface)) return 1;
    const pull = gravityOf(this.scene);
    const along = surface.axes(this.startTime)[2].reduce((sum, n, k) => sum + n * pull[k], 0);
    return this.scene.gravity > 0 ? Math.abs(along) / this.scene.gravity : 1;
  }

  #moveSurfaces() {
    const now = this.startTime + this.steps * this.timeStep;
    this.#moveBeside(now);
    if (this.moving.length === 0) return;
    const then = now + this.timeStep;
    const [from, to] = [this.motion.position(now), this.motion.position(then)];
    const velocity = this.chosen.surface_velocity === 'step_end'
      ? this.motion.velocity(then) : to.map((value, k) => (value - from[k]) / this.timeStep);
    for (const { body, place } of this.moving) {
      body.position.set(...added(place, from));
      body.velocity.set(...velocity);
      body.aabbNeedsUpdate = true;
    }
  }

  #ownLacks(scene) {
    const own = [];
    if (this.asTyped)
      own.push({
        text: "a sphere's moment of inertia (that of the cube around it)",
        kind: "a sphere's moment of inertia",
      });
    const pairs = materialPairs(scene).map(([i, j]) => contactOf(scene, i, j));
    const impacts = (scene.on_surfaces ?? []).map(({ impact }) => impact);
    const bouncing = impacts.filter((each) => dependsOnSpeed(each) || each.restitution > 0);
    if ([...pairs, ...bouncing].some((contact) => frictionOf(contact) > 0))
      own.push({ text: 'friction in collisions (its limit is by the weight)', kind: 'friction in collisions' });
    const grounds = this.#grounds(scene);
    if (grounds.some(({ kinetic_friction }) => kinetic_friction > 0))
      own.push({
        text: 'friction alike in all headings (up to 1.41 times on diagonals)',
        kind: 'friction alike in all headings',
      });
    const round = scene.surfaces?.some(({ shape }) => shape.kind === 'rod');
    if (round)
      own.push({ text: `round cylinders (prisms of ${CYLINDER_FACES} faces)`, kind: 'round cylinders' });
    if (this.#isSteep())
      own.push({
        text: 'friction on what is not level (its limit is by the weight)',
        kind: 'friction on what is not level',
      });
    if (this.#sinksIn())
      own.push({
        text: 'surfaces that turn over and carry bodies (contact_relaxation lets overlaps grow)',
        kind: 'surfaces that turn over and carry bodies',
      });
    return own;
  }

  #grounds(scene) {
    if (scene.box) return [];
    const beside = scene.bodies.flatMap((_, i) => this.beside.map(({ surface }) => lastingOf(scene, i, surface.touch)));
    return hasSubstrate(scene) ? [...scene.bodies.map((_, i) => groundOf(scene, i)), ...beside] : beside;
  }

  /// Whether a surface that turns comes at bodies while nothing pushes overlaps out: the velocities
  /// agree, but the places drift.
  #sinksIn() {
    return this.chosen.contact_relaxation > MOST_RELAXED && this.beside.some(({ surface }) => turnsOver(surface));
  }

  /// Whether there is friction on a surface on which a body does not simply lie: a round one, a wall,
  /// one that turns over.
  #isSteep() {
    return this.beside.some(({ surface }) => {
      const rubs = this.scene.bodies.some((_, i) => onSurface(this.scene, i, surface.touch).friction > 0);
      return rubs && (!isFlat(surface) || turnsOver(surface) || this.#weightShare(surface.touch) < STEEP);
    });
  }

  #applied(scene, timeStep) {
    const gathered = new Gathered();
    if (!this.asTyped) {
      const first = scene.substrate.map((_, material) => scene.bodies.findIndex((b) => b.material === material));
      for (const i of first.filter((body) => body >= 0 && !scene.box)) {
        for (const [surface, name] of surfaceNames(scene)) {
          const { friction, restitution } = onSurface(scene, i, surface);
          const whose = whoseOn(name, i, surface);
          const limit = friction * this.#weightShare(surface) * this.timeStep;
          gathered.add(name === 'substrate' ? 'friction' : `${name}_friction`, whose, limit);
          const law = surface === FLOOR ? 0 : contactOf(scene, i, surface);
          gathered.add(`${name}_restitution`, whose, law && dependsOnSpeed(law) ? 'by speed' : restitution);
        }
      }
      for (const [i, j] of materialPairs(scene)) {
        const contact = contactOf(scene, i, j);
        gathered.add('restitution', `${i}-${j}`, dependsOnSpeed(contact) ? 'by speed' : contact.restitution);
        gathered.add('pair_friction', `${i}-${j}`, frictionOf(contact) * this.timeStep);
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

const isFlat = ({ shape }) => shape.kind === 'plane' || shape.kind === 'rectangle';
const turnsOver = ({ turns, rate: [x, y] }) => turns && (x !== 0 || y !== 0);
const added = (a, b) => a.map((value, k) => value + b[k]);

/// cannon takes a body's inertia to be that of the box around it.
function setInertia(body, inertia) {
  body.inertia.set(...inertia);
  body.invInertia.set(...inertia.map((moment) => 1 / moment));
  body.updateInertiaWorld(true);
}
