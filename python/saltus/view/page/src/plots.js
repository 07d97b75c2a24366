// Small plots over time with a cursor: energies, and the gap of a pair.

import { rowAt } from './motion.js';

const PAD = { left: 46, right: 8, top: 8, bottom: 18 };
const DASHES = [[], [6, 3], [2, 2]]; // curves differ by more than colour

export class Plot {
  // curves: () => [{ x, y }]; x and y are arrays of equal length.
  constructor(canvas, unit, curves, clock, least = 0) {
    this.least = least; // what is smaller is rounding
    this.canvas = canvas;
    this.unit = unit;
    this.curves = curves;
    this.clock = clock;
    this.picture = null; // the curves without the cursor
    const scrub = (event) => {
      const part = (event.offsetX - PAD.left) / (this.width - PAD.left - PAD.right);
      clock.pause();
      clock.seek(this.from + part * (this.to - this.from));
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      scrub(event);
    });
    canvas.addEventListener('pointermove', (event) => event.buttons && scrub(event));
  }

  get width() {
    return this.canvas.clientWidth;
  }

  // Draws the curves anew: after a change of data, size or theme.
  redraw(theme) {
    const { canvas } = this;
    if (!canvas.clientWidth) return; // hidden
    this.theme = theme;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    this.picture = new OffscreenCanvas(canvas.width, canvas.height);
    const pen = this.picture.getContext('2d');
    pen.scale(ratio, ratio);
    this.box = { w: canvas.clientWidth, h: canvas.clientHeight };
    this.from = this.clock.start;
    this.to = Math.max(this.clock.end, this.from + 1e-9);
    const all = this.curves();
    this.range(all);
    this.axes(pen);
    all.forEach((curve, k) => this.curve(pen, curve, k));
    this.cursor();
  }

  range(all) {
    let low = Infinity;
    let high = -Infinity;
    for (const { y } of all) {
      for (const value of y) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (!(low <= high)) [low, high] = [0, 1];
    const least = Math.max(this.least, 1e-6 * Math.max(Math.abs(low), Math.abs(high)));
    if (high - low < least) [low, high] = [(low + high - least) / 2, (low + high + least) / 2];
    const room = 0.06 * (high - low) || 1;
    this.low = low - room;
    this.high = high + room;
  }

  x(t) {
    const wide = this.box.w - PAD.left - PAD.right;
    return PAD.left + ((t - this.from) / (this.to - this.from)) * wide;
  }

  y(value) {
    const tall = this.box.h - PAD.top - PAD.bottom;
    return PAD.top + ((this.high - value) / (this.high - this.low)) * tall;
  }

  axes(pen) {
    const { w, h } = this.box;
    pen.font = '11px system-ui, sans-serif';
    pen.fillStyle = this.theme.faint;
    pen.strokeStyle = this.theme.grid;
    pen.globalAlpha = 0.35;
    pen.lineWidth = 1;
    const steps = ticks(this.low, this.high, 3);
    for (const value of steps) line(pen, PAD.left, this.y(value), w - PAD.right, this.y(value));
    pen.globalAlpha = 1;
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (const value of steps) pen.fillText(label(value, steps), PAD.left - 5, this.y(value));
    pen.textAlign = 'center';
    pen.textBaseline = 'bottom';
    const times = ticks(this.from, this.to, 4);
    for (const t of times) pen.fillText(label(t, times), this.x(t), h - 2);
    pen.textAlign = 'left';
    pen.fillText(this.unit, 2, h - 2);
  }

  curve(pen, { x, y }, k) {
    pen.strokeStyle = this.theme.curves[k % 3];
    pen.setLineDash(DASHES[k % 3]);
    pen.lineWidth = 1.5;
    pen.beginPath();
    // No more points than columns can show: of each column the lowest and the highest.
    const columns = Math.max(Math.round(this.box.w), 1);
    if (x.length <= 4 * columns) {
      for (let i = 0; i < x.length; i++) pen.lineTo(this.x(x[i]), this.y(y[i]));
    } else {
      const block = x.length / (2 * columns);
      for (let c = 0; c < 2 * columns; c++) {
        let [least, most] = [Infinity, -Infinity];
        const begin = Math.floor(c * block);
        for (let i = begin; i < Math.min(begin + Math.ceil(block), x.length); i++) {
          least = Math.min(least, y[i]);
          most = Math.max(most, y[i]);
        }
        const at = this.x(x[begin]);
        pen.lineTo(at, this.y(c % 2 ? least : most));
        pen.lineTo(at, this.y(c % 2 ? most : least));
      }
    }
    pen.stroke();
    pen.setLineDash([]);
  }

  // The curves as they were drawn, and a line at the time now.
  cursor() {
    if (!this.picture) return;
    const pen = this.canvas.getContext('2d');
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.drawImage(this.picture, 0, 0);
    const ratio = window.devicePixelRatio || 1;
    pen.scale(ratio, ratio);
    pen.strokeStyle = '#e8481c';
    pen.lineWidth = 1.5;
    const at = this.x(Math.min(this.clock.time, this.to)); // a live page draws curves now and then
    line(pen, at, PAD.top - 4, at, this.box.h - PAD.bottom + 4);
  }
}

function line(pen, x0, y0, x1, y1) {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

export function ticks(low, high, about) {
  const raw = (high - low) / about;
  if (!(raw > 0)) return [];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((each) => each >= raw) ?? raw;
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  return found;
}

export function short(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(0).replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}

// A label of one of several ticks, where four digits do not tell them apart by how far it is from
// the first: "1e9", "+0.5".
export function label(value, all) {
  const apart = new Set(all.map(short)).size === all.length;
  if (apart || value === all[0]) return short(value);
  return `+${short(value - all[0])}`;
}

// Values of the last seconds, for a program that goes on: { x, and a list of each name }.
export class Recent {
  constructor(span, ...names) {
    this.span = span;
    this.names = ['x', ...names];
    this.forget();
  }

  forget() {
    for (const name of this.names) this[name] = [];
  }

  // Adds values at a time; a time again replaces what was there.
  add(t, ...values) {
    const again = this.x.at(-1) === t;
    [t, ...values].forEach((value, i) => {
      const own = this[this.names[i]];
      if (again) own.pop();
      own.push(value);
    });
    const old = this.x.findIndex((time) => time >= t - this.span);
    if (old > 0) for (const name of this.names) this[name].splice(0, old);
  }
}

// Energies with two values at impacts, before and after: { x, kinetic, potential, total }.
export function energiesOf(data) {
  const { t, kinetic, potential, impacts } = data;
  const before = new Map();
  impacts.instant.forEach((row, i) => {
    if (!before.has(row)) before.set(row, impacts.kinetic_before[i]);
  });
  const x = [];
  const rows = { kinetic: [], potential: [], total: [] };
  const add = (time, T, V) => {
    x.push(time);
    rows.kinetic.push(T);
    rows.potential.push(V);
    rows.total.push(T + V);
  };
  for (let i = 0; i < t.length; i++) {
    if (before.has(i)) add(t[i], before.get(i), potential[i]);
    add(t[i], kinetic[i], potential[i]);
  }
  return { x, ...rows };
}

// Value at a time, by a straight line between samples; at a jump the later one.
export function valueAt(x, y, time) {
  if (!x.length) return NaN;
  const i = rowAt(x, time);
  if (i + 1 >= x.length || x[i + 1] === x[i]) return y[i];
  const part = Math.min(Math.max((time - x[i]) / (x[i + 1] - x[i]), 0), 1);
  return y[i] + part * (y[i + 1] - y[i]);
}
