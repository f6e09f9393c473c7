// Blocks and cylinders beside spheres. Quaternions are [x, y, z, w].

export const isSphere = ({ shape }) => shape === undefined || shape === 'sphere';
export const isBlock = ({ shape }) => shape === 'block';

/// From a body's own axes to the scene's: x is turned to its axis.
export function turnOf({ axis: [x, y] }) {
  const half = Math.atan2(y, x) / 2;
  return [0, 0, Math.sin(half), Math.cos(half)];
}

const HALF = Math.SQRT1_2;
/// The same of a cylinder that an engine lays along y, or along z.
export const turnFromY = (body) => product(turnOf(body), [0, 0, -HALF, HALF]);
export const turnFromZ = (body) => product(turnOf(body), [0, HALF, 0, HALF]);

function product([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

/// Moments of inertia about a body's own axes.
export function inertiaOf(body) {
  const { mass, radius, shape_factor, size } = body;
  const own = shape_factor * mass * radius * radius;
  if (isSphere(body)) return [own, own, own];
  const [x, y, z] = size.map((length) => length * length);
  if (isBlock(body)) return [y + z, x + z, x + y].map((sum) => (mass / 12) * sum);
  const across = mass * (y / 16 + x / 12);
  return [own, across, across];
}

/// `half` of each edge of a block, or of a cylinder the half of its length and its radius.
export const halfOf = ({ size }) => size.map((length) => length / 2);
