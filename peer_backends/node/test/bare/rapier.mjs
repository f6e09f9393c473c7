// The three scenes in Rapier's own API, as somebody writes them who never saw the adapter.

export async function run(RAPIER, { radius, mass, friction, restitution, pair, states }, step, count) {
  await RAPIER.init();
  const world = new RAPIER.World({ x: 0, y: 0, z: -9.81 });
  world.timestep = step;
  const ground = world.createRigidBody(RAPIER.RigidBodyDesc.fixed());
  const plane = new RAPIER.ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 0, z: 1 }))
    .setFriction(friction).setRestitution(restitution);
  if (pair !== undefined)
    plane.setFrictionCombineRule(RAPIER.CoefficientCombineRule.Max)
      .setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Min);
  world.createCollider(plane, ground);
  const balls = states.map(([x, y, z, vx, vy, vz, wx, wy, wz]) => {
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(x, y, z)
      .setLinvel(vx, vy, vz).setAngvel({ x: wx, y: wy, z: wz }));
    world.createCollider(RAPIER.ColliderDesc.ball(radius).setMass(mass)
      .setFriction(pair === undefined ? friction : 0)
      .setRestitution(pair ?? restitution), body);
    return body;
  });
  const seen = [];
  for (let k = 0; k < count; ++k) {
    world.step();
    for (const body of balls)
      for (const v of [body.translation(), body.linvel(), body.angvel()]) seen.push(v.x, v.y, v.z);
  }
  return seen;
}

/// A plate, a peg and a belt: a body that moves on and is put back before each step.
export async function runSurfaces(RAPIER, { radius, mass, friction, restitution, plate, peg, belt, state }, step, count) {
  await RAPIER.init();
  const world = new RAPIER.World({ x: 0, y: 0, z: -9.81 });
  world.timestep = step;
  const { RigidBodyDesc, ColliderDesc } = RAPIER;
  const add = (body, shape) =>
    world.createCollider(shape.setFriction(friction).setRestitution(restitution), body);
  add(world.createRigidBody(RigidBodyDesc.fixed().setTranslation(...plate.centre)), ColliderDesc.cuboid(...plate.half));
  add(world.createRigidBody(RigidBodyDesc.fixed().setTranslation(...peg.centre)), ColliderDesc.ball(peg.radius));
  const home = { x: 0, y: 0, z: belt.height };
  const conveyor = world.createRigidBody(RigidBodyDesc.kinematicPositionBased().setTranslation(0, 0, belt.height));
  add(conveyor, new ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 0, z: 1 })));
  const [x, y, z, vx, vy, vz] = state;
  const ball = world.createRigidBody(RigidBodyDesc.dynamic().setTranslation(x, y, z).setLinvel(vx, vy, vz));
  add(ball, ColliderDesc.ball(radius).setMass(mass));
  const seen = [];
  for (let k = 0; k < count; ++k) {
    conveyor.setTranslation(home, true);
    conveyor.setNextKinematicTranslation({ ...home, x: belt.velocity * step });
    world.step();
    for (const v of [ball.translation(), ball.linvel(), ball.angvel()]) seen.push(v.x, v.y, v.z);
  }
  return seen;
}
