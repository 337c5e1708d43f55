// A line chart on a canvas: round ticks, units, sharp at any pixel ratio, in the colours of the theme.

import { seriesColour } from './colours.js';
import { watchPixels } from './map.js';
import { ticks, tickTexts } from './units.js';

function extent(all) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of all) {
    for (const value of values) {
      if (value === null || !Number.isFinite(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

/** A chart; see `draw`. */
export class Chart {
  #size = null;
  #last = null;

  constructor(canvas, axes) {
    this.canvas = canvas;
    this.axes = axes;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', axes.label ?? `${axes.y} against ${axes.x}`);
    watchPixels(canvas, (width, height, cssWidth, cssHeight) => {
      canvas.width = width;
      canvas.height = height;
      this.#size = [cssWidth, cssHeight];
      this.#paint();
    });
    new MutationObserver(() => this.#paint()).observe(document.documentElement, { attributeFilter: ['data-theme'] });
  }

  /** Draws series of {name, x, y, colour?, width?, dashed?}; ranges follow the data unless given; marks are {x, text}. */
  draw(data) {
    this.#last = data;
    this.#paint();
  }

  #paint() {
    if (!this.#size || !this.#last) return;
    const [width, height] = this.#size;
    const ctx = this.canvas.getContext('2d');
    const ratio = this.canvas.width / width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const style = getComputedStyle(this.canvas);
    const font = parseFloat(style.fontSize) * 0.76;
    const look = {
      font, ink: style.getPropertyValue('--ink'), quiet: style.getPropertyValue('--quiet'),
      line: style.getPropertyValue('--line'), theme: document.documentElement.dataset.theme ?? 'dark', thick: Math.max(1, font / 11.8),
    };
    ctx.font = `${font}px system-ui, sans-serif`;
    const box = { left: 0, right: width - 0.8 * font, top: 1.6 * font, bottom: height - 1.6 * font };
    const levels = this.#scales(box).ys;
    const widest = tickTexts(this.#yTicks(levels, box, font)).map((text) => ctx.measureText(text).width);
    box.left = Math.max(2.4 * font, ...widest) + 8;
    const scale = this.#scales(box);
    this.#grid(ctx, box, scale, look);
    this.#lines(ctx, box, scale, look);
  }

  #scales(box) {
    const { series, xRange, yRange } = this.#last;
    const [x0, x1] = xRange ?? extent(series.map((s) => s.x));
    let [y0, y1] = yRange ?? extent(series.map((s) => s.y));
    if (!yRange) {
      const room = 0.06 * (y1 - y0) || Math.abs(y1) || 1;
      [y0, y1] = [y0 - room, y1 + room];
    }
    const warp = this.axes.log ? (v) => Math.log10(Math.max(v, 1e-12)) : (v) => v;
    const [a, b] = [warp(x0), warp(x1)];
    return {
      xs: [x0, x1], ys: [y0, y1],
      x: (v) => box.left + ((warp(v) - a) / (b - a || 1)) * (box.right - box.left),
      y: (v) => box.bottom - ((v - y0) / (y1 - y0 || 1)) * (box.bottom - box.top),
    };
  }

  #yTicks(levels, box, font) {
    return ticks(...levels, Math.max(2, (box.bottom - box.top) / (2.4 * font)));
  }

  #xTicks([low, high], room) {
    if (!this.axes.log) return ticks(low, high, room);
    const out = [];
    for (let power = 10 ** Math.floor(Math.log10(Math.max(low, 1e-9))); power <= high; power *= 10) {
      for (const step of [1, 2, 5]) if (step * power >= low && step * power <= high) out.push(step * power);
    }
    return out;
  }

  #grid(ctx, box, scale, look) {
    const { axes } = this;
    const xs = this.#xTicks(scale.xs, Math.max(2, (box.right - box.left) / (6 * look.font)));
    const ys = this.#yTicks(scale.ys, box, look.font);
    ctx.lineWidth = 1;
    ctx.strokeStyle = look.line;
    ctx.fillStyle = look.quiet;
    ctx.beginPath();
    for (const v of xs) {
      ctx.moveTo(Math.round(scale.x(v)) + 0.5, box.top);
      ctx.lineTo(Math.round(scale.x(v)) + 0.5, box.bottom);
    }
    for (const v of ys) {
      ctx.moveTo(box.left, Math.round(scale.y(v)) + 0.5);
      ctx.lineTo(box.right, Math.round(scale.y(v)) + 0.5);
    }
    ctx.stroke();
    ctx.textBaseline = 'top';
    ctx.textAlign = 'center';
    const name = `${axes.x}${axes.xUnit ? ` ${axes.xUnit}` : ''}`;
    const title = axes.xUnit && box.right - box.left < 45 * look.font ? axes.xUnit : name;
    const limit = box.right - ctx.measureText(title).width - 1.6 * look.font;
    tickTexts(xs).forEach((text, i) => {
      if (scale.x(xs[i]) < limit) ctx.fillText(text, scale.x(xs[i]), box.bottom + 3);
    });
    ctx.textAlign = 'right';
    ctx.fillText(title, box.right, box.bottom + 3);
    ctx.textBaseline = 'middle';
    tickTexts(ys).forEach((text, i) => ctx.fillText(text, box.left - 4, scale.y(ys[i])));
    ctx.textAlign = 'left';
    ctx.textBaseline = 'top';
    ctx.fillText(`${axes.y}${axes.yUnit ? ` ${axes.yUnit}` : ''}`, 2, 1);
  }

  #lines(ctx, box, scale, look) {
    ctx.save();
    ctx.beginPath();
    ctx.rect(box.left, box.top - 2, box.right - box.left, box.bottom - box.top + 4);
    ctx.clip();
    for (const { x, text } of this.#last.marks ?? []) {
      ctx.strokeStyle = look.quiet;
      ctx.fillStyle = look.ink;
      ctx.setLineDash([3, 3]);
      ctx.beginPath();
      ctx.moveTo(scale.x(x), box.top);
      ctx.lineTo(scale.x(x), box.bottom);
      ctx.stroke();
      ctx.textAlign = scale.x(x) > (box.left + box.right) / 2 ? 'right' : 'left';
      ctx.fillText(` ${text} `, scale.x(x), box.top);
    }
    this.#last.series.forEach((series, i) => {
      ctx.setLineDash(series.dashed ? [5, 4] : []);
      ctx.lineWidth = (series.width ?? 1.5) * look.thick;
      ctx.lineJoin = 'round';
      ctx.strokeStyle = series.colour === 'currentColor' ? look.ink : series.colour ?? seriesColour(i, look.theme);
      ctx.beginPath();
      let pen = false;
      for (let k = 0; k < series.y.length; k += 1) {
        const value = series.y[k];
        if (value === null || !Number.isFinite(value)) pen = false;
        else {
          ctx[pen ? 'lineTo' : 'moveTo'](scale.x(series.x[k]), scale.y(value));
          pen = true;
        }
      }
      ctx.stroke();
    });
    ctx.restore();
  }
}
