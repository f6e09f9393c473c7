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

/// A plate, a peg and a belt: a body that moves on and is put back before each step.
export async function runSurfaces(CANNON, { radius, mass, friction, restitution, plate, peg, belt, state }, step, count) {
  const world = new CANNON.World({ gravity: new CANNON.Vec3(0, 0, -9.81) });
  const steel = new CANNON.Material();
  const wood = new CANNON.Material();
  world.addContactMaterial(new CANNON.ContactMaterial(steel, wood, { friction: friction * step, restitution }));
  const add = (shape, [x, y, z], type) => {
    const body = new CANNON.Body({ mass: 0, type, shape, material: wood, position: new CANNON.Vec3(x, y, z) });
    world.addBody(body);
    return body;
  };
  add(new CANNON.Box(new CANNON.Vec3(...plate.half)), plate.centre, CANNON.Body.STATIC);
  add(new CANNON.Sphere(peg.radius), peg.centre, CANNON.Body.STATIC);
  const conveyor = add(new CANNON.Plane(), [0, 0, belt.height], CANNON.Body.KINEMATIC);
  conveyor.velocity.set(belt.velocity, 0, 0);
  const ball = new CANNON.Body({ mass, shape: new CANNON.Sphere(radius), material: steel });
  const inertia = 0.4 * mass * radius * radius;
  ball.inertia.set(inertia, inertia, inertia);
  ball.invInertia.set(1 / inertia, 1 / inertia, 1 / inertia);
  ball.updateInertiaWorld(true);
  ball.position.set(...state.slice(0, 3));
  ball.velocity.set(...state.slice(3, 6));
  world.addBody(ball);
  const seen = [];
  for (let k = 0; k < count; ++k) {
    conveyor.position.set(0, 0, belt.height);
    world.step(step);
    for (const v of [ball.position, ball.velocity, ball.angularVelocity]) seen.push(v.x, v.y, v.z);
  }
  return seen;
}
