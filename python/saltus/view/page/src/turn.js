// Orientations between instants, as unit quaternions x y z w.

const LARGE = 0.5; // rad between instants; above it turns are even, about one axis

// Rotation vector of conj(a) b: how b is turned as seen from a, the short way.
export function turnFrom(q, a, b, out) {
  const [ax, ay, az, aw] = [q[a], q[a + 1], q[a + 2], q[a + 3]];
  const [bx, by, bz, bw] = [q[b], q[b + 1], q[b + 2], q[b + 3]];
  let w = aw * bw + ax * bx + ay * by + az * bz;
  let x = aw * bx - ax * bw - ay * bz + az * by;
  let y = aw * by + ax * bz - ay * bw - az * bx;
  let z = aw * bz - ax * by + ay * bx - az * bw;
  if (w < 0) [w, x, y, z] = [-w, -x, -y, -z]; // a quaternion and its negative are one orientation
  const sine = Math.hypot(x, y, z);
  const scale = sine > 1e-9 ? (2 * Math.atan2(sine, w)) / sine : 2;
  out[0] = scale * x;
  out[1] = scale * y;
  out[2] = scale * z;
  return out;
}

// Writes q[a] turned by a rotation vector in its own axes.
export function turned(q, a, r, out, at) {
  const angle = Math.hypot(r[0], r[1], r[2]);
  const scale = angle > 1e-9 ? Math.sin(angle / 2) / angle : 0.5;
  const [ax, ay, az, aw] = [q[a], q[a + 1], q[a + 2], q[a + 3]];
  const [x, y, z, w] = [scale * r[0], scale * r[1], scale * r[2], Math.cos(angle / 2)];
  out[at] = aw * x + ax * w + ay * z - az * y;
  out[at + 1] = aw * y - ax * z + ay * w + az * x;
  out[at + 2] = aw * z + ax * y - ay * x + az * w;
  out[at + 3] = aw * w - ax * x - ay * y - az * z;
  const length = Math.hypot(out[at], out[at + 1], out[at + 2], out[at + 3]);
  for (let k = 0; k < 4; k++) out[at + k] /= length;
}

export const isLarge = (r) => r[0] * r[0] + r[1] * r[1] + r[2] * r[2] > LARGE * LARGE;
