// A scene's motion played back: the reference as solid balls, a run of an engine as a ghost.
import { largest_of, make, make_select, number_text, prefixed, quantity_text } from './dom.js';
import { between, between_periodic, end_of, frame_at, kRoles, orientations, turned } from './motion.js';
import { ReplayWorld } from './replay_world.js';
import { on_theme, theme_colours } from './theme.js';

const kAuto = 8;         // [s] that the whole run takes unless told otherwise
const kSteps = 2000;     // of the slider
const kMostTold = 4;     // bodies in the line of text
const kStep = 0.12;      // [rad] of an arrow key

const kPhases = { median: 'the phase in the middle of the engine’s ensemble', worst: 'the phase that is farthest off',
  nearest: 'the phase that is nearest to the reference' };

let open_replay = null;  // browsers allow few WebGL contexts: one at a time
const remembered = new Map();  // how a scene was looked at: its id -> {view, follow}
const still = window.matchMedia('(prefers-reduced-motion: reduce)');

/** A button in `parent` that opens the replay; `motions()` gives the scene's, unpacked, the reference's first. */
export function add_replay(parent, scene, motions) {
  const panel = make('div', { class: 'replay', hidden: true });
  const button = make('button', { type: 'button', class: 'replay-open', 'aria-expanded': 'false',
    onclick: () => (panel.hidden ? open() : close()) }, 'Replay in 3D');
  parent.append(button, panel);

  function open() {
    open_replay?.();
    panel.hidden = false;
    button.setAttribute('aria-expanded', 'true');
    button.textContent = 'Close the replay';
    const replay = new Replay(panel, scene, motions());
    open_replay = close;
    close.end = () => replay.close();
  }
  function close() {
    close.end?.();
    close.end = null;
    panel.replaceChildren();
    panel.hidden = true;
    button.setAttribute('aria-expanded', 'false');
    button.textContent = 'Replay in 3D';
    if (open_replay === close) open_replay = null;
  }
}

class Replay {
  constructor(panel, scene, motions) {
    this.scene = scene;
    this.motions = motions;
    this.turns = new Map(motions.map((motion) => [motion, motion.bodies.map((body) => orientations(motion.time, body.w))]));
    this.begin = Math.min(...motions.map((motion) => motion.time[0]));
    this.end = end_of(motions);
    this.time = this.begin;
    this.clock = prefixed('s', this.end);
    this.rate = null;  // simulated seconds a second; null: the whole run in kAuto
    this.most_slip = largest_of(motions.flatMap((motion) => motion.bodies.flatMap((body) => body.slip.flat())));
    this.runs = [...new Set(motions.filter((motion) => motion.run >= 0).map((motion) => motion.run))];
    this.run = this.runs[0] ?? null;
    this.follow = remembered.get(scene.id)?.follow ?? this.reach() > 14 * scene.motion.bodies[0].radius;
    this.make_controls(panel);
    try {
      this.world = new ReplayWorld(this.canvas, scene.motion);
    } catch {
      panel.replaceChildren(make('p', { class: 'replay-none', role: 'status' },
        'This browser shows no WebGL, which the replay is drawn with; the charts and tables have the same numbers.'));
      return;
    }
    this.paint();
    this.choose_roles();
    this.end_theme = on_theme(() => { this.paint(); this.show(); });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.canvas);
    const before = remembered.get(scene.id);
    if (before) this.world.view = { ...before.view };
    this.resize();
    this.show();
    if (!still.matches) this.toggle();
  }

  make_controls(panel) {
    this.canvas = make('canvas', { class: 'replay-canvas', tabindex: '0', role: 'img',
      'aria-label': `Replay of ${this.scene.name}: drag or arrow keys turn it, the wheel, plus and minus zoom, space plays; at the slider arrow keys step through time` });
    this.play = make('button', { type: 'button', class: 'replay-play', onclick: () => this.toggle() }, 'Play');
    this.slider = make('input', { type: 'range', min: 0, max: kSteps, value: 0, step: 1, 'aria-label': 'Time',
      class: 'replay-time', oninput: () => this.go(this.begin + (this.slider.value / kSteps) * (this.end - this.begin)) });
    const speeds = [['', `whole run in ${kAuto} s`], ...[1, 0.1, 0.01, 0.001].map((rate) => [rate, rate === 1 ? 'real time' : `1/${1 / rate} of it`])];
    const speed = make_select('Speed', speeds, (value) => { this.rate = value === '' ? null : Number(value); });
    const run = make_select('Engine', [...this.runs.map((k) => [k, this.scene.runs[k].label]), ['', 'none']], (value) => {
      this.run = value === '' ? null : Number(value);
      this.choose_roles();
      this.paint();
      this.show();
    });
    run.select.classList.add('replay-run');
    const role = make_select('Phase', [], () => this.show());
    this.role = role.select;
    this.role.classList.add('replay-phase');
    const follow = make('input', { type: 'checkbox', checked: this.follow,
      onchange: () => { this.follow = follow.checked; this.show(); } });
    const controls = make('div', { class: 'replay-controls' }, this.play, this.slider, speed.label);
    if (this.meetings().length) {
      controls.append(make('button', { type: 'button', onclick: () => this.next_contact() }, 'Next contact'));
    }
    if (this.runs.length) controls.append(run.label, role.label);
    if (this.runs.length > 1) {
      const beside = make_select('Beside it', [['', 'nothing'], ...this.runs.map((k) => [k, this.scene.runs[k].label])],
        (value) => this.set_beside(value === '' ? null : Number(value)));
      beside.select.classList.add('replay-beside');
      controls.append(beside.label);
    }
    controls.append(make('label', {}, follow, ' Follow'));
    this.text = make('p', { class: 'replay-text', role: 'status' });
    this.views = make('div', { class: 'replay-views' }, this.canvas);
    panel.append(this.views, controls, this.text, make('p', { class: 'faint' }, this.explanation()));
    this.listen();
  }

  explanation() {
    const { tilt, substrate } = this.scene.motion;
    return `Solid: the reference.${this.runs.length ? ' Ghost: the engine.' : ''}` +
      (substrate && this.most_slip > 0 ? ' Arrows: slip at the lowest point.' : '') +
      (this.motions[0].bodies.length && (this.scene.motion.surfaces ?? []).some(({ belt, velocity, rate }) => belt ?? velocity ?? rate)
        ? ' Grey arrows: where surfaces move.' : '') +
      (this.runs.length ? ' A phase is where within a time step the first contact falls; the engine’s ensemble has many.' : '') +
      (this.meetings().length ? ' Yellow: where balls touch.' : '') + (tilt ? ` The plane is tilted by ${number_text(tilt, 3)}°.` : '');
  }

  listen() {
    let from = null;
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => {
      from = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!from) return;
      this.turn(-(event.clientX - from[0]) / 160, (event.clientY - from[1]) / 160);
      from = [event.clientX, event.clientY];
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { from = null; });
    canvas.addEventListener('wheel', (event) => {
      if (document.activeElement !== canvas) return;  // the page scrolls on
      event.preventDefault();
      this.turn(0, 0, Math.exp(-event.deltaY / 500));
    }, { passive: false });
    const keys = {
      ArrowLeft: [-kStep, 0], ArrowRight: [kStep, 0], ArrowUp: [0, kStep], ArrowDown: [0, -kStep],
      '+': [0, 0, 1.15], '=': [0, 0, 1.15], '-': [0, 0, 1 / 1.15],
    };
    canvas.closest('.replay').addEventListener('keydown', (event) => {
      if (event.target.matches('button, select, input[type=checkbox]') || (event.target !== canvas && event.key !== ' ')) return;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === ' ') this.toggle();
      else if (keys[event.key]) this.turn(...keys[event.key]);
      else return;
      event.preventDefault();
    });
  }

  /** Each view in the colours of its run. */
  paint() {
    this.world.paint(theme_colours(), this.scene.runs[this.run] ?? null);
    this.other?.world.paint(theme_colours(), this.scene.runs[this.other.run]);
  }

  /** A second engine in a view of its own, under the same camera; null takes it away. */
  set_beside(run) {
    this.other?.world.close();
    this.other?.canvas.remove();
    this.other = null;
    if (run !== null) {
      const canvas = make('canvas', { class: 'replay-canvas', role: 'img', 'aria-label': `The same with ${this.scene.runs[run].label}` });
      this.views.append(canvas);
      this.other = { run, canvas, world: new ReplayWorld(canvas, this.scene.motion) };
      this.other.world.view = this.world.view;
      this.observer.observe(canvas);
      this.paint();
    }
    this.views.classList.toggle('two', run !== null);
    this.resize();
    this.show();
  }

  turn(...by) {
    this.world.turn(...by);
    this.other?.world.draw();
  }

  choose_roles() {
    const before = this.role.value;
    const roles = kRoles.filter((role) => this.motions.some((motion) => motion.run === this.run && motion.role === role));
    this.role.replaceChildren(...roles.map((role) => make('option', { value: role }, role)));
    if (roles.includes(before)) this.role.value = before;
    this.role.disabled = roles.length < 2;
  }

  /** The motion of a run in the phase that is chosen, or in the first that it has. */
  ghost(run = this.run) {
    const motions = this.motions.filter((motion) => motion.run === run && motion.run >= 0);
    return motions.find(({ role }) => role === this.role.value) ?? motions[0];
  }

  /** [m] from the first to the farthest place of any body of the reference. */
  reach() {
    const { bodies } = this.motions[0];
    return Math.max(...bodies.map(({ p }) => Math.hypot(...p.map((column) => Math.max(...column) - Math.min(...column)))));
  }

  /** Times at which balls of the reference met. */
  meetings() {
    const { time, touches } = this.motions[0];
    return [...new Set(touches.filter(([, , j]) => j !== undefined && j >= 0).map(([frame]) => time[frame]))];
  }

  next_contact() {
    const times = this.meetings();
    this.stop();
    this.go(times.find((time) => time > this.time * (1 + 1e-9) + 1e-15) ?? times[0]);
  }

  toggle() {
    if (this.frame) {
      this.stop();
      return undefined;
    }
    if (this.time >= this.end) this.time = this.begin;
    let last = null;
    const step = (now) => {
      const passed = last === null ? 0 : Math.min(0.1, (now - last) / 1000);
      last = now;
      const rate = this.rate ?? (this.end - this.begin) / kAuto;
      this.go(Math.min(this.end, this.time + passed * rate));
      if (this.time >= this.end) this.stop();
      else this.frame = requestAnimationFrame(step);
    };
    this.frame = requestAnimationFrame(step);
    this.play.textContent = 'Pause';
    this.text.setAttribute('aria-live', 'off');  // not sixty times a second
    return undefined;
  }

  stop() {
    cancelAnimationFrame(this.frame);
    this.frame = null;
    this.play.textContent = 'Play';
    this.text.setAttribute('aria-live', 'polite');
  }

  go(time) {
    this.time = time;
    this.slider.value = Math.round((kSteps * (time - this.begin)) / (this.end - this.begin || 1));
    this.slider.setAttribute('aria-valuetext', quantity_text(time / this.clock.factor, this.clock.unit));
    this.show();
  }

  /** All bodies of a run at the time that is shown. */
  bodies_of(motion) {
    const at = frame_at(motion.time, this.time), [k, fraction] = at;
    const step = fraction > 0 ? fraction * (motion.time[k + 1] - motion.time[k]) : 0;
    const { periodic } = this.scene.motion;
    return motion.bodies.map((body, b) => {
      const position = body.p.map((column, axis) => {
        const length = axis < 2 && periodic ? periodic[axis] : null;
        if (!length) return between(column, at);
        const x = between_periodic(column, at, length);
        return x - length * Math.floor(x / length);
      });
      const turn = step === 0 ? this.turns.get(motion)[b][k]
        : turned(this.turns.get(motion)[b][k], body.w.map((column) => 0.5 * step * (column[k] + column[k + 1])));
      const slip = body.slip.map((column) => between(column, at));
      return { position, turn, slip: slip.some(Number.isNaN) ? null : slip, speed: between(body.speed, at) };
    });
  }

  /** Points at which balls have met within the last frame or are about to in the next. */
  marks(motion, bodies) {
    const [k] = frame_at(motion.time, this.time);
    return motion.touches.filter(([frame, , j]) => (frame === k || frame === k + 1) && j !== undefined && j >= 0)
      .map(([, i, j]) => {
        const [a, b] = [bodies[i].position, bodies[j].position];
        const share = motion.bodies[i].radius / (motion.bodies[i].radius + motion.bodies[j].radius);
        return a.map((x, axis) => x + share * (b[axis] - x));
      });
  }

  show() {
    const [truth] = this.motions, ghost = this.ghost();
    const reference = this.bodies_of(truth);
    const other = ghost ? this.bodies_of(ghost) : null;
    this.look(reference, other);
    const seen = { reference, marks: this.marks(truth, reference), most_slip: this.most_slip, time: this.time,
      substrate: truth.substrate.map((column) => between(column, frame_at(truth.time, this.time))) };
    this.world.show({ ...seen, ghost: other });
    const beside = this.other && this.ghost(this.other.run);
    if (this.other) this.other.world.show({ ...seen, ghost: beside ? this.bodies_of(beside) : null });
    this.tell(reference, other, ghost);
  }

  /** The camera sees all of the way, or follows the balls as they are, with ghosts that are near theirs. */
  look(reference, other) {
    const radius = Math.max(...this.scene.motion.bodies.map((body) => body.radius));
    const near = (other ?? []).filter(({ position }, k) =>
      Math.hypot(...position.map((x, axis) => x - reference[k].position[axis])) < 12 * radius);
    const ranges = [0, 1, 2].map((axis) => {
      const values = this.follow ? [...reference, ...near].map(({ position }) => position[axis])
        : this.motions[0].bodies.flatMap((body) => body.p[axis]);
      return values.reduce(([low, high], x) => [Math.min(low, x), Math.max(high, x)], [Infinity, -Infinity]);
    });
    const centre = ranges.map(([low, high]) => (low + high) / 2);
    const span = Math.hypot(...ranges.map(([low, high]) => high - low)) + 4 * radius;
    this.world.look_at(centre, span);
    this.other?.world.look_at(centre, span);
  }

  tell(reference, other, ghost) {
    const { bodies } = this.motions[0];
    const least = 1e-4 * largest_of([...reference, ...(other ?? [])].map((body) => body.speed));
    const speed = (value) => {
      if (value <= least) return '0';
      const scale = prefixed('m/s', value);
      return quantity_text(value / scale.factor, scale.unit, 3);
    };
    const of = (body) => `${speed(body.speed)}${body.slip ? `, slip ${speed(Math.hypot(...body.slip))}` : ''}`;
    const lines = bodies.slice(0, kMostTold).map(({ name }, k) =>
      make('span', {}, make('b', {}, name), ` reference ${of(reference[k])}${other ? `; engine ${of(other[k])}` : ''}`));
    const more = bodies.length > kMostTold ? [make('span', {}, `… ${bodies.length - kMostTold} more`)] : [];
    const phase = ghost ? `${this.scene.runs[ghost.run].label}, phase ${ghost.phase + 1}, ${kPhases[ghost.role] ?? ghost.role}` +
      (ghost.error === null || ghost.error === undefined ? '' : `, off by ${number_text(ghost.error, 3)} tolerances`) : '';
    this.text.replaceChildren(
      make('span', { class: 'replay-clock' }, `t = ${quantity_text(this.time / this.clock.factor, this.clock.unit)}`),
      ...lines, ...more, make('span', { class: 'faint' }, phase),
      ...(this.other ? [make('span', { class: 'faint' }, `beside it: ${this.scene.runs[this.other.run].label}`)] : []));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width > 0 && height > 0) this.world.resize(width, height);
    if (this.other && this.other.canvas.clientWidth > 0) this.other.world.resize(this.other.canvas.clientWidth, this.other.canvas.clientHeight);
  }

  close() {
    if (this.world) remembered.set(this.scene.id, { view: { ...this.world.view }, follow: this.follow });
    this.stop();
    this.end_theme?.();
    this.observer?.disconnect();
    this.world?.close();
    this.other?.world.close();
  }
}
