// Names of bodies beside them, and the body that the mouse points at.

import * as THREE from 'three';

const MOST = 60; // names at once

export class Labels {
  constructor(page, element, tip) {
    this.page = page;
    this.element = element;
    this.tip = tip;
    this.visible = false;
    this.ray = new THREE.Raycaster();
    this.pointed = null;
    const named = page.items.all.filter((i) => i.kind === 'collision' || i.kind === 'visual');
    const firsts = new Map(named.map((item) => [item.link, item]).reverse());
    this.shown = [...firsts.values()].filter((item) => item.body !== null && item.mesh);
    this.shown = this.shown.slice(0, MOST);
  }

  show(visible) {
    this.visible = visible;
    this.element.replaceChildren();
    if (!visible) return;
    for (const item of this.shown) {
      const span = document.createElement('span');
      span.textContent = item.link;
      this.element.append(span);
    }
  }

  place() {
    if (!this.visible) return;
    this.shown.forEach((item, i) => {
      const [x, y, front] = this.page.project(this.page.items.poseOf(item, this.page.motion.now));
      const { style } = this.element.children[i];
      style.display = front ? '' : 'none';
      style.left = `${x}px`;
      style.top = `${y}px`;
    });
  }

  // What is under a pixel of the canvas: { item, point } or null.
  under(x, y) {
    const { stage, items } = this.page;
    const [w, h] = [stage.canvas.clientWidth, stage.canvas.clientHeight];
    const at = new THREE.Vector2((2 * x) / w - 1, 1 - (2 * y) / h);
    this.ray.setFromCamera(at, stage.camera);
    const solid = items.meshes.filter((each) => each.mesh.visible && each.kind !== 'frame');
    const [hit] = this.ray.intersectObjects(solid.map((each) => each.mesh), false);
    if (!hit) return null;
    const item = solid.find((each) => each.mesh === hit.object).items[hit.instanceId];
    return { item, point: hit.point };
  }

  // Tells the name under the mouse.
  point(x, y) {
    const found = this.under(x, y);
    const body = found && found.item.body >= 0 ? found.item.body : null;
    if (body !== this.pointed) {
      this.pointed = body;
      this.page.items.highlight(body);
      this.page.dirty = true;
    }
    this.tip.hidden = !found || !found.item.link;
    if (this.tip.hidden) return;
    this.tip.textContent = found.item.name ?? found.item.link;
    this.tip.style.left = `${x}px`;
    this.tip.style.top = `${y}px`;
  }

  leave() {
    this.tip.hidden = true;
    if (this.pointed === null) return;
    this.pointed = null;
    this.page.items.highlight(null);
    this.page.dirty = true;
  }
}
