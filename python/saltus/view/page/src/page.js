// The page as a whole: what is drawn when, and what its parts do together.

import * as THREE from 'three';
import { Arrows } from './arrows.js';
import { $, Bar } from './bar.js';
import { boundsOf } from './bounds.js';
import { Clock } from './clock.js';
import { THEMES } from './colours.js';
import { Ground } from './ground.js';
import { ICONS } from './icons.js';
import { Items } from './items.js';
import { listen } from './keys.js';
import { Labels } from './labels.js';
import { Motion } from './motion.js';
import { Panel } from './panel.js';
import { Stage } from './stage.js';
import { Views } from './views.js';

const NARROW = 900; // px; narrower pages begin without the panel
const KINDS = ['collision', 'visual', 'both'];

// m of the longest arrow: beside bodies that touch it reaches over one of them.
function arrowLength(radius, body) {
  return Math.min(0.3 * radius, Math.max(1.7 * body, Math.min(0.12 * radius, 6 * body)));
}

export class Page {
  constructor(data) {
    this.data = data;
    this.motion = new Motion(data.t, data.poses, data.bodies.length, data.impacts.instant);
    this.clock = new Clock(this.motion.start, this.motion.end);
    this.bounds = boundsOf(data, this.motion);
    const gravity = new THREE.Vector3().fromArray(data.gravity);
    this.up = gravity.length() > 0 ? gravity.negate().normalize() : new THREE.Vector3(0, 0, 1);
    const { radius, body } = this.bounds;
    this.stage = new Stage($('view'), this.bounds, this.up);
    this.items = new Items(data, { thread: Math.min(0.0035 * radius, 0.15 * body), axis: 0.14 * radius });
    this.ground = new Ground(data, this.bounds, this.up);
    this.arrows = new Arrows(data, arrowLength(radius, body));
    this.stage.scene.add(this.items.group, this.ground.group, this.arrows.group);
    this.views = new Views(this.stage, this.bounds, this.up);
    this.labels = new Labels(this, $('names'), $('tip'));
    this.head();
    this.bar = new Bar(this);
    this.panel = new Panel(this);
    this.clock.changed = () => {
      this.bar.changed();
      this.dirty = true;
    };
    this.views.controls.addEventListener('change', () => (this.dirty = true));
    this.showBodies(this.items.has('visual') ? 'visual' : 'collision');
    listen(this);
    this.listenToMouse();
    this.begin();
  }

  head() {
    const { title, summary, notices } = this.data;
    document.title = `${title} · saltus`;
    $('title').textContent = title;
    $('summary').textContent = summary.replace(/e-(\d)/g, 'e-\u2060$1'); // no line ends in a number
    for (const text of notices) {
      const item = document.createElement('li');
      item.textContent = text;
      $('notices').append(item);
    }
    const bodies = this.data.bodies.length === 1 ? '1 body' : `${this.data.bodies.length} bodies`;
    const label = `Picture of ${title}, ${bodies}. Space plays and pauses, Shift and arrow keys go to impacts.`;
    $('view').setAttribute('aria-label', label);
    $('menu').innerHTML = ICONS.menu;
    $('theme').innerHTML = ICONS.theme;
    $('menu').onclick = () => this.openPanel(document.body.classList.contains('closed'));
    $('theme').onclick = () => this.otherTheme();
  }

  begin() {
    const dark = window.matchMedia('(prefers-color-scheme: dark)').matches;
    this.setTheme(this.data.theme ?? (dark ? 'dark' : 'light'));
    this.openPanel(window.innerWidth >= NARROW);
    new ResizeObserver(() => this.resize()).observe($('picture'));
    this.resize();
    this.look('corner');
    this.bar.changed();
    const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (this.data.autoplay && !still) this.clock.play();
    const frame = (now) => {
      if (!this.filming) this.frame(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  frame(now) {
    const moved = this.clock.tick(now);
    if (!moved && !this.dirty) return;
    this.dirty = false;
    this.render();
    this.bar.place();
    this.panel.place();
    this.labels.place();
  }

  // Draws the scene at the time of the clock.
  render() {
    const { time, speed } = this.clock;
    this.motion.set(time);
    this.views.track(this.motion.now);
    this.items.place(this.motion.now);
    this.arrows.place(time, this.filming ?? speed);
    this.stage.draw();
  }

  moved() {
    this.dirty = true;
  }

  resize() {
    if (this.filming) return;
    this.stage.fit();
    const tall = this.stage.canvas.clientHeight;
    const most = this.data.notices.length ? 0.3 : 0.15; // of the picture; what is to be read stays free
    this.views.margin.top = Math.min(Math.max($('head').offsetHeight + 10, 56), most * tall);
    // Where the page is narrow the legend would stand over bodies.
    this.views.margin.bottom = 8 + (window.innerWidth <= 720 ? $('legend').offsetHeight : 0);
    if (this.views.preset) this.look(this.views.preset);
    else this.views.aim();
    this.bar.marks(this.theme);
    this.panel.setTheme();
    this.dirty = true;
  }

  look(name) {
    this.views.look(name);
    this.dirty = true;
  }

  follow(body) {
    this.views.follow(body, this.motion.now);
    $('follow').value = body === null ? '' : String(body);
    this.dirty = true;
  }

  showBodies(which) {
    this.bodiesShown = which;
    this.items.show('collision', which !== 'visual', which === 'both');
    this.items.show('visual', which !== 'collision');
    this.showThreads();
    const radio = document.querySelector(`input[name="bodies"][value="${which}"]`);
    if (radio) radio.checked = true;
    this.dirty = true;
  }

  showThreads() {
    const wanted = $('show-thread').checked;
    this.items.show('thread', wanted);
    this.items.show('thread of shapes', wanted && this.bodiesShown !== 'visual');
  }

  nextBodies() {
    if (!$('bodies').hidden) this.showBodies(KINDS[(KINDS.indexOf(this.bodiesShown) + 1) % 3]);
  }

  setTheme(name) {
    this.themeName = name;
    this.theme = THEMES[name];
    document.documentElement.dataset.theme = name;
    this.stage.setTheme(name);
    this.ground.setTheme(this.theme);
    this.items.setThreadColour(this.theme.thread);
    this.bar.marks(this.theme);
    this.panel.setTheme();
    this.dirty = true;
  }

  otherTheme() {
    this.setTheme(this.themeName === 'dark' ? 'light' : 'dark');
  }

  openPanel(open) {
    document.body.classList.toggle('closed', !open);
    $('menu').setAttribute('aria-expanded', String(open));
    if (this.theme) this.panel.setTheme();
    this.dirty = true;
  }

  say(text, { lasting = false } = {}) {
    $('status').textContent = text;
    clearTimeout(this.silence);
    this.silence = lasting ? null : setTimeout(() => ($('status').textContent = ''), 4000);
  }

  // Pixel of a point on the canvas, and whether it is before the camera.
  project(point) {
    const at = new THREE.Vector3().fromArray(point);
    this.stage.camera.updateMatrixWorld();
    const front = at.clone().applyMatrix4(this.stage.camera.matrixWorldInverse).z < 0;
    at.project(this.stage.camera);
    const [w, h] = this.stage.fixedSize ?? [this.stage.canvas.clientWidth, this.stage.canvas.clientHeight];
    return [((at.x + 1) / 2) * w, ((1 - at.y) / 2) * h, front];
  }

  listenToMouse() {
    // A click on a button leaves the keys to the picture: Space plays, whatever was clicked.
    document.addEventListener('mousedown', (event) => {
      if (event.target.closest('button')) event.preventDefault();
    });
    const canvas = this.stage.canvas;
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons === 0 && event.pointerType === 'mouse') this.labels.point(event.offsetX, event.offsetY);
    });
    canvas.addEventListener('pointerleave', () => this.labels.leave());
    canvas.addEventListener('dblclick', (event) => {
      const found = this.labels.under(event.offsetX, event.offsetY);
      this.follow(found && found.item.body >= 0 ? found.item.body : null);
    });
  }

  // While a video is made the page stands still and has the size of the video.
  beginVideo(size, speed) {
    this.before = { time: this.clock.time, preset: this.views.preset };
    this.clock.pause();
    this.filming = speed;
    this.stage.fixedSize = size;
    this.stage.fit();
    this.look(this.views.preset);
  }

  endVideo() {
    this.filming = undefined;
    this.stage.fixedSize = null;
    this.clock.seek(this.before.time);
    this.resize();
  }
}
