// Pair coefficients in an engine whose coefficients belong to shapes and are combined by rules.
//
// Two shapes with the same value combine to it by the rule of the smaller. A surface's shape has
// its own value and the rule of the smaller or of the larger, whichever yields that value; of two
// rules the engine takes the later of the two. Where pairs of materials differ, a ball has a shape
// for each pair, and filters let those meet that belong together.

import {
  contactOf,
  frictionOf,
  materialPairs,
  naiveBall,
  naiveSurface,
  onSurface,
  pairRestitution,
  surfaceNames,
  touchedSurface,
  whoseOn,
} from './contacts.mjs';
import { Refused } from './faults.mjs';
import { Gathered } from './gathered.mjs';

const NUMBERS = ['friction', 'staticFriction', 'restitution', 'drilling'];
const alike = (a, b) => NUMBERS.every((key) => a[key] === b[key]);
const typed = ({ friction, restitution }) => ({
  friction,
  staticFriction: friction,
  restitution,
  drilling: 0,
});
const NO_CONTACT = typed({ friction: 0, restitution: 0 });

/// Coefficients as people type them: one pair of fields for each body and surface, under the
/// engine's own rule.
export function typedShapes(scene) {
  const applied = new Gathered();
  scene.bodies.forEach((_, i) => {
    const { friction, restitution } = naiveBall(scene, i);
    applied.add('body_friction', i, friction);
    applied.add('body_restitution', i, restitution);
  });
  for (const [surface, name] of surfaceNames(scene)) {
    const whose = name === 'surface' ? touchedSurface(surface) : surface;
    applied.add(`${name}_friction`, whose, naiveSurface(scene, surface).friction);
    applied.add(`${name}_restitution`, whose, naiveSurface(scene, surface).restitution);
  }
  const all = { member: 1, filter: 1, rule: 'as shipped' };
  return {
    ofBall: (i) => [{ ...typed(naiveBall(scene, i)), ...all }],
    ofSurface: (surface) => [{ ...typed(naiveSurface(scene, surface)), ...all }],
    applied: applied.settings(),
  };
}

/// The scene's coefficients exactly: shapes {friction, staticFriction, restitution, drilling, rule,
/// member, filter} of each body, ofBall(i), and of each surface, ofSurface(FLOOR). `rule` has two
/// words, 'smaller' or 'larger', of friction and of restitution; two shapes meet where the `member`
/// of each is in the other's `filter`. `filterBits` is how many bits those may have. Throws
/// Refused.
export function pairShapes(scene, engine, filterBits) {
  const pairs = materialPairs(scene).map(([i, j]) => {
    const friction = frictionOf(contactOf(scene, i, j));
    return {
      a: scene.bodies[i].material,
      b: scene.bodies[j].material,
      name: `${i}-${j}`,
      ...typed({ friction, restitution: pairRestitution(scene, i, j) }),
    };
  });
  const firstOf = scene.substrate.map((_, material) =>
    scene.bodies.findIndex((b) => b.material === material),
  );
  const present = firstOf.map((body, material) => ({ body, material })).filter(({ body }) => body >= 0);
  const bits = new Bits(engine, filterBits);
  const balls = pairs.every((pair) => alike(pair, pairs[0]))
    ? alikeBalls(scene, pairs[0] ?? NO_CONTACT, bits)
    : ballsByPair(scene, pairs, bits);
  const surfaces = new Map();
  const made = []; // surfaces that all materials meet alike have the same shapes and bits
  for (const [surface] of surfaceNames(scene)) {
    const contacts = present.map(({ body }) => onSurface(scene, body, surface));
    let sort = made.find((each) => each.contacts.every((one, k) => alike(one, contacts[k])));
    if (!sort) {
      sort = { contacts, shapes: shapesOfSurface(present, contacts, balls, bits) };
      made.push(sort);
    }
    surfaces.set(surface, sort.shapes);
  }
  return {
    ofBall: (i) => balls[scene.bodies[i].material],
    ofSurface: (surface) => surfaces.get(surface),
    applied: appliedOf(scene, pairs, present),
  };
}

/// Bits of filters, given out one by one.
class Bits {
  constructor(engine, count) {
    this.engine = engine;
    this.count = count;
    this.given = 0;
  }

  next() {
    if (this.given === this.count)
      throw new Refused(
        `${this.engine}: the contacts of these materials need more than ${this.count} bits of collision filters`,
      );
    return 2 ** this.given++;
  }
}

const EVEN = { friction: 'smaller', restitution: 'smaller' };

function alikeBalls(scene, contact, bits) {
  const common = bits.next();
  return scene.substrate.map(() => [{ ...contact, rule: EVEN, member: common, filter: common }]);
}

function ballsByPair(scene, pairs, bits) {
  const balls = scene.substrate.map(() => []);
  for (const pair of pairs) {
    const one = bits.next();
    const other = pair.a === pair.b ? one : bits.next();
    balls[pair.a].push({ ...pair, rule: EVEN, member: one, filter: other });
    if (pair.a !== pair.b) balls[pair.b].push({ ...pair, rule: EVEN, member: other, filter: one });
  }
  return balls.map((own) =>
    own.length > 0 ? own : [{ ...NO_CONTACT, rule: EVEN, member: 0, filter: 0 }],
  );
}

/// How a surface's value comes of its own and a ball's; undefined where one rule for static and
/// kinetic friction cannot.
function ruleFor(contact, ball) {
  const isSmaller = contact.friction <= ball.friction && contact.staticFriction <= ball.staticFriction;
  const isLarger = contact.friction >= ball.friction && contact.staticFriction >= ball.staticFriction;
  if (!isSmaller && !isLarger) return undefined;
  return {
    friction: isSmaller ? 'smaller' : 'larger',
    restitution: contact.restitution <= ball.restitution ? 'smaller' : 'larger',
  };
}

/// Shapes of a surface, one for all materials that meet it alike. It meets a ball's first shape, or
/// one of its own.
function shapesOfSurface(present, contacts, balls, bits) {
  const shapes = [];
  for (const [k, { material }] of present.entries()) {
    const contact = contacts[k];
    let ball = balls[material][0];
    let rule = ruleFor(contact, ball);
    if (!rule) {
      ball = { ...contact, drilling: 0, rule: EVEN, member: 0, filter: 0 };
      balls[material].push(ball);
      rule = EVEN;
    }
    let shape = shapes.find(
      (each) =>
        alike(each, contact) &&
        each.rule.friction === rule.friction &&
        each.rule.restitution === rule.restitution,
    );
    if (!shape) {
      shape = { ...contact, rule, member: bits.next(), filter: bits.next() };
      shapes.push(shape);
    }
    if ((ball.member & shape.filter) === 0) {
      ball.member += shape.filter;
      ball.filter += shape.member;
    }
  }
  return shapes;
}

function appliedOf(scene, pairs, present) {
  const applied = new Gathered();
  for (const { name, friction, restitution } of pairs) {
    applied.add('restitution', name, restitution);
    applied.add('pair_friction', name, friction);
  }
  for (const [surface, name] of surfaceNames(scene)) {
    for (const { body } of present) {
      const { friction, staticFriction, restitution, drilling } = onSurface(scene, body, surface);
      const whose = whoseOn(name, body, surface);
      applied.add(name === 'substrate' ? 'friction' : `${name}_friction`, whose, friction);
      if (staticFriction !== friction) applied.add('static_friction', whose, staticFriction);
      if (drilling > 0) applied.add('drilling_length', whose, drilling);
      applied.add(`${name}_restitution`, whose, restitution);
    }
  }
  return applied.settings();
}
