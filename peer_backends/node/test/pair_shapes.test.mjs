import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FLOOR, surfaceTouch } from '../kit/contacts.mjs';
import { pairShapes } from '../kit/pair_shapes.mjs';
import { Refused } from '../kit/faults.mjs';

const ground = (kinetic_friction, restitution, static_friction = kinetic_friction) => ({
  static_friction,
  kinetic_friction,
  rolling: [[0, 0]],
  drilling_length: 0,
  restitution,
});
const pair = (restitution, friction) => ({ restitution, friction, tangential_restitution: 0 });

function sceneOf(materials, substrate, pairs) {
  return {
    bodies: materials.map((material) => ({ radius: 1, mass: 1, shape_factor: 0.4, material })),
    initial: new Float64Array(9 * materials.length),
    substrate,
    pairs,
  };
}

/// What two shapes have between them in an engine that knows the smaller and the larger of two
/// values and takes the larger where either asks for it.
function combined(a, b, key, rule) {
  const words = [a.rule[rule], b.rule[rule]];
  return (words.includes('larger') ? Math.max : Math.min)(a[key], b[key]);
}

const meet = (a, b) => (a.member & b.filter) !== 0 && (b.member & a.filter) !== 0;

/// The one contact of two lists of shapes.
function contactOf(some, others) {
  const found = some.flatMap((a) =>
    others
      .filter((b) => meet(a, b))
      .map((b) => ({
        friction: combined(a, b, 'friction', 'friction'),
        staticFriction: combined(a, b, 'staticFriction', 'friction'),
        restitution: combined(a, b, 'restitution', 'restitution'),
      })),
  );
  assert.equal(found.length, 1, 'two bodies have one contact');
  return found[0];
}

function check(scene) {
  const shapes = pairShapes(scene, 'some', 31);
  const materials = scene.substrate.length;
  scene.bodies.forEach(({ material }, i) => {
    const on = scene.substrate[material];
    assert.deepEqual(contactOf(shapes.ofBall(i), shapes.ofSurface(FLOOR)), {
      friction: on.kinetic_friction,
      staticFriction: on.static_friction,
      restitution: on.restitution,
    });
    for (let j = 0; j < i; ++j) {
      const { friction, restitution } = scene.pairs[material * materials + scene.bodies[j].material];
      assert.deepEqual(contactOf(shapes.ofBall(i), shapes.ofBall(j)), {
        friction,
        staticFriction: friction,
        restitution,
      });
    }
  });
}

test('one material, on a surface with less and with more of each', () => {
  check(sceneOf([0, 0], [ground(0.1, 0.9)], [pair(0.5, 0.3)]));
  check(sceneOf([0, 0], [ground(0.4, 0)], [pair(0.5, 0.3)]));
});

test('static and kinetic friction on both sides of that of two balls', () => {
  check(sceneOf([0, 0], [ground(0.1, 0.2, 0.5)], [pair(0.5, 0.3)]));
});

test('every two of three materials have their own coefficients', () => {
  const pairs = [
    [0.1, 0.2, 0.3],
    [0.2, 0.4, 0.5],
    [0.3, 0.5, 0.6],
  ]
    .flat()
    .map((e, k) => pair(e, 1 - e));
  check(sceneOf([0, 0, 1, 1, 2, 2], [ground(0.1, 0.9), ground(0.2, 0.8), ground(0.9, 0.1, 1)], pairs));
});

test('more materials than there are bits are refused', () => {
  const many = 9;
  const pairs = Array.from({ length: many * many }, (_, k) =>
    pair(((k % many) + Math.floor(k / many)) / 20, 0),
  );
  const scene = sceneOf(
    Array.from({ length: many }, (_, k) => k),
    Array.from({ length: many }, () => ground(0.1, 0)),
    pairs,
  );
  assert.throws(
    () => pairShapes(scene, 'some', 31),
    (error) =>
      error instanceof Refused &&
      error.message ===
        'some: the contacts of these materials need more than 31 bits of collision filters',
  );
});

test('surfaces beside the substrate keep their own contacts, and those met alike share their bits', () => {
  const materials = [0, 0, 1, 1];
  const scene = sceneOf(materials, [ground(0.1, 0.2), ground(0.3, 0.4)],
    [pair(0.5, 0.3), pair(0.6, 0.1), pair(0.6, 0.1), pair(0.7, 0.2)]);
  // Two of five plates are met otherwise by the second material.
  const on = (material, k) => ({
    lasting: ground(0.05 + 0.1 * material + (k > 2 && material === 1 ? 0.3 : 0), 0),
    impact: pair(0.25, 0.3),
  });
  scene.surfaces = Array.from({ length: 5 }, () => ({ shape: {}, motion: { kind: 'still' } }));
  scene.on_surfaces = [0, 1].flatMap((material) => scene.surfaces.map((_, k) => on(material, k)));
  const shapes = pairShapes(scene, 'some', 31);
  materials.forEach((material, i) => {
    scene.surfaces.forEach((_, k) => {
      const { kinetic_friction } = on(material, k).lasting;
      assert.deepEqual(contactOf(shapes.ofBall(i), shapes.ofSurface(surfaceTouch(k))),
        { friction: kinetic_friction, staticFriction: kinetic_friction, restitution: 0.25 });
    });
    assert.equal(contactOf(shapes.ofBall(i), shapes.ofSurface(FLOOR)).restitution, [0.2, 0.4][material]);
  });
  assert.equal(shapes.ofSurface(surfaceTouch(0)), shapes.ofSurface(surfaceTouch(2)));
  assert.notEqual(shapes.ofSurface(surfaceTouch(0)), shapes.ofSurface(surfaceTouch(3)));
  assert.equal(shapes.applied['surface_friction[2-4]'], 0.45);
});
