// The three scenes in Jolt's own API, as somebody writes them who never saw the adapter.

export async function run(start, { radius, mass, friction, restitution, pair, states }, step, count) {
  const Jolt = await start();
  const settings = new Jolt.JoltSettings();
  const filter = new Jolt.ObjectLayerPairFilterTable(1);
  filter.EnableCollision(0, 0);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = filter;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, filter, 1);
  const jolt = new Jolt.JoltInterface(settings);
  const system = jolt.GetPhysicsSystem();
  system.SetGravity(new Jolt.Vec3(0, 0, -9.81));
  const bodies = system.GetBodyInterface();
  const add = (shape, [x, y, z], motion, change) => {
    const creation = new Jolt.BodyCreationSettings(shape, new Jolt.RVec3(x, y, z), new Jolt.Quat(0, 0, 0, 1), motion, 0);
    creation.mFriction = friction;
    creation.mRestitution = restitution;
    change(creation);
    const body = bodies.CreateBody(creation);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    return body;
  };
  const plane = new Jolt.PlaneShape(new Jolt.Plane(new Jolt.Vec3(0, 0, 1), 0));
  const ground = add(plane, [0, 0, 0], Jolt.EMotionType_Static, () => {});
  const balls = states.map(([x, y, z, vx, vy, vz, wx, wy, wz]) =>
    add(new Jolt.SphereShape(radius), [x, y, z], Jolt.EMotionType_Dynamic, (creation) => {
      creation.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
      creation.mMassPropertiesOverride.mMass = mass;
      creation.mLinearVelocity = new Jolt.Vec3(vx, vy, vz);
      creation.mAngularVelocity = new Jolt.Vec3(wx, wy, wz);
    }));
  if (pair !== undefined) listen(Jolt, system, ground, friction, pair);
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

/// Balls that have friction with the ground and restitution with each other.
function listen(Jolt, system, ground, friction, restitution) {
  const listener = new Jolt.ContactListenerJS();
  const meet = (a, b, manifold, pointer) => {
    const onGround = [a, b].includes(Jolt.getPointer(ground));
    const contact = Jolt.wrapPointer(pointer, Jolt.ContactSettings);
    contact.mCombinedFriction = onGround ? friction : 0;
    contact.mCombinedRestitution = onGround ? 0 : restitution;
  };
  listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
  listener.OnContactAdded = meet;
  listener.OnContactPersisted = meet;
  listener.OnContactRemoved = () => {};
  system.SetContactListener(listener);
}
