// Arrows of impulses, of the forces of held contacts, and normals, at the instant they act.

import * as THREE from 'three';
import { ARROWS } from './colours.js';
import { rowAt } from './motion.js';

const MOST = 4000; // arrows drawn at once
const SEEN = 0.15; // s of the clock on the wall that an impact's arrows stay
const Z = new THREE.Vector3(0, 0, 1);

// Instanced shafts and heads, drawn over everything: contacts lie between bodies.
class Quiver {
  constructor(colour, most, thick) {
    const material = () =>
      new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    const shaft = new THREE.CylinderGeometry(1, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const head = new THREE.ConeGeometry(1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.shafts = new THREE.InstancedMesh(shaft, material(), Math.max(most, 1));
    this.heads = new THREE.InstancedMesh(head, material(), Math.max(most, 1));
    this.group = new THREE.Group();
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = 0;
      mesh.frustumCulled = false;
      mesh.renderOrder = 10;
      this.group.add(mesh);
    }
    this.most = most;
    this.thick = thick;
  }

  // arrows: [{ at: Vector3, along: Vector3 (with its length), head: bool }]
  set(arrows) {
    const X = new THREE.Matrix4();
    const count = Math.min(arrows.length, this.most);
    let heads = 0;
    for (let i = 0; i < count; i++) {
      const { at, along, head } = arrows[i];
      const length = along.length();
      const turned = new THREE.Quaternion().setFromUnitVectors(Z, along.clone().normalize());
      const thick = this.thick * (head ? 1 : 0.5);
      const tip = head ? Math.min(0.4 * length, 5 * thick) : 0;
      X.compose(at, turned, new THREE.Vector3(thick, thick, Math.max(length - tip, 1e-12)));
      this.shafts.setMatrixAt(i, X);
      if (!head) continue;
      const base = at.clone().addScaledVector(along, 1 - tip / length);
      X.compose(base, turned, new THREE.Vector3(2.4 * thick, 2.4 * thick, tip));
      this.heads.setMatrixAt(heads++, X);
    }
    this.shafts.count = count;
    this.heads.count = heads;
    this.shafts.instanceMatrix.needsUpdate = true;
    this.heads.instanceMatrix.needsUpdate = true;
  }
}

export class Arrows {
  constructor(data, size) {
    this.data = data;
    this.size = size; // m of the longest arrow
    const thick = 0.035 * size;
    const live = data.mode === 'live' ? 400 : 0;
    const impulses = Math.max(Math.min(2 * data.impulses.lambda.length, MOST), live);
    const held = data.forces ? Math.min(longestGroup(data.forces.first), MOST) : 0;
    this.impulse = new Quiver(ARROWS.impulse, impulses, thick);
    this.force = new Quiver(ARROWS.force, Math.max(held, live), thick);
    this.normal = new Quiver(ARROWS.normal, impulses, thick);
    this.group = new THREE.Group();
    this.group.add(this.normal.group, this.force.group, this.impulse.group);
    this.largest = { impulse: largest(data.impulses.vector), force: largest(data.forces?.vector) };
    this.shown = { impulse: true, force: true, normal: true };
    this.now = []; // what is drawn, for whoever asks
  }

  // Impacts whose arrows are seen at a time: those at it, and those just before while it plays.
  impactsAt(time, speed) {
    const { t } = this.data.impacts;
    if (!t.length) return [];
    const found = [];
    const exact = 1e-9 * Math.max(1, Math.abs(time));
    for (let i = rowAt(t, time + exact); i >= 0; i--) {
      if (t[i] > time + exact) continue;
      if (t[i] < time - SEEN * speed - exact) break;
      found.push(i);
    }
    return found.reverse();
  }

  place(time, speed) {
    this.now = [];
    const normals = [];
    const impulses = [];
    for (const i of this.impactsAt(time, speed)) this.addImpact(i, impulses, normals);
    const forces = this.data.forces ? this.heldAt(time) : [];
    this.impulse.set(this.shown.impulse ? impulses : []);
    this.normal.set(this.shown.normal ? normals : []);
    this.force.set(this.shown.force ? forces : []);
  }

  // Arrows that a program gives, in place of those of a run.
  given(impulses, forces) {
    this.now = [...impulses, ...forces];
    for (const { kind, vector } of this.now) {
      this.largest[kind] = Math.max(this.largest[kind], Math.hypot(...vector));
    }
    const arrow = ({ kind, point, vector }) => ({
      at: new THREE.Vector3(...point),
      along: new THREE.Vector3(...vector).multiplyScalar(this.size / (this.largest[kind] || 1)),
      head: true,
    });
    const seen = ({ vector }) => vector.some((x) => x !== 0);
    this.impulse.set(this.shown.impulse ? impulses.filter(seen).map(arrow) : []);
    this.force.set(this.shown.force ? forces.filter(seen).map(arrow) : []);
  }

  addImpact(i, impulses, normals) {
    const { impacts, impulses: own } = this.data;
    const scale = this.size / (this.largest.impulse || 1);
    for (let k = impacts.first[i]; k < impacts.first[i + 1]; k++) {
      const at = new THREE.Vector3().fromArray(own.point, 3 * k);
      const vector = new THREE.Vector3().fromArray(own.vector, 3 * k);
      if (!Number.isFinite(at.x) || vector.lengthSq() === 0) continue; // older files have no points
      this.now.push({
        kind: 'impulse', pair: own.pairs[own.pair[k]], point: at.toArray(), vector: vector.toArray(),
      });
      const along = vector.clone().multiplyScalar(scale);
      impulses.push({ at, along, head: true }, { at, along: along.clone().negate(), head: true });
      const normal = new THREE.Vector3().fromArray(own.normal, 3 * k).multiplyScalar(0.45 * this.size);
      normals.push({ at: at.clone().sub(normal), along: normal.clone().multiplyScalar(2), head: false });
    }
  }

  heldAt(time) {
    const { t, first, point, vector, pairs, pair } = this.data.forces;
    const scale = this.size / (this.largest.force || 1);
    // Forces of a row acted over the step that ends there.
    let row = rowAt(t, time);
    if (t[row] < time && row + 1 < t.length) row++;
    const found = [];
    for (let k = first[row]; k < first[row + 1]; k++) {
      const at = new THREE.Vector3().fromArray(point, 3 * k);
      const force = new THREE.Vector3().fromArray(vector, 3 * k);
      if (force.lengthSq() === 0) continue;
      this.now.push({
        kind: 'force', pair: pairs[pair[k]], point: at.toArray(), vector: force.toArray(),
      });
      found.push({ at, along: force.multiplyScalar(scale), head: true });
    }
    return found;
  }
}

function largest(vectors) {
  let most = 0;
  for (let k = 0; vectors && k < vectors.length; k += 3) {
    const size = Math.hypot(vectors[k], vectors[k + 1], vectors[k + 2]);
    if (size > most) most = size; // older files have NaN
  }
  return most;
}

function longestGroup(first) {
  let most = 0;
  for (let i = 0; i + 1 < first.length; i++) most = Math.max(most, first[i + 1] - first[i]);
  return most;
}
