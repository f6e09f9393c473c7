// Surfaces in Havok's own API.

export async function runSurfaces({ hp }, { radius, mass, friction, restitution, plate, peg, belt, state }, step, count) {
  const value = ([result, made]) => {
    if (result !== hp.Result.RESULT_OK) throw new Error('a call of Havok failed');
    return made;
  };
  const world = value(hp.HP_World_Create());
  hp.HP_World_SetGravity(world, [0, 0, -9.81]);
  const { MINIMUM } = hp.MaterialCombine;
  const add = (shape, place, motion, ready = () => {}) => {
    hp.HP_Shape_SetMaterial(shape, [friction, friction, restitution, MINIMUM, MINIMUM]);
    const body = value(hp.HP_Body_Create());
    hp.HP_Body_SetShape(body, shape);
    hp.HP_Body_SetMotionType(body, motion);
    ready(body);
    hp.HP_Body_SetPosition(body, place);
    hp.HP_World_AddBody(world, body, false);
    return body;
  };
  const { STATIC, KINEMATIC, DYNAMIC } = hp.MotionType;
  const still = [0, 0, 0, 1];
  add(value(hp.HP_Shape_CreateBox([0, 0, 0], still, plate.half.map((half) => 2 * half))), plate.centre, STATIC);
  add(value(hp.HP_Shape_CreateSphere([0, 0, 0], peg.radius)), peg.centre, STATIC);
  // A box 32 radii thick, of 200 m.
  const thick = 32 * radius;
  const home = [0, 0, belt.height];
  const conveyor = add(value(hp.HP_Shape_CreateBox([0, 0, -thick / 2], still, [200, 200, thick])), home, KINEMATIC);
  const inertia = 0.4 * radius * radius; // of a mass of 1
  const ball = add(value(hp.HP_Shape_CreateSphere([0, 0, 0], radius)), state.slice(0, 3), DYNAMIC, (body) =>
    hp.HP_Body_SetMassProperties(body, [[0, 0, 0], mass, [inertia, inertia, inertia], still]));
  hp.HP_Body_SetLinearVelocity(ball, state.slice(3, 6));
  const seen = [];
  for (let k = 0; k < count; ++k) {
    hp.HP_Body_SetPosition(conveyor, home);
    hp.HP_Body_SetLinearVelocity(conveyor, [belt.velocity, 0, 0]);
    hp.HP_World_Step(world, step);
    seen.push(...value(hp.HP_Body_GetPosition(ball)), ...value(hp.HP_Body_GetLinearVelocity(ball)),
      ...value(hp.HP_Body_GetAngularVelocity(ball)));
  }
  hp.HP_World_Release(world);
  return seen;
}
