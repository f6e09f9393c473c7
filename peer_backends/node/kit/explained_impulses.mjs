// Normal impulses of an engine that does not tell them, from what they did to the bodies.

const SWEEPS = 60;
/// Of the largest impulse: what a sweep may still change when it is the last one.
const SETTLED = 1e-9;

/// A contact is {i, j, normal}: bodies, j < 0 for what does not move by contacts, and the unit normal
/// [x, y, z] that points from j to i. `changes` holds for each body what contacts did to its velocity
/// and angular velocity, 6 numbers. The impulses are those that explain the changes: by
/// Gauss-Seidel over the contacts, each takes what is left at its point, P = (C₁ + C₂)⁻¹ Δu.
/// Normal impulses below `least`(i, j) [N s] count as none. [[i, j, impulse], ...].
export function explainedImpulses(bodies, contacts, changes, least) {
  const left = Float64Array.from(changes);
  const sums = contacts.map(() => [0, 0, 0]);
  let largest = 0;
  for (let sweep = 0, change = Infinity; sweep < SWEEPS && change > SETTLED * largest; ++sweep) {
    change = 0;
    contacts.forEach((contact, k) => {
      const impulse = atPoint(bodies, contact, left);
      change = Math.max(change, Math.hypot(...impulse));
      act(bodies[contact.i], contact, impulse, left, contact.i, 1);
      if (contact.j >= 0) act(bodies[contact.j], contact, impulse, left, contact.j, -1);
      impulse.forEach((value, axis) => (sums[k][axis] += value));
    });
    largest = Math.max(largest, change);
  }
  const found = [];
  contacts.forEach(({ i, j, normal }, k) => {
    const impulse = dot(sums[k], normal);
    if (impulse > least(i, j)) found.push([i, j, impulse]);
  });
  return found;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];

/// Change of a body's velocity at the point of contact, -side R n from its centre.
function pointChange(left, body, { normal }, { radius }, side) {
  const v = left.subarray(6 * body, 6 * body + 3);
  const w = left.subarray(6 * body + 3, 6 * body + 6);
  const turn = cross(w, normal);
  return [0, 1, 2].map((axis) => v[axis] - side * radius * turn[axis]);
}

/// What two bodies exchange so that nothing is left at their contact: a sphere's mobility there is
/// 1/m along the normal and (1 + m R²/I)/m across it.
function atPoint(bodies, contact, left) {
  const { i, j, normal } = contact;
  const first = bodies[i];
  const u = pointChange(left, i, contact, first, 1);
  let along = 1 / first.mass;
  let across = (1 + 1 / first.shape_factor) / first.mass;
  if (j >= 0) {
    const second = bodies[j];
    pointChange(left, j, contact, second, -1).forEach((value, axis) => (u[axis] -= value));
    along += 1 / second.mass;
    across += (1 + 1 / second.shape_factor) / second.mass;
  }
  const un = dot(u, normal);
  return u.map((value, axis) => (un * normal[axis]) / along + (value - un * normal[axis]) / across);
}

function act({ mass, radius, shape_factor }, { normal }, impulse, left, body, side) {
  const turn = cross(normal, impulse);
  for (let axis = 0; axis < 3; ++axis) {
    left[6 * body + axis] -= (side * impulse[axis]) / mass;
    // r × P with r = -side R n and the impulse side P
    left[6 * body + 3 + axis] += (radius * turn[axis]) / (shape_factor * mass * radius * radius);
  }
}
