// scenarios/slide-to-roll.yaml, bouncing-ball.yaml and symmetric-30cms.yaml as numbers: radius [m],
// states (position, velocity, angular velocity), friction and restitution on the plane, restitution
// of two balls, which have no friction.

export const scenes = {
  'slide-to-roll': {
    radius: 0.005, friction: 0.2, restitution: 0,
    states: [[0, 0, 0.005, 0.5, 0, 0, 0, 0, 0]],
  },
  'bouncing-ball': {
    radius: 0.01, friction: 0.3, restitution: 0.8,
    states: [[0, 0, 0.06, 0, 0, 0, 0, 0, 0]],
  },
  'symmetric-30cms': {
    radius: 0.002, friction: 0.1, restitution: 0, pair: 0.9,
    states: [[-0.0095, 0, 0.002, 0.15, 0, 0, 0, 75, 0], [0.0095, 0, 0.002, -0.15, 0, 0, 0, -75, 0]],
  },
};

export const STEPS = 240;
export const STEP = 1 / 240;
