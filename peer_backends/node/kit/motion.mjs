// How substrate and floor move: functions of the scene's time.

const STILL = { position: () => [0, 0], velocity: () => [0, 0], isStill: true };

function constant({ velocity: [x, y] }) {
  return { position: (t) => [x * t, y * t], velocity: () => [x, y], isStill: x === 0 && y === 0 };
}

function oscillation({ amplitude: [x, y], frequency, phase }) {
  const omega = 2 * Math.PI * frequency;
  return {
    position: (t) => [x, y].map((a) => Math.sin(omega * t + phase) * a),
    velocity: (t) => [x, y].map((a) => omega * Math.cos(omega * t + phase) * a),
    isStill: x === 0 && y === 0,
  };
}

/// Linear between the points and at rest outside them.
function table({ points }) {
  const passed = (t) => points.filter(([at]) => at <= t).length;
  const slope = (n) => {
    if (n === 0 || n >= points.length) return [0, 0];
    const [[t0, x0, y0], [t1, x1, y1]] = [points[n - 1], points[n]];
    return [(x1 - x0) / (t1 - t0), (y1 - y0) / (t1 - t0)];
  };
  return {
    position: (t) => {
      const n = passed(t);
      if (n === 0) return points[0].slice(1);
      const [at, x, y] = points[n - 1];
      const [vx, vy] = slope(n);
      return [x + (t - at) * vx, y + (t - at) * vy];
    },
    velocity: (t) => slope(passed(t)),
    isStill: points.length < 2,
  };
}

/// x_S(t) and its derivative, along the plane.
export function substrateMotion(motion) {
  return { still: () => STILL, constant, oscillation, table }[motion.kind](motion);
}

/// z_f(t) = A sin(2π f t) and its derivative.
export function floorMotion({ amplitude, frequency }) {
  const omega = 2 * Math.PI * frequency;
  return {
    height: (t) => amplitude * Math.sin(omega * t),
    velocity: (t) => amplitude * omega * Math.cos(omega * t),
    isStill: amplitude === 0 || frequency === 0,
  };
}

/// Place and velocity in space of what moves in a scene: the substrate, or the floor of its box.
export function surfaceMotion(scene) {
  if (scene.box) {
    const floor = floorMotion(scene.box.floor);
    return {
      position: (t) => [0, 0, floor.height(t)],
      velocity: (t) => [0, 0, floor.velocity(t)],
      isStill: floor.isStill,
    };
  }
  const plane = substrateMotion(scene.motion);
  return {
    position: (t) => [...plane.position(t), 0],
    velocity: (t) => [...plane.velocity(t), 0],
    isStill: plane.isStill,
  };
}
