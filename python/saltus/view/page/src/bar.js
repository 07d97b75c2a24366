// The bar below: play, pause, scrub, speed, impacts before and after.

import { SPEEDS, sameInstant } from './clock.js';
import { ICONS } from './icons.js';
import { rowAt } from './motion.js';

const STEPS = 100000; // of the slider
const EDGE = 8; // px at both ends of a slider where its knob's middle does not come

export const $ = (id) => document.getElementById(id);

export class Bar {
  constructor(page) {
    this.page = page;
    const { clock } = page;
    $('previous').innerHTML = ICONS.previous;
    $('next').innerHTML = ICONS.next;
    for (const speed of SPEEDS) {
      const text = speed < 1 ? `1/${Math.round(1 / speed)}` : String(speed);
      $('speed').add(new Option(`${text} ×`, speed));
    }
    $('play').onclick = () => clock.toggle();
    $('previous').onclick = () => this.jump(-1);
    $('next').onclick = () => this.jump(1);
    $('speed').onchange = () => clock.setSpeed(Number($('speed').value));
    $('loop').onchange = () => (clock.loop = $('loop').checked);
    $('time').oninput = () => {
      const part = $('time').value / STEPS; // before anything moves the knob
      clock.pause();
      clock.seek(clock.start + part * (clock.end - clock.start));
    };
    const none = !page.data.impacts.t.length;
    $('previous').disabled = none;
    $('next').disabled = none;
    if (clock.end <= clock.start) for (const id of ['play', 'time']) $(id).disabled = true;
  }

  // Goes to the next impact in a direction, to the bit; says which.
  jump(direction) {
    const { clock, data } = this.page;
    const { t } = data.impacts;
    const own = sameInstant(clock.time);
    const found =
      direction > 0
        ? t.findIndex((time) => time > clock.time + own)
        : t.findLastIndex((time) => time < clock.time - own);
    clock.pause();
    if (found < 0) {
      this.page.say(direction > 0 ? 'No impact after this time.' : 'No impact before this time.');
      return;
    }
    clock.seek(t[found]);
    this.page.say(`Impact ${found + 1} of ${t.length} at ${t[found].toFixed(6)} s`);
  }

  // Goes on or back by one frame of 1/60 s at the chosen speed.
  frame(direction) {
    const { clock } = this.page;
    clock.pause();
    clock.seek(clock.time + (direction * clock.speed) / 60);
  }

  changed() {
    const { clock } = this.page;
    const word = clock.playing ? 'Pause' : 'Play';
    if ($('play').getAttribute('aria-label') !== word || !$('play').firstChild) {
      $('play').innerHTML = clock.playing ? ICONS.pause : ICONS.play;
      $('play').setAttribute('aria-label', word);
    }
    $('speed').value = String(clock.speed);
    this.place();
  }

  place() {
    const { clock } = this.page;
    const span = clock.end - clock.start;
    const digits = Math.min(Math.max(3 - Math.floor(Math.log10(clock.speed)), 3), 6);
    const text = `${clock.time.toFixed(clock.playing || clock.speed < 1 ? digits : 4)} s`;
    $('clock').textContent = text;
    $('time').value = span > 0 ? Math.round(((clock.time - clock.start) / span) * STEPS) : 0;
    $('time').setAttribute('aria-valuetext', text);
  }

  // Ticks of impacts along the slider.
  marks(theme) {
    const canvas = $('marks');
    const { clock, data } = this.page;
    if (!canvas.clientWidth) return;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    const pen = canvas.getContext('2d');
    pen.fillStyle = theme.faint;
    const wide = canvas.width - 2 * EDGE * ratio;
    const drawn = new Set();
    for (const t of data.impacts.t) {
      const x = Math.round(EDGE * ratio + ((t - clock.start) / (clock.end - clock.start)) * wide);
      if (drawn.has(x)) continue;
      drawn.add(x);
      pen.fillRect(x - ratio / 2, 0, ratio, 7 * ratio);
    }
  }
}

// The last impact at or before a time; -1 if there is none.
export function lastImpact(t, time) {
  if (!t.length) return -1;
  const own = sameInstant(time);
  const i = rowAt(t, time + own);
  return t[i] <= time + own ? i : -1;
}
