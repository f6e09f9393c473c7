// The installed engine that a test is about: SLIPCHECK_NODE_ENGINE names its folder,
// <name>@<version>.

import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { inForce } from '../../kit/settings.mjs';

/// The folder, where it is one of this engine.
export function folderOf(engine) {
  const folder = process.env.SLIPCHECK_NODE_ENGINE ?? '';
  if (basename(folder).split('@')[0] !== engine)
    throw new Error(`SLIPCHECK_NODE_ENGINE must name a folder of ${engine}, ${engine}@<version>`);
  return folder;
}

/// What a file in engines/ opens.
export async function openEngine(engine) {
  const { open } = await import(`../../engines/${engine}.mjs`);
  return open(folderOf(engine));
}

function valueOf(text) {
  if (text === 'true' || text === 'false') return text === 'true';
  return Number.isNaN(Number(text)) ? text : Number(text);
}

/// The settings of a profile that comes along, whose lines are "  name: value  # why".
export function profile(engine, name) {
  const text = readFileSync(new URL(`../../profiles/${engine}/${name}.yaml`, import.meta.url), 'utf8');
  const lines = text.split('\n').filter((line) => /^ {2}[a-z]/.test(line));
  return Object.fromEntries(
    lines.map((line) => {
      const [key, value] = line.replace(/#.*/, '').trim().split(': ');
      return [key, valueOf(value)];
    }),
  );
}

/// A run in this process: what configure tells, and states and touches after each step.
export function runHere(engine, scene, settings, timeStep, steps) {
  const initial = new Float64Array(Uint8Array.from(scene.initial).buffer);
  const told = engine.configure({ ...scene, initial }, inForce(engine.settings, settings), timeStep);
  engine.start(initial, 0);
  const frames = Array.from({ length: steps }, () => {
    engine.step();
    const states = new Float64Array(initial.length);
    const touches = [];
    engine.read(states, touches);
    return { states, touches };
  });
  return { told, frames, last: frames.at(-1).states };
}
