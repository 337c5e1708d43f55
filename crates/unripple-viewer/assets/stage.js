// The stage: one or two panes, each a map and a relief of the same frames, painted once per animation frame.

import { Bar } from './bar.js';
import { el, setText } from './dom.js';
import { FieldMap } from './map.js';
import { ink } from './marks.js';
import { Relief } from './relief.js';
import { Scale } from './scale.js';
import { Sheet } from './sheet.js';
import { fieldValue, fixed, seconds } from './units.js';

const CALM_MS = 500;
// What takes no longer is not told; a wait of 0.1 s is noticed.
const NOTICED_MS = 60;
const GROUNDS = { dark: '#151a21', light: '#ffffff' };

/** Whether a picture that waits to be painted is worth more than a newer one: of the strongest instants of real time the stronger. */
function outdoes(waiting, newer) {
  return Boolean(waiting?.strobed && newer.strobed && waiting.time_s <= newer.time_s && waiting.peak > newer.peak);
}

/** Everything that is shown of the field. Serves as `app.map` and as the scene of its panes. */
export class Stage {
  layers = [];
  panes = 1;
  theme = 'dark';
  probes = [];
  levels = new Map();
  cursor = null;
  pressing = false;
  /** Strongest drive of late, as a share of the limit. */
  driven = 0;
  sheet = null;
  #scale = new Scale();
  #fresh = new Map();
  #wanted = false;
  #font = 16;
  #calmUntil = 0;
  #calmTimer = null;
  #built = 0;
  #strongest = 0;
  #still = matchMedia('(prefers-reduced-motion: reduce)');
  #faulty = new WeakSet();

  constructor(app, cost) {
    this.app = app;
    this.cost = cost;
    this.box = document.getElementById('panes');
    this.figures = [0, 1].map((i) => document.getElementById(`pane-${i}`));
    this.maps = [0, 1].map((i) => new FieldMap(document.getElementById(`map-${i}`), i, this));
    this.reliefs = [0, 1].map((i) => new Relief(document.getElementById(`relief-${i}`), i, this));
    this.bar = new Bar(document.getElementById('bar'), this);
    this.held = () => [];
    this.#controls();
    const measure = () => {
      this.#font = parseFloat(getComputedStyle(document.documentElement).fontSize) || 16;
      this.redraw();
    };
    addEventListener('resize', measure);
    measure();
    const { state } = app;
    state.subscribe('surface', (message) => this.#setSurface(message));
    state.subscribe('settings', (message) => {
      this.probes = message.probes ?? [];
      this.redraw();
    });
    state.subscribe('status', ({ fingers }) => {
      this.levels = new Map((fingers ?? []).map((f) => [f.id, f.level_db]));
    });
    state.subscribe('building', ({ on }) => this.#building(on));
    state.subscribe('compare', () => this.#label());
    state.subscribe('theme', ({ name }) => this.#setTheme(name));
    this.show(state.ui.view === 'relief' ? 'relief' : 'map');
  }

  get full() {
    return this.#scale.full;
  }

  get quantity() {
    return this.frame(0)?.head.quantity ?? this.app.state.last('settings')?.quantity ?? 'displacement';
  }

  get ground() {
    return GROUNDS[this.theme];
  }

  /** The page's type size in CSS pixels, which drawings follow. */
  get font() {
    return this.#font;
  }

  /** Widths of lines grow with the type, so that a wall is read from afar. */
  get line() {
    return Math.max(1, this.#font / 15.5);
  }

  get inkColour() {
    return ink(this.theme);
  }

  frame(pane = 0) {
    return this.maps[pane].frame;
  }

  /** Which trace colour a probe has: its place among the frame's traces. */
  probeColour = (probe) => {
    const at = (this.frame(0)?.traces ?? []).findIndex((trace) => trace.name === `probe ${probe.id}`);
    return at < 0 ? probe.id : at;
  };

  /** Radius in mm of a finger's ring: it grows with the force, by its share of the strongest of late. */
  reach = ({ force_n }) => 3.5 + (this.#strongest > 0 ? 3 * Math.sqrt(Math.min(1, Math.abs(force_n ?? 0) / this.#strongest)) : 0);

  /** Lets the colours follow what is shown at once, and not after a while, as where all of it is known to be weaker from now on. */
  rescale() {
    if (!this.#scale.held) this.#scale.reset();
  }

  /** Draws something over the maps; returns how to remove it. */
  addLayer(layer) {
    this.layers.push(layer);
    this.redraw();
    return () => {
      this.layers = this.layers.filter((other) => other !== layer);
      this.redraw();
    };
  }

  faulty(layer, error) {
    if (this.#faulty.has(layer)) return;
    this.#faulty.add(layer);
    console.error('a layer of the map:', error);
    this.app.toast(`Something drawn on the map failed: ${error.message}`, 'fault');
  }

  /** The field last shown in a pane, in metres or m/s. */
  field(pane = 0) {
    const frame = this.frame(pane);
    if (!frame || !this.sheet) return null;
    const { columns, rows, head } = frame;
    const [left, bottom, width, height] = this.sheet.cover();
    const at_mm = (i) => [
      left + ((i % columns) + 0.5) * (width / columns), bottom + (Math.floor(i / columns) + 0.5) * (height / rows),
    ];
    const values = Float32Array.from(frame.values, (count) => count * head.scale);
    return { columns, rows, values, time_s: head.time_s, quantity: head.quantity, at_mm };
  }

  /** Takes a frame; it is painted with the next animation frame unless a better one comes first. */
  take(frame) {
    if (frame.pane > 1) return;
    if (!outdoes(this.#fresh.get(frame.pane)?.head, frame.head)) this.#fresh.set(frame.pane, frame);
    const wait = this.#calmUntil - performance.now();
    if (wait <= 0) this.redraw();
    else if (this.#calmTimer === null) this.#calmTimer = setTimeout(() => this.redraw(), wait);
  }

  /** Where a person asked for less motion, pulses in real time must not flash: two pictures a second. */
  #calm() {
    const settings = this.app.state.last('settings');
    const live = settings?.speed === 1 && !settings.paused;
    this.#calmUntil = live && this.#still.matches ? performance.now() + CALM_MS : 0;
    clearTimeout(this.#calmTimer);
    this.#calmTimer = null;
  }

  redraw() {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame((now) => this.#paint(now));
  }

  /** Shows the map or the relief. */
  show(name) {
    this.view = name;
    this.app.state.ui.view = name;
    for (const [i, map] of this.maps.entries()) {
      map.canvas.hidden = name !== 'map';
      this.reliefs[i].show(name === 'relief');
    }
    for (const other of ['map', 'relief']) {
      document.getElementById(`view-${other}`).setAttribute('aria-pressed', String(other === name));
    }
    this.app.state.publish('view', { name });
    this.redraw();
  }

  #controls() {
    for (const name of ['map', 'relief']) {
      document.getElementById(`view-${name}`).addEventListener('click', () => this.show(name));
    }
    const hold = document.getElementById('hold-scale');
    hold.addEventListener('click', () => {
      this.#scale.held = !this.#scale.held;
      hold.setAttribute('aria-pressed', String(this.#scale.held));
    });
  }

  #setSurface(message) {
    this.sheet = new Sheet(message);
    for (const map of this.maps) map.setSheet(this.sheet);
    for (const relief of this.reliefs) relief.setSheet(this.sheet);
    this.#fresh.clear();
    this.#scale.reset();
    const { width, height } = this.sheet;
    this.box.style.setProperty('--aspect', String(Math.min(2, Math.max(0.35, height / width))));
    for (const map of this.maps) {
      map.canvas.setAttribute('aria-label',
        `Surface ${message.name}, ${fixed(width, 0)} by ${fixed(height, 0)} mm. Press to send waves to a place.`);
    }
    this.redraw();
  }

  /** Says that what is drawn does not play yet, if that takes longer than is noticed. */
  #building(on) {
    clearTimeout(this.#built);
    const say = (shown) => { document.getElementById('building').hidden = !shown; };
    if (on) this.#built = setTimeout(say, NOTICED_MS, true);
    else say(false);
  }

  #setTheme(name) {
    this.theme = name;
    this.bar.paint();
    this.redraw();
  }

  #setPanes(count) {
    if (this.panes === count) return;
    this.panes = count;
    this.figures[1].hidden = count < 2;
    this.box.classList.toggle('two', count > 1);
  }

  #paint(now) {
    this.#wanted = false;
    const started = performance.now();
    const due = this.#calmUntil <= started;
    const fresh = due ? [...this.#fresh.values()] : [];
    if (fresh.length > 0) {
      this.#fresh.clear();
      this.#accept(fresh, now);
      this.#calm();
    }
    this.paintNow();
    if (fresh.length > 0) this.cost.drawn(performance.now() - started, fresh.length);
  }

  /** Paints what is shown at once, as a picture of a relief needs. */
  paintNow() {
    for (const pane of (this.view === 'relief' ? this.reliefs : this.maps).slice(0, this.panes)) pane.paint();
  }

  #accept(fresh, now) {
    this.#setPanes(Math.max(...fresh.map((frame) => frame.panes)));
    for (const frame of fresh) {
      this.maps[frame.pane].frame = frame;
      const forces = (frame.head.fingers ?? []).map((finger) => Math.abs(finger.force_n ?? 0));
      this.#strongest = Math.max(0.995 * this.#strongest, ...forces);
      this.driven = Math.max(0.995 * this.driven, ...(frame.head.drive ?? []).map(Math.abs), 1e-9);
    }
    const peak = Math.max(...fresh.map((frame) => frame.head.peak ?? 0));
    if (this.#scale.take(peak, this.quantity, now)) this.bar.paint();
    this.#label();
    for (const frame of fresh) this.app.state.publish('frame', frame);
  }

  #label() {
    const methods = this.app.state.last('compare')?.panes?.map((pane) => pane.method) ?? [];
    for (let i = 0; i < this.panes; i += 1) {
      const frame = this.frame(i);
      const box = this.figures[i].querySelector('.pane-label');
      if (!box.firstChild) box.append(el('b'), el('span'));
      setText(box.firstChild, this.panes > 1 ? methods[i] ?? `Pane ${i + 1}` : '');
      const peak = frame?.head.peak > 0 ? `peak ${this.peakText(frame)}` : '';
      setText(box.lastChild, peak && frame.head.strobed ? `${peak}, strongest since the last picture` : peak);
    }
  }

  /** A frame's peak with its unit. */
  peakText({ head }) {
    return fieldValue(head.quantity, head.peak ?? 0);
  }

  /** One line that says what is seen, for a picture's caption. */
  caption() {
    const surface = this.app.state.last('surface');
    const settings = this.app.state.last('settings');
    const head = this.frame(0)?.head;
    const at = head ? `t = ${seconds(head.time_s, 5)}` : '';
    return [surface?.name, settings?.method, this.quantity, at].filter(Boolean).join(', ');
  }
}
