// The three scenes in cannon-es's own API. Its limit of friction is an impulse μ m g in each step,
// and its spheres have the inertia of cubes; both are put right as somebody does who knows.

export async function run(CANNON, { radius, mass, friction, restitution, pair, states }, step, count) {
  const world = new CANNON.World({ gravity: new CANNON.Vec3(0, 0, -9.81) });
  const steel = new CANNON.Material();
  const floor = new CANNON.Material();
  world.addContactMaterial(new CANNON.ContactMaterial(steel, floor, { friction: friction * step, restitution }));
  if (pair !== undefined)
    world.addContactMaterial(new CANNON.ContactMaterial(steel, steel, { friction: 0, restitution: pair }));
  world.addBody(new CANNON.Body({ mass: 0, shape: new CANNON.Plane(), material: floor }));
  const balls = states.map(([x, y, z, vx, vy, vz, wx, wy, wz]) => {
    const body = new CANNON.Body({ mass, shape: new CANNON.Sphere(radius), material: steel });
    const inertia = 0.4 * mass * radius * radius;
    body.inertia.set(inertia, inertia, inertia);
    body.invInertia.set(1 / inertia, 1 / inertia, 1 / inertia);
    body.updateInertiaWorld(true);
    body.position.set(x, y, z);
    body.velocity.set(vx, vy, vz);
    body.angularVelocity.set(wx, wy, wz);
    world.addBody(body);
    return body;
  });
  const seen = [];
  for (let k = 0; k < count; ++k) {
    world.step(step);
    for (const { position, velocity, angularVelocity } of balls)
      for (const v of [position, velocity, angularVelocity]) seen.push(v.x, v.y, v.z);
  }
  return seen;
}
