// Scenes as the harness sends them: one material, SI.

export const GRAVITY = 9.81;

/// Mass of a steel ball [kg].
export const steel = (radius) => 7850 * (4 / 3) * Math.PI * radius ** 3;

const NO_SURFACE = {
  static_friction: 0,
  kinetic_friction: 0,
  rolling: [[0, 0]],
  drilling_length: 0,
  coupled_radius: 0,
  hertzian_pressure: false,
  rolling_while_sliding: false,
  restitution: 0,
};
const NO_PAIR = { restitution: 0, friction: 0, tangential_restitution: -1 };

const packed = (numbers) => Buffer.from(Float64Array.from(numbers).buffer);

/// Steel balls of one radius; `states` has 9 numbers for each.
export function scene({ radius, states, substrate = {}, pair = {}, ...more }) {
  const mass = steel(radius);
  return {
    bodies: states.map(() => ({ radius, mass, shape_factor: 0.4, material: 0 })),
    initial: packed(states.flat()),
    substrate: [{ ...NO_SURFACE, ...substrate }],
    pairs: [{ ...NO_PAIR, ...pair }],
    gravity: GRAVITY,
    downhill: [0, 0],
    motion: { kind: 'still' },
    confined: false,
    periodic: [0, 0],
    ...more,
  };
}

/// scenarios/slide-to-roll.yaml
export const slideToRoll = scene({
  radius: 0.005,
  states: [[0, 0, 0.005, 0.5, 0, 0, 0, 0, 0]],
  substrate: { static_friction: 0.2, kinetic_friction: 0.2 },
});

/// scenarios/bouncing-ball.yaml
export const bouncingBall = scene({
  radius: 0.01,
  states: [[0, 0, 0.06, 0, 0, 0, 0, 0, 0]],
  substrate: { static_friction: 0.3, kinetic_friction: 0.3, restitution: 0.8 },
});

/// scenarios/symmetric-30cms.yaml
export const symmetric = scene({
  radius: 0.002,
  states: [
    [-0.0095, 0, 0.002, 0.15, 0, 0, 0, 75, 0],
    [0.0095, 0, 0.002, -0.15, 0, 0, 0, -75, 0],
  ],
  substrate: { static_friction: 0.5, kinetic_friction: 0.1 },
  pair: { restitution: 0.9 },
});
