// Recorded motions, unpacked, and where everything is between their frames.
import { count_of, values_of } from './data.js';

export const kRoles = ['median', 'worst', 'nearest'];

/** A run of a scene's motion with plain arrays: one number for each frame. */
export function unpacked(run, bodies) {
  const count = Math.max(count_of(run.time), ...run.bodies.flatMap((body) => body.p.map((one) => count_of(one))));
  const column = (channel) => values_of(channel, count);
  return {
    run: run.run, role: run.role, phase: run.phase, error: run.error, count,
    time: column(run.time),
    substrate: (run.substrate ?? [0, 0]).map(column),
    energy: column(run.energy),
    touches: run.touches ?? [],
    bodies: run.bodies.map((body, k) => ({
      name: bodies[k].name, radius: bodies[k].radius,
      p: body.p.map(column), w: body.w.map(column), speed: column(body.speed), slip: body.slip.map(column),
    })),
  };
}

/**
 * Until when it is worth looking at [s]: an engine that comes to rest far too late does not squeeze
 * the others.
 */
export function end_of(motions) {
  const last = motions.map(({ time }) => time[time.length - 1]);
  const reference = motions.findIndex((motion) => motion.run < 0);
  const all = Math.max(...last);
  return reference < 0 ? all : Math.min(all, 1.4 * last[reference]);
}

/** The frame at or before a time, and how far the way to the next is gone: [k, fraction]. */
export function frame_at(times, time) {
  let low = 0, high = times.length - 1;
  if (high <= 0 || !(time > times[0])) return [0, 0];
  if (time >= times[high]) return [high, 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return [low, (time - times[low]) / (times[high] - times[low])];
}

/** Of a column of numbers, linear between frames; the frame's own where the next has none. */
export function between(column, [k, fraction]) {
  if (fraction === 0) return column[k];
  const next = column[k + 1];
  return Number.isNaN(next) ? column[k] : column[k] + fraction * (next - column[k]);
}

/**
 * The same on a periodic plane of that length: the short way round, since a body that leaves on
 * one side comes in on the other.
 */
export function between_periodic(column, [k, fraction], length) {
  if (fraction === 0) return column[k];
  const way = column[k + 1] - column[k];
  return column[k] + fraction * (way - length * Math.round(way / length));
}

/** How a body stands at each frame, from its angular velocities: unit quaternions [x, y, z, w]. */
export function orientations(time, w) {
  const result = [[0, 0, 0, 1]];
  for (let k = 1; k < time.length; ++k) {
    const step = time[k] - time[k - 1];
    // The mean of both ends: exact where the angular acceleration is constant about one axis.
    const turn = w.map((column) => 0.5 * step * (column[k - 1] + column[k]));
    result.push(turned(result[k - 1], turn));
  }
  return result;
}

/** `from`, turned by a rotation vector [rad] of the laboratory. */
export function turned(from, [x, y, z]) {
  const angle = Math.hypot(x, y, z);
  if (!(angle > 0)) return from;
  const s = Math.sin(angle / 2) / angle, c = Math.cos(angle / 2);
  const [qx, qy, qz] = [s * x, s * y, s * z];
  const [x0, y0, z0, w0] = from;
  const product = [
    c * x0 + qx * w0 + qy * z0 - qz * y0,
    c * y0 - qx * z0 + qy * w0 + qz * x0,
    c * z0 + qx * y0 - qy * x0 + qz * w0,
    c * w0 - qx * x0 - qy * y0 - qz * z0,
  ];
  const norm = Math.hypot(...product);
  return product.map((part) => part / norm);
}
