// How large the scene is: the box of all that moves, and of what stands still.

import * as THREE from 'three';
import { bodyMatrix } from './items.js';

const ROWS = 200; // of the motion that are looked at
const RARE = 0.04; // part of the time that a body may be out of the picture, at either end

// Returns { box, radius, body }: box of the scene [m], half of its diagonal, typical radius of a body.
export function boundsOf(data, motion) {
  const items = data.items.filter((item) => item.body !== null && reach(data, item) < Infinity);
  const rows = motion.end > motion.start ? Math.min(ROWS, motion.t.length) : 1;
  const tracks = tracksOf();
  const box = boxOf(usualOf(tracks), 0);
  const usual = boxOf(usualOf(tracks), RARE);
  // What flies away in the end, or breaks, would make all else small.
  if (diagonal(box) > 1.6 * diagonal(usual)) box.copy(usual);
  if (box.isEmpty()) box.setFromCenterAndSize(new THREE.Vector3(), new THREE.Vector3(1, 1, 1));
  const radii = items.filter((item) => item.body >= 0).map((item) => reach(data, item));
  radii.sort((a, b) => a - b);
  const half = Math.max(diagonal(box) / 2, 1e-3);
  return { box, radius: half, body: radii.length ? radii[radii.length >> 1] : half / 8 };

  // Of each item and each pivot: radius, and its coordinates over time, in order.
  function tracksOf() {
    const found = items.map((item) => ({ radius: reach(data, item), at: [[], [], []] }));
    const pivots = Array.from({ length: motion.bodies }, () => ({ radius: 0, at: [[], [], []] }));
    const p = new THREE.Vector3();
    for (let k = 0; k < rows; k++) {
      motion.set(motion.start + ((motion.end - motion.start) * k) / Math.max(rows - 1, 1));
      items.forEach((item, i) => {
        p.fromArray(item.pose);
        if (item.body >= 0) p.applyMatrix4(bodyMatrix(motion.now, item.body));
        p.toArray().forEach((x, axis) => found[i].at[axis].push(x));
      });
      pivots.forEach(({ at }, body) => {
        for (const axis of [0, 1, 2]) at[axis].push(motion.now[7 * body + axis]);
      });
    }
    const all = [...found, ...pivots];
    for (const { at } of all) at.forEach((xs) => xs.sort((a, b) => a - b));
    return all;
  }
}

// The tracks without those few that go much further than three quarters of all do.
function usualOf(tracks) {
  const centre = [0, 1, 2].map(middle);
  const far = tracks.map(({ radius, at }) =>
    Math.max(...at.map((xs, k) => Math.max(xs.at(-1) - centre[k], centre[k] - xs[0]))) + radius,
  );
  const typical = [...far].sort((a, b) => a - b)[Math.ceil(0.75 * far.length) - 1];
  return tracks.filter((_, i) => far[i] <= 4 * typical);

  // Middle of all, along an axis, where most of their time is spent.
  function middle(k) {
    const middles = tracks.map(({ at }) => at[k][at[k].length >> 1]).sort((a, b) => a - b);
    return middles[middles.length >> 1];
  }
}

function boxOf(tracks, rare) {
  const box = new THREE.Box3();
  for (const { radius, at } of tracks) {
    const end = (part) => at.map((xs) => xs[Math.round(part * (xs.length - 1))]);
    box.expandByPoint(new THREE.Vector3(...end(rare)).addScalar(-radius));
    box.expandByPoint(new THREE.Vector3(...end(1 - rare)).addScalar(radius));
  }
  return box;
}

const diagonal = (box) => (box.isEmpty() ? 0 : box.getSize(new THREE.Vector3()).length());

// Largest distance of an item's points from its frame's origin [m].
function reach(data, item) {
  const geometry = data.geometries[item.geometry];
  const [x, y, z] = item.scale;
  switch (geometry.type) {
    case 'plane':
      return Infinity;
    case 'sphere':
      return Math.max(x, y, z);
    case 'cylinder':
      return Math.hypot(x, z);
    case 'capsule':
      return geometry.radius + geometry.half_length;
    case 'box':
      return Math.hypot(x, y, z);
    default: {
      let most = 0;
      const v = geometry.vertices;
      for (let k = 0; k < v.length; k += 3) {
        most = Math.max(most, Math.hypot(v[k] * x, v[k + 1] * y, v[k + 2] * z));
      }
      return most;
    }
  }
}
