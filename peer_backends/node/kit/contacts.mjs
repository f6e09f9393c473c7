// What the contacts of a scene are: coefficients and laws.

/// What a body can touch besides others; negative, so that none is a body's index.
export const FLOOR = -1; // the substrate's too
export const WALL = -2;
export const LID = -3;
/// A surface beside the substrate, where there is no box; and back.
export const surfaceTouch = (surface) => -2 - surface;
export const touchedSurface = (touch) => -2 - touch;

/// The surfaces of a scene, each with its name in the settings in force.
export function surfaceNames(scene) {
  const { box, surfaces = [] } = scene;
  const beside = surfaces.map((_, k) => [surfaceTouch(k), 'surface']);
  if (!box) return scene.has_substrate === false ? beside : [[FLOOR, 'substrate'], ...beside];
  const both = [[FLOOR, 'floor'], [WALL, 'wall']];
  return box.lid ? [...both, [LID, 'lid']] : both;
}

/// Whose coefficient is told under such a name: a body's, or of several surfaces a body's on one.
export const whoseOn = (name, body, surface) =>
  (name === 'surface' ? `${body}-${touchedSurface(surface)}` : body);

/// A sphere's material on the substrate.
export const groundOf = (scene, body) => scene.substrate[scene.bodies[body].material];

/// What two materials have between them.
export const pairOf = (scene, a, b) => scene.pairs[a * scene.substrate.length + b];

/// A body as it lies on a surface beside the substrate and as it bounces off: {lasting, impact}.
const onBeside = (scene, body, touch) =>
  scene.on_surfaces[scene.bodies[body].material * scene.surfaces.length + touchedSurface(touch)];

/// What a body has while it lies on the substrate or a surface beside it, as in `substrate`.
export const lastingOf = (scene, body, surface) =>
  (surface === FLOOR ? groundOf(scene, body) : onBeside(scene, body, surface).lasting);

/// Between a body and another one, or a surface of the box, or one beside the substrate.
export function contactOf(scene, body, other) {
  const { material } = scene.bodies[body];
  if (other >= 0) return pairOf(scene, material, scene.bodies[other].material);
  if (!scene.box) return onBeside(scene, body, other).impact;
  const { on_floor, on_wall, on_lid } = scene.box;
  return { [FLOOR]: on_floor, [WALL]: on_wall, [LID]: on_lid }[other][material];
}

export const dependsOnSpeed = (contact) => typeof contact.restitution !== 'number';

/// β0 = -1, u_t' = u_t: no tangential impulse whatever μ is.
export const frictionOf = (contact) => (contact.tangential_restitution === -1 ? 0 : contact.friction);

/// e at the normal impact speed g [m/s].
export function restitutionAt(law, g) {
  if (typeof law === 'number') return law;
  if (law.log_odds) return tabulated(law, g);
  return Math.min(1, law.coefficient * (g / law.speed) ** -law.exponent);
}

const odds = (y) => 1 / (1 + Math.exp(-y));

/// The cubic between two points of ln(e/(1 - e)) over ln g that has both values and slopes.
function tabulated({ log_first, log_step, log_odds, slope }, g) {
  const x = (Math.log(Math.max(g, 1e-300)) - log_first) / log_step;
  const last = log_odds.length - 1;
  if (!(x > 0)) return beyond(log_odds[0], slope[0], log_step * x);
  if (x >= last) return beyond(log_odds[last], slope[last], log_step * (x - last));
  const i = Math.floor(x);
  const s = x - i;
  const r = 1 - s;
  return odds(r * r * ((1 + 2 * s) * log_odds[i] + s * log_step * slope[i]) +
              s * s * ((1 + 2 * r) * log_odds[i + 1] - r * log_step * slope[i + 1]));
}

/// With e = 1/(1 + e^-y) the slope of ln e over ln g is y' (1 - e), that of ln(1 - e) is -y' e.
function beyond(y, yPrime, distance) {
  const e = odds(y);
  const rest = odds(-y);
  if (y < 0) return Math.min(1, e * Math.exp(yPrime * rest * distance));
  return Math.max(0, 1 - rest * Math.exp(-yPrime * e * distance));
}

/// The one number of a law for an engine that takes no law: a power law's own coefficient, else the
/// value at the speed `start` [m/s].
export function oneRestitution(law, start) {
  return restitutionAt(law, law.exponent === undefined ? start : law.speed);
}

/// μ_r at a speed [m/s]; the points' coefficients are linear between and constant outside.
export function rollingAt(points, speed) {
  const next = points.findIndex(([at]) => at > speed);
  if (next === 0) return points[0][1];
  if (next < 0) return points.at(-1)[1];
  const [[v0, a], [v1, b]] = [points[next - 1], points[next]];
  return a + ((b - a) * (speed - v0)) / (v1 - v0);
}

/// The length whose product with the normal force is the torque that slows a rolling sphere by
/// dv/dt = -μ_r g [m]: (1 + I/(m R²)) μ_r R.
export const rollingLength = ({ radius, shape_factor }, mu) => (1 + shape_factor) * mu * radius;

/// Pairs of bodies, one for each pair of materials that there are: indices [i, j], i < j.
export function materialPairs(scene) {
  const firstTwo = scene.substrate.map(() => []);
  scene.bodies.forEach(({ material }, i) => {
    if (firstTwo[material].length < 2) firstTwo[material].push(i);
  });
  const pairs = [];
  firstTwo.forEach((some, a) => {
    if (some.length === 2) pairs.push(some);
    for (const others of firstTwo.slice(a + 1))
      if (some.length > 0 && others.length > 0) pairs.push([some[0], others[0]].sort((i, j) => i - j));
  });
  return pairs;
}

const speedBetween = (scene, i, j) =>
  Math.hypot(...[3, 4, 5].map((k) => scene.initial[9 * i + k] - scene.initial[9 * j + k]));

/// Restitution of two bodies as one number, by the speed at which they start.
export const pairRestitution = (scene, i, j) =>
  oneRestitution(contactOf(scene, i, j).restitution, speedBetween(scene, i, j));

/// Restitution on a surface, of a box or beside the substrate, as one number, by the speed at which
/// the body starts.
export function surfaceRestitution(scene, body, surface) {
  if (!scene.box)
    return oneRestitution(contactOf(scene, body, surface).restitution,
      Math.hypot(...scene.initial.subarray(9 * body + 3, 9 * body + 6)));
  const moves = surface === FLOOR || scene.box.moving_walls;
  const { amplitude, frequency } = scene.box.floor;
  const up = moves ? 2 * Math.PI * frequency * amplitude : 0;
  const [x, y, z] = scene.initial.subarray(9 * body + 3, 9 * body + 6);
  return oneRestitution(contactOf(scene, body, surface).restitution, Math.hypot(x, y, z - up));
}

/// Kinetic and static friction, restitution and drilling length of a body on the substrate or a
/// surface. One that keeps its slip in an impact, β0 = -1, has no friction.
export function onSurface(scene, body, surface) {
  if (scene.box) {
    const friction = frictionOf(contactOf(scene, body, surface));
    return {
      friction, staticFriction: friction, restitution: surfaceRestitution(scene, body, surface), drilling: 0,
    };
  }
  const ground = lastingOf(scene, body, surface);
  const own = surface === FLOOR ? undefined : contactOf(scene, body, surface);
  const isSmooth = own?.tangential_restitution === -1;
  return {
    friction: isSmooth ? 0 : ground.kinetic_friction,
    staticFriction: isSmooth ? 0 : ground.static_friction,
    restitution: own ? surfaceRestitution(scene, body, surface) : ground.restitution,
    drilling: ground.drilling_length,
  };
}

/// What people type into the fields of a body.
export function naiveBall(scene, body) {
  if (scene.box && scene.bodies.length === 1) return naiveSurface(scene, FLOOR);
  const isAbove = scene.has_substrate !== false || !(scene.surfaces?.length > 0);
  const ground = isAbove ? groundOf(scene, body) : lastingOf(scene, body, surfaceTouch(0));
  const other = body === 0 ? 1 : 0;
  if (scene.bodies.length === 1)
    return {
      friction: ground.kinetic_friction, restitution: ground.restitution,
      rolling: ground.rolling[0][1], spinning: ground.drilling_length,
    };
  const restitution = pairRestitution(scene, body, other);
  if (scene.box)
    return { friction: contactOf(scene, body, other).friction, restitution, rolling: 0, spinning: 0 };
  return {
    friction: ground.kinetic_friction, restitution,
    rolling: ground.rolling[0][1], spinning: ground.drilling_length,
  };
}

/// What people type into the fields of the substrate or of a surface of the box.
export function naiveSurface(scene, surface) {
  const none = { rolling: 0, spinning: 0 };
  if (!scene.box && surface !== FLOOR)
    return {
      friction: lastingOf(scene, 0, surface).kinetic_friction,
      restitution: surfaceRestitution(scene, 0, surface), ...none,
    };
  if (!scene.box) {
    const ground = groundOf(scene, 0);
    return { friction: ground.kinetic_friction, restitution: ground.restitution, ...none };
  }
  return {
    friction: contactOf(scene, 0, surface).friction,
    restitution: surfaceRestitution(scene, 0, surface), ...none,
  };
}
