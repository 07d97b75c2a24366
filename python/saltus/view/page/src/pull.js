// The mouse on a live page: a press on a body pulls it, elsewhere it turns the view.

import * as THREE from 'three';
import { $ } from './bar.js';
import { bodyMatrix } from './items.js';

export class Pull {
  constructor(page, wish) {
    this.page = page;
    this.grip = null; // { body, at: point of the body, to: where the mouse is }
    const { canvas } = page.stage;
    const material = new THREE.LineBasicMaterial({ color: '#e8481c', depthTest: false });
    this.thread = new THREE.Line(new THREE.BufferGeometry(), material);
    this.thread.frustumCulled = false;
    this.thread.renderOrder = 11;
    this.thread.visible = false;
    page.stage.scene.add(this.thread);
    const plane = new THREE.Plane();
    const to = (event) => {
      const [w, h] = [canvas.clientWidth, canvas.clientHeight];
      const at = new THREE.Vector2((2 * event.offsetX) / w - 1, 1 - (2 * event.offsetY) / h);
      page.labels.ray.setFromCamera(at, page.stage.camera);
      return page.labels.ray.ray.intersectPlane(plane, new THREE.Vector3());
    };
    const pull = (target) => {
      if (!target) return;
      this.grip.to = target;
      this.line();
      const { body, at } = this.grip;
      wish({ do: 'pull', body, at: at.toArray(), to: target.toArray() });
    };
    // Before the camera's own listener, which is on the canvas.
    $('picture').addEventListener('pointerdown', (event) => {
      if (event.target !== canvas || event.button !== 0) return;
      const found = page.labels.under(event.offsetX, event.offsetY);
      if (!found || found.item.body < 0) return;
      event.stopPropagation();
      canvas.setPointerCapture(event.pointerId);
      plane.setFromNormalAndCoplanarPoint(
        page.stage.camera.getWorldDirection(new THREE.Vector3()),
        found.point,
      );
      const inverse = bodyMatrix(page.motion.now, found.item.body).clone().invert();
      this.grip = { body: found.item.body, at: found.point.clone().applyMatrix4(inverse) };
      pull(found.point);
    }, true);
    canvas.addEventListener('pointermove', (event) => this.grip && pull(to(event)));
    for (const name of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(name, () => {
        if (!this.grip) return;
        this.grip = null;
        this.line();
        wish({ do: 'release' });
      });
    }
  }

  // The line from the body to the mouse.
  line() {
    const { page, thread } = this;
    thread.visible = Boolean(this.grip?.to);
    if (!thread.visible) return;
    const from = this.grip.at.clone().applyMatrix4(bodyMatrix(page.motion.now, this.grip.body));
    thread.geometry.setFromPoints([from, this.grip.to]);
    page.dirty = true;
  }
}
