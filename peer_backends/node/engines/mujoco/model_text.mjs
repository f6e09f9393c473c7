// The scene as a model in MuJoCo's XML.

import {
  FLOOR,
  LID,
  WALL,
  contactOf,
  dependsOnSpeed,
  materialPairs,
  naiveBall,
  naiveSurface,
  touchedSurface,
} from '../../kit/contacts.mjs';
import { Refused } from '../../kit/faults.mjs';
import { surfaceMotion } from '../../kit/motion.mjs';
import { besideSurfaces, farthest, hasSubstrate } from '../../kit/surfaces.mjs';
import { halfOf, inertiaOf, isBlock, isSphere, turnFromZ, turnOf } from '../../kit/solids.mjs';
import { gravityOf } from '../../kit/units.mjs';

const MOST_PAIRS = 50_000;

export const text = (values) => values.join(' ');

/// The scene as MuJoCo's XML, and which geom is whose.
export class ModelText {
  constructor(scene, settings, timeStep, terms) {
    this.scene = scene;
    this.settings = settings;
    this.timeStep = timeStep;
    this.terms = terms;
    const motion = surfaceMotion(scene);
    this.isMoved = !motion.isStill;
    const beside = besideSurfaces(scene);
    /// Those that stay, geoms of the world, and those that are bodies of their own, in this order.
    this.staying = beside.filter((surface) => surface.stays);
    this.driven = beside.filter((surface) => !surface.stays);
    /// Half the size of a box in the place of a plane that moves away.
    this.reach = 100 * farthest(scene, scene.bodies.reduce((most, { radius }) => Math.max(most, radius), 0));
    this.isTyped = settings.coefficients === 'fields';
    this.isByGeom = this.isTyped || this.#isOneKind();
    this.bodyOfGeom = [
      ...this.#surfaces(false).map(({ surface }) => surface),
      ...this.staying.map(({ touch }) => touch),
      ...this.#surfaces(true).map(({ surface }) => surface),
      ...this.driven.map(({ touch }) => touch),
      ...scene.bodies.map((_, i) => i),
    ];
  }

  xml() {
    const { settings: s } = this;
    const option =
      `<option timestep="${this.timeStep}" gravity="${text(gravityOf(this.scene))}" cone="${s.cone}"` +
      ` impratio="${s.impratio}" solver="${s.solver}" integrator="${s.integrator}" tolerance="${s.solver_tolerance}"` +
      ` iterations="${s.solver_iterations}" ls_iterations="${s.line_search_iterations}"` +
      ` noslip_iterations="${s.noslip_iterations}"><flag autoreset="disable"/></option>`;
    return (
      `<mujoco>${option}${this.#statistic()}<worldbody>${this.#surfaceGeoms(false)}` +
      `${this.staying.map((surface) => this.#stayingGeom(surface)).join('')}${this.#movingBody()}` +
      `${this.driven.map((surface) => this.#drivenBody(surface)).join('')}` +
      `${this.scene.bodies.map((_, i) => this.#ball(i)).join('')}</worldbody><contact>${this.#pairs()}</contact></mujoco>`
    );
  }

  /// A moving floor is a body of such mass that nothing stops it; the solver's tolerance is to go
  /// on being measured by the balls.
  #statistic() {
    if (!this.#hasMovingBody() && this.driven.length === 0) return '';
    const inertias = this.scene.bodies.map(
      ({ mass, radius, shape_factor }) => (2 * mass + shape_factor * mass * radius ** 2) / 3,
    );
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
    const all = hasSubstrate(this.scene) ? [{ surface: FLOOR, place: [0, 0, 0], normal: [0, 0, 1] }] : [];
    if (box) {
      all.push({ surface: WALL, place: [0, 0, 0], normal: [1, 0, 0] });
      all.push({ surface: WALL, place: [box.width, 0, 0], normal: [-1, 0, 0] });
      if (box.lid) all.push({ surface: LID, place: [0, 0, box.lid], normal: [0, 0, -1] });
    }
    return all.filter(({ surface }) => isMoving(surface) === moving);
  }

  #surfaceGeoms(moving) {
    const half =
      100 *
      this.scene.bodies.reduce(
        (most, { radius }) => Math.max(most, radius),
        this.scene.box?.width ?? 1,
      );
    return this.#surfaces(moving)
      .map(({ surface, place, normal }, k) => {
        const name = `${moving ? 'moving' : 'still'}${k}`;
        const own = this.isTyped
          ? `${this.#typed(naiveSurface(this.scene, surface))}${this.scene.box ? '' : ' conaffinity="0"'}`
          : 'contype="0" conaffinity="0"';
        if (moving) {
          const middle = place.map((p, axis) => p - half * normal[axis]);
          return `<geom name="${name}" type="box" pos="${text(middle)}" size="${half} ${half} ${half}" mass="0" ${own}/>`;
        }
        const belt = this.isMoved && surface === FLOOR ? ' surfacevel="1 0 0 0 0 0"' : '';
        return `<geom name="${name}" type="plane" size="0 0 1" pos="${text(place)}" zaxis="${text(normal)}" ${own}${belt}/>`;
      })
      .join('');
  }

  /// A plane, a box, a cylinder along z or a sphere in the surface's own frame.
  #geomOfSurface({ shape, extent, touch }) {
    const wide = this.reach;
    const geom = {
      plane: () => `type="box" size="${wide} ${wide} ${wide}"`,
      rectangle: () => `type="box" size="${text(extent)}"`,
      rod: () => `type="cylinder" size="${shape.radius} ${extent[2]}"`,
      ball: () => `type="sphere" size="${shape.radius}"`,
    }[shape.kind]();
    return `name="${besideName(touch)}" ${geom} ${this.#ofSurface(touch)}`;
  }

  /// Surfaces do not meet each other.
  #ofSurface(touch) {
    if (!this.isTyped) return 'contype="0" conaffinity="0"';
    return `${this.#typed(naiveSurface(this.scene, touch))} conaffinity="0"`;
  }

  /// surfacevel is told step by step, but only a model that has some looks at it.
  #stayingGeom(surface) {
    const belt = surface.isStill ? '' : ' surfacevel="1 0 0 0 0 1"';
    const { shape, touch } = surface;
    const geom = shape.kind === 'plane'
      ? `name="${besideName(touch)}" type="plane" size="0 0 1" ${this.#ofSurface(touch)}` : this.#geomOfSurface(surface);
    return `<geom ${geom} pos="${text(surface.centre(0))}" ${quat(surface.quaternion(0))}${belt}/>`;
  }

  /// A body of such mass that nothing stops it; where it is and how it moves is told step by step.
  #drivenBody(surface) {
    const mass = 1e6 * this.scene.bodies.reduce((sum, body) => sum + body.mass, 0);
    const inertia = mass * this.reach ** 2;
    return (
      `<body gravcomp="1"><freejoint/><inertial pos="0 0 0" mass="${mass}" ` +
      `diaginertia="${inertia} ${inertia} ${inertia}"/><geom ${this.#geomOfSurface(surface)} mass="0"/></body>`
    );
  }

  /// How far behind its face the middle of what is driven lies.
  depthOf({ shape }) {
    return shape.kind === 'plane' ? this.reach : 0;
  }

  #movingBody() {
    if (!this.#hasMovingBody()) return '';
    const mass = 1e6 * this.scene.bodies.reduce((sum, body) => sum + body.mass, 0);
    return (
      `<body gravcomp="1"><joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass="${mass}" ` +
      `diaginertia="${mass} ${mass} ${mass}"/>${this.#surfaceGeoms(true)}</body>`
    );
  }

  #ball(i) {
    const body = this.scene.bodies[i];
    const joints = this.scene.box
      ? '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>'
      : '<freejoint/>';
    return (
      `<body>${joints}<inertial pos="0 0 0" mass="${body.mass}" ${turned(body, turnOf)}` +
      `diaginertia="${text(inertiaOf(body))}"/>` +
      `<geom name="ball${i}" ${geomOf(body)} ${this.#ballContact(i)}/></body>`
    );
  }

  #ballContact(i) {
    if (this.isTyped) return this.#typed(naiveBall(this.scene, i));
    const [some] = materialPairs(this.scene);
    if (!this.isByGeom || !some) return 'contype="0" conaffinity="0"';
    const { condim, friction, solref } = this.terms.of(...some);
    return (
      `condim="${condim}" friction="${text([friction[0], friction[2], friction[3]])}" ` +
      `solref="${text(solref)}" ${this.#common(2)}`
    );
  }

  #typed({ friction, rolling, spinning }) {
    const { condim, time_constant, damping_ratio } = this.settings;
    const rows = condim !== 'by_need' ? condim : rolling > 0 ? 6 : spinning > 0 ? 4 : 3;
    return (
      `condim="${rows}" friction="${friction} ${spinning} ${rolling}" ` +
      `solref="${time_constant} ${damping_ratio}" ${this.#common(2)}`
    );
  }

  /// The margins of two geoms add up to that of their contact.
  #common(geoms) {
    const s = this.settings;
    const smallest = this.scene.bodies.reduce((least, { radius }) => Math.min(least, radius), Infinity);
    return (
      `solimp="${s.impedance_at_touch} ${s.impedance} ${s.impedance_width} 0.5 2" ` +
      `margin="${(s.margin * smallest) / geoms}"`
    );
  }

  #pairs() {
    if (this.isTyped) return '';
    const pairs = [];
    const names = [
      ...this.#surfaces(false).map((each, k) => ({ ...each, name: `still${k}` })),
      ...this.#surfaces(true).map((each, k) => ({ ...each, name: `moving${k}` })),
      ...[...this.staying, ...this.driven].map(({ touch }) => ({ surface: touch, name: besideName(touch) })),
    ];
    this.scene.bodies.forEach((_, i) => {
      for (const { surface, name } of names)
        pairs.push(this.#pair(`ball${i}`, name, this.terms.of(i, surface)));
      if (this.isByGeom) return;
      for (let j = 0; j < i; ++j) pairs.push(this.#pair(`ball${j}`, `ball${i}`, this.terms.of(j, i)));
    });
    if (pairs.length > MOST_PAIRS)
      throw new Refused(
        `mujoco: ${pairs.length} pairs with coefficients of their own, more than ${MOST_PAIRS}`,
      );
    return pairs.join('');
  }

  #pair(first, second, { condim, friction, solref, solreffriction }) {
    return (
      `<pair geom1="${first}" geom2="${second}" condim="${condim}" friction="${text(friction)}" ` +
      `solref="${text(solref)}" solreffriction="${text(solreffriction)}" ${this.#common(1)}/>`
    );
  }
}

const besideName = (touch) => `beside${touchedSurface(touch)}`;
const quat = ([x, y, z, w]) => `quat="${text([w, x, y, z])}"`;

/// Turned in its body, whose axes are the world's at the start. MuJoCo's quaternions begin with w.
function turned(body, turn) {
  if (isSphere(body)) return '';
  return `${quat(turn(body))} `;
}

function geomOf(body) {
  if (isSphere(body)) return `type="sphere" size="${body.radius}"`;
  const half = halfOf(body);
  return isBlock(body) ? `type="box" size="${text(half)}" ${turned(body, turnOf)}`
    : `type="cylinder" size="${text([half[1], half[0]])}" ${turned(body, turnFromZ)}`;
}
