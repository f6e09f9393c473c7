// A worker as the harness starts it, and scenes as it sends them.

import { spawnSync } from 'node:child_process';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import { codecIn } from '../kit/packages.mjs';
import { frame } from '../kit/connection.mjs';

const MAIN = fileURLToPath(new URL('../main.mjs', import.meta.url));

/// The folder of an engine, <name>@<version>, and its name.
export const folder = process.env.SLIPCHECK_NODE_ENGINE;
if (!folder) throw new Error('SLIPCHECK_NODE_ENGINE must name the folder of an engine');
export const engine = basename(folder).split('@')[0];
export const codec = await codecIn(folder);

/// Replies to requests, given as messages or as bytes. warm: as the harness has it, seconds later.
export function replies(requests, { warm = false } = {}) {
  const input = Buffer.concat(requests.map((each) => (each instanceof Uint8Array ? each : frame(codec, each))));
  const { status, stdout, stderr } = spawnSync(process.execPath, [MAIN, engine, folder, ...(warm ? [] : ['cold'])],
    { input, maxBuffer: 1 << 28 });
  const found = [];
  for (let rest = stdout; rest.length > 0; ) {
    const length = rest.readUInt32LE(0);
    found.push(codec.decode(rest.subarray(4, 4 + length)));
    rest = rest.subarray(4 + length);
  }
  return { found, status, stderr: String(stderr) };
}

export const ball = (radius) => ({
  radius, mass: 7850 * (4 / 3) * Math.PI * radius ** 3, shape_factor: 0.4, material: 0,
});

export const packed = (states) => Buffer.from(Float64Array.from(states.flat()).buffer);

/// Spheres on the plane, of one material.
export function sceneOf(bodies, states, ground, pair) {
  return {
    bodies,
    initial: packed(states),
    substrate: [{
      static_friction: ground.friction, kinetic_friction: ground.friction, rolling: [[0, 0]],
      drilling_length: 0, coupled_radius: 0, hertzian_pressure: false, rolling_while_sliding: false,
      restitution: ground.restitution ?? 0,
    }],
    pairs: [{ restitution: pair?.restitution ?? 1, friction: pair?.friction ?? 0, tangential_restitution: -1 }],
    gravity: 9.81, downhill: [0, 0], motion: { kind: 'still' }, confined: false, periodic: [0, 0],
  };
}

/// Frames of so many steps: states and touches, each frame's own.
export function framesOf(scene, settings, timeStep, count, options) {
  return framesOfStarts(scene, settings, timeStep, count, [scene.initial], options)[0];
}

/// The same from each of several starts, in one process.
export function framesOfStarts(scene, settings, timeStep, count, starts, options) {
  const { found, stderr } = replies([
    { type: 'configure', scene, settings, time_step: timeStep },
    ...starts.flatMap((states) => [{ type: 'start', states, time: 0 }, { type: 'step', count }]),
  ], options);
  const runs = found.filter(({ type }) => type === 'frames');
  if (runs.length !== starts.length) throw new Error(JSON.stringify(found.at(-1)) + stderr);
  return runs.map((run) => framesIn(run, count));
}

function framesIn({ bodies, states, touch_counts, touches: told }, count) {
  const size = 9 * bodies;
  const all = new Float64Array(states.length / 8);
  new Uint8Array(all.buffer).set(states);
  let at = 0;
  return Array.from({ length: count }, (_, k) => {
    const touches = Array.from({ length: touch_counts.readUInt32LE(4 * k) }, () => {
      const touch = [told.readUInt32LE(at), told.readUInt32LE(at + 4), told.readDoubleLE(at + 8)];
      at += 16;
      return touch;
    });
    return { states: all.subarray(size * k, size * (k + 1)), touches };
  });
}
