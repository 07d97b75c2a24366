// The camera: presets, fitting, following a body.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

// Directions from the scene to the camera, as [aside, back, up].
const DIRECTIONS = {
  corner: [0.45, -1, 0.38],
  front: [0, -1, 0],
  side: [1, 0, 0],
  top: [0, -1e-4, 1],
};

const MOST_WIDE = 4; // times the size at the start that a scene may grow to
const EASE = 0.15; // s in which the way that is left shrinks by e

export class Views {
  constructor(stage, bounds, up) {
    this.stage = stage;
    this.bounds = bounds;
    this.up = up;
    this.across = new THREE.Vector3(1, 0, 0);
    if (Math.abs(up.x) > 0.9) this.across.set(0, 1, 0);
    this.across.projectOnPlane(up).normalize();
    this.back = new THREE.Vector3().crossVectors(up, this.across);
    this.controls = new OrbitControls(stage.camera, stage.canvas);
    this.controls.enableDamping = false;
    this.followed = null; // body
    this.goal = null; // box that the scene grows to
    this.at = new THREE.Vector3();
    this.margin = { left: 0, right: 0, top: 0, bottom: 0 }; // px that panels cover
    this.preset = 'corner';
    this.controls.addEventListener('start', () => (this.preset = null));
  }

  // Looks at the whole scene from a preset's direction, or from where the camera is.
  look(name) {
    this.preset = name ?? this.preset;
    const { camera } = this.stage;
    const target = this.bounds.box.getCenter(new THREE.Vector3());
    let toward = camera.position.clone().sub(this.controls.target);
    if (name) {
      const [aside, back, up] = DIRECTIONS[name];
      toward = this.across.clone().multiplyScalar(aside);
      toward.addScaledVector(this.back, back).addScaledVector(this.up, up);
    }
    toward.normalize();
    camera.position.copy(target).add(toward);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    const distance = this.distance(target, toward);
    camera.position.copy(target).addScaledVector(toward, distance);
    camera.near = Math.max(distance - 30 * this.bounds.radius, distance / 1000);
    camera.far = distance + 40 * this.bounds.radius;
    this.controls.target.copy(target);
    this.controls.minDistance = 0.02 * this.bounds.radius;
    this.controls.maxDistance = 40 * this.bounds.radius;
    this.aim();
    this.controls.update();
  }

  // Takes in what leaves the scene's box; not what flies away.
  widen(box) {
    const own = this.bounds.box;
    if (box.isEmpty() || own.containsBox(box)) return;
    const wide = own.clone().union(box);
    if (wide.getSize(new THREE.Vector3()).length() < 2 * MOST_WIDE * this.bounds.radius) this.goal = wide;
  }

  // Goes a part of the way to a box that has grown, where the camera is that of a preset.
  ease() {
    const now = performance.now();
    const part = 1 - Math.exp(-(now - (this.eased ?? now)) / (1000 * EASE));
    this.eased = now;
    if (!this.goal) return;
    const own = this.bounds.box;
    own.min.lerp(this.goal.min, part);
    own.max.lerp(this.goal.max, part);
    const left = own.min.distanceTo(this.goal.min) + own.max.distanceTo(this.goal.max);
    if (left < 1e-3 * this.bounds.radius) this.goal = null;
    if (this.preset && this.followed === null) this.look(this.preset);
  }

  // Distance at which all corners of the box are in the picture.
  distance(target, toward) {
    const { camera, canvas, fixedSize } = this.stage;
    const { margin } = this;
    const [wide, high] = [margin.left + margin.right, margin.top + margin.bottom];
    const covered = fixedSize
      ? [0, 0]
      : [wide / (canvas.clientWidth || 1), high / (canvas.clientHeight || 1)];
    const free = covered.map((part) => Math.max(1 - part, 0.3));
    const tall = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    const half = [tall * camera.aspect * free[0], tall * free[1]];
    const right = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const upward = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    let most = 0;
    for (const corner of corners(this.bounds.box)) {
      corner.sub(target);
      const deep = corner.dot(toward);
      most = Math.max(
        most,
        deep + Math.abs(corner.dot(right)) / half[0],
        deep + Math.abs(corner.dot(upward)) / half[1],
      );
    }
    return 1.08 * most;
  }

  // Shifts the picture so that the scene is in the middle of what panels leave free.
  aim() {
    const { camera, canvas, fixedSize } = this.stage;
    if (fixedSize) {
      camera.clearViewOffset();
      return;
    }
    const { left, right, top, bottom } = this.margin;
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    camera.setViewOffset(w, h, (right - left) / 2, (bottom - top) / 2, w, h);
  }

  follow(body, poses) {
    this.followed = body;
    if (body !== null) this.at.fromArray(poses, 7 * body);
  }

  // Moves the camera along with the followed body; true if it moved.
  track(poses) {
    if (this.followed === null) return false;
    const now = new THREE.Vector3().fromArray(poses, 7 * this.followed);
    const moved = now.clone().sub(this.at);
    this.at.copy(now);
    this.stage.camera.position.add(moved);
    this.controls.target.add(moved);
    this.controls.update();
    return moved.lengthSq() > 0;
  }
}

function corners(box) {
  const all = [];
  for (const x of [box.min.x, box.max.x]) {
    for (const y of [box.min.y, box.max.y]) {
      for (const z of [box.min.z, box.max.z]) all.push(new THREE.Vector3(x, y, z));
    }
  }
  return all;
}
