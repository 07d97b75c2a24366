// The picture: renderer, lights, shadows, themes.

import * as THREE from 'three';
import { THEMES } from './colours.js';

// Whether no graphics card draws: shadows then take most of the time of a frame.
function drawsInSoftware(gl) {
  const asked = gl.getExtension('WEBGL_debug_renderer_info');
  const name = asked ? gl.getParameter(asked.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class Stage {
  constructor(canvas, bounds, up) {
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    } catch (error) {
      throw new Error(`This browser cannot draw in 3-D (WebGL 2 is missing): ${error.message}`);
    }
    this.canvas = canvas;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.copy(up);
    this.lights(bounds, up);
    this.fixedSize = null;
  }

  lights(bounds, up) {
    this.ambient = new THREE.HemisphereLight('#ffffff', '#8f99a5', 1);
    this.ambient.position.copy(up);
    this.sun = new THREE.DirectionalLight('#ffffff', 2);
    const centre = bounds.box.getCenter(new THREE.Vector3());
    const r = 1.3 * bounds.radius;
    const aside = new THREE.Vector3(-0.35, -0.5, 0).projectOnPlane(up);
    const from = up.clone().add(aside).normalize();
    this.sun.position.copy(centre).addScaledVector(from, 3 * r);
    this.sun.target.position.copy(centre);
    this.sun.castShadow = !drawsInSoftware(this.renderer.getContext());
    Object.assign(this.sun.shadow.camera, { left: -r, right: r, top: r, bottom: -r });
    Object.assign(this.sun.shadow.camera, { near: 0.5 * r, far: 6 * r });
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0005;
    this.sun.shadow.normalBias = 0.002 * r;
    this.sun.shadow.intensity = 0.55;
    this.scene.add(this.ambient, this.sun, this.sun.target);
  }

  setTheme(name) {
    const theme = THEMES[name];
    this.scene.background = new THREE.Color(theme.sky);
    this.ambient.intensity = theme.ambient;
    this.ambient.groundColor.set(theme.shade);
    this.sun.intensity = theme.sun;
  }

  // Fits the canvas to its box on the page, or to a size that a video has.
  fit() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    const [width, height] = this.fixedSize ?? [clientWidth, clientHeight];
    const ratio = this.fixedSize ? 1 : Math.min(window.devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, !this.fixedSize);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }
}
