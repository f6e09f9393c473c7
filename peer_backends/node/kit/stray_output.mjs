// Standard output belongs to the protocol; whatever else is written there goes to standard error.

import fs from 'node:fs';
import { Console } from 'node:console';
import { syncBuiltinESMExports } from 'node:module';

/// Turns all other output aside and gives back what writes bytes to standard output itself. Engines
/// print through the console, through process.stdout or, as Emscripten does, through fs.
export function keepOutputFree() {
  const writeSync = fs.writeSync;
  const aside = (fd) => (fd === 1 ? 2 : fd);
  for (const name of ['write', 'writeSync', 'writev', 'writevSync', 'writeFile', 'writeFileSync']) {
    const original = fs[name];
    fs[name] = (file, ...rest) => original(aside(file), ...rest);
  }
  syncBuiltinESMExports();
  process.stdout.write = process.stderr.write.bind(process.stderr);
  globalThis.console = new Console(process.stderr);
  return (bytes, offset) => writeSync(1, bytes, offset);
}
