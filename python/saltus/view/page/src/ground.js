// The floor: half-spaces as large planes, and a grid of a sensible width on them or below the scene.

import * as THREE from 'three';
import { matrixOf } from './items.js';

// A width of squares of 1, 2 or 5 times a power of ten: five to ten squares over the scene.
export function gridWidth(radius) {
  const wanted = radius / 2.5;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [5, 2, 1].map((k) => k * power).find((width) => width <= wanted) ?? power;
}

const VERTEX = `
  varying vec2 at;
  void main() {
    at = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

// Lines of one pixel by derivatives of the position; every fifth is stronger; fades to the rim.
const FRAGMENT = `
  uniform vec3 colour;
  uniform float width;
  uniform float rim;
  uniform vec2 origin;
  varying vec2 at;
  float lines(float width) {
    vec2 x = (at - origin) / width;
    vec2 near = abs(fract(x - 0.5) - 0.5) / fwidth(x);
    return 1.0 - min(min(near.x, near.y), 1.0);
  }
  void main() {
    float fade = 1.0 - smoothstep(0.1 * rim, 0.75 * rim, length(at));
    float strength = max(0.3 * lines(width), 0.6 * lines(5.0 * width)) * fade;
    if (strength < 0.01) discard;
    gl_FragColor = vec4(colour, strength);
    #include <colorspace_fragment>
  }`;

const STEEP = 0.3; // half-spaces whose normal rises less are walls

export class Ground {
  constructor(data, bounds, up) {
    this.group = new THREE.Group();
    this.grids = [];
    this.floors = [];
    this.walls = [];
    this.width = gridWidth(bounds.radius);
    const centre = bounds.box.getCenter(new THREE.Vector3());
    let level = false;
    for (const item of data.items) {
      if (data.geometries[item.geometry].type !== 'plane') continue;
      const X = matrixOf(item.pose, [1, 1, 1]);
      const normal = new THREE.Vector3().setFromMatrixColumn(X, 2);
      const rise = normal.dot(up);
      if (rise > STEEP) {
        level = true;
        this.plane(X, centre, bounds.radius * (rise > 0.95 ? 12 : 5), true);
      } else {
        this.wall(X, centre, bounds.radius);
      }
    }
    if (!level) this.below(bounds, centre, up);
  }

  // Without a floor a grid lies just below everything; it is not part of the model.
  below(bounds, centre, up) {
    const half = bounds.box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
    const down = Math.abs(half.x * up.x) + Math.abs(half.y * up.y) + Math.abs(half.z * up.z);
    const base = centre.clone().addScaledVector(up, -down - 0.02 * bounds.radius);
    const turned = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
    const X = matrixOf([...base.toArray(), ...turned.toArray()], [1, 1, 1]);
    this.plane(X, centre, bounds.radius * 12, false);
  }

  // Walls are squares that one sees through, with a border.
  wall(X, centre, radius) {
    const foot = centre.clone().applyMatrix4(X.clone().invert());
    const place = X.clone().multiply(new THREE.Matrix4().makeTranslation(foot.x, foot.y, 0));
    const square = new THREE.PlaneGeometry(2.4 * radius, 2.4 * radius);
    const options = { transparent: true, opacity: 0.5, depthWrite: false, side: THREE.DoubleSide };
    const face = new THREE.Mesh(square, new THREE.MeshBasicMaterial(options));
    const border = new THREE.LineSegments(
      new THREE.EdgesGeometry(square),
      new THREE.LineBasicMaterial(),
    );
    face.renderOrder = -2;
    for (const each of [face, border]) {
      each.applyMatrix4(place);
      this.group.add(each);
    }
    this.walls.push({ face, border });
  }

  // A disc in the plane z = 0 of X, about the foot of the scene's centre.
  plane(X, centre, rim, solid) {
    const foot = centre.clone().applyMatrix4(X.clone().invert());
    const place = X.clone().multiply(new THREE.Matrix4().makeTranslation(foot.x, foot.y, 0));
    const disc = fadingDisc(rim);
    const floor = new THREE.Mesh(
      disc,
      solid
        ? new THREE.MeshStandardMaterial({ roughness: 0.95, vertexColors: true, transparent: true })
        : new THREE.ShadowMaterial({ opacity: 0.16 }),
    );
    floor.receiveShadow = true;
    floor.applyMatrix4(place);
    floor.renderOrder = -2;
    // What stands on it lies in it: the floor gives way, as deep buffers are not exact.
    Object.assign(floor.material, { polygonOffset: true, polygonOffsetFactor: 1, depthWrite: false });
    const grid = new THREE.Mesh(disc, this.lines(rim, foot));
    grid.applyMatrix4(place);
    grid.renderOrder = -1;
    this.floors.push(floor);
    this.grids.push(grid);
    this.group.add(floor, grid);
  }

  lines(rim, foot) {
    return new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
      uniforms: {
        colour: { value: new THREE.Color() },
        width: { value: this.width },
        rim: { value: rim },
        // Lines repeat: large coordinates would lose their digits on the graphics card.
        origin: { value: new THREE.Vector2(-foot.x % (5 * this.width), -foot.y % (5 * this.width)) },
      },
    });
  }

  setTheme(theme) {
    for (const grid of this.grids) grid.material.uniforms.colour.value.set(theme.grid);
    for (const { face, border } of this.walls) {
      face.material.color.set(theme.wall);
      border.material.color.set(theme.grid);
    }
    for (const floor of this.floors) {
      if (floor.material.isMeshStandardMaterial) floor.material.color.set(theme.floor);
    }
  }

  showGrid(visible) {
    for (const grid of this.grids) grid.visible = visible;
  }
}

// A disc whose opacity falls to 0 towards its rim.
function fadingDisc(rim) {
  const geometry = new THREE.RingGeometry(0, rim, 64, 12);
  const position = geometry.getAttribute('position');
  const colours = new Float32Array(4 * position.count);
  for (let i = 0; i < position.count; i++) {
    const part = Math.hypot(position.getX(i), position.getY(i)) / rim;
    const alpha = 1 - THREE.MathUtils.smoothstep(part, 0.4, 1);
    colours.set([1, 1, 1, alpha], 4 * i);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 4));
  return geometry;
}
