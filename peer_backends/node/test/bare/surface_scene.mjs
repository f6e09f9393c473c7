// A ball slides along a plate, over its edge, onto a peg and from there onto a belt: radius [m], friction
// and restitution on all three, the ball's state (position, velocity, angular velocity).

export const surfaceScene = {
  radius: 0.02,
  friction: 0.3,
  restitution: 0.5,
  plate: { centre: [0, 0, 0.1], half: [0.1, 0.1, 1e-7] }, // 1e-6 of its width thick
  peg: { centre: [0.25, 0, -0.03], radius: 0.05 },
  belt: { height: -0.1, velocity: -0.5 }, // along x
  state: [0, 0, 0.12, 0.8, 0, 0, 0, 0, 0],
};

// A power of two, so that times and ways of the belt are exact.
export const SURFACE_STEP = 1 / 256;
export const SURFACE_STEPS = 256;
