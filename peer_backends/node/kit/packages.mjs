// What lies in the node_modules of an engine's folder.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

/// The package's exports; for one in CommonJS what it assigns to module.exports.
export async function load(folder, name) {
  const require = createRequire(join(resolve(folder), 'index.js'));
  const module = await import(pathToFileURL(require.resolve(name)).href);
  return module.default ?? module;
}

/// "0.19.3"
export function versionOf(folder, name) {
  const file = join(resolve(folder), 'node_modules', name, 'package.json');
  return JSON.parse(readFileSync(file, 'utf8')).version;
}

/// What encodes and decodes CBOR as the protocol has it: maps with text as keys, byte strings
/// without tags, lengths definite.
export async function codecIn(folder) {
  process.env.CBOR_NATIVE_ACCELERATION_DISABLED = 'true';
  const { Encoder } = await load(folder, 'cbor-x');
  return new Encoder({ useRecords: false, tagUint8Array: false, variableMapSize: true });
}
