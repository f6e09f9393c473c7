// Answers requests in the only order that makes sense: configure, start, step.

import { Refused, Rubbish } from './faults.mjs';
import { packFrames, readScene, unpackStates } from './packing.mjs';
import { MAX_MESSAGE } from './connection.mjs';
import { refuseBadSettings, inForce } from './settings.mjs';
import { warmUp } from './warm_up.mjs';

const PROTOCOL = 5;

/// CPU time of the whole process [s]: an engine may have threads of its own.
function cpuSeconds() {
  const { user, system } = process.cpuUsage();
  return 1e-6 * (user + system);
}

export class Worker {
  /// `engine` is what open() of a file in engines/ gives. isWarm: its CPU time needs no warming up.
  constructor(name, engine, isWarm = false) {
    this.name = name;
    this.engine = engine;
    this.bodies = 0; // 0: not configured
    this.started = false;
    this.isWarm = isWarm;
  }

  /// The reply to a request. Throws Rubbish for what is no request.
  answer(request) {
    const handlers = {
      hello: () => this.#hello(),
      configure: () => this.#configure(request),
      start: () => this.#start(request),
      step: () => this.#step(request),
      time: () => this.#time(request),
    };
    if (!Object.hasOwn(handlers, request.type))
      throw new Rubbish('request.type must be a type of message');
    try {
      return handlers[request.type]();
    } catch (error) {
      if (error instanceof Rubbish) throw error;
      if (error instanceof Refused) return { type: 'refused', reason: error.message };
      return { type: 'failed', reason: String(error?.message ?? error) };
    }
  }

  #hello() {
    const { version, precision, settings, takes = [] } = this.engine;
    return { type: 'welcome', protocol: PROTOCOL, engine: this.name, version, precision, settings, takes };
  }

  #configure(request) {
    this.bodies = 0;
    this.started = false;
    const timeStep = numberOf(request, 'time_step');
    if (!(timeStep > 0)) throw new Rubbish('request.time_step must be > 0');
    const scene = readScene(request.scene);
    refuseBadSettings(this.engine.settings, request.settings);
    const settings = inForce(this.engine.settings, request.settings);
    const applied = this.engine.configure(scene, settings, timeStep);
    this.bodies = scene.bodies.length;
    if (!this.isWarm) warmUp(this.engine, scene);
    this.isWarm = true;
    return {
      type: 'configured',
      settings: applied.settings,
      not_represented: applied.not_represented.map((lack) => lack.text),
      not_represented_kinds: applied.not_represented.map((lack) => lack.kind),
      left_out: applied.left_out,
    };
  }

  #start(request) {
    const states = this.#statesOf(request);
    this.engine.start(states, timeOf(request));
    this.started = true;
    return { type: 'started' };
  }

  #step(request) {
    const count = countOf(request, 'count');
    if (!this.started) throw new Error('step before start');
    const states = new Float64Array(9 * this.bodies * count);
    const touches = [];
    let seconds = 0;
    for (let k = 0; k < count; ++k) {
      const before = cpuSeconds();
      this.engine.step();
      seconds += cpuSeconds() - before;
      const here = [];
      this.engine.read(states.subarray(9 * this.bodies * k, 9 * this.bodies * (k + 1)), here);
      touches.push(here);
    }
    return { type: 'frames', count, bodies: this.bodies, cpu_seconds: seconds, ...packFrames(states, touches) };
  }

  #time(request) {
    const states = this.#statesOf(request);
    const time = timeOf(request);
    const steps = countOf(request, 'steps');
    const repeats = countOf(request, 'repeats');
    this.started = false;
    const seconds = [];
    for (let run = 0; run < repeats; ++run) {
      this.engine.start(states, time);
      const before = cpuSeconds();
      for (let k = 0; k < steps; ++k) this.engine.step();
      seconds.push(cpuSeconds() - before);
    }
    return { type: 'timed', cpu_seconds: seconds };
  }

  #statesOf(request) {
    const states = unpackStates(request.states, 'request.states');
    if (this.bodies === 0) throw new Error('start before configure');
    if (states.length !== 9 * this.bodies) throw new Error('wrong number of states');
    return states;
  }
}

function numberOf(request, key) {
  if (!Number.isFinite(request[key])) throw new Rubbish(`request.${key} must be a number`);
  return request[key];
}

function timeOf(request) {
  const time = numberOf(request, 'time');
  if (time < 0) throw new Rubbish('request.time must be >= 0');
  return time;
}

function countOf(request, key) {
  const count = request[key];
  if (!Number.isInteger(count) || count < 1 || count > MAX_MESSAGE)
    throw new Rubbish(`request.${key} must be from 1 to ${MAX_MESSAGE}`);
  return count;
}
