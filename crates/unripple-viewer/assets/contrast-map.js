// Contrast predicted at every place of the surface, as a picture with a colour bar.

import { el } from './dom.js';
import { sequential } from './colours.js';
import { number } from './units.js';
import { fit, sharp, trace } from './outline.js';

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** A map of `contrast` in cells; place and value are shown for the pointer and, by arrow keys, for a cross. */
export class ContrastMap {
  constructor(app) {
    this.app = app;
    this.map = null;
    this.surface = null;
    this.cell = null;
    this.range = null;
    this.canvas = el('canvas', {
      class: 'contrast-map', tabindex: '0', role: 'application', 'aria-label': 'Map of contrast: no values yet',
      on: {
        pointermove: (event) => this.point(event),
        pointerdown: (event) => this.point(event),
        pointerleave: () => this.look(null),
        keydown: (event) => this.pressed(event),
        blur: () => this.look(null),
      },
    });
    this.bar = el('canvas', { class: 'colour-bar', 'aria-hidden': 'true' });
    this.low = el('span', {});
    this.high = el('span', {});
    this.read = el('p', { class: 'map-read mono', role: 'status' });
    this.over = el('input', { type: 'checkbox', on: { change: () => this.lay() } });
    this.over.checked = Boolean(app.state.ui.design_overlay);
    this.node = el('figure', { class: 'contrast-figure' },
      this.canvas,
      el('figcaption', { class: 'stack' },
        el('div', { class: 'bar-row mono' }, this.low, this.bar, this.high),
        this.read,
        el('label', { class: 'check' }, this.over, ' lay it over the large map')));
    app.map.addLayer({ draw: (ctx, view) => this.drawOver(ctx, view) });
    app.state.subscribe('theme', () => this.paint());
    app.onShow('design', () => this.paint());
    new ResizeObserver(() => this.paint()).observe(this.canvas);
  }

  /** Takes the map of a `design` message, and the surface it belongs to. */
  show(map, surface) {
    this.map = map ?? null;
    this.surface = surface ?? this.surface;
    this.paint();
    if (this.over.checked) this.app.map.redraw();
  }

  lay() {
    this.app.state.ui.design_overlay = this.over.checked;
    this.app.map.redraw();
  }

  // The scale stays while it fits, so that the picture before and after an edit can be compared by colour.
  // It follows the values away from the rim, where next to nothing moves, and leaves their outliers beyond its ends.
  rescale(values) {
    const away = clearOfRim(this.map, this.surface.rings_mm);
    const sorted = [...(away.length ? away : values)].sort((a, b) => a - b);
    const [least, most] = [0.02, 0.98].map((share) => sorted[Math.round(share * (sorted.length - 1))]);
    const kept = this.range && least >= this.range[0] && most <= this.range[1]
      && most - least > 0.4 * (this.range[1] - this.range[0]);
    if (kept) return;
    const unit = niceStep((most - least || most || 1) / 4);
    const low = Math.floor(least / unit) * unit;
    this.range = [low, Math.max(low + unit, Math.ceil(most / unit) * unit)];
  }

  paint() {
    const values = this.map?.contrast?.filter((value) => Number.isFinite(value)) ?? [];
    if (!values.length || !this.surface) {
      this.picture = null;
      sharp(this.canvas);
      sharp(this.bar);
      this.tell();
      return;
    }
    this.rescale(values);
    const sorted = [...values].sort((a, b) => a - b);
    this.spread = { least: sorted[0], median: sorted[sorted.length >> 1], most: sorted.at(-1) };
    this.picture = this.colour();
    this.paintMap();
    this.paintBar();
    const { least, median, most } = this.spread;
    this.canvas.setAttribute('aria-label',
      `Map of contrast: smallest ${number(least)}, median ${number(median)}, largest ${number(most)}. Arrow keys read it place by place.`);
    this.tell();
  }

  get theme() {
    return this.app.state.last('theme')?.name ?? 'dark';
  }

  colour() {
    const { columns, rows, contrast } = this.map;
    const picture = document.createElement('canvas');
    picture.width = columns;
    picture.height = rows;
    const image = new ImageData(columns, rows);
    const [low, high] = this.range;
    contrast.forEach((value, i) => {
      if (!Number.isFinite(value)) return;
      const row = rows - 1 - Math.floor(i / columns);
      const rgb = sequential((value - low) / (high - low), this.theme);
      image.data.set([...rgb, 255], 4 * (row * columns + (i % columns)));
    });
    picture.getContext('2d').putImageData(image, 0, 0);
    return picture;
  }

  // Corner of the picture, and its size, in px of a view.
  corners(toPx) {
    const { columns, rows, origin_mm: [x, y], pitch_mm: [px, py] } = this.map;
    const [left, top] = toPx([x - px / 2, y + (rows - 0.5) * py]);
    const [right, bottom] = toPx([x + (columns - 0.5) * px, y - py / 2]);
    return [left, top, right - left, bottom - top];
  }

  paintMap() {
    const drawing = sharp(this.canvas);
    if (!drawing) return;
    const { ctx, width, height } = drawing;
    const { extent_mm: extent, rings_mm: rings, actuators } = this.surface;
    this.view = fit(extent, width, height, 6);
    const style = getComputedStyle(this.canvas);
    ctx.save();
    trace(ctx, rings, this.view.toPx);
    ctx.clip('evenodd');
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(this.picture, ...this.corners(this.view.toPx));
    ctx.restore();
    ctx.strokeStyle = style.color;
    ctx.lineWidth = 1;
    trace(ctx, rings, this.view.toPx);
    ctx.stroke();
    for (const { at_mm: at } of actuators) {
      const [x, y] = this.view.toPx(at);
      ctx.fillStyle = style.backgroundColor;
      ctx.fillRect(x - 4, y - 4, 8, 8);
      ctx.strokeRect(x - 4, y - 4, 8, 8);
    }
    if (this.cell) this.cross(ctx, style);
  }

  cross(ctx, style) {
    const [x, y] = this.view.toPx(this.at(this.cell));
    for (const [colour, width] of [[style.backgroundColor, 4], [style.color, 1.5]]) {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width;
      ctx.beginPath();
      ctx.arc(x, y, 7, 0, 2 * Math.PI);
      ctx.stroke();
    }
  }

  paintBar() {
    const drawing = sharp(this.bar);
    if (!drawing) return;
    const { ctx, width, height } = drawing;
    for (let x = 0; x < width; x++) {
      const [r, g, b] = sequential(x / Math.max(1, width - 1), this.theme);
      ctx.fillStyle = `rgb(${r}, ${g}, ${b})`;
      ctx.fillRect(x, 0, 1, height);
    }
    const { least, most } = this.spread;
    this.low.textContent = `${least < this.range[0] ? '≤ ' : ''}${number(this.range[0])}`;
    this.high.textContent = `${most > this.range[1] ? '≥ ' : ''}${number(this.range[1])}`;
  }

  drawOver(ctx, view) {
    if (!this.over.checked || this.app.shown() !== 'design' || !this.picture) return;
    ctx.globalAlpha = 0.72;
    trace(ctx, this.surface.rings_mm, view.toPx);
    ctx.clip('evenodd');
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(this.picture, ...this.corners(view.toPx));
  }

  at([column, row]) {
    const { origin_mm: [x, y], pitch_mm: [px, py] } = this.map;
    return [x + column * px, y + row * py];
  }

  point(event) {
    if (!this.map || !this.view) return;
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = this.view.toMm([event.clientX - box.left, event.clientY - box.top]);
    const { columns, rows, origin_mm: origin, pitch_mm: pitch } = this.map;
    const column = Math.round((x - origin[0]) / pitch[0]);
    const row = Math.round((y - origin[1]) / pitch[1]);
    this.look(column >= 0 && row >= 0 && column < columns && row < rows ? [column, row] : null);
  }

  pressed(event) {
    const step = STEPS[event.key];
    if (!step || !this.map) return;
    event.preventDefault();
    const { columns, rows } = this.map;
    const [column, row] = this.cell ?? [columns >> 1, rows >> 1];
    this.look([
      Math.min(columns - 1, Math.max(0, column + step[0])),
      Math.min(rows - 1, Math.max(0, row + step[1])),
    ]);
  }

  look(cell) {
    this.cell = cell;
    if (this.picture) this.paintMap();
    this.tell();
  }

  tell() {
    if (!this.map || !this.picture) {
      this.read.textContent = 'no values yet';
      return;
    }
    if (this.cell) {
      const value = this.map.contrast[this.cell[1] * this.map.columns + this.cell[0]];
      const [x, y] = this.at(this.cell).map((each) => each.toFixed(0));
      this.read.textContent = Number.isFinite(value) ? `contrast ${number(value)} at ${x}, ${y} mm` : `nothing at ${x}, ${y} mm`;
      return;
    }
    const { least, median, most } = this.spread;
    this.read.textContent = `smallest ${number(least)} · median ${number(median)} · largest ${number(most)}`;
  }
}

function niceStep(rough) {
  const unit = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find((each) => each * unit >= rough) * unit;
}

// The finite values of a map whose cells lie more than three quarters of a cell from every rim.
function clearOfRim({ columns, contrast, origin_mm: [x0, y0], pitch_mm: [px, py] }, rings) {
  const least = 0.75 * Math.max(px, py);
  return contrast.filter((value, i) => Number.isFinite(value)
    && rimAway([x0 + (i % columns) * px, y0 + Math.floor(i / columns) * py], rings) > least);
}

function rimAway([x, y], rings) {
  let least = Infinity;
  for (const ring of rings) {
    ring.forEach(([ax, ay], i) => {
      const [bx, by] = ring[(i + 1) % ring.length];
      const [dx, dy] = [bx - ax, by - ay];
      const along = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
      least = Math.min(least, Math.hypot(x - ax - along * dx, y - ay - along * dy));
    });
  }
  return least;
}
