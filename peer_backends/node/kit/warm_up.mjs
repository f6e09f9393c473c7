const CPU_MICROSECONDS = 150_000;
const STEPS_IN_A_WORLD = 60;

/// Steps throw-away worlds of the configured scene until what is hot has been compiled: JavaScript
/// and WebAssembly are interpreted or compiled quickly at first and well later, and the CPU time of
/// steps is to be that of the engine.
export function warmUp(engine, scene) {
  const states = new Float64Array(9 * scene.bodies.length);
  const begin = process.cpuUsage();
  const isWarm = () => {
    const { user, system } = process.cpuUsage(begin);
    return user + system > CPU_MICROSECONDS;
  };
  while (!isWarm()) {
    engine.start(scene.initial, 0);
    for (let k = 0; k < STEPS_IN_A_WORLD && !isWarm(); ++k) {
      engine.step();
      engine.read(states, []);
    }
  }
}
