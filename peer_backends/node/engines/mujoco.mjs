// MuJoCo, package @mujoco/mujoco: double precision, rolling and drilling friction, no coefficient of
// restitution (mujoco/contact_terms.mjs).

import { FLOOR, WALL, lastingOf, materialPairs, surfaceNames, touchedSurface, whoseOn } from '../kit/contacts.mjs';
import { Refused } from '../kit/faults.mjs';
import { Gathered } from '../kit/gathered.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { besideSurfaces, planeEnds } from '../kit/surfaces.mjs';
import { rounded } from '../kit/text.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units } from '../kit/units.mjs';
import { ContactTerms } from './mujoco/contact_terms.mjs';
import { ModelText, text } from './mujoco/model_text.mjs';
import { SETTINGS } from './mujoco/settings.mjs';

const PACKAGE = '@mujoco/mujoco';
const LEAST_COEFFICIENT = 1e-5; // mjMINMU
const RESTITUTION_AS_SHIPPED = Math.exp(-2); // of a damping ratio of 1

export async function open(folder) {
  const mujoco = await (await load(folder, PACKAGE))({ print: console.error, printErr: console.error });
  return new MujocoEngine(mujoco, versionOf(folder, PACKAGE));
}

const surfacesOf = (scene) => surfaceNames(scene).map(([surface]) => surface);

class MujocoEngine {
  constructor(mujoco, version) {
    this.mujoco = mujoco;
    this.version = version;
    this.precision = 'double';
    this.takes = ['block', 'cylinder', 'surfaces'];
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
    this.beside = besideSurfaces(this.scene);
    this.#refuse();
    this.terms = new ContactTerms(this.scene, this.chosen, this.timeStep);
    const model = new ModelText(this.scene, this.chosen, this.timeStep, this.terms);
    this.bodyOfGeom = model.bodyOfGeom;
    this.reach = model.reach;
    this.driven = model.driven.map((surface) => ({ surface, depth: model.depthOf(surface) }));
    this.sliding = model.staying
      .filter((surface) => !surface.isStill)
      .map((surface) => ({ surface, geom: model.bodyOfGeom.indexOf(surface.touch) }));
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
      const [x, y, z, vx, vy, vz, wx, wy, wz] = Array.from(
        states.subarray(9 * i, 9 * i + 9),
        (value, k) => value * factors[k],
      );
      if (scene.box) {
        position.set([x, z, 0], this.#offset + 3 * i);
        velocity.set([vx, vz, wy], this.#offset + 3 * i);
      } else {
        const joint = this.driven.length + i;
        position.set([x, y, z, 1, 0, 0, 0], 7 * joint);
        velocity.set([vx, vy, vz, wx, wy, wz], 6 * joint);
      }
    });
  }

  step() {
    if (!this.motion.isStill) this.#moveSurface();
    this.#moveBeside();
    for (const pair of this.bySpeed) this.#setBySpeed(pair);
    this.mujoco.mj_step(this.model, this.data);
    ++this.steps;
  }

  read(states, touches) {
    const { data, scene } = this;
    this.#checkMemory();
    const factors = this.units.ofState;
    const position = data.qpos;
    const velocity = data.qvel;
    scene.bodies.forEach((_, i) => {
      const state = scene.box
        ? this.#stateInBox(position, velocity, i)
        : stateInSpace(position, velocity, this.driven.length + i);
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
      throw new Refused(
        'mujoco: the substrate repeats itself, and a MuJoCo world has no periodic boundaries',
      );
    if (
      restitution === 'one_step' &&
      coefficients === 'pair' &&
      (integrator === 'RK4' || cone !== 'elliptic')
    )
      throw new Refused(
        'mujoco: restitution one_step needs the elliptic cone, whose friction has a solref of its own, and an ' +
          'integrator that takes one force for a step, not RK4',
      );
    if (this.#hasSurfaceVelocity()) return;
    if (!this.scene.box && !this.motion.isStill)
      throw new Refused(
        `mujoco: the substrate moves, and version ${this.version} has no surfacevel (from 3.11 on)`,
      );
    const belt = this.beside.find((surface) => surface.stays && !surface.isStill);
    if (belt)
      throw new Refused(
        `mujoco: surface ${touchedSurface(belt.touch)} moves in itself, and version ${this.version} has no ` +
          'surfacevel (from 3.11 on)',
      );
  }

  #hasSurfaceVelocity() {
    const [major, minor] = this.version.split('.').map(Number);
    return major > 3 || (major === 3 && minor >= 11);
  }

  #stateInBox(position, velocity, i) {
    const at = this.#offset + 3 * i;
    return [
      position[at],
      0,
      position[at + 1],
      velocity[at],
      0,
      velocity[at + 1],
      0,
      velocity[at + 2],
      0,
    ];
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
      const rolls = terms.isOnGround(j) && lastingOf(scene, i, j).rolling.length > 1;
      if (bounces || rolls) found.push({ pair, i, j, bounces, rolls });
    }
    return found;
  }

  #setBySpeed({ pair, i, j, bounces, rolls }) {
    const { approach, along } = this.#speeds(i, j);
    const { friction, solref } = this.terms.of(i, j, { approach, along });
    if (bounces) this.model.pair_solref.set(solref, 2 * pair);
    if (rolls)
      this.model.pair_friction.set(
        friction.map((mu) => Math.max(mu, LEAST_COEFFICIENT)),
        5 * pair,
      );
  }

  /// What is driven begins each step where its surface is, with the velocity at the step's end; what
  /// moves in itself has that as surfacevel, in its own frame.
  #moveBeside() {
    const now = this.startTime + this.steps * this.timeStep;
    const then = now + this.timeStep;
    const inOwn = (axes, v) => axes.map((axis) => axis.reduce((sum, a, k) => sum + a * v[k], 0));
    this.driven.forEach(({ surface, depth }, k) => {
      const centre = surface.behind(now, depth);
      const [x, y, z, w] = surface.quaternion(now);
      this.data.qpos.set([...centre, w, x, y, z], 7 * k);
      const turn = inOwn(surface.axes(now), surface.rate);
      this.data.qvel.set([...surface.velocity(then, centre), ...turn], 6 * k);
    });
    for (const { surface, geom } of this.sliding) {
      const axes = surface.axes(0);
      const velocity = inOwn(axes, surface.velocity(then, surface.centre(0)));
      this.model.geom_surfacevel.set([...velocity, ...inOwn(axes, surface.rate)], 6 * geom);
    }
  }

  /// Towards a surface beside the substrate, and along it.
  #speedsBeside(i, j) {
    const now = this.startTime + this.steps * this.timeStep;
    const surface = this.beside[touchedSurface(j)];
    const state = this.#stateOf(i);
    const normal = surface.normalAt(now, state.slice(0, 3));
    const { radius } = this.scene.bodies[i];
    const point = normal.map((n, k) => state[k] - radius * n);
    const own = surface.velocity(now, point);
    const velocity = own.map((v, k) => state[3 + k] - v);
    const towards = velocity.reduce((sum, v, k) => sum + v * normal[k], 0);
    const along = Math.hypot(...velocity.map((v, k) => v - towards * normal[k]));
    return { approach: Math.abs(towards), along };
  }

  /// Along the line of centres or the plane's normal, and along the plane.
  #speeds(i, j) {
    if (j < FLOOR && !this.scene.box) return this.#speedsBeside(i, j);
    const [a, b] = [i, j].map((body) => this.#stateOf(body));
    const velocity = [3, 4, 5].map((k) => a[k] - b[k]);
    const apart = j >= 0 ? [0, 1, 2].map((k) => a[k] - b[k]) : j === WALL ? [1, 0, 0] : [0, 0, 1];
    const normal = velocity.reduce((sum, v, k) => sum + v * apart[k], 0) / Math.hypot(...apart);
    return { approach: Math.abs(normal), along: Math.hypot(velocity[0], velocity[1]) };
  }

  #stateOf(body) {
    const { data, scene } = this;
    if (body >= 0)
      return scene.box
        ? this.#stateInBox(data.qpos, data.qvel, body)
        : stateInSpace(data.qpos, data.qvel, this.driven.length + body);
    const time = this.startTime + this.steps * this.timeStep;
    const moves = body === FLOOR || scene.box.moving_walls;
    return [0, 0, 0, ...(moves ? this.motion.velocity(time) : [0, 0, 0])];
  }

  /// MuJoCo goes on without the contacts that it has no memory for.
  #checkMemory() {
    const { mjWARN_CONTACTFULL, mjWARN_CNSTRFULL } = this.mujoco.mjtWarning;
    const warnings = this.data.warning; // the data's own, not a copy
    const isFull = [mjWARN_CONTACTFULL, mjWARN_CNSTRFULL].some(({ value }) => warnings.get(value).number > 0);
    if (isFull) throw new Error('MuJoCo had no memory for all contacts');
  }

  #findTouches(touches) {
    const { mujoco, model, data } = this;
    const contacts = data.contact;
    const found = new Touches(this.scene);
    for (let k = 0; k < data.ncon; ++k) {
      const contact = contacts.get(k);
      const ends = [contact.geom1, contact.geom2].map((geom) => this.bodyOfGeom[geom]);
      const [first, second] = ends[0] >= 0 ? ends : [ends[1], ends[0]];
      if (contact.efc_address >= 0 && (second >= FLOOR || !this.scene.box)) {
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
      rolling: true,
      drilling: true,
      rollingTable: !isTyped,
      bounceLaw: !isTyped && settings.restitution !== 'none',
      tangentialRestitution:
        !isTyped && settings.restitution === 'one_step' && settings.slip_time === 0,
      surfaceVelocity: !scene.box,
    });
    const note = (condition, kind, why, filled = kind) => {
      if (condition) missing.push({ text: `${filled} (${why})`, kind });
    };
    const terms = this.#someTerms();
    const slides = terms.some(({ condim }) => condim > 1);
    note(
      settings.cone === 'pyramidal' && slides,
      'friction alike in all headings',
      'down to 0.71 times on diagonals',
    );
    note(
      settings.cone === 'pyramidal' && terms.some(({ condim }) => condim > 3),
      'friction and torques each by itself',
      'the pyramid limits the sum of their shares',
    );
    note(
      slides,
      'sliding without being lifted',
      'the cone pushes a contact apart with up to μ times its slip',
    );
    const bounces = terms.some(({ restitution }) => restitution > 0);
    note(
      bounces && (isTyped || settings.restitution === 'none'),
      'restitution',
      'solref is what ships',
    );
    const isSoft = isTyped || settings.restitution !== 'one_step';
    note(
      isSoft && terms.some(({ restitution }) => restitution === 0),
      'contacts without a rebound',
      `a damping ratio of 1 leaves ${rounded(RESTITUTION_AS_SHIPPED, 3)}`,
    );
    const isRaised = terms.some(
      ({ condim, friction }) =>
        (condim > 3 && friction[2] < LEAST_COEFFICIENT) ||
        (condim > 4 && friction[3] < LEAST_COEFFICIENT),
    );
    const least = rounded(LEAST_COEFFICIENT / this.units.length, 3);
    note(
      isRaised,
      'rolling and drilling lengths below … m',
      'MuJoCo raises them to it',
      `rolling and drilling lengths below ${least} m`,
    );
    return [...missing, ...planeEnds(this.beside, this.reach / this.units.length)];
  }

  /// Of each body on its surfaces, and of two bodies for each two materials.
  #someTerms() {
    const { scene, terms } = this;
    const onSurfaces = scene.bodies.flatMap((_, i) =>
      surfacesOf(scene).map((surface) => terms.of(i, surface)),
    );
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
    scene.bodies.forEach((_, i) => {
      for (const [surface, name] of surfaceNames(scene))
        add(`${name}_`, whoseOn(name, i, surface), terms.of(i, surface), terms.restitutionLaw(i, surface));
    });
    for (const [i, j] of materialPairs(scene))
      add('pair_', `${i}-${j}`, terms.of(i, j), terms.restitutionLaw(i, j));
  }
}

/// A free joint's angular velocity is in the frame of its body; turned as mju_rotVecQuat does.
function stateInSpace(position, velocity, i) {
  const [x, y, z, q0, q1, q2, q3] = position.subarray(7 * i, 7 * i + 7);
  const [vx, vy, vz, wx, wy, wz] = velocity.subarray(6 * i, 6 * i + 6);
  const tx = q0 * wx + q2 * wz - q3 * wy;
  const ty = q0 * wy + q3 * wx - q1 * wz;
  const tz = q0 * wz + q1 * wy - q2 * wx;
  const turned = [
    wx + 2 * (q2 * tz - q3 * ty),
    wy + 2 * (q3 * tx - q1 * tz),
    wz + 2 * (q1 * ty - q2 * tx),
  ];
  return [x, y, z, vx, vy, vz, ...turned];
}
