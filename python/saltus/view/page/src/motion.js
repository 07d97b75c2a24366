// Poses of all bodies at any time, between the instants that the run recorded.

import { isLarge, turnFrom, turned } from './turn.js';

export const NUMBERS = 7; // position, quaternion x y z w

// Index i with t[i] <= time < t[i + 1], held within the array.
export function rowAt(t, time) {
  let low = 0;
  let high = t.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (t[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

export class Motion {
  // Positions and small turns follow cubics, which have no corner but at impacts.
  constructor(t, poses, bodies, kinks) {
    this.t = t;
    this.poses = poses;
    this.bodies = bodies;
    this.kink = new Uint8Array(t.length);
    for (const i of kinks) this.kink[i] = 1;
    this.kink[0] = 1;
    this.kink[t.length - 1] = 1;
    this.now = new Float64Array(bodies * NUMBERS);
    this.work = Array.from({ length: 6 }, () => new Float64Array(3));
  }

  get start() {
    return this.t[0];
  }

  get end() {
    return this.t[this.t.length - 1];
  }

  // Writes the poses at a time to `now`.
  set(time) {
    const { t, poses, bodies, now } = this;
    const width = bodies * NUMBERS;
    const i = rowAt(t, time);
    const h = i + 1 < t.length ? t[i + 1] - t[i] : 0;
    const s = h > 0 ? Math.min(Math.max((time - t[i]) / h, 0), 1) : 0;
    if (s === 0) {
      now.set(poses.subarray(i * width, (i + 1) * width));
      return;
    }
    const left = this.neighbours(i, 1, width);
    const right = this.neighbours(i + 1, -1, width);
    for (let body = 0; body < bodies; body++) {
      const at = body * NUMBERS;
      this.move(i * width + at, width, s, h, left, right, at);
      this.turn(i * width + at + 3, width, s, h, left, right, at + 3);
    }
  }

  // The instants on whose parabola the velocity at instant i is, of the arc in this direction
  // (1: after it, -1: before it): times from it, and where their poses are from its own.
  neighbours(i, direction, width) {
    const { t, kink } = this;
    const other = kink[i] ? i + 2 * direction : i - direction;
    const inside = other >= 0 && other < t.length && !(kink[i] && kink[i + direction]);
    const near = t[i + direction] - t[i];
    const far = inside ? t[other] - t[i] : 0;
    const both = far !== 0 && far !== near;
    return { near, toNear: direction * width, far: both ? far : 0, toFar: (other - i) * width };
  }

  move(a, width, s, h, left, right, at) {
    const { poses, now } = this;
    const b = a + width;
    for (let k = 0; k < 3; k++) {
      const [from, to] = [poses[a + k], poses[b + k]];
      const before = slope(poses[a + left.toNear + k] - from, far(poses, a + k, left), left);
      const after = slope(poses[b + right.toNear + k] - to, far(poses, b + k, right), right);
      now[at + k] = from + cubic(to - from, h * before, h * after, s);
    }
  }

  turn(a, width, s, h, left, right, at) {
    const { poses, now } = this;
    const [whole, back, before, after, result] = this.work;
    turnFrom(poses, a, a + width, whole);
    const even = isLarge(whole);
    if (!even) {
      // Rotation vectors from either end are those of one curve but for their products, which
      // are small of second order.
      turnFrom(poses, a + width, a, back);
      if (left.far) turnFrom(poses, a, a + left.toFar, before);
      if (right.far) turnFrom(poses, a + width, a + width + right.toFar, after);
    }
    for (let k = 0; k < 3; k++) {
      result[k] = even
        ? s * whole[k]
        : cubic(whole[k], h * slope(whole[k], before[k], left), h * slope(back[k], after[k], right), s);
    }
    turned(poses, a, result, now, at);
  }
}

const far = (poses, at, { far, toFar }) => (far ? poses[at + toFar] - poses[at] : 0);

// Velocity at 0 of the parabola through 0 and two other points, or of the line through one.
function slope(near, far, times) {
  if (!times.far) return near / times.near;
  const [v, w] = [near / times.near, far / times.far];
  return (v * times.far - w * times.near) / (times.far - times.near);
}

// The cubic from 0 to `whole` with these tangents at its ends.
function cubic(whole, before, after, s) {
  const s2 = s * s;
  const s3 = s2 * s;
  return whole * (3 * s2 - 2 * s3) + before * (s3 - 2 * s2 + s) + after * (s3 - s2);
}
