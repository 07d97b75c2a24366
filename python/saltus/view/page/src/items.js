// Everything that is fixed to bodies: shapes, visuals, threads, frames. Equal ones are one call.

import * as THREE from 'three';
import { AXES, BODIES, FIXED } from './colours.js';
import { makeGeometry, makeMaterial } from './geometry.js';
import { NUMBERS } from './motion.js';

const p = new THREE.Vector3();
const r = new THREE.Quaternion();
const one = new THREE.Vector3(1, 1, 1);
const X_WB = new THREE.Matrix4();
const X_WI = new THREE.Matrix4();

export class Items {
  // data: the scene; size: { thread, axis } in m.
  constructor(data, size) {
    this.data = data;
    this.size = size;
    this.group = new THREE.Group();
    this.meshes = []; // { mesh, items, kind, group }
    this.geometries = [...data.geometries, { type: 'rod' }];
    this.rod = data.geometries.length;
    this.all = [...data.items.map((item) => ({ ...item })), ...this.threads(), ...this.frames()];
    this.seen = new Set(data.items.filter((i) => i.kind === 'visual').map((item) => item.link));
    const bodies = data.items.filter((i) => i.kind === 'visual').map((item) => item.body);
    this.seenBodies = new Set(bodies);
    this.all.forEach((item) => this.prepare(item));
    this.build();
  }

  threads() {
    const rows = this.data.threads;
    const items = [];
    for (let k = 0; k < rows.length; k += 7) {
      const from = new THREE.Vector3(rows[k + 1], rows[k + 2], rows[k + 3]);
      const to = new THREE.Vector3(rows[k + 4], rows[k + 5], rows[k + 6]);
      items.push(this.rodFrom(rows[k], from, to, this.size.thread, 'thread', null));
    }
    return items;
  }

  frames() {
    const items = [];
    for (const frame of this.data.frames) {
      const base = matrixOf(frame.pose, [1, 1, 1]);
      const from = new THREE.Vector3().setFromMatrixPosition(base);
      [0, 1, 2].forEach((k) => {
        const axis = new THREE.Vector3().setFromMatrixColumn(base, k);
        const to = from.clone().addScaledVector(axis, this.size.axis);
        items.push(this.rodFrom(frame.body, from, to, 0.03 * this.size.axis, 'frame', AXES[k]));
      });
    }
    return items;
  }

  rodFrom(body, from, to, radius, kind, colour) {
    const along = to.clone().sub(from);
    const length = along.length();
    const turned = new THREE.Quaternion().setFromUnitVectors(
      new THREE.Vector3(0, 0, 1),
      along.normalize(),
    );
    const pose = [...from.toArray(), ...turned.toArray()];
    return { kind, body, geometry: this.rod, pose, scale: [radius, radius, length], colour };
  }

  prepare(item) {
    item.local = matrixOf(item.pose, item.scale);
    item.rigid = matrixOf(item.pose, [1, 1, 1]);
    item.alpha ??= 1;
    item.group = this.groupOf(item);
    const own = item.body < 0 ? FIXED : BODIES[item.body % BODIES.length];
    item.paint = new THREE.Color(item.colour ?? own);
  }

  // What is shown and hidden together: links without visuals always show their collision shapes,
  // and visuals have their own threads.
  groupOf({ kind, link, body }) {
    if (kind === 'collision' && !this.seen.has(link)) return 'plain';
    if (kind === 'thread' && this.seenBodies.has(body)) return 'thread of shapes';
    return kind;
  }

  build() {
    const groups = new Map();
    for (const item of this.all) {
      if (item.body === null || this.geometries[item.geometry].type === 'plane') continue;
      const see = item.alpha < 1 ? item.alpha.toFixed(2) : 1;
      const key = `${item.group} ${item.geometry} ${see}`;
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(item);
    }
    for (const items of groups.values()) {
      const { kind, group, geometry, alpha } = items[0];
      const stored = this.geometries[geometry];
      const glass = alpha < 1 ? { transparent: true, opacity: alpha, depthWrite: false } : {};
      const mesh = new THREE.InstancedMesh(
        makeGeometry(stored, items.length),
        makeMaterial(stored.type, glass, kind === 'collision'),
        items.length,
      );
      mesh.frustumCulled = false; // instances are everywhere
      mesh.castShadow = (kind === 'collision' || kind === 'visual') && alpha === 1; // thin ones flicker
      mesh.receiveShadow = kind !== 'frame';
      items.forEach((item, i) => {
        item.mesh = mesh;
        item.index = i;
        mesh.setMatrixAt(i, item.local);
        mesh.setColorAt(i, item.paint);
      });
      this.meshes.push({ mesh, items, kind, group });
      this.group.add(mesh);
    }
  }

  // Moves everything to the poses of all bodies.
  place(poses) {
    for (const { mesh, items } of this.meshes) {
      if (!mesh.visible) continue;
      for (const item of items) {
        if (item.body < 0) continue;
        mesh.setMatrixAt(item.index, X_WI.multiplyMatrices(bodyMatrix(poses, item.body), item.local));
      }
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null; // of the poses before; picking makes it anew
    }
  }

  // Pose of an item as it is drawn: position, quaternion.
  poseOf(item, poses) {
    const X = item.body < 0 ? item.rigid : X_WI.multiplyMatrices(bodyMatrix(poses, item.body), item.rigid);
    X.decompose(p, r, new THREE.Vector3());
    return [...p.toArray(), ...r.toArray()];
  }

  show(group, visible, glass = false) {
    for (const { mesh, group: own, items } of this.meshes) {
      if (own !== group) continue;
      mesh.visible = visible;
      if (items[0].alpha < 1) continue;
      Object.assign(mesh.material, { transparent: glass, opacity: glass ? 0.4 : 1, depthWrite: !glass });
      mesh.material.needsUpdate = true;
    }
  }

  has(group) {
    return this.meshes.some((each) => each.group === group);
  }

  setThreadColour(colour) {
    for (const { mesh, items, kind } of this.meshes) {
      if (kind !== 'thread') continue;
      items.forEach((_, i) => mesh.setColorAt(i, new THREE.Color(colour)));
      mesh.instanceColor.needsUpdate = true;
    }
  }

  // The body that is pointed at stands out by a lighter colour; null: none.
  highlight(body) {
    for (const { mesh, items } of this.meshes) {
      items.forEach((item, i) => {
        if (item.kind !== 'collision' && item.kind !== 'visual') return;
        const colour = item.paint.clone();
        if (body !== null && item.body === body) colour.lerp(new THREE.Color('#ffffff'), 0.35);
        mesh.setColorAt(i, colour);
      });
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }
}

export function matrixOf(pose, scale) {
  return new THREE.Matrix4().compose(
    new THREE.Vector3().fromArray(pose),
    new THREE.Quaternion().fromArray(pose, 3),
    new THREE.Vector3().fromArray(scale),
  );
}

export function bodyMatrix(poses, body) {
  const at = body * NUMBERS;
  return X_WB.compose(p.fromArray(poses, at), r.fromArray(poses, at + 3), one);
}
