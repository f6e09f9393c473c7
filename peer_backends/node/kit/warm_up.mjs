// JavaScript and WebAssembly are interpreted or compiled quickly at first and well later, on threads
// of their own, and the CPU time of steps is to be that of the engine.

const STEPS_IN_A_WORLD = 60;
const WINDOW = 5e-3; // [s]
const LEAST = 0.15;
const MOST = 2;
const CALM_WINDOWS = 12;

const cpuSeconds = (since) => {
  const { user, system } = process.cpuUsage(since);
  return 1e-6 * (user + system);
};

/// Steps throw-away worlds of the configured scene until what a step costs has settled: a number of
/// windows in which it was neither much less than before nor much more than at its least.
export function warmUp(engine, scene) {
  const states = new Float64Array(9 * scene.bodies.length);
  const begin = process.cpuUsage();
  let least = Infinity;
  for (let calm = 0; cpuSeconds(begin) < LEAST || (calm < CALM_WINDOWS && cpuSeconds(begin) < MOST); ) {
    const cost = costOfSteps(engine, scene.initial, states);
    calm = cost > 0.9 * least && cost < 1.25 * least ? calm + 1 : 0;
    least = Math.min(least, cost);
  }
}

/// CPU time of a step and what else the process does meanwhile, over a window [s].
function costOfSteps(engine, initial, states) {
  let seconds = 0;
  let steps = 0;
  while (seconds < WINDOW) {
    engine.start(initial, 0);
    const begin = process.cpuUsage();
    for (let k = 0; k < STEPS_IN_A_WORLD && cpuSeconds(begin) < WINDOW; ++k, ++steps) engine.step();
    seconds += cpuSeconds(begin);
    engine.read(states, []);
  }
  return seconds / steps;
}
