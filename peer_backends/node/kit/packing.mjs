// Packed values and the scene of a request, checked as far as an engine relies on it.

import { Rubbish } from './faults.mjs';

const STATE = 9; // numbers of a state: position, velocity, angular velocity

/// 9 numbers for each body.
export function unpackStates(bytes, place) {
  if (!(bytes instanceof Uint8Array)) throw new Rubbish(`${place} must be bytes`);
  if (bytes.length % (8 * STATE) !== 0)
    throw new Rubbish(`${place} has ${bytes.length} bytes, must be a multiple of ${8 * STATE}`);
  const states = new Float64Array(bytes.length / 8);
  new Uint8Array(states.buffer).set(bytes);
  return states;
}

/// The packed members of `frames`: all states one after the other, and for each frame a list of
/// touches [first, second, normal impulse].
export function packFrames(states, touches) {
  const counts = Buffer.alloc(4 * touches.length);
  touches.forEach((here, k) => counts.writeUInt32LE(here.length, 4 * k));
  const packed = Buffer.alloc(16 * touches.reduce((sum, here) => sum + here.length, 0));
  let at = 0;
  for (const here of touches) {
    for (const [first, second, impulse] of here) {
      packed.writeUInt32LE(first, at);
      packed.writeInt32LE(second, at + 4); // the substrate and surfaces are negative
      packed.writeDoubleLE(impulse, at + 8);
      at += 16;
    }
  }
  return {
    states: Buffer.from(states.buffer, states.byteOffset, states.byteLength),
    touch_counts: counts,
    touches: packed,
  };
}

function listOf(scene, key, place, count, things) {
  const list = scene[key];
  if (!Array.isArray(list)) throw new Rubbish(`${place}.${key} must be a list`);
  if (count !== undefined && list.length !== count)
    throw new Rubbish(
      `${place}.${key} must have an entry for each of ${count} ${things}, has ${list.length}`);
  if (count === undefined && list.length === 0)
    throw new Rubbish(`${place}.${key} must have an entry`);
  return list;
}

const SHAPES = ['plane', 'rectangle', 'rod', 'ball'];
const MOTIONS = ['still', 'belt', 'moving', 'turning'];

function readSurfaces(scene, place, materials) {
  const surfaces = listOf(scene, 'surfaces', place);
  listOf(scene, 'on_surfaces', place, materials * surfaces.length, 'materials on surfaces');
  surfaces.forEach(({ shape, motion }, k) => {
    if (!SHAPES.includes(shape?.kind))
      throw new Rubbish(`${place}.surfaces[${k}].shape.kind must be one of ${SHAPES.join(', ')}`);
    if (!MOTIONS.includes(motion?.kind))
      throw new Rubbish(`${place}.surfaces[${k}].motion.kind must be one of ${MOTIONS.join(', ')}`);
  });
}

/// The scene of a request, its states unpacked.
export function readScene(scene) {
  const place = 'request.scene';
  if (typeof scene !== 'object' || scene === null) throw new Rubbish(`${place} must be a map`);
  const bodies = listOf(scene, 'bodies', place);
  const materials = listOf(scene, 'substrate', place).length;
  listOf(scene, 'pairs', place, materials ** 2, 'pairs of materials');
  bodies.forEach((body, i) => {
    for (const key of ['radius', 'mass', 'shape_factor'])
      if (!(body[key] > 0)) throw new Rubbish(`${place}.bodies[${i}].${key} must be > 0`);
    if (!(body.material >= 0 && body.material < materials))
      throw new Rubbish(`${place}.bodies[${i}].material must be below ${materials}`);
  });
  if (!(scene.gravity >= 0)) throw new Rubbish(`${place}.gravity must be >= 0`);
  for (const key of ['downhill', 'periodic']) listOf(scene, key, place, 2, 'directions');
  if (typeof scene.motion?.kind !== 'string') throw new Rubbish(`${place}.motion.kind must be a text`);
  if (scene.box)
    for (const key of ['on_floor', 'on_wall', 'on_lid'])
      listOf(scene.box, key, `${place}.box`, materials, 'materials');
  if (scene.surfaces !== undefined) readSurfaces(scene, place, materials);
  const initial = unpackStates(scene.initial, `${place}.initial`);
  if (initial.length !== STATE * bodies.length)
    throw new Rubbish(`${place}.initial must have an entry for each of ${bodies.length} bodies, has ${initial.length / STATE}`);
  return { ...scene, initial };
}
