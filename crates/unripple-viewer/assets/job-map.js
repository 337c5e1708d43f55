// Where a calibration has measured, by colour and by shape.

import { el } from './dom.js';
import { number } from './units.js';
import { fit, sharp, trace } from './outline.js';

const STATES = { done: 'measured', bad: 'bad', todo: 'to do' };
const STEPS = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 };

/** A picture of all points: a disc is measured, a cross is bad, a ring is still to be done. */
export class JobMap {
  constructor(app) {
    this.app = app;
    this.points = [];
    this.chosen = -1;
    this.canvas = el('canvas', {
      class: 'job-map', tabindex: '0', role: 'application',
      on: {
        pointermove: (event) => this.point(event),
        pointerdown: (event) => this.point(event),
        pointerleave: () => this.choose(-1),
        keydown: (event) => this.pressed(event),
        blur: () => this.choose(-1),
      },
    });
    this.read = el('p', { class: 'map-read mono', role: 'status' });
    const key = Object.entries(STATES).map(([state, text]) => el('li', {}, sample(state), ` ${text}`));
    this.legend = el('ul', { class: 'job-key', 'aria-hidden': 'true' }, ...key);
    this.bad = el('p', { class: 'is-bad', hidden: true });
    this.node = el('figure', { class: 'stack', hidden: true }, this.canvas, el('figcaption', { class: 'stack' }, this.legend, this.read, this.bad));
    app.state.subscribe('theme', () => this.paint());
    app.onShow('rig', () => this.paint());
    new ResizeObserver(() => this.paint()).observe(this.canvas);
  }

  show(quality) {
    this.points = quality?.points ?? [];
    this.node.hidden = !this.points.length;
    this.chosen = Math.min(this.chosen, this.points.length - 1);
    const bad = this.points.filter(({ state }) => state === 'bad');
    this.bad.hidden = !bad.length;
    this.bad.textContent = `Bad: ${bad.slice(0, 12).map(({ at_mm: at }) => told(at)).join('; ')}${bad.length > 12 ? ` and ${bad.length - 12} more` : ''}`;
    this.paint();
    this.tell();
  }

  counted() {
    const count = (state) => this.points.filter((point) => point.state === state).length;
    return `${this.points.length} points: ${count('done')} measured, ${count('bad')} bad, ${count('todo')} to do`;
  }

  paint() {
    const surface = this.app.state.last('surface');
    const drawing = this.points.length && surface ? sharp(this.canvas) : null;
    if (!drawing) return;
    const { ctx, width, height } = drawing;
    this.view = fit(surface.extent_mm, width, height, 12);
    const style = getComputedStyle(this.canvas);
    const colour = (name, other) => style.getPropertyValue(name).trim() || other;
    ctx.strokeStyle = colour('--edge', '#888');
    ctx.lineWidth = 1.5;
    trace(ctx, surface.rings_mm, this.view.toPx);
    ctx.stroke();
    const colours = { done: colour('--good', '#2a8'), bad: colour('--bad', '#d44'), todo: colour('--quiet', '#888') };
    const size = Math.max(2.5, Math.min(6, 0.3 * this.view.scale * this.spacing()));
    this.points.forEach(({ at_mm: at, state }, i) => {
      const [x, y] = this.view.toPx(at);
      mark(ctx, x, y, state, colours[state] ?? colours.todo, size);
      if (i !== this.chosen) return;
      ctx.strokeStyle = style.color;
      ctx.lineWidth = 2;
      ctx.strokeRect(x - size - 4, y - size - 4, 2 * size + 8, 2 * size + 8);
    });
  }

  // About how far apart points are, in mm.
  spacing() {
    const [width, height] = this.app.state.last('surface').extent_mm;
    return Math.sqrt((width * height) / this.points.length);
  }

  point(event) {
    if (!this.view) return;
    const box = this.canvas.getBoundingClientRect();
    const at = [event.clientX - box.left, event.clientY - box.top];
    let [best, least] = [-1, 20];
    this.points.forEach((point, i) => {
      const [x, y] = this.view.toPx(point.at_mm);
      const away = Math.hypot(x - at[0], y - at[1]);
      if (away < least) [best, least] = [i, away];
    });
    this.choose(best);
  }

  pressed(event) {
    const step = STEPS[event.key];
    if (!step || !this.points.length) return;
    event.preventDefault();
    this.choose((this.chosen + step + this.points.length) % this.points.length);
  }

  choose(i) {
    if (i === this.chosen) return;
    this.chosen = i;
    this.paint();
    this.tell();
  }

  tell() {
    const all = this.counted();
    this.canvas.setAttribute('aria-label', `${all}. Arrow keys read them one by one.`);
    const point = this.points[this.chosen];
    const level = Number.isFinite(point?.db) ? `, ${number(point.db)} dB` : '';
    const text = point ? `${told(point.at_mm)} mm: ${STATES[point.state] ?? point.state}${level}` : all;
    if (this.read.textContent !== text) this.read.textContent = text;
  }
}

function mark(ctx, x, y, state, colour, size) {
  ctx.strokeStyle = colour;
  ctx.fillStyle = colour;
  ctx.lineWidth = state === 'bad' ? 2.5 : 1.5;
  ctx.beginPath();
  if (state === 'bad') {
    ctx.moveTo(x - size, y - size);
    ctx.lineTo(x + size, y + size);
    ctx.moveTo(x + size, y - size);
    ctx.lineTo(x - size, y + size);
    ctx.stroke();
    return;
  }
  ctx.arc(x, y, size, 0, 2 * Math.PI);
  if (state === 'done') ctx.fill();
  else ctx.stroke();
}

function sample(state) {
  return el('span', { class: `job-sample is-${state}` }, { done: '●', bad: '✕', todo: '○' }[state]);
}

function told(at) {
  return at.map((value) => String(Math.round(value * 10) / 10)).join(', ');
}
