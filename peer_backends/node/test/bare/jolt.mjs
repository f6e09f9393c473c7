// The three scenes in Jolt's own API, as somebody writes them who never saw the adapter.

/// A world with gravity in which everything meets everything.
function worldOf(Jolt) {
  const settings = new Jolt.JoltSettings();
  const filter = new Jolt.ObjectLayerPairFilterTable(1);
  filter.EnableCollision(0, 0);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = filter;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, filter, 1);
  const jolt = new Jolt.JoltInterface(settings);
  jolt.GetPhysicsSystem().SetGravity(new Jolt.Vec3(0, 0, -9.81));
  return jolt;
}

/// A function that adds a body whose settings `change` completes, and returns it.
function adderTo(Jolt, bodies) {
  return (shape, [x, y, z], motion, change = () => {}) => {
    const creation = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(x, y, z), new Jolt.Quat(0, 0, 0, 1), motion, 0);
    change(creation);
    const body = bodies.CreateBody(creation);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    return body;
  };
}

/// Gives a ball its mass, a solid sphere's inertia and how it begins.
function begin(Jolt, creation, mass, [, , , vx, vy, vz, wx, wy, wz]) {
  creation.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
  creation.mMassPropertiesOverride.mMass = mass;
  creation.mLinearVelocity = new Jolt.Vec3(vx, vy, vz);
  creation.mAngularVelocity = new Jolt.Vec3(wx, wy, wz);
}

/// Place, velocity and angular velocity of each body after each of so many steps, one list.
function course(jolt, balls, step, count) {
  const seen = [];
  for (let k = 0; k < count; ++k) {
    jolt.Step(step, 1);
    for (const body of balls)
      for (const part of ['GetPosition', 'GetLinearVelocity', 'GetAngularVelocity']) {
        const v = body[part]();
        seen.push(v.GetX(), v.GetY(), v.GetZ());
      }
  }
  return seen;
}

export async function run(start, { radius, mass, friction, restitution, pair, states }, step, count) {
  const Jolt = await start();
  const jolt = worldOf(Jolt);
  const system = jolt.GetPhysicsSystem();
  const add = adderTo(Jolt, system.GetBodyInterface());
  const plane = new Jolt.PlaneShape(new Jolt.Plane(new Jolt.Vec3(0, 0, 1), 0));
  const rough = (creation) => {
    creation.mFriction = friction;
    creation.mRestitution = restitution;
  };
  const ground = add(plane, [0, 0, 0], Jolt.EMotionType_Static, rough);
  const balls = states.map((state) =>
    add(new Jolt.SphereShape(radius), state, Jolt.EMotionType_Dynamic, (creation) => {
      rough(creation);
      begin(Jolt, creation, mass, state);
    }));
  if (pair !== undefined) listen(Jolt, system, ground, friction, pair);
  return course(jolt, balls, step, count);
}

/// Calls `meet` for each contact, new and old, before the solver takes it.
function onContacts(Jolt, system, meet) {
  const listener = new Jolt.ContactListenerJS();
  listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
  listener.OnContactAdded = meet;
  listener.OnContactPersisted = meet;
  listener.OnContactRemoved = () => {};
  system.SetContactListener(listener);
}

/// Balls that have friction with the ground and restitution with each other.
function listen(Jolt, system, ground, friction, restitution) {
  const meet = (a, b, manifold, pointer) => {
    const onGround = [a, b].includes(Jolt.getPointer(ground));
    const contact = Jolt.wrapPointer(pointer, Jolt.ContactSettings);
    contact.mCombinedFriction = onGround ? friction : 0;
    contact.mCombinedRestitution = onGround ? 0 : restitution;
  };
  onContacts(Jolt, system, meet);
}

/// A plate, a peg and a belt, whose surface alone moves.
export async function runSurfaces(start, { radius, mass, friction, restitution, plate, peg, belt, state }, step, count) {
  const Jolt = await start();
  const jolt = worldOf(Jolt);
  const system = jolt.GetPhysicsSystem();
  const add = adderTo(Jolt, system.GetBodyInterface());
  add(new Jolt.BoxShape(new Jolt.Vec3(...plate.half), 0), plate.centre, Jolt.EMotionType_Static);
  add(new Jolt.SphereShape(peg.radius), peg.centre, Jolt.EMotionType_Static);
  const plane = new Jolt.PlaneShape(new Jolt.Plane(new Jolt.Vec3(0, 0, 1), 0));
  const conveyor = add(plane, [0, 0, belt.height], Jolt.EMotionType_Static);
  const ball = add(new Jolt.SphereShape(radius), state, Jolt.EMotionType_Dynamic,
    (creation) => begin(Jolt, creation, mass, state));
  const meet = (a, b, manifold, pointer) => {
    const contact = Jolt.wrapPointer(pointer, Jolt.ContactSettings);
    contact.mCombinedFriction = friction;
    contact.mCombinedRestitution = restitution;
    // Of the second body relative to the first, and the ball is the one that moves.
    const side = a === Jolt.getPointer(conveyor) ? -1 : b === Jolt.getPointer(conveyor) ? 1 : 0;
    if (side !== 0) contact.mRelativeLinearSurfaceVelocity = new Jolt.Vec3(side * belt.velocity, 0, 0);
  };
  onContacts(Jolt, system, meet);
  return course(jolt, [ball], step, count);
}
