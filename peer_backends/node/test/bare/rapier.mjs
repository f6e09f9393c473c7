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
