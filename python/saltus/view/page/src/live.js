// A page whose model is simulated while it is open: frames come in, wishes go out.

import { SEEN } from './arrows.js';
import { $ } from './bar.js';
import { boxNow } from './bounds.js';
import { ICONS } from './icons.js';
import { impactWords } from './panel.js';
import { Recent } from './plots.js';
import { Pull } from './pull.js';

const WINDOW = 10; // s that are plotted
const PLOTS = 8; // plots drawn anew a second
const MANY = 60; // sliders; more are set as often as plots are drawn

class Live {
  constructor(page) {
    this.page = page;
    this.frames = 0;
    this.lags = [];
    this.busy = false; // a wish is on its way
    this.waiting = []; // those that wait for it, in order
    this.drawn = 0;
    this.impulses = []; // whose arrows are seen, each until a time
    this.told = 0; // number of the last impact that is known
    this.waits = null; // the frame to be shown next
    this.take();
    this.plots();
    this.sliders();
    this.pull = new Pull(page, (what) => this.wish(what));
    this.source = new EventSource('events');
    this.source.onmessage = ({ data }) => this.newest(JSON.parse(data));
    this.source.onerror = () => this.end();
    window.addEventListener('pagehide', () => this.source.close());
  }

  // Shows frames at most as fast as the screen draws: where that is slow the newest is shown, with
  // the impacts of those that were not, and none waits for its turn.
  newest(news) {
    this.frames++;
    const { waits } = this;
    if (waits?.beginning === news.beginning) {
      const first = news.impacts[0]?.number ?? Infinity;
      news.impacts.unshift(...waits.impacts.filter(({ number }) => number < first));
    }
    this.waits = news;
    if (waits) return;
    requestAnimationFrame(() => {
      const shown = this.waits;
      this.waits = null;
      if (this.source.readyState !== EventSource.CLOSED) this.frame(shown);
    });
  }

  // Sends wishes one after another. Of a slider that moves the newest is kept.
  async wish(what) {
    const last = this.waiting.at(-1);
    const isNewer = ['do', 'slider', 'actuator'].every((key) => last?.[key] === what[key]);
    if (isNewer && what.do !== 'step') this.waiting.pop();
    this.waiting.push(what);
    if (this.busy) return;
    this.busy = true;
    while (this.waiting.length > 0) await this.send(this.waiting.shift());
    this.busy = false;
  }

  async send(what) {
    try {
      const answer = await fetch('do', { method: 'POST', body: JSON.stringify(what) });
      if (!answer.ok) this.page.say(await answer.text());
    } catch {
      this.end();
    }
  }

  // The program has ended: what it showed last stays, and the page says so for good.
  end() {
    const { page } = this;
    this.source.close();
    page.say('The program that simulates this page has ended.', { lasting: true });
    page.clock.playing = false;
    page.bar.changed();
    for (const id of ['play', 'single', 'reset']) $(id).disabled = true;
    for (const { input } of [...this.inputs, ...this.controls]) input.disabled = true;
  }

  // Gives the bar and the clock to the program.
  take() {
    const { page } = this;
    const { clock } = page;
    document.body.classList.add('live');
    for (const id of ['previous', 'next', 'track', 'loop-box', 'save-video']) {
      $(id).hidden = true;
    }
    $('single').hidden = false;
    $('single').onclick = () => this.wish({ do: 'step' });
    $('joints').hidden = false;
    $('reset').onclick = () => this.wish({ do: 'reset' });
    $('play').disabled = false;
    clock.tick = () => false;
    clock.toggle = () => this.wish({ do: clock.playing ? 'pause' : 'play' });
    clock.seek = () => {};
    clock.setSpeed = (value) => this.wish({ do: 'speed', value });
    page.bar.frame = (direction) => direction > 0 && this.wish({ do: 'step' });
    page.bar.jump = () => {};
    page.motion.set = () => {};
    page.arrows.place = () => {};
    page.panel.impacts = () => {};
    page.motion.now.set(page.data.poses);
    if (window.innerWidth < 900) page.openPanel(false);
  }

  plots() {
    const { page } = this;
    page.energies = page.panel.energy = new Recent(WINDOW, 'kinetic', 'potential', 'total');
    page.gap = page.panel.gap = new Recent(WINDOW, 'phi');
    $('pair').onchange = () => this.wish({ do: 'gap', pair: Number($('pair').value) });
    this.noImpact();
  }

  noImpact() {
    this.told = 0;
    this.impulses = [];
    $('impact-title').textContent = 'Last impact';
    this.page.panel.impactTable('none yet', []);
  }

  sliders() {
    const { sliders, controls } = this.page.data;
    const set = (slider, value) => this.wish({ do: 'set', slider, value });
    const tell = (actuator, value) => this.wish({ do: 'control', actuator, value });
    this.inputs = sliders.map((slider, i) => this.slider($('sliders'), `slider-${i}`, slider, (x) => set(i, x)));
    this.controls = controls.map((c, i) => this.slider($('controls'), `control-${i}`, c, (x) => tell(i, x)));
    $('controls-title').hidden = !controls.length;
    if (!sliders.length) $('sliders').textContent = 'This model has no joints that move.';
  }

  slider(where, id, { name, unit, lower, upper }, changed) {
    const label = document.createElement('label');
    const input = document.createElement('input');
    const output = document.createElement('output');
    label.textContent = name;
    label.htmlFor = input.id = id;
    Object.assign(input, { type: 'range', min: lower, max: upper, step: 'any' });
    input.oninput = () => changed(Number(input.value));
    where.append(label, input, output);
    return { input, output, unit };
  }

  frame(news) {
    const { page } = this;
    this.lags.push(Date.now() - 1000 * news.sent);
    if (this.lags.length > 600) this.lags.shift();
    const bytes = Uint8Array.from(atob(news.poses), (c) => c.charCodeAt(0));
    page.motion.now.set(new Float32Array(bytes.buffer));
    const { clock } = page;
    const changed = clock.playing !== news.playing || clock.speed !== news.speed;
    Object.assign(clock, { time: news.t, playing: news.playing, speed: news.speed });
    if (changed) page.bar.changed();
    $('play').innerHTML ||= ICONS.pause;
    this.numbers = news;
    if (this.inputs.length <= MANY) this.values();
    this.begin(news);
    page.energies.add(news.t, news.kinetic, news.potential, news.kinetic + news.potential);
    const fresh = this.impacts(news.impacts);
    this.gap(news, fresh);
    this.arrows(fresh, news.forces);
    this.draw(news.t);
    if (news.problem && news.problem !== this.problem) page.say(news.problem);
    this.problem = news.problem;
    this.pull.line();
    if (!this.pull.grip) page.views.ease(); // the mouse would leave the body
    page.dirty = true;
  }

  values() {
    const { values, control } = this.numbers;
    const set = ({ input, output, unit }, value) => {
      if (!input.matches(':active')) input.value = value;
      const text = `${value.toFixed(3).replace(/^-(0\.0*)$/, '$1')} ${unit}`.trim();
      if (output.textContent !== text) output.textContent = text;
    };
    this.inputs.forEach((slider, i) => set(slider, values[i]));
    this.controls.forEach((slider, i) => set(slider, control[i]));
  }

  // Forgets what was before a reset.
  begin({ beginning }) {
    const { page } = this;
    if (beginning === this.beginning) return;
    this.beginning = beginning;
    this.noImpact();
    page.energies.forget();
    page.gap.forget();
    Object.assign(page.arrows.largest, { impulse: 0, force: 0 });
    page.panel.legend();
  }

  // Returns the impacts that no frame before told, and shows the last of them as a table.
  impacts(list) {
    const fresh = list.filter(({ number }) => number > this.told);
    if (!fresh.length) return fresh;
    const { number, t, certificate, impulses } = fresh.at(-1);
    this.told = number;
    $('impact-title').textContent = `Last impact, number ${number}`;
    this.page.panel.impactTable(impactWords(t, certificate), impulses);
    return fresh;
  }

  // Adds the gap of the chosen pair; at its impacts it is 0, between two frames too.
  gap({ t, gap: { pair, phi } }, fresh) {
    const { gap } = this.page;
    if (phi === null) return;
    if (this.pair !== pair) {
      this.pair = pair;
      if (!$('pair').matches(':focus')) $('pair').value = pair;
      gap.forget();
    }
    for (const impact of fresh) {
      if (impact.closed.includes(pair) && impact.t > gap.x.at(-1)) gap.add(impact.t, 0);
    }
    gap.add(t, phi);
  }

  arrows(fresh, forces) {
    const { page } = this;
    const now = performance.now();
    const arrow = (kind) => ([pair, point, vector, normal]) => ({ kind, pair, point, vector, normal });
    const added = fresh.flatMap(({ arrows }) => arrows.map(arrow('impulse')));
    for (const each of added) each.until = now + 1000 * SEEN;
    this.impulses = [...this.impulses.filter(({ until }) => until > now), ...added];
    if (page.arrows.given([...this.impulses, ...forces.map(arrow('force'))])) page.panel.legend();
  }

  // Draws anew what takes time, less often than frames come.
  draw(t) {
    const { page } = this;
    const now = performance.now();
    clearTimeout(this.late);
    const early = this.drawn + 1000 / PLOTS - now;
    if (early > 0) {
      this.late = setTimeout(() => this.draw(t), early); // no frame may come after this one
      return;
    }
    this.drawn = now;
    const start = Math.max(t - WINDOW, page.energies.x[0]);
    Object.assign(page.clock, { start, end: Math.max(t, start + 1) });
    if (this.inputs.length > MANY) this.values();
    page.panel.energyPlot.redraw(page.theme);
    page.panel.gapPlot.redraw(page.theme);
    if (!this.pull.grip) page.views.widen(boxNow(page.data, page.motion.now));
  }
}

export function goLive(page) {
  page.live = new Live(page);
}
