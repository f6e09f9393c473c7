// Havok, package @babylonjs/havok: single precision, no rolling or drilling friction. Its source is
// closed: what is said of it here is measured. Coefficients belong to shapes and are combined by
// modes.

import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { FLOOR } from '../kit/contacts.mjs';
import { Refused } from '../kit/faults.mjs';
import { lacks } from '../kit/lacks.mjs';
import { surfaceMotion } from '../kit/motion.mjs';
import { load, versionOf } from '../kit/packages.mjs';
import { pairShapes, typedShapes } from '../kit/pair_shapes.mjs';
import { flag, number, word } from '../kit/settings.mjs';
import { rounded } from '../kit/text.mjs';
import { halfOf, inertiaOf, isBlock, isSphere, turnOf } from '../kit/solids.mjs';
import { besideSurfaces, hasSubstrate } from '../kit/surfaces.mjs';
import { Touches } from '../kit/touches.mjs';
import { Units, gravityOf, unitSettings } from '../kit/units.mjs';

const PACKAGE = '@babylonjs/havok';
const FILTER_BITS = 31;
const SLOW = 0.2; // length units/s; a ball that rolls slower is braked (docs/engines/havok.md)
const ALL_EVENTS = 7;
/// Havok's own modes cannot be read or set from JavaScript: those of Babylon.js's setMaterial().
const AS_TYPED = { friction: 'smaller', restitution: 'larger' };
const NO_TURN = [0, 0, 0, 1];

export async function open(folder) {
  const start = await load(folder, PACKAGE);
  const wasm = join(resolve(folder), 'node_modules', PACKAGE, 'lib', 'esm', 'HavokPhysics.wasm');
  const havok = await start({
    wasmBinary: readFileSync(wasm),
    print: console.error,
    printErr: console.error,
  });
  return new HavokEngine(havok, versionOf(folder, PACKAGE));
}

class HavokEngine {
  constructor(havok, version) {
    this.hp = havok;
    this.version = version;
    this.precision = 'single';
    this.takes = ['block', 'cylinder', 'surfaces'];
    this.hasSpeedLimit = Boolean(havok.HP_World_SetSpeedLimit);
    this.settings = this.#makeSettings();
  }

  configure(scene, settings, timeStep) {
    this.#refuse(scene);
    this.#leave();
    this.units = new Units(scene, settings);
    this.chosen = settings;
    this.scene = this.units.scene(scene);
    this.timeStep = timeStep * this.units.time;
    this.motion = surfaceMotion(this.scene);
    this.shapes =
      settings.coefficients === 'fields'
        ? typedShapes(this.scene)
        : pairShapes(withoutStaticFriction(this.scene), 'havok', FILTER_BITS);
    this.start(scene.initial, 0);
    const speed = rounded(SLOW / this.units.speed, 3);
    return {
      settings: this.#applied(scene, timeStep),
      not_represented: [
        ...lacks(scene, timeStep, { surfaceVelocity: settings.surface_velocity === 'step_end' }),
        { text: `rolling below ${speed} m/s (such a ball is braked)`, kind: 'rolling below … m/s' },
      ],
      left_out: [],
    };
  }

  start(states, time) {
    this.#leave();
    const { hp } = this;
    const factors = this.units.ofState;
    this.startTime = time * this.units.time;
    this.steps = 0;
    this.bodyOf = new Map(); // by a body's handle: a body's index, or a surface
    this.handles = { bodies: [], shapes: [] };
    this.world = made(hp, hp.HP_World_Create());
    done(hp, hp.HP_World_SetGravity(this.world, gravityOf(this.scene)));
    done(hp, hp.HP_World_SetIdealStepTime(this.world, this.chosen.ideal_step_time));
    if (this.hasSpeedLimit)
      done(
        hp,
        hp.HP_World_SetSpeedLimit(
          this.world,
          this.chosen.max_linear_velocity,
          this.chosen.max_angular_velocity,
        ),
      );
    if (hasSubstrate(this.scene)) this.#addSubstrate();
    this.beside = besideSurfaces(this.scene).map((surface) => this.#addBeside(surface));
    this.balls = this.scene.bodies.map((_, i) =>
      this.#addBall(
        i,
        Array.from(states.subarray(9 * i, 9 * i + 9), (value, k) => value * factors[k]),
      ),
    );
  }

  step() {
    const now = this.startTime + this.steps * this.timeStep;
    if (!this.motion.isStill) this.#moveSubstrate(now);
    this.#moveBeside(now);
    this.hp.HP_World_Step(this.world, this.timeStep);
    ++this.steps;
  }

  read(states, touches) {
    const { hp } = this;
    const factors = this.units.ofState;
    this.balls.forEach((ball, i) => {
      const parts = [
        made(hp, hp.HP_Body_GetPosition(ball)),
        made(hp, hp.HP_Body_GetLinearVelocity(ball)),
        made(hp, hp.HP_Body_GetAngularVelocity(ball)),
      ];
      parts.flat().forEach((value, k) => {
        states[9 * i + k] = value / factors[k];
      });
    });
    this.#findTouches(touches);
  }

  #makeSettings() {
    const { hp } = this;
    const body = made(hp, hp.HP_Body_Create());
    const damping = [hp.HP_Body_GetLinearDamping(body), hp.HP_Body_GetAngularDamping(body)].map(
      (answer) => Number(made(hp, answer).toPrecision(6)),
    );
    hp.HP_Body_Release(body);
    const limits = this.hasSpeedLimit
      ? [
          number('max_linear_velocity', 'm/s', 200, 'at which a velocity is cut', {
            high: 1e9,
            candidates: [200, 1e9],
          }),
          number('max_angular_velocity', 'rad/s', 100, 'at which a spin is cut', {
            high: 1e9,
            candidates: [100, 1e9],
          }),
        ]
      : [];
    return [
      word(
        'coefficients',
        ['fields', 'pair'],
        'pair',
        "the scene's coefficients straight in the shapes' materials, of which Babylon.js has the smaller friction and the larger restitution; or " +
          'exactly, pair by pair, through combine modes and collision filters',
      ),
      number(
        'ideal_step_time',
        's',
        1 / 60,
        'HP_World_SetIdealStepTime: the step for which contacts are tuned; 0: whichever ' + 'it is',
        { high: 10, candidates: [1 / 60, 0] },
      ),
      flag('sleeping', true, 'a body that is slow for a while stops'),
      number('linear_damping', '1/s', damping[0], 'of each body', { candidates: [] }),
      number('angular_damping', '1/s', damping[1], 'of each body', { candidates: [damping[1], 0] }),
      ...limits,
      word(
        'surface_velocity',
        ['this_step', 'step_end'],
        'this_step',
        'velocity of a moving substrate as contacts feel it: the mean over the step, or that at its end',
      ),
      ...unitSettings,
    ];
  }

  #refuse(scene) {
    if (scene.box)
      throw new Refused(
        'havok: bodies in a box stay in a plane, and Havok locks no directions of a body',
      );
    if (scene.periodic.some((length) => length > 0))
      throw new Refused(
        'havok: the substrate repeats itself, and a Havok world has no periodic boundaries',
      );
  }

  #leave() {
    const { hp } = this;
    if (!this.world) return;
    for (const body of this.handles.bodies) {
      hp.HP_World_RemoveBody(this.world, body);
      hp.HP_Body_Release(body);
    }
    for (const shape of this.handles.shapes) hp.HP_Shape_Release(shape);
    hp.HP_World_Release(this.world);
    this.world = undefined;
  }

  #addBall(i, state) {
    const { hp, chosen } = this;
    const body = this.scene.bodies[i];
    const { mass } = body;
    const shapes = this.shapes
      .ofBall(i)
      .map((contact) => this.#shape(this.#created(body), contact));
    const ball = this.#body(shapes, hp.MotionType.DYNAMIC);
    const inertia = inertiaOf({ ...body, mass: 1 }); // of a mass of 1
    const turn = isSphere(body) ? NO_TURN : turnOf(body);
    done(
      hp,
      hp.HP_Body_SetMassProperties(ball, [[0, 0, 0], mass, inertia, turn]),
    );
    done(hp, hp.HP_Body_SetLinearDamping(ball, chosen.linear_damping));
    done(hp, hp.HP_Body_SetAngularDamping(ball, chosen.angular_damping));
    done(hp, hp.HP_Body_SetPosition(ball, state.slice(0, 3)));
    this.#enter(ball, i);
    done(hp, hp.HP_Body_SetLinearVelocity(ball, state.slice(3, 6)));
    done(hp, hp.HP_Body_SetAngularVelocity(ball, state.slice(6, 9)));
    done(hp, hp.HP_Body_SetEventMask(ball, ALL_EVENTS));
    if (!chosen.sleeping)
      done(hp, hp.HP_Body_SetActivationControl(ball, hp.ActivationControl.ALWAYS_ACTIVE));
    return ball;
  }

  /// Turned in its body, whose axes are the world's at the start.
  #created(body) {
    const { hp } = this;
    if (isSphere(body)) return hp.HP_Shape_CreateSphere([0, 0, 0], body.radius);
    if (isBlock(body)) return hp.HP_Shape_CreateBox([0, 0, 0], turnOf(body), body.size);
    const [half, radius] = halfOf(body);
    const [x, y] = body.axis.map((direction) => direction * half);
    return hp.HP_Shape_CreateCylinder([-x, -y, 0], [x, y, 0], radius);
  }

  #shape(created, { friction, restitution, rule, member, filter }) {
    const { hp } = this;
    const shape = made(hp, created);
    this.handles.shapes.push(shape);
    const mode = { smaller: hp.MaterialCombine.MINIMUM, larger: hp.MaterialCombine.MAXIMUM };
    const modes = rule === 'as shipped' ? AS_TYPED : rule;
    done(
      hp,
      hp.HP_Shape_SetMaterial(shape, [
        friction,
        friction,
        restitution,
        mode[modes.friction],
        mode[modes.restitution],
      ]),
    );
    done(hp, hp.HP_Shape_SetFilterInfo(shape, [member, filter]));
    return shape;
  }

  #body(shapes, motion) {
    const { hp } = this;
    const body = made(hp, hp.HP_Body_Create());
    this.handles.bodies.push(body);
    done(hp, hp.HP_Body_SetShape(body, shapes.length === 1 ? shapes[0] : this.#container(shapes)));
    done(hp, hp.HP_Body_SetMotionType(body, motion));
    return body;
  }

  #container(shapes) {
    const { hp } = this;
    const container = made(hp, hp.HP_Shape_CreateContainer());
    this.handles.shapes.push(container);
    for (const shape of shapes)
      done(hp, hp.HP_Shape_AddChild(container, shape, [[0, 0, 0], NO_TURN, [1, 1, 1]]));
    return container;
  }

  #enter(body, index) {
    this.bodyOf.set(body[0], index);
    done(this.hp, this.hp.HP_World_AddBody(this.world, body, false));
  }

  /// A box, so thin that single precision tells where its face is: Havok has no plane.
  #addSubstrate() {
    const { hp } = this;
    const { wide, thick } = this.#plane();
    const shapes = this.shapes
      .ofSurface(FLOOR)
      .map((contact) =>
        this.#shape(hp.HP_Shape_CreateBox([0, 0, -thick / 2], NO_TURN, [wide, wide, thick]), contact),
      );
    const isStill = this.motion.isStill;
    this.substrate = this.#body(shapes, isStill ? hp.MotionType.STATIC : hp.MotionType.KINEMATIC);
    done(hp, hp.HP_Body_SetPosition(this.substrate, this.motion.position(this.startTime)));
    this.#enter(this.substrate, FLOOR);
  }

  /// Sizes of a box in the place of a plane.
  #plane() {
    const thick = 32 * this.scene.bodies.reduce((most, { radius }) => Math.max(most, radius), 0);
    return { wide: 200 * this.units.length, thick };
  }

  /// A box, a cylinder or a sphere in the surface's own frame.
  #shapeOfSurface({ shape, extent }) {
    const { hp } = this;
    const { wide, thick } = this.#plane();
    switch (shape.kind) {
      case 'plane': return hp.HP_Shape_CreateBox([0, 0, -thick / 2], NO_TURN, [wide, wide, thick]);
      case 'rectangle': return hp.HP_Shape_CreateBox([0, 0, 0], NO_TURN, extent.map((half) => 2 * half));
      case 'rod': return hp.HP_Shape_CreateCylinder([0, 0, -extent[2]], [0, 0, extent[2]], shape.radius);
      default: return hp.HP_Shape_CreateSphere([0, 0, 0], shape.radius);
    }
  }

  #addBeside(surface) {
    const { hp } = this;
    const shapes = this.shapes
      .ofSurface(surface.touch)
      .map((contact) => this.#shape(this.#shapeOfSurface(surface), contact));
    const body = this.#body(shapes, surface.isStill ? hp.MotionType.STATIC : hp.MotionType.KINEMATIC);
    const place = [surface.centre(this.startTime), surface.quaternion(this.startTime)];
    done(hp, hp.HP_Body_SetQTransform(body, place));
    this.#enter(body, surface.touch);
    return { surface, body };
  }

  /// What stays, as a belt does, begins each step where it is.
  #moveBeside(now) {
    const { hp, timeStep } = this;
    const isMean = this.chosen.surface_velocity === 'this_step';
    for (const { surface, body } of this.beside) {
      if (surface.isStill) continue;
      const centre = surface.centre(now);
      done(hp, hp.HP_Body_SetQTransform(body, [centre, surface.quaternion(now)]));
      done(hp, hp.HP_Body_SetLinearVelocity(body, surface.stepVelocity(now, timeStep, centre, isMean)));
      done(hp, hp.HP_Body_SetAngularVelocity(body, surface.rate));
    }
  }

  #moveSubstrate(now) {
    const { hp, substrate, motion } = this;
    const then = now + this.timeStep;
    if (this.chosen.surface_velocity === 'step_end') {
      hp.HP_Body_SetPosition(substrate, motion.position(now));
      hp.HP_Body_SetLinearVelocity(substrate, motion.velocity(then));
    } else {
      hp.HP_Body_SetTargetQTransform(substrate, [motion.position(then), NO_TURN]);
    }
  }

  /// By Havok's events, each with the impulse of a contact in the step; the one that ends a contact
  /// repeats the last.
  #findTouches(touches) {
    const { hp } = this;
    const found = new Touches(this.scene);
    const world = Number(this.world[0]);
    for (
      let event = Number(hp.HP_World_GetCollisionEvents(this.world)[1]);
      event !== 0;
      event = Number(hp.HP_World_GetNextCollisionEvent(world, event))
    ) {
      const [type, one, other, impulse] = made(hp, hp.HP_Event_AsCollision(event));
      if (type === hp.EventType.COLLISION_FINISHED) continue;
      const [a, b] = [one, other].map((point) => this.bodyOf.get(point[0][0]));
      found.add(...(a >= 0 ? [a, b] : [b, a]), impulse);
    }
    found.pushTo(touches, 1 / this.units.impulse);
  }

  #applied(scene, timeStep) {
    const [x, y] = scene.downhill;
    return {
      ...this.chosen,
      ...this.shapes.applied,
      ...this.units.applied(),
      time_step: timeStep,
      gravity: scene.gravity,
      ...(x !== 0 || y !== 0 ? { downhill_x: x, downhill_y: y } : {}),
    };
  }
}

/// Havok has a static friction, but applies it to what slides as well.
const withoutStaticFriction = (scene) => ({
  ...scene,
  substrate: scene.substrate.map(withoutStatic),
  on_surfaces: scene.on_surfaces?.map((each) => ({ ...each, lasting: withoutStatic(each.lasting) })),
});
const withoutStatic = (ground) => ({ ...ground, static_friction: ground.kinetic_friction });

function done(hp, result) {
  if (result !== hp.Result.RESULT_OK) throw new Error('a call of Havok failed');
}

/// What a call gives.
function made(hp, [result, value]) {
  done(hp, result);
  return value;
}
