// Surfaces beside the substrate: where they lie and how they move, as functions of the scene's time.

import { surfaceTouch } from './contacts.mjs';
import { substrateMotion } from './motion.mjs';
import { rounded } from './text.mjs';

const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
const scaled = (a, factor) => a.map((value) => value * factor);
const plus = (a, b) => a.map((value, k) => value + b[k]);
const minus = (a, b) => a.map((value, k) => value - b[k]);
const unit = (a) => scaled(a, 1 / Math.hypot(...a));
export const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

/// A unit vector at right angles to another.
function unitAcross(axis) {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  return unit(cross(axis, [0, 1, 2].map((k) => (k === least ? 1 : 0))));
}

/// The quaternion [x, y, z, w] of the turn that takes the axes x, y, z to these right-handed ones.
export function quaternionOf([x, y, z]) {
  const trace = x[0] + y[1] + z[2];
  const squares = [1 + 2 * x[0] - trace, 1 + 2 * y[1] - trace, 1 + 2 * z[2] - trace, 1 + trace];
  const k = squares.indexOf(Math.max(...squares));
  const off = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
  const sum = [[0, y[0] + x[1], z[0] + x[2]], [y[0] + x[1], 0, z[1] + y[2]], [z[0] + x[2], z[1] + y[2], 0]];
  const q = k === 3 ? [...off, squares[3]] : [...sum[k].map((value, i) => (i === k ? squares[k] : value)), off[k]];
  return unit(q);
}

/// v turned by an angle [rad] about a unit axis.
function turned(v, axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const along = scaled(axis, dot(axis, v) * (1 - c));
  return plus(plus(scaled(v, c), scaled(cross(axis, v), s)), along);
}

/// Where the shape's own centre is at rest, and its axes: the third is the normal of a plane or plate
/// and the axis of a rod.
const FRAMES = {
  plane: ({ point, normal }) => frameAbout(point, normal),
  rectangle: ({ centre, half_length, half_width }) => {
    const [x, y] = [unit(half_length), unit(half_width)];
    return { centre, axes: [x, y, cross(x, y)] };
  },
  rod: ({ begin, end }) => frameAbout(scaled(plus(begin, end), 0.5), unit(minus(end, begin))),
  ball: ({ centre }) => ({ centre, axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }),
};

function frameAbout(centre, z) {
  if (z[0] === 0 && z[1] === 0 && z[2] === 1) return { centre, axes: [[1, 0, 0], [0, 1, 0], z] };
  const x = unitAcross(z);
  return { centre, axes: [x, cross(z, x), z] };
}

/// Half of a plate's thickness, of the shorter of its half sides: engines have boxes, and plates none.
const THICKNESS = 1e-6;
/// A velocity along a plane is so to within this part of it.
const ALONG = 1e-9;

/// A course along two directions: way [m] and velocity [m/s] in space.
function along({ course, first, second }) {
  const plane = substrateMotion(course);
  const inSpace = ([a, b]) => plus(scaled(first, a), scaled(second, b));
  return { way: (t) => inSpace(plane.position(t)), velocity: (t) => inSpace(plane.velocity(t)) };
}

/// One surface:
///   touch     its number where a body touches it
///   shape     as in the scene
///   moves     whether its shape goes anywhere; a belt's stays, and only its matter moves
///   isBelt, isStill, turns
///   stays     whether each of its places is the surface's at all times, as a belt's, and those of a
///             plane that moves or turns in itself
///   centre(t), axes(t), quaternion(t)   of the shape
///   way(t)                 of the matter, zero where it turns
///   velocity(t, at)        of the matter at a place
///   rate                   [rad/s]
///   extent                 half sizes along the axes, of a plate, which is as good as not thick, and a rod
class BesideSurface {
  constructor({ shape, motion }, k) {
    this.touch = surfaceTouch(k);
    this.shape = shape;
    const { centre, axes } = FRAMES[shape.kind](shape);
    this.isStill = motion.kind === 'still';
    this.isBelt = motion.kind === 'belt';
    this.turns = motion.kind === 'turning';
    this.moves = !this.isStill && !this.isBelt;
    this.rate = this.turns ? motion.rate : [0, 0, 0];
    const course = motion.course ? along(motion) : { way: () => [0, 0, 0], velocity: () => [0, 0, 0] };
    this.way = course.way;
    const omega = Math.hypot(...this.rate);
    const turn = (v, t) => (this.turns ? turned(v, scaled(this.rate, 1 / omega), omega * t) : v);
    this.axes = (t) => axes.map((axis) => turn(axis, t));
    this.centre = (t) => {
      if (this.turns) return plus(motion.pivot, turn(minus(centre, motion.pivot), t));
      return this.moves ? plus(centre, course.way(t)) : centre;
    };
    this.velocity = (t, at) =>
      (this.turns ? cross(this.rate, minus(at, motion.pivot)) : course.velocity(t));
    this.stays = !this.moves || (shape.kind === 'plane' && this.#movesInItself(motion, axes[2]));
    if (shape.kind === 'rectangle') {
      const sides = [Math.hypot(...shape.half_length), Math.hypot(...shape.half_width)];
      this.extent = [...sides, THICKNESS * Math.min(...sides)];
    }
    if (shape.kind === 'rod')
      this.extent = [shape.radius, shape.radius, 0.5 * Math.hypot(...minus(shape.end, shape.begin))];
  }

  /// A plane turns about its normal alone.
  #movesInItself({ course, first, second }, normal) {
    if (this.turns) return true;
    const most = (a) => a.reduce((sum, [x, y]) => [Math.max(sum[0], Math.abs(x)), Math.max(sum[1], Math.abs(y))], [0, 0]);
    const [x, y] = most([course.velocity ?? course.amplitude ?? [0, 0], ...(course.points ?? []).map((p) => p.slice(1))]);
    return Math.abs(x * dot(first, normal)) + Math.abs(y * dot(second, normal)) <= ALONG * (x + y);
  }

  /// So far behind the face of a plane, where the middle of a box is that stands in for it.
  behind(t, depth) {
    return minus(this.centre(t), scaled(this.axes(t)[2], depth));
  }

  /// From the nearest place of the surface to a point; of a plate's middle plane its own normal.
  normalAt(t, point) {
    const [x, y, z] = this.axes(t);
    const { kind, radius } = this.shape;
    if (kind === 'plane') return z;
    const from = minus(point, this.centre(t));
    const own = [x, y, z].map((axis) => dot(axis, from));
    const clamped = (value, half) => Math.min(half, Math.max(-half, value));
    let nearest = [0, 0, 0];
    if (kind === 'rectangle') nearest = [clamped(own[0], this.extent[0]), clamped(own[1], this.extent[1]), 0];
    if (kind === 'rod') {
      const out = Math.hypot(own[0], own[1]);
      const share = out > radius ? radius / out : 1;
      nearest = [own[0] * share, own[1] * share, clamped(own[2], this.extent[2])];
      if (share === 1 && nearest[2] === own[2]) nearest = [0, 0, own[2]]; // inside
    }
    const away = minus(own, nearest);
    const length = Math.hypot(...away);
    if (!(length > 0)) return z;
    return [0, 1, 2].map((k) => (away[0] * x[k] + away[1] * y[k] + away[2] * z[k]) / length);
  }

  /// That of axes(), or for an engine whose cylinders stand along their second axis or lie along the
  /// first, with those in their places.
  quaternion(t, rodAxis = 'z') {
    const [x, y, z] = this.axes(t);
    if (this.shape.kind !== 'rod' || rodAxis === 'z') return quaternionOf([x, y, z]);
    return quaternionOf(rodAxis === 'y' ? [y, z, x] : [z, x, y]);
  }

  /// The velocity that contacts are to feel in a step from t on: the mean over the step, or that at
  /// its end.
  stepVelocity(t, timeStep, at, isMean) {
    if (!isMean || this.turns) return this.velocity(t + timeStep, at);
    return scaled(minus(this.way(t + timeStep), this.way(t)), 1 / timeStep);
  }
}

/// All of a scene, in their order.
export const besideSurfaces = ({ surfaces = [] }) => surfaces.map((each, k) => new BesideSurface(each, k));

/// Whether there is a plane below, which a scene with surfaces may lack.
export const hasSubstrate = ({ has_substrate }) => has_substrate !== false;

/// How far bodies and surfaces lie from the origin at the start, at least `least`.
export function farthest(scene, least) {
  const places = scene.bodies.map((_, i) => scene.initial.subarray(9 * i, 9 * i + 3));
  const edges = besideSurfaces(scene).map(({ centre, extent }) => Math.hypot(...centre(0)) + Math.hypot(...(extent ?? [0])));
  return Math.max(least, ...places.map((place) => Math.hypot(...place)), ...edges);
}

/// What an engine lacks whose planes that move away are boxes of half this width [m].
export function planeEnds(beside, half) {
  if (!beside.some(({ shape, stays }) => shape.kind === 'plane' && !stays)) return [];
  return [{
    text: `planes without end that move away (boxes of ±${rounded(half, 3)} m)`,
    kind: 'planes without end that move away',
  }];
}
