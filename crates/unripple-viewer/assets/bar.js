// The colour bar under the stage: what a colour means, in round numbers with their unit.

import { css, diverging } from './colours.js';
import { watchPixels } from './map.js';
import { fieldUnit, ticks, tickTexts } from './units.js';

/** Draws the bar on a 2D context of CSS size `width` by `height`. */
export function drawBar(ctx, width, height, { full, quantity, theme, ink, font }) {
  const { factor, unit } = fieldUnit(quantity, full);
  const most = full / factor;
  const name = quantity === 'velocity' ? 'Velocity' : 'Displacement';
  ctx.font = `${font}px system-ui, sans-serif`;
  const side = 2.2 * font;
  const [left, right, top] = [side, width - side, 2];
  const thick = Math.max(8, height - 1.5 * font - 4);
  const gradient = ctx.createLinearGradient(left, 0, right, 0);
  for (let i = 0; i <= 64; i += 1) gradient.addColorStop(i / 64, css(diverging((2 * i) / 64 - 1, theme)));
  ctx.fillStyle = gradient;
  ctx.fillRect(left, top, right - left, thick);
  ctx.strokeStyle = ink;
  ctx.lineWidth = 1;
  ctx.strokeRect(left + 0.5, top + 0.5, right - left - 1, thick - 1);
  const values = ticks(-most, most, width > 30 * font ? 8 : 4);
  const texts = tickTexts(values);
  ctx.fillStyle = ink;
  ctx.textBaseline = 'top';
  ctx.textAlign = 'center';
  values.forEach((value, i) => {
    const x = left + ((value + most) / (2 * most)) * (right - left);
    ctx.fillRect(x - 0.5, top + thick, 1, 3);
    ctx.fillText(value === 0 ? `0 ${unit}` : texts[i], x, top + thick + 4);
  });
  return `${name} from −${texts[texts.length - 1]} to ${texts[texts.length - 1]} ${unit}, full scale ${most} ${unit}`;
}

/** The bar's canvas; `redraw` on a change of scale, theme or quantity. */
export class Bar {
  #size = null;

  constructor(canvas, scene) {
    this.canvas = canvas;
    this.scene = scene;
    watchPixels(canvas, (width, height, cssWidth, cssHeight) => {
      canvas.width = width;
      canvas.height = height;
      this.#size = [cssWidth, cssHeight];
      this.paint();
    });
  }

  paint() {
    if (!this.#size) return;
    const [width, height] = this.#size;
    const ctx = this.canvas.getContext('2d');
    const ratio = this.canvas.width / width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const { full, quantity, theme, inkColour } = this.scene;
    const font = parseFloat(getComputedStyle(this.canvas).fontSize) * 0.86;
    const text = drawBar(ctx, width, height, { full, quantity, theme, ink: inkColour, font });
    this.canvas.setAttribute('aria-label', `Colour scale. ${text}.`);
  }
}
