// A worker in a process of its own, as the harness starts it.

import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { codecIn } from '../../kit/packages.mjs';
import { frame } from '../../kit/connection.mjs';

const MAIN = fileURLToPath(new URL('../../main.mjs', import.meta.url));

export class WorkerClient {
  static async start(engine, folder) {
    return new WorkerClient(
      spawn('node', [MAIN, engine, folder], { stdio: ['pipe', 'pipe', 'inherit'] }),
      await codecIn(folder),
    );
  }

  constructor(process, codec) {
    this.process = process;
    this.codec = codec;
    this.arrived = Buffer.alloc(0);
    this.output = process.stdout[Symbol.asyncIterator]();
  }

  /// The reply to a request.
  async ask(request) {
    this.process.stdin.write(frame(this.codec, request));
    const length = (await this.#take(4)).readUInt32LE(0);
    return this.codec.decode(await this.#take(length));
  }

  /// All states after each step, 9 numbers a body.
  async run(scene, settings, timeStep, steps) {
    const configured = await this.ask({ type: 'configure', scene, settings, time_step: timeStep });
    if (configured.type !== 'configured') throw new Error(`${configured.type}: ${configured.reason}`);
    await this.ask({ type: 'start', states: scene.initial, time: 0 });
    const { states } = await this.ask({ type: 'step', count: steps });
    const numbers = new Float64Array(Uint8Array.from(states).buffer);
    const size = 9 * scene.bodies.length;
    return Array.from({ length: steps }, (_, n) => [...numbers.subarray(n * size, (n + 1) * size)]);
  }

  quit() {
    this.process.stdin.end(frame(this.codec, { type: 'quit' }));
  }

  async #take(bytes) {
    while (this.arrived.length < bytes) {
      const { value, done } = await this.output.next();
      if (done) throw new Error('the worker is gone');
      this.arrived = Buffer.concat([this.arrived, value]);
    }
    const taken = this.arrived.subarray(0, bytes);
    this.arrived = this.arrived.subarray(bytes);
    return taken;
  }
}
