// An engine's units: some have tolerances that are lengths, times or masses of their own.

import { number } from './settings.mjs';

/// The rows of an engine's table that choose units.
export const unitSettings = [
  number('scale_radius_to', '', 0, 'length units that the smallest radius becomes; 0: metres', {
    high: 1e6, candidates: [0, 1] }),
  number('scale_mass_to', '', 0, 'mass units that the largest mass becomes; 0: kilograms', { high: 1e6 }),
  number('scale_gravity_to', '', 0,
    'length units per square of time units that gravity becomes; 0: seconds', { high: 1e6 }),
];

/// Units of the engine's in a metre, a second, a kilogram.
export class Units {
  constructor(scene, settings) {
    const { scale_radius_to, scale_mass_to, scale_gravity_to } = settings;
    const of = (key) => scene.bodies.map((body) => body[key]);
    this.length = scale_radius_to > 0 ? scale_radius_to / of('radius').reduce((a, b) => Math.min(a, b)) : 1;
    this.mass = scale_mass_to > 0 ? scale_mass_to / of('mass').reduce((a, b) => Math.max(a, b)) : 1;
    const gravity = Math.hypot(...gravityOf(scene));
    this.time = scale_gravity_to > 0 && gravity > 0
      ? Math.sqrt((this.length * gravity) / scale_gravity_to) : 1;
  }

  get speed() {
    return this.length / this.time;
  }

  get impulse() {
    return this.mass * this.speed;
  }

  /// What a number of a state is multiplied by, in the order of a state.
  get ofState() {
    const { length, speed, time } = this;
    return [length, length, length, speed, speed, speed, 1 / time, 1 / time, 1 / time];
  }

  /// Where it is not the SI: the units as part of the settings in force.
  applied() {
    if (this.length === 1 && this.time === 1 && this.mass === 1) return {};
    return { length_unit: 1 / this.length, time_unit: 1 / this.time, mass_unit: 1 / this.mass };
  }

  /// The scene counted in these units.
  scene(scene) {
    const { length, time, mass, speed } = this;
    const acceleration = speed / time;
    const factors = this.ofState;
    const law = (restitution) => {
      if (restitution.log_odds) return { ...restitution, log_first: restitution.log_first + Math.log(speed) };
      if (restitution.exponent !== undefined) return { ...restitution, speed: restitution.speed * speed };
      return restitution;
    };
    const contacts = (list) => list.map((each) => ({ ...each, restitution: law(each.restitution) }));
    const lasting = (ground) => ({
      ...ground,
      rolling: ground.rolling.map(([v, mu]) => [v * speed, mu]),
      drilling_length: ground.drilling_length * length,
      coupled_radius: ground.coupled_radius * length,
    });
    const { box } = scene;
    return {
      ...scene,
      bodies: scene.bodies.map((body) => ({
        ...body, radius: body.radius * length, mass: body.mass * mass,
        ...(body.size && { size: body.size.map((edge) => edge * length) }),
      })),
      initial: scene.initial.map((value, k) => value * factors[k % 9]),
      substrate: scene.substrate.map(lasting),
      pairs: contacts(scene.pairs),
      gravity: scene.gravity * acceleration,
      downhill: scene.downhill.map((a) => a * acceleration),
      motion: this.#motion(scene.motion),
      surfaces: scene.surfaces?.map(({ shape, motion }) => ({
        shape: this.#shape(shape), motion: this.#surfaceMotion(motion),
      })),
      on_surfaces: scene.on_surfaces?.map((each) => ({
        lasting: lasting(each.lasting), impact: contacts([each.impact])[0],
      })),
      box: box && {
        ...box,
        width: box.width * length,
        floor: { amplitude: box.floor.amplitude * length, frequency: box.floor.frequency / time },
        lid: box.lid && box.lid * length,
        on_floor: contacts(box.on_floor),
        on_wall: contacts(box.on_wall),
        on_lid: contacts(box.on_lid),
      },
    };
  }

  #shape(shape) {
    const scaled = { ...shape };
    for (const key of ['point', 'centre', 'half_length', 'half_width', 'begin', 'end'])
      if (shape[key]) scaled[key] = shape[key].map((x) => x * this.length);
    if (shape.radius) scaled.radius = shape.radius * this.length;
    return scaled;
  }

  #surfaceMotion(motion) {
    const scaled = { ...motion };
    if (motion.course) scaled.course = this.#motion(motion.course);
    if (motion.pivot) scaled.pivot = motion.pivot.map((x) => x * this.length);
    if (motion.rate) scaled.rate = motion.rate.map((x) => x / this.time);
    return scaled;
  }

  #motion(motion) {
    const { length, time, speed } = this;
    const scaled = { ...motion };
    if (motion.velocity) scaled.velocity = motion.velocity.map((v) => v * speed);
    if (motion.amplitude) scaled.amplitude = motion.amplitude.map((a) => a * length);
    if (motion.frequency) scaled.frequency = motion.frequency / time;
    if (motion.points) scaled.points = motion.points.map(([t, x, y]) => [t * time, x * length, y * length]);
    return scaled;
  }
}

/// The vector of gravity [m/s²].
export const gravityOf = ({ downhill: [x, y], gravity }) => [x, y, -gravity];
