// A worker for an engine from npm: node main.mjs ENGINE FOLDER [cold], the package in
// FOLDER/node_modules; cold: without warming up, for those to whom CPU times say nothing.
// Answers the requests of docs/engine-protocol.md.

import { keepOutputFree } from './kit/stray_output.mjs';

const write = keepOutputFree(); // before an engine is loaded

const [engineName, folder, cold] = process.argv.slice(2);
if (!/^[a-z0-9-]+$/.test(engineName ?? '') || !folder || (cold ?? 'cold') !== 'cold') {
  console.error('usage: node main.mjs ENGINE FOLDER [cold], with the package in FOLDER/node_modules');
  process.exit(2);
}

const { Connection } = await import('./kit/connection.mjs');
const { Worker } = await import('./kit/worker.mjs');
const { codecIn } = await import('./kit/packages.mjs');
const { serve } = await import('./kit/serve.mjs');

try {
  const { open } = await import(`./engines/${engineName}.mjs`);
  const connection = new Connection(await codecIn(folder), write);
  process.exit(serve(connection, new Worker(engineName, await open(folder), cold === 'cold')));
} catch (error) {
  console.error(`${engineName} in ${folder}: ${error.message}`);
  process.exit(1);
}
