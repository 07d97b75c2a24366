// Geometries of shapes. Round ones have two tones, so that one sees them turn.

import * as THREE from 'three';
import { toCreasedNormals } from 'three/addons/utils/BufferGeometryUtils.js';

const CREASE = 0.7; // rad between triangles; flatter angles are drawn round
const PATTERNED = new Set(['sphere', 'cylinder', 'capsule']);

// Fewer triangles where there are many bodies: [around, along].
function fineness(count) {
  if (count > 3000) return [12, 8];
  if (count > 300) return [20, 12];
  return [48, 28];
}

export function makeGeometry(stored, count) {
  const [around, along] = fineness(count);
  switch (stored.type) {
    case 'sphere':
      return upright(new THREE.SphereGeometry(1, around, along));
    case 'box':
      return new THREE.BoxGeometry(2, 2, 2);
    case 'cylinder':
      return upright(new THREE.CylinderGeometry(1, 1, 2, around));
    case 'capsule': {
      const { radius, half_length: half } = stored;
      return upright(new THREE.CapsuleGeometry(radius, 2 * half, Math.ceil(along / 2), around));
    }
    case 'rod': // from z = 0 to 1
      return upright(new THREE.CylinderGeometry(1, 1, 1, 8)).translate(0, 0, 0.5);
    case 'mesh':
      return flat(stored);
    default:
      throw new Error(`unknown geometry "${stored.type}"`);
  }
}

// three.js has its axes of revolution along y, saltus along z.
function upright(geometry) {
  return geometry.rotateX(Math.PI / 2);
}

function flat(stored) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(stored.vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(stored.triangles), 1));
  if (stored.smooth) return toCreasedNormals(geometry, CREASE);
  const apart = geometry.toNonIndexed(); // flat faces, as boxes have
  apart.computeVertexNormals();
  return apart;
}

export function makeMaterial(type, options, patterned) {
  const material = new THREE.MeshStandardMaterial({ roughness: 0.55, metalness: 0.02, ...options });
  if (patterned && PATTERNED.has(type)) material.map = pattern();
  return material;
}

let shared = null;

function pattern() {
  if (shared) return shared;
  const [wide, high] = [8, 2];
  const bytes = new Uint8Array(4 * wide * high);
  for (let y = 0; y < high; y++) {
    for (let x = 0; x < wide; x++) {
      const tone = (x + y) % 2 ? 255 : 222;
      bytes.set([tone, tone, tone, 255], 4 * (y * wide + x));
    }
  }
  shared = new THREE.DataTexture(bytes, wide, high);
  shared.magFilter = THREE.NearestFilter;
  shared.minFilter = THREE.LinearFilter;
  shared.colorSpace = THREE.SRGBColorSpace;
  shared.needsUpdate = true;
  return shared;
}
