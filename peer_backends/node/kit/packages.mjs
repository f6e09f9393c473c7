// What lies in the node_modules of an engine's folder.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const home = (folder, name) => join(resolve(folder), 'node_modules', name);

const manifest = (folder, name) => JSON.parse(readFileSync(join(home(folder, name), 'package.json'), 'utf8'));

/// The file that a package starts with. Some call themselves modules and name a file in CommonJS as
/// their main one, which cannot be imported; those have a module beside it.
function entry(folder, name) {
  const { type, module, exports } = manifest(folder, name);
  if (type === 'module' && module && !exports) return join(home(folder, name), module);
  return createRequire(join(resolve(folder), 'index.js')).resolve(name);
}

/// The package's exports; for one in CommonJS what it assigns to module.exports.
export async function load(folder, name) {
  const module = await import(pathToFileURL(entry(folder, name)).href);
  return module.default ?? module;
}

/// "0.19.3"
export const versionOf = (folder, name) => manifest(folder, name).version;

/// What encodes and decodes CBOR as the protocol has it: maps with text as keys, byte strings
/// without tags, lengths definite.
export async function codecIn(folder) {
  process.env.CBOR_NATIVE_ACCELERATION_DISABLED = 'true';
  const { Encoder } = await load(folder, 'cbor-x');
  return new Encoder({ useRecords: false, tagUint8Array: false, variableMapSize: true });
}
