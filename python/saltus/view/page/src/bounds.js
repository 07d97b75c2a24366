// How large the scene is: the box of all that moves, and of what stands still.

import * as THREE from 'three';
import { bodyMatrix, matrixOf } from './items.js';

const ROWS = 200; // of the motion that are looked at
const LEAST = 1e-9; // m; what is smaller is a point
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
  const half = diagonal(box) > LEAST ? diagonal(box) / 2 : 0.5;
  return { box, radius: half, body: radii.length ? radii[radii.length >> 1] : half / 8 };

  // Of each item, pivot and thread: least and greatest coordinates over time, in order.
  function tracksOf() {
    const track = () => ({ low: [[], [], []], high: [[], [], []] });
    const found = items.map(track);
    const pivots = Array.from({ length: motion.bodies }, track);
    const threads = Array.from({ length: data.threads.length / 7 }, track);
    for (let k = 0; k < rows; k++) {
      motion.set(motion.start + ((motion.end - motion.start) * k) / Math.max(rows - 1, 1));
      items.forEach((item, i) => push(found[i], extent(data, item, motion.now)));
      pivots.forEach((pivot, body) => {
        const p = new THREE.Vector3().fromArray(motion.now, 7 * body);
        push(pivot, new THREE.Box3(p, p));
      });
      threadEnds(data, motion.now).forEach((p, i) => push(threads[i], new THREE.Box3(p, p)));
    }
    const all = [...found, ...pivots, ...threads];
    for (const { low, high } of all) [...low, ...high].forEach((xs) => xs.sort((a, b) => a - b));
    return all;
  }
}

// The box of all that moves, in these poses of the bodies.
export function boxNow(data, poses) {
  const box = new THREE.Box3();
  for (const item of data.items) if (item.body >= 0) box.union(extent(data, item, poses));
  threadEnds(data, poses).forEach((p) => box.expandByPoint(p));
  return box;
}

// Where threads end: without shapes they are what is seen.
function threadEnds({ threads }, poses) {
  const ends = [];
  for (let k = 0; k < threads.length; k += 7) {
    ends.push(new THREE.Vector3().fromArray(threads, k + 4).applyMatrix4(bodyMatrix(poses, threads[k])));
  }
  return ends;
}

// The box about an item.
function extent(data, item, poses) {
  const X = matrixOf(item.pose, [1, 1, 1]);
  if (item.body >= 0) X.premultiply(bodyMatrix(poses, item.body));
  const box = localBox(data, item);
  if (data.geometries[item.geometry].type !== 'sphere') return box.applyMatrix4(X);
  const half = box.max.clone(); // of an ellipsoid |R half|, row by row
  const e = X.elements;
  const wide = [0, 1, 2].map((k) => Math.hypot(e[k] * half.x, e[4 + k] * half.y, e[8 + k] * half.z));
  const size = new THREE.Vector3(...wide).multiplyScalar(2);
  return new THREE.Box3().setFromCenterAndSize(new THREE.Vector3().setFromMatrixPosition(X), size);
}

function push({ low, high }, box) {
  box.min.toArray().forEach((x, axis) => low[axis].push(x));
  box.max.toArray().forEach((x, axis) => high[axis].push(x));
}

// The tracks without those few that go much further than three quarters of all do.
function usualOf(tracks) {
  const centre = [0, 1, 2].map(middle);
  const far = tracks.map(({ low, high }) =>
    Math.max(...[0, 1, 2].map((k) => Math.max(high[k].at(-1) - centre[k], centre[k] - low[k][0]))),
  );
  const typical = [...far].sort((a, b) => a - b)[Math.ceil(0.75 * far.length) - 1];
  return tracks.filter((_, i) => far[i] <= 4 * typical);

  // Middle of all, along an axis, where most of their time is spent.
  function middle(k) {
    const middles = tracks.map(({ low }) => low[k][low[k].length >> 1]).sort((a, b) => a - b);
    return middles[middles.length >> 1];
  }
}

function boxOf(tracks, rare) {
  const box = new THREE.Box3();
  for (const { low, high } of tracks) {
    const end = (part, all) => all.map((xs) => xs[Math.round(part * (xs.length - 1))]);
    box.expandByPoint(new THREE.Vector3(...end(rare, low)));
    box.expandByPoint(new THREE.Vector3(...end(1 - rare, high)));
  }
  return box;
}

const diagonal = (box) => (box.isEmpty() ? 0 : box.getSize(new THREE.Vector3()).length());

// Largest distance of an item's points from its frame's origin [m].
function reach(data, item) {
  const { type } = data.geometries[item.geometry];
  if (type === 'plane') return Infinity;
  if (type === 'sphere') return Math.max(...item.scale);
  const { min, max } = localBox(data, item);
  return Math.max(min.length(), max.length());
}

// The box of an item in its own frame.
function localBox(data, item) {
  const geometry = data.geometries[item.geometry];
  const scale = new THREE.Vector3().fromArray(item.scale);
  if (geometry.type === 'mesh') {
    geometry.box ??= new THREE.Box3().setFromArray(geometry.vertices);
    return new THREE.Box3(geometry.box.min.clone().multiply(scale), geometry.box.max.clone().multiply(scale));
  }
  const { radius, half_length: half } = geometry;
  const size = geometry.type === 'capsule' ? new THREE.Vector3(radius, radius, radius + half) : scale;
  return new THREE.Box3(size.clone().negate(), size.clone());
}
