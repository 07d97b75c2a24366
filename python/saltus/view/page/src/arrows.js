// Arrows of impulses, of the forces of held contacts, and normals, at the instant they act.

import * as THREE from 'three';
import { sameInstant } from './clock.js';
import { ARROWS } from './colours.js';
import { rowAt } from './motion.js';

const MOST = 4000; // arrows drawn at once
export const SEEN = 0.15; // s of the clock on the wall that an impact's arrows stay
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
    const exact = sameInstant(time);
    for (let i = rowAt(t, time + exact); i >= 0; i--) {
      if (t[i] > time + exact) continue;
      if (t[i] < time - SEEN * speed - exact) break;
      found.push(i);
    }
    return found.reverse();
  }

  // Draws what acts at a time of the run.
  place(time, speed) {
    const impulses = this.impactsAt(time, speed).flatMap((i) => this.ofImpact(i));
    this.draw([...impulses, ...(this.data.forces ? this.heldAt(time) : [])]);
  }

  // Draws what a program tells; true if one is longer than all before, and the scale another.
  given(list) {
    const before = { ...this.largest };
    for (const { kind, vector } of list) {
      this.largest[kind] = Math.max(this.largest[kind], Math.hypot(...vector));
    }
    this.draw(list);
    return before.impulse !== this.largest.impulse || before.force !== this.largest.force;
  }

  // list: [{ kind: 'impulse' or 'force', pair, point, vector, normal }]
  draw(list) {
    const acts = ({ point, vector }) => Number.isFinite(point[0]) && vector.some((x) => x !== 0);
    this.now = list.filter(acts); // older files have no points
    const arrows = { impulse: [], force: [], normal: [] };
    for (const { kind, point, vector, normal } of this.now) {
      const at = new THREE.Vector3(...point);
      const along = new THREE.Vector3(...vector).multiplyScalar(this.size / this.largest[kind]);
      arrows[kind].push({ at, along, head: true });
      if (kind !== 'impulse') continue;
      arrows.impulse.push({ at, along: along.clone().negate(), head: true });
      const half = new THREE.Vector3(...normal).multiplyScalar(0.45 * this.size);
      arrows.normal.push({ at: at.clone().sub(half), along: half.multiplyScalar(2), head: false });
    }
    for (const kind in arrows) this[kind].set(this.shown[kind] ? arrows[kind] : []);
  }

  ofImpact(i) {
    const { impacts, impulses: own } = this.data;
    const found = [];
    for (let k = impacts.first[i]; k < impacts.first[i + 1]; k++) {
      found.push({ kind: 'impulse', pair: own.pairs[own.pair[k]], ...act(own, k) });
    }
    return found;
  }

  heldAt(time) {
    const { t, first, pairs, pair } = this.data.forces;
    // Forces of a row acted over the step that ends there.
    let row = rowAt(t, time);
    if (t[row] < time && row + 1 < t.length) row++;
    const found = [];
    for (let k = first[row]; k < first[row + 1]; k++) {
      found.push({ kind: 'force', pair: pairs[pair[k]], ...act(this.data.forces, k) });
    }
    return found;
  }
}

// Point, vector and, where it is stored, normal of the k-th of stored arrows.
function act(own, k) {
  const three = (all) => all && Array.from(all.subarray(3 * k, 3 * k + 3));
  return { point: three(own.point), vector: three(own.vector), normal: three(own.normal) };
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
