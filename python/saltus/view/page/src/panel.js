// The panel: plots, the last impact as a table, what is shown, cameras.

import { ARROWS } from './colours.js';
import { $, lastImpact } from './bar.js';
import { Plot, energiesOf, short, valueAt } from './plots.js';

const ROWS = 8; // impulses in the table

// What each does; then, where they differ, the key and what it does while the model is simulated.
const KEYS = [
  ['Space', 'play, pause'],
  ['← →', 'a frame back, on', '→', 'a step'],
  ['Shift ← →', 'the impact before, after', null],
  ['Home End', 'to the start, the end', null],
  ['[ ]', 'slower, faster'],
  ['1 2 3 4', 'corner, front, side, top'],
  ['F', 'the whole scene'],
  ['C', 'collision shapes, visuals, both'],
  ['N', 'names'],
  ['T', 'light, dark'],
  ['P', 'this panel'],
  ['Double click', 'follow a body'],
];

export class Panel {
  constructor(page) {
    this.page = page;
    this.impact = null;
    this.keys();
    this.energies();
    this.gaps();
    this.shown();
    this.cameras();
    this.legend();
  }

  keys() {
    const live = this.page.data.mode === 'live';
    for (const [key, what, liveKey = key, liveWhat = what] of KEYS) {
      if (live && !liveKey) continue;
      const term = document.createElement('dt');
      const text = document.createElement('dd');
      term.textContent = live ? liveKey : key;
      text.textContent = live ? liveWhat : what;
      $('keys').append(term, text);
    }
  }

  energies() {
    const { data, clock } = this.page;
    this.energy = energiesOf(data);
    const curves = () =>
      ['kinetic', 'potential', 'total'].map((name) => ({ x: this.energy.x, y: this.energy[name] }));
    this.energyPlot = new Plot($('energies'), 'J', curves, clock);
  }

  gaps() {
    const { data, clock } = this.page;
    const { pairs, phi } = data.gaps;
    $('gap-box').hidden = !pairs.length;
    pairs.forEach((name, i) => $('pair').add(new Option(name, i)));
    const column = () => {
      const k = Number($('pair').value || 0);
      return { x: data.t, phi: Array.from(data.t, (_, row) => phi[row * pairs.length + k]) };
    };
    this.gap = phi.length ? column() : { x: [], phi: [] };
    const rounding = 1e-6 * this.page.bounds.radius;
    this.gapPlot = new Plot($('gap'), 'm', () => [{ x: this.gap.x, y: this.gap.phi }], clock, rounding);
    $('pair').onchange = () => {
      this.gap = column();
      this.gapPlot.redraw(this.page.theme);
      this.place();
    };
  }

  shown() {
    const { page } = this;
    const both = page.items.has('visual') && page.items.has('collision');
    $('bodies').hidden = !both;
    for (const radio of document.querySelectorAll('input[name="bodies"]')) {
      radio.onchange = () => page.showBodies(radio.value);
    }
    const boxes = {
      impulse: (on) => (page.arrows.shown.impulse = on),
      normal: (on) => (page.arrows.shown.normal = on),
      force: (on) => (page.arrows.shown.force = on),
      thread: () => page.showThreads(),
      frame: (on) => page.items.show('frame', on),
      names: (on) => page.labels.show(on),
      grid: (on) => page.ground.showGrid(on),
      shadow: (on) => (page.stage.sun.castShadow = on),
    };
    for (const [name, set] of Object.entries(boxes)) {
      const box = $(`show-${name}`);
      box.onchange = () => {
        set(box.checked);
        page.moved();
      };
    }
    $('show-shadow').checked = page.stage.sun.castShadow;
    const live = page.data.mode === 'live';
    const { impulse, force } = page.arrows.largest;
    $('show-force').parentElement.hidden = !force && !live;
    $('show-impulse').parentElement.hidden = !impulse && !live;
    $('show-normal').parentElement.hidden = !impulse && !live;
    $('show-thread').parentElement.hidden =
      !page.items.has('thread') && !page.items.has('thread of shapes');
    page.items.show('frame', false);
    if (!page.data.items.length) $('show-frame').click();
  }

  cameras() {
    const { page } = this;
    for (const button of document.querySelectorAll('[data-view]')) {
      button.onclick = () => page.look(button.dataset.view);
    }
    $('fit').onclick = () => page.look(null);
    $('follow').add(new Option('nothing', ''));
    page.data.bodies.forEach((name, i) => $('follow').add(new Option(name, i)));
    $('follow').onchange = () => page.follow($('follow').value === '' ? null : Number($('follow').value));
  }

  legend() {
    const { arrows } = this.page;
    const words = [];
    const unit = (value, symbol) => `${short(Number(value.toPrecision(3)))} ${symbol}`;
    if (arrows.largest.impulse) {
      words.push([ARROWS.impulse, `impulse, longest ${unit(arrows.largest.impulse, 'N s')}`]);
      words.push([ARROWS.normal, 'contact normal']);
    }
    if (arrows.largest.force) {
      words.push([ARROWS.force, `contact force, longest ${unit(arrows.largest.force, 'N')}`]);
    }
    const ground = this.page.ground.grids.length ? this.page.ground.width : 0;
    if (ground) words.push([null, `squares of ${short(ground)} m`]);
    $('legend').replaceChildren();
    for (const [colour, text] of words) {
      const item = document.createElement('li');
      if (colour) {
        const mark = document.createElement('i');
        mark.style.background = colour;
        item.append(mark);
      }
      item.append(text);
      $('legend').append(item);
    }
  }

  setTheme() {
    this.energyPlot.redraw(this.page.theme);
    this.gapPlot.redraw(this.page.theme);
    this.place();
  }

  // Numbers and cursors at the time now.
  place() {
    const { clock, theme } = this.page;
    const { energy } = this;
    const [T, V, H] = ['kinetic', 'potential', 'total'].map((name) =>
      valueAt(energy.x, energy[name], clock.time),
    );
    const rounding = 1e-12 * Math.max(Math.abs(T), Math.abs(V));
    const value = (x) => (Math.abs(x) < rounding ? '0' : short(Number(x.toPrecision(4))));
    key($('energy-line'), theme.curves, [
      ['kinetic', value(T)],
      ['potential', value(V)],
      ['total', `${value(H)} J`],
    ]);
    this.energyPlot.cursor();
    if (this.gap.x.length) {
      const phi = valueAt(this.gap.x, this.gap.phi, clock.time);
      const touches = Math.abs(phi) < 1e-9 * this.page.bounds.radius; // a gap of rounding
      key($('gap-line'), theme.curves, [['φ', `${touches ? 0 : short(Number(phi.toPrecision(4)))} m`]]);
      this.gapPlot.cursor();
    }
    this.impacts();
  }

  impacts() {
    const { data, clock } = this.page;
    const { t, first, certificates } = data.impacts;
    const i = lastImpact(t, clock.time);
    if (i === this.impact) return;
    this.impact = i;
    const count = t.length;
    $('impact-title').textContent = i < 0 ? `Impacts: ${count}` : `Impact ${i + 1} of ${count}`;
    if (i < 0) {
      this.impactTable(count ? `the first at ${t[0].toFixed(6)} s` : 'none in this run', []);
      return;
    }
    const { pairs, pair, lambda } = data.impulses;
    const rows = Array.from(pair.subarray(first[i], first[i + 1]), (number, k) => [
      pairs[number], lambda[first[i] + k],
    ]);
    this.impactTable(impactWords(t[i], certificates[i]), rows);
  }

  // rows: [[pair, impulse]] of one impact.
  impactTable(words, rows) {
    $('impact-line').textContent = words;
    const table = $('impact-table');
    table.hidden = !rows.length;
    const digits = (x) => (x < 1e-3 ? x.toExponential(3) : Number(x.toPrecision(4)));
    const cells = rows.slice(0, ROWS).map(([pair, lambda]) => [pair, digits(lambda)]);
    if (rows.length > ROWS) cells.push([`… ${rows.length - ROWS} more`, '']);
    table.tBodies[0].replaceChildren(...cells.map(tableRow));
  }
}

export function impactWords(t, certificate) {
  return [`t = ${t.toFixed(6)} s`, certificate].filter(Boolean).join('; ');
}

function tableRow(cells) {
  const row = document.createElement('tr');
  for (const text of cells) row.insertCell().textContent = text;
  return row;
}

function key(element, colours, entries) {
  while (element.children.length < entries.length) element.append(document.createElement('span'));
  entries.forEach(([name, value], k) => {
    const span = element.children[k];
    const text = `${name} ${value}`;
    if (span.textContent !== text) span.textContent = text;
    span.style.setProperty('--colour', colours[k]);
    span.style.setProperty('--line', ['solid', 'dashed', 'dotted'][k]);
  });
}
