// Surfaces in a model of MuJoCo's typed by hand.

/// -k d and -b d of a contact that rebounds with e = 0.5: exp(-2 ζ acos ζ/√(1 - ζ²)) = 0.5, with
/// ω = 1/(0.02 √0.95), as stiff as MuJoCo ships.
function rebound(e, dampingRatioOf) {
  const zeta = dampingRatioOf(e);
  const omega = 1 / (Math.sqrt(0.95) * 0.02);
  return `${-0.95 * omega * omega} ${-2 * zeta * omega}`;
}

export async function runSurfaces({ mujoco }, scene, step, count) {
  const { radius, mass, friction, restitution, plate, peg, belt, state } = scene;
  const { dampingRatioOf } = await import('../../kit/contact_spring.mjs');
  const inertia = 0.4 * mass * radius * radius;
  const off = 'contype="0" conaffinity="0"';
  const contact = (name) =>
    `<pair geom1="ball" geom2="${name}" condim="3" friction="${friction} ${friction}" solref="${rebound(restitution, dampingRatioOf)}"/>`;
  const xml =
    `<mujoco><option timestep="${step}" gravity="0 0 -9.81" cone="pyramidal"/><worldbody>` +
    `<geom name="plate" type="box" size="${plate.half.join(' ')}" pos="${plate.centre.join(' ')}" ${off}/>` +
    `<geom name="peg" type="sphere" size="${peg.radius}" pos="${peg.centre.join(' ')}" ${off}/>` +
    `<geom name="belt" type="plane" size="0 0 1" pos="0 0 ${belt.height}" surfacevel="${belt.velocity} 0 0 0 0 0" ${off}/>` +
    `<body pos="${state.slice(0, 3).join(' ')}"><freejoint/><inertial pos="0 0 0" mass="${mass}" diaginertia="${inertia} ${inertia} ${inertia}"/>` +
    `<geom name="ball" type="sphere" size="${radius}" ${off}/></body></worldbody>` +
    `<contact>${['plate', 'peg', 'belt'].map(contact).join('')}</contact></mujoco>`;
  const model = mujoco.MjModel.from_xml_string(xml);
  const data = new mujoco.MjData(model);
  data.qvel.set([...state.slice(3, 6), 0, 0, 0]);
  const seen = [];
  for (let k = 0; k < count; ++k) {
    mujoco.mj_step(model, data);
    const [q0, q1, q2, q3] = data.qpos.subarray(3, 7);
    const [x, y, z] = data.qvel.subarray(3, 6);
    // mju_rotVecQuat
    const [tx, ty, tz] = [q0 * x + q2 * z - q3 * y, q0 * y + q3 * x - q1 * z, q0 * z + q1 * y - q2 * x];
    const spin = [x + 2 * (q2 * tz - q3 * ty), y + 2 * (q3 * tx - q1 * tz), z + 2 * (q1 * ty - q2 * tx)];
    seen.push(...data.qpos.subarray(0, 3), ...data.qvel.subarray(0, 3), ...spin);
  }
  data.delete();
  model.delete();
  return seen;
}
