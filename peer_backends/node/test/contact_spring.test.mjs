import assert from 'node:assert/strict';
import { test } from 'node:test';
import { contactTime, dampingRatioOf, restitutionOf } from '../kit/contact_spring.mjs';

/// ẍ = -2 ζ ẋ - x from x = 0, ẋ = -1 until ẍ = 0, by Runge and Kutta's method of fourth order; the
/// last step is cut where a straight line through ẍ has its zero, an error of second order in the
/// step.
function integrated(zeta, dt) {
  const slope = ([x, v]) => [v, -2 * zeta * v - x];
  const moved = ([x, v], [a, b], h) => [x + h * a, v + h * b];
  let state = [0, -1];
  for (let n = 0; ; ++n) {
    const k1 = slope(state);
    const k2 = slope(moved(state, k1, dt / 2));
    const k3 = slope(moved(state, k2, dt / 2));
    const k4 = slope(moved(state, k3, dt));
    const mean = [0, 1].map((k) => (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]) / 6);
    const next = moved(state, mean, dt);
    const before = slope(state)[1];
    const after = slope(next)[1];
    if (after <= 0) {
      const part = before / (before - after);
      return { e: state[1] + part * (next[1] - state[1]), time: dt * (n + part) };
    }
    state = next;
  }
}

test('restitution of a spring that only pushes is that of its equation of motion', () => {
  for (const zeta of [0, 0.05, 0.3, 0.9, 1, 1.5]) {
    const { e, time } = integrated(zeta, 1e-3);
    assert.ok(
      Math.abs(restitutionOf(zeta) - e) < 1e-6,
      `ζ = ${zeta}: ${restitutionOf(zeta)}, integrated ${e}`,
    );
    if (zeta < 1) assert.ok(Math.abs(contactTime(zeta) - time) < 1e-5, `ζ = ${zeta}: ${time}`);
  }
});

test('the critical spring rebounds with e^-2, an undamped one with 1', () => {
  assert.equal(restitutionOf(1), Math.exp(-2));
  assert.equal(restitutionOf(0), 1);
  // From both sides; the series about ζ = 1 has a first term of order √|1 - ζ|².
  for (const near of [1 - 1e-9, 1 + 1e-9])
    assert.ok(Math.abs(restitutionOf(near) - Math.exp(-2)) < 1e-6);
});

test('the damping ratio of a restitution gives it back', () => {
  for (const e of [1e-6, 0.01, Math.exp(-2), 0.3, 0.8, 0.999])
    assert.ok(Math.abs(restitutionOf(dampingRatioOf(e)) - e) < 1e-12, `${e}`);
  assert.ok(dampingRatioOf(1) < 1e-15);
});
