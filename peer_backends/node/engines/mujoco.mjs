// MuJoCo, package @mujoco/mujoco: double precision. A contact is a soft constraint,
//   a + d (b v + k x) = (1 - d) a0,
// with the impedance d of solimp and b, k of solref (mj_makeImpedance of engine_core_constraint.c). It
// has no coefficient of restitution: solref makes one (ReboundRule).

import {
  FLOOR, LID, WALL, contactOf, dependsOnSpeed, frictionOf, groundOf, materialPairs, naiveBall, naiveSurface,
  pairRestitution, restitutionAt, rollingAt, rollingLength, surfaceRestitution,
} from '../kit/contacts.mjs';
import { contactTime, dampingRatioOf } from '../kit/contact_spring.mjs';
import { Refused } from '../kit/faults.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { count, number, search, word } from '../kit/settings.mjs';
import { rounded } from '../kit/text.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

const PACKAGE = '@mujoco/mujoco';
const LEAST_COEFFICIENT = 1e-5; // mjMINMU
const MOST_PAIRS = 50_000;
const RESTITUTION_AS_SHIPPED = Math.exp(-2); // of a damping ratio of 1

const SETTINGS = [
  word('coefficients', ['fields', 'pair'], 'pair',
    "the scene's coefficients straight in the geoms' fields, of which MuJoCo takes the larger; or exactly, " +
    'in a <pair> for each two bodies'),
  word('restitution', ['none', 'damping_ratio', 'one_step'], 'damping_ratio',
    'how solref makes a rebound: not at all; by the damping ratio of a spring that has that e; by a damping ' +
    'that turns v into -e v in one step of Euler'),
  number('contact_steps', '', 0, 'duration of a rebound by damping_ratio, in steps; 0: as stiff as MuJoCo ships',
    { high: 1e4, ...search(2, 40, true) }),
  number('overlap_push', '', 0.001, 'part of an overlap that one_step pushes out in a step',
    { high: 1, ...search(1e-4, 0.2, true) }),
  number('slip_time', 's', 0, 'time over which friction of one_step ends a slip; 0: one step, and tangential restitution', {
    high: 10, ...search(1e-3, 0.1, true) }),
  number('time_constant', 's', 0.02, 'solref[0] of contacts that do not rebound', {
    low: 1e-9, high: 1e3, ...search(1e-3, 0.1, true) }),
  number('damping_ratio', '', 1, 'solref[1] of contacts that do not rebound', { low: 1e-3, high: 1e3 }),
  number('impedance_at_touch', '', 0.9, 'solimp[0]', { low: 1e-4, high: 0.9999, candidates: [0.9, 0.9999] }),
  number('impedance', '', 0.95, 'solimp[1], of overlaps beyond the width',
    { low: 1e-4, high: 0.9999, candidates: [0.95, 0.9999] }),
  number('impedance_width', 'm', 0.001, 'solimp[2], overlap over which the impedance changes'),
  number('margin', 'R', 0, 'gap at which there is a contact, over the smallest radius',
    { high: 1, candidates: [0, 1e-6, 1e-4] }),
  word('cone', ['pyramidal', 'elliptic'], 'pyramidal', 'limit of friction and of rolling and drilling torque'),
  word('condim', ['by_need', '3', '4', '6'], 'by_need',
    'rows of a contact: those that its coefficients need, or with friction (3), drilling (4), rolling friction (6)',
    { candidates: ['by_need'] }),
  number('impratio', '', 1, 'impedance of friction over that of the normal force',
    { low: 1e-3, high: 1e6, candidates: [1, 10, 100] }),
  word('solver', ['PGS', 'CG', 'Newton'], 'Newton', 'of the constraints'),
  count('solver_iterations', 100, 'at most', { low: 1, high: 100_000, candidates: [1, 10, 100] }),
  count('line_search_iterations', 50, 'at most, of CG and Newton', { low: 1, high: 100_000 }),
  number('solver_tolerance', '', 1e-8, 'improvement at which the iterations end', {
    high: 1, candidates: [1e-8, 1e-14] }),
  count('noslip_iterations', 0, 'of a solver that goes over friction again', { high: 100_000, candidates: [0, 10] }),
  word('integrator', ['Euler', 'RK4', 'implicit', 'implicitfast'], 'Euler', 'of the motion'),
  ...unitSettings,
];

export async function open(folder) {
  const mujoco = await (await load(folder, PACKAGE))({ print: console.error, printErr: console.error });
  return new MujocoEngine(mujoco, versionOf(folder, PACKAGE));
}

/// What a contact's coefficients are in MuJoCo's terms.
class ReboundRule {
  constructor(settings, timeStep) {
    this.settings = settings;
    this.timeStep = timeStep;
  }

  /// solref for a coefficient of restitution. In its negative form it is -k d, -b d for d the
  /// impedance, which is taken for that of an overlap beyond the width: ω² = -solref[0]/d, 2 ζ ω = -solref[1].
  solref(e) {
    const { restitution, time_constant, damping_ratio, impedance } = this.settings;
    if (restitution === 'one_step') return this.#inOneStep(e);
    if (restitution === 'none' || e === 0) return [time_constant, damping_ratio];
    const zeta = dampingRatioOf(e);
    const omega = this.#frequency(zeta);
    return [-impedance * omega * omega, -2 * zeta * omega];
  }

  /// Of the rows of friction; only an elliptic cone has them by themselves. Slip decays over slip_time, or one step
  /// stops it or turns u into -β0 u.
  solrefFriction(beta0) {
    const { restitution, slip_time } = this.settings;
    if (restitution !== 'one_step') return [0, 0];
    if (slip_time > this.timeStep) return [0, -1 / slip_time];
    return [0, -(1 + Math.max(beta0, 0)) / this.timeStep];
  }

  /// v' = v - d dt b v = -e v.
  #inOneStep(e) {
    const { overlap_push, impedance } = this.settings;
    return [(-impedance * overlap_push) / this.timeStep ** 2, -(1 + e) / this.timeStep];
  }

  /// ω by the shipped k = 1/(d time_constant damping_ratio)², or by the duration of the rebound.
  #frequency(zeta) {
    const { contact_steps, time_constant, damping_ratio, impedance } = this.settings;
    if (contact_steps > 0 && zeta < 1) return contactTime(zeta) / (contact_steps * this.timeStep);
    return 1 / (Math.sqrt(impedance) * time_constant * damping_ratio);
  }
}

/// What MuJoCo takes for a contact: rows, their coefficients and how they answer.
class ContactTerms {
  constructor(scene, settings, timeStep) {
    this.scene = scene;
    this.settings = settings;
    this.rule = new ReboundRule(settings, timeStep);
  }

  /// Between a body and another or a surface; the numbers of a law are those at these speeds [m/s].
  of(i, j, speeds = {}) {
    const { friction, drilling, rolling, restitution, beta0 } = this.#coefficients(i, j, speeds);
    return {
      condim: this.#condim(friction, drilling, rolling),
      friction: [friction, friction, drilling, rolling, rolling],
      solref: this.rule.solref(restitution),
      solreffriction: this.rule.solrefFriction(beta0),
      restitution,
    };
  }

  isOnSubstrate(j) {
    return j === FLOOR && !this.scene.box;
  }

  restitutionLaw(i, j) {
    return this.isOnSubstrate(j) ? groundOf(this.scene, i).restitution : contactOf(this.scene, i, j).restitution;
  }

  #coefficients(i, j, { approach, along = 0 }) {
    const { scene } = this;
    if (this.isOnSubstrate(j)) {
      const { kinetic_friction, drilling_length, rolling, restitution } = groundOf(scene, i);
      return {
        friction: kinetic_friction, drilling: drilling_length,
        rolling: rollingLength(scene.bodies[i], rollingAt(rolling, along)), restitution, beta0: 0,
      };
    }
    const contact = contactOf(scene, i, j);
    const atStart = () => (j < 0 ? surfaceRestitution(scene, i, j) : pairRestitution(scene, i, j));
    const restitution = approach === undefined ? atStart() : restitutionAt(contact.restitution, approach);
    return {
      friction: frictionOf(contact), drilling: 0, rolling: 0, restitution, beta0: contact.tangential_restitution,
    };
  }

  #condim(friction, drilling, rolling) {
    if (this.settings.condim !== 'by_need') return Number(this.settings.condim);
    if (rolling > 0) return 6;
    if (drilling > 0) return 4;
    return friction > 0 ? 3 : 1;
  }
}

const surfacesOf = ({ box }) => (!box ? [FLOOR] : box.lid ? [FLOOR, WALL, LID] : [FLOOR, WALL]);
const text = (values) => values.join(' ');

/// The scene as MuJoCo's XML, and which geom is whose.
class ModelText {
  constructor(scene, settings, timeStep, terms) {
    this.scene = scene;
    this.settings = settings;
    this.timeStep = timeStep;
    this.terms = terms;
    const motion = surfaceMotion(scene);
    this.isMoved = !motion.isStill;
    this.isTyped = settings.coefficients === 'fields';
    this.isByGeom = this.isTyped || this.#isOneKind();
    this.bodyOfGeom = [...this.#surfaces(false), ...this.#surfaces(true)].map(({ surface }) => surface)
      .concat(scene.bodies.map((_, i) => i));
  }

  xml() {
    const { settings: s } = this;
    const option = `<option timestep="${this.timeStep}" gravity="${text(gravityOf(this.scene))}" cone="${s.cone}"` +
      ` impratio="${s.impratio}" solver="${s.solver}" integrator="${s.integrator}" tolerance="${s.solver_tolerance}"` +
      ` iterations="${s.solver_iterations}" ls_iterations="${s.line_search_iterations}"` +
      ` noslip_iterations="${s.noslip_iterations}"><flag autoreset="disable"/></option>`;
    return `<mujoco>${option}${this.#statistic()}<worldbody>${this.#surfaceGeoms(false)}${this.#movingBody()}` +
      `${this.scene.bodies.map((_, i) => this.#ball(i)).join('')}</worldbody><contact>${this.#pairs()}</contact></mujoco>`;
  }

  /// A moving floor is a body of such mass that nothing stops it; the solver's tolerance is to go on being
  /// measured by the balls.
  #statistic() {
    if (!this.#hasMovingBody()) return '';
    const inertias = this.scene.bodies.map(
      ({ mass, radius, shape_factor }) => (2 * mass + shape_factor * mass * radius ** 2) / 3);
    return `<statistic meaninertia="${inertias.reduce((a, b) => a + b) / inertias.length}"/>`;
  }

  #hasMovingBody() {
    return this.isMoved && Boolean(this.scene.box);
  }

  #isOneKind() {
    const { scene, terms } = this;
    const pairs = materialPairs(scene);
    if (pairs.length === 0) return true;
    if (scene.substrate.length > 1 || dependsOnSpeed(contactOf(scene, ...pairs[0]))) return false;
    return this.settings.restitution !== 'one_step' || terms.of(...pairs[0]).condim === 1;
  }

  /// Planes where they stand; boxes where they move, since a plane of MuJoCo's cannot.
  #surfaces(moving) {
    const { box } = this.scene;
    const isMoving = (surface) => this.#hasMovingBody() && (surface === FLOOR || box.moving_walls);
    const all = [{ surface: FLOOR, place: [0, 0, 0], normal: [0, 0, 1] }];
    if (box) {
      all.push({ surface: WALL, place: [0, 0, 0], normal: [1, 0, 0] });
      all.push({ surface: WALL, place: [box.width, 0, 0], normal: [-1, 0, 0] });
      if (box.lid) all.push({ surface: LID, place: [0, 0, box.lid], normal: [0, 0, -1] });
    }
    return all.filter(({ surface }) => isMoving(surface) === moving);
  }

  #surfaceGeoms(moving) {
    const half = 100 * this.scene.bodies.reduce((most, { radius }) => Math.max(most, radius), this.scene.box?.width ?? 1);
    return this.#surfaces(moving).map(({ surface, place, normal }, k) => {
      const name = `${moving ? 'moving' : 'still'}${k}`;
      const own = this.isTyped ? this.#typed(naiveSurface(this.scene, surface)) : 'contype="0" conaffinity="0"';
      if (moving) {
        const middle = place.map((p, axis) => p - half * normal[axis]);
        return `<geom name="${name}" type="box" pos="${text(middle)}" size="${half} ${half} ${half}" mass="0" ${own}/>`;
      }
      const belt = this.isMoved && surface === FLOOR ? ' surfacevel="1 0 0 0 0 0"' : '';
      return `<geom name="${name}" type="plane" size="0 0 1" pos="${text(place)}" zaxis="${text(normal)}" ${own}${belt}/>`;
    }).join('');
  }

  #movingBody() {
    if (!this.#hasMovingBody()) return '';
    const mass = 1e6 * this.scene.bodies.reduce((sum, body) => sum + body.mass, 0);
    return `<body gravcomp="1"><joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass="${mass}" ` +
      `diaginertia="${mass} ${mass} ${mass}"/>${this.#surfaceGeoms(true)}</body>`;
  }

  #ball(i) {
    const { radius, mass, shape_factor } = this.scene.bodies[i];
    const inertia = shape_factor * mass * radius * radius;
    const joints = this.scene.box
      ? '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>'
      : '<freejoint/>';
    return `<body>${joints}<inertial pos="0 0 0" mass="${mass}" diaginertia="${inertia} ${inertia} ${inertia}"/>` +
      `<geom name="ball${i}" type="sphere" size="${radius}" ${this.#ballContact(i)}/></body>`;
  }

  #ballContact(i) {
    if (this.isTyped) return this.#typed(naiveBall(this.scene, i));
    const [some] = materialPairs(this.scene);
    if (!this.isByGeom || !some) return 'contype="0" conaffinity="0"';
    const { condim, friction, solref } = this.terms.of(...some);
    return `condim="${condim}" friction="${text([friction[0], friction[2], friction[3]])}" ` +
      `solref="${text(solref)}" ${this.#common(2)}`;
  }

  #typed({ friction, rolling, spinning }) {
    const { condim, time_constant, damping_ratio } = this.settings;
    const rows = condim !== 'by_need' ? condim : rolling > 0 ? 6 : spinning > 0 ? 4 : 3;
    return `condim="${rows}" friction="${friction} ${spinning} ${rolling}" ` +
      `solref="${time_constant} ${damping_ratio}" ${this.#common(2)}`;
  }

  /// The margins of two geoms add up to that of their contact.
  #common(geoms) {
    const s = this.settings;
    const smallest = this.scene.bodies.reduce((least, { radius }) => Math.min(least, radius), Infinity);
    return `solimp="${s.impedance_at_touch} ${s.impedance} ${s.impedance_width} 0.5 2" ` +
      `margin="${(s.margin * smallest) / geoms}"`;
  }

  #pairs() {
    if (this.isTyped) return '';
    const pairs = [];
    const names = [...this.#surfaces(false).map((each, k) => ({ ...each, name: `still${k}` })),
      ...this.#surfaces(true).map((each, k) => ({ ...each, name: `moving${k}` }))];
    this.scene.bodies.forEach((_, i) => {
      for (const { surface, name } of names) pairs.push(this.#pair(`ball${i}`, name, this.terms.of(i, surface)));
      if (this.isByGeom) return;
      for (let j = 0; j < i; ++j) pairs.push(this.#pair(`ball${j}`, `ball${i}`, this.terms.of(j, i)));
    });
    if (pairs.length > MOST_PAIRS)
      throw new Refused(`mujoco: ${pairs.length} pairs with coefficients of their own, more than ${MOST_PAIRS}`);
    return pairs.join('');
  }

  #pair(first, second, { condim, friction, solref, solreffriction }) {
    return `<pair geom1="${first}" geom2="${second}" condim="${condim}" friction="${text(friction)}" ` +
      `solref="${text(solref)}" solreffriction="${text(solreffriction)}" ${this.#common(1)}/>`;
  }
}

class MujocoEngine {
  constructor(mujoco, version) {
    this.mujoco = mujoco;
    this.version = version;
    this.precision = 'double';
    this.settings = SETTINGS;
    this.force = new mujoco.DoubleBuffer(6);
  }

  configure(scene, settings, timeStep) {
    this.#leave();
    this.units = new Units(scene, settings);
    this.chosen = settings;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.motion = surfaceMotion(this.scene);
    this.#refuse();
    this.terms = new ContactTerms(this.scene, this.chosen, this.timeStep);
    const model = new ModelText(this.scene, this.chosen, this.timeStep, this.terms);
    this.bodyOfGeom = model.bodyOfGeom;
    this.model = this.mujoco.MjModel.from_xml_string(model.xml());
    this.data = new this.mujoco.MjData(this.model);
    this.bySpeed = model.isTyped ? [] : this.#pairsBySpeed();
    return {
      settings: this.#applied(scene, settings, timeStep),
      not_represented: this.#lacks(scene, settings, timeStep),
      left_out: this.#leftOut(),
    };
  }

  start(states, time) {
    const { mujoco, model, data, scene } = this;
    mujoco.mj_resetData(model, data);
    this.startTime = time * this.units.time;
    this.steps = 0;
    const position = data.qpos;
    const velocity = data.qvel;
    const factors = this.units.ofState;
    scene.bodies.forEach((_, i) => {
      const [x, y, z, vx, vy, vz, wx, wy, wz] =
        Array.from(states.subarray(9 * i, 9 * i + 9), (value, k) => value * factors[k]);
      if (scene.box) {
        position.set([x, z, 0], this.#offset + 3 * i);
        velocity.set([vx, vz, wy], this.#offset + 3 * i);
      } else {
        position.set([x, y, z, 1, 0, 0, 0], 7 * i);
        velocity.set([vx, vy, vz, wx, wy, wz], 6 * i);
      }
    });
  }

  step() {
    if (!this.motion.isStill) this.#moveSurface();
    for (const pair of this.bySpeed) this.#setBySpeed(pair);
    this.mujoco.mj_step(this.model, this.data);
    ++this.steps;
  }

  read(states, touches) {
    const { data, scene } = this;
    const factors = this.units.ofState;
    const position = data.qpos;
    const velocity = data.qvel;
    scene.bodies.forEach((_, i) => {
      const state = scene.box ? this.#stateInBox(position, velocity, i) : stateInSpace(position, velocity, i);
      state.forEach((value, k) => {
        states[9 * i + k] = value / factors[k];
      });
    });
    this.#findTouches(touches);
  }

  #leave() {
    this.data?.delete();
    this.model?.delete();
    this.data = this.model = undefined;
  }

  /// Numbers of qpos and qvel before the balls': the floor's.
  get #offset() {
    return this.scene.box && !this.motion.isStill ? 1 : 0;
  }

  #refuse() {
    const { restitution, integrator, cone, coefficients } = this.chosen;
    if (this.scene.periodic.some((length) => length > 0))
      throw new Refused('mujoco: the substrate repeats itself, and a MuJoCo world has no periodic boundaries');
    if (restitution === 'one_step' && coefficients === 'pair' && (integrator === 'RK4' || cone !== 'elliptic'))
      throw new Refused(
        'mujoco: restitution one_step needs the elliptic cone, whose friction has a solref of its own, and an ' +
        'integrator that takes one force for a step, not RK4');
    if (!this.scene.box && !this.motion.isStill && !this.#hasSurfaceVelocity())
      throw new Refused(`mujoco: the substrate moves, and version ${this.version} has no surfacevel (from 3.11 on)`);
  }

  #hasSurfaceVelocity() {
    const [major, minor] = this.version.split('.').map(Number);
    return major > 3 || (major === 3 && minor >= 11);
  }

  #stateInBox(position, velocity, i) {
    const at = this.#offset + 3 * i;
    return [position[at], 0, position[at + 1], velocity[at], 0, velocity[at + 1], 0, velocity[at + 2], 0];
  }

  /// The plane has the velocity of the step's end; the floor of a box its mean over the step.
  #moveSurface() {
    const now = this.startTime + this.steps * this.timeStep;
    if (!this.scene.box) {
      this.model.geom_surfacevel.set(this.motion.velocity(now + this.timeStep), 0);
      return;
    }
    const height = this.motion.position(now)[2];
    const then = this.motion.position(now + this.timeStep)[2];
    this.data.qpos[0] = height;
    this.data.qvel[0] = (then - height) / this.timeStep;
  }

  /// Pairs whose restitution or rolling friction is a law.
  #pairsBySpeed() {
    const { model, scene, terms } = this;
    const first = model.pair_geom1;
    const second = model.pair_geom2;
    const found = [];
    for (let pair = 0; pair < first.length; ++pair) {
      const ends = [first[pair], second[pair]].map((geom) => this.bodyOfGeom[geom]);
      const [i, j] = ends[0] >= 0 ? ends : [ends[1], ends[0]];
      const bounces = typeof terms.restitutionLaw(i, j) !== 'number';
      const rolls = terms.isOnSubstrate(j) && groundOf(scene, i).rolling.length > 1;
      if (bounces || rolls) found.push({ pair, i, j, bounces, rolls });
    }
    return found;
  }

  #setBySpeed({ pair, i, j, bounces, rolls }) {
    const { approach, along } = this.#speeds(i, j);
    const { friction, solref } = this.terms.of(i, j, { approach, along });
    if (bounces) this.model.pair_solref.set(solref, 2 * pair);
    if (rolls) this.model.pair_friction.set(friction.map((mu) => Math.max(mu, LEAST_COEFFICIENT)), 5 * pair);
  }

  /// Along the line of centres or the plane's normal, and along the plane.
  #speeds(i, j) {
    const [a, b] = [i, j].map((body) => this.#stateOf(body));
    const velocity = [3, 4, 5].map((k) => a[k] - b[k]);
    const apart = j >= 0 ? [0, 1, 2].map((k) => a[k] - b[k]) : j === WALL ? [1, 0, 0] : [0, 0, 1];
    const normal = velocity.reduce((sum, v, k) => sum + v * apart[k], 0) / Math.hypot(...apart);
    return { approach: Math.abs(normal), along: Math.hypot(velocity[0], velocity[1]) };
  }

  #stateOf(body) {
    const { data, scene } = this;
    if (body >= 0)
      return scene.box ? this.#stateInBox(data.qpos, data.qvel, body) : stateInSpace(data.qpos, data.qvel, body);
    const time = this.startTime + this.steps * this.timeStep;
    const moves = body === FLOOR || scene.box.moving_walls;
    return [0, 0, 0, ...(moves ? this.motion.velocity(time) : [0, 0, 0])];
  }

  #findTouches(touches) {
    const { mujoco, model, data } = this;
    const contacts = data.contact;
    const found = new Touches();
    for (let k = 0; k < data.ncon; ++k) {
      const contact = contacts.get(k);
      const ends = [contact.geom1, contact.geom2].map((geom) => this.bodyOfGeom[geom]);
      const [first, second] = ends[0] >= 0 ? ends : [ends[1], ends[0]];
      if (contact.efc_address >= 0 && (second === FLOOR || second >= 0)) {
        mujoco.mj_contactForce(model, data, k, this.force);
        found.add(first, second, this.force.GetView()[0] * this.timeStep);
      }
      contact.delete();
    }
    contacts.delete();
    found.pushTo(touches, 1 / this.units.impulse);
  }

  #lacks(scene, settings, timeStep) {
    const isTyped = settings.coefficients === 'fields';
    const missing = lacks(scene, timeStep, {
      rolling: true, drilling: true, rollingTable: !isTyped,
      bounceLaw: !isTyped && settings.restitution !== 'none',
      tangentialRestitution: !isTyped && settings.restitution === 'one_step' && settings.slip_time === 0,
      surfaceVelocity: !scene.box,
    });
    const note = (condition, kind, why, filled = kind) => {
      if (condition) missing.push({ text: `${filled} (${why})`, kind });
    };
    const terms = this.#someTerms();
    const slides = terms.some(({ condim }) => condim > 1);
    note(settings.cone === 'pyramidal' && slides, 'friction alike in all headings', 'down to 0.71 times on diagonals');
    note(settings.cone === 'pyramidal' && terms.some(({ condim }) => condim > 3),
      'friction and torques each by itself', 'the pyramid limits the sum of their shares');
    note(slides, 'sliding without being lifted', 'the cone pushes a contact apart with up to μ times its slip');
    const bounces = terms.some(({ restitution }) => restitution > 0);
    note(bounces && (isTyped || settings.restitution === 'none'), 'restitution', 'solref is what ships');
    const isSoft = isTyped || settings.restitution !== 'one_step';
    note(isSoft && terms.some(({ restitution }) => restitution === 0), 'contacts without a rebound',
      `a damping ratio of 1 leaves ${rounded(RESTITUTION_AS_SHIPPED, 3)}`);
    const isRaised = terms.some(({ condim, friction }) =>
      (condim > 3 && friction[2] < LEAST_COEFFICIENT) || (condim > 4 && friction[3] < LEAST_COEFFICIENT));
    const least = rounded(LEAST_COEFFICIENT / this.units.length, 3);
    note(isRaised, 'rolling and drilling lengths below … m', 'MuJoCo raises them to it',
      `rolling and drilling lengths below ${least} m`);
    return missing;
  }

  /// Of each body on its surfaces, and of two bodies for each two materials.
  #someTerms() {
    const { scene, terms } = this;
    const onSurfaces = scene.bodies.flatMap((_, i) => surfacesOf(scene).map((surface) => terms.of(i, surface)));
    return [...onSurfaces, ...materialPairs(scene).map(([i, j]) => terms.of(i, j))];
  }

  #leftOut() {
    if (this.chosen.condim !== 'by_need' || this.chosen.coefficients === 'fields') return [];
    const most = Math.max(...this.#someTerms().map(({ condim }) => condim));
    const texts = [];
    if (most < 6) texts.push('rolling rows (no rolling friction)');
    if (most < 4) texts.push('spinning rows (no drilling friction)');
    if (most < 3) texts.push('friction rows (no friction)');
    return texts;
  }

  #applied(scene, settings, timeStep) {
    const [x, y] = scene.downhill;
    const gathered = new Gathered();
    if (settings.coefficients === 'pair') this.#gather(gathered);
    return {
      ...settings,
      ...gathered.settings(),
      ...this.units.applied(),
      time_step: timeStep,
      gravity: scene.gravity,
      ...(x !== 0 || y !== 0 ? { downhill_x: x, downhill_y: y } : {}),
    };
  }

  #gather(gathered) {
    const { scene, terms } = this;
    const add = (prefix, whose, { condim, friction, solref, restitution }, law) => {
      gathered.add(`${prefix}condim`, whose, condim);
      gathered.add(`${prefix}friction`, whose, friction[0]);
      if (condim > 3) gathered.add(`${prefix}drilling_friction`, whose, friction[2]);
      if (condim > 4) gathered.add(`${prefix}rolling_friction`, whose, friction[3]);
      const isLaw = typeof law !== 'number';
      gathered.add(`${prefix}restitution`, whose, isLaw ? 'by speed' : restitution);
      gathered.add(`${prefix}solref`, whose, isLaw ? 'by speed' : text(solref));
    };
    const names = { [FLOOR]: scene.box ? 'floor_' : 'substrate_', [WALL]: 'wall_', [LID]: 'lid_' };
    scene.bodies.forEach((_, i) => {
      for (const surface of surfacesOf(scene))
        add(names[surface], i, terms.of(i, surface), terms.restitutionLaw(i, surface));
    });
    for (const [i, j] of materialPairs(scene)) add('pair_', `${i}-${j}`, terms.of(i, j), terms.restitutionLaw(i, j));
  }
}

/// A free joint's angular velocity is in the frame of its body.
function stateInSpace(position, velocity, i) {
  const [x, y, z, qw, qx, qy, qz] = position.subarray(7 * i, 7 * i + 7);
  const [vx, vy, vz, wx, wy, wz] = velocity.subarray(6 * i, 6 * i + 6);
  const tx = 2 * (qy * wz - qz * wy);
  const ty = 2 * (qz * wx - qx * wz);
  const tz = 2 * (qx * wy - qy * wx);
  return [x, y, z, vx, vy, vz,
    wx + qw * tx + qy * tz - qz * ty,
    wy + qw * ty + qz * tx - qx * tz,
    wz + qw * tz + qx * ty - qy * tx];
}
