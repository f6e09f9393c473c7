// Surfaces in PhysX's own API. PhysX has one foundation in a process: that of `engine`.

export async function runSurfaces(engine, { radius, mass, friction, restitution, plate, peg, belt, state }, step, count) {
  const { px, top, physics, threads, tolerances } = engine;
  const vector = (numbers) => new px.PxVec3(...numbers);
  const pose = (place) => new px.PxTransform(vector(place), new px.PxQuat(0, 0, 0, 1));
  const desc = new px.PxSceneDesc(tolerances);
  desc.gravity = vector([0, 0, -9.81]);
  desc.cpuDispatcher = threads;
  desc.filterShader = top.DefaultFilterShader();
  const world = physics.createScene(desc);
  const add = (actor, geometry) => {
    const material = physics.createMaterial(friction, friction, restitution);
    const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE);
    const shape = physics.createShape(geometry, material, true, flags);
    shape.setSimulationFilterData(new px.PxFilterData(1, 1, 0, 0));
    actor.attachShape(shape);
    world.addActor(actor);
  };
  add(physics.createRigidStatic(pose(plate.centre)), new px.PxBoxGeometry(...plate.half));
  add(physics.createRigidStatic(pose(peg.centre)), new px.PxSphereGeometry(peg.radius));
  // A box of 16 radii half thickness, 100 m on each side.
  const thick = 16 * radius;
  const home = pose([0, 0, belt.height - thick]);
  const conveyor = physics.createRigidDynamic(home);
  conveyor.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eKINEMATIC, true);
  add(conveyor, new px.PxBoxGeometry(100, 100, thick));
  const ball = physics.createRigidDynamic(pose(state.slice(0, 3)));
  ball.setMass(mass);
  const inertia = 0.4 * mass * radius * radius;
  ball.setMassSpaceInertiaTensor(vector([inertia, inertia, inertia]));
  ball.setLinearVelocity(vector(state.slice(3, 6)));
  add(ball, new px.PxSphereGeometry(radius));
  const seen = [];
  for (let k = 0; k < count; ++k) {
    conveyor.setGlobalPose(home);
    conveyor.setKinematicTarget(pose([belt.velocity * step, 0, belt.height - thick]));
    world.simulate(step);
    world.fetchResults(true);
    for (const v of [ball.getGlobalPose().p, ball.getLinearVelocity(), ball.getAngularVelocity()]) seen.push(v.x, v.y, v.z);
  }
  world.release();
  return seen;
}
