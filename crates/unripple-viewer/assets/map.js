// A colour map of the surface on a canvas, with everything that belongs to it. One per pane.

import { divergingPixels } from './colours.js';
import {
  drawActuators, drawCursor, drawFingers, drawOutline, drawProbes, drawScaleBar, drawTargets, ink,
} from './marks.js';
import { Smooth } from './smooth.js';

const MOST_PIXELS = 384;

/** Follows the size of an element in device pixels and calls back when it changes. */
export function watchPixels(canvas, changed) {
  const observer = new ResizeObserver(([entry]) => {
    const ratio = devicePixelRatio || 1;
    const [wide, high] = [entry.contentRect.width * ratio, entry.contentRect.height * ratio];
    // Some browsers tell the box in CSS pixels while they emulate another screen: then the ratio is right.
    const box = entry.devicePixelContentBoxSize?.[0];
    const exact = box && Math.abs(box.inlineSize - wide) < 2 && Math.abs(box.blockSize - high) < 2;
    const [width, height] = exact ? [box.inlineSize, box.blockSize] : [Math.round(wide), Math.round(high)];
    if (width > 0 && height > 0) changed(width, height, entry.contentRect.width, entry.contentRect.height);
  });
  try {
    observer.observe(canvas, { box: 'device-pixel-content-box' });
  } catch {
    observer.observe(canvas);
  }
}

/** One pane's map. `scene` gives what is common to panes: layers, fingers, probes, cursor, full scale. */
export class FieldMap {
  sheet = null;
  frame = null;
  #context;
  #smooth = null;
  #colours = null;
  #theme = null;
  #size = null;

  constructor(canvas, pane, scene) {
    this.canvas = canvas;
    this.pane = pane;
    this.scene = scene;
    this.#context = canvas.getContext('2d', { alpha: false });
    watchPixels(canvas, (width, height, cssWidth, cssHeight) => {
      canvas.width = width;
      canvas.height = height;
      this.#size = [cssWidth, cssHeight];
      // A new size empties the canvas, and an empty one is black: paint before it is shown.
      this.paint();
    });
  }

  get seen() {
    return this.#size !== null && !this.canvas.hidden;
  }

  setSheet(sheet) {
    this.sheet = sheet;
    this.frame = null;
    this.#smooth = null;
  }

  /** Where places in mm lie in the canvas, in CSS pixels. */
  view() {
    const [width, height] = this.#size ?? [1, 1];
    const font = this.scene.font * 0.86;
    const { sheet, pane } = this;
    const theme = this.scene.theme;
    const side = Math.max(10, 0.9 * font);
    const [above, below] = [1.7 * font + 6, 1.9 * font + 4];
    const scale = Math.max(0.01, Math.min(
      (width - 2 * side) / sheet.width, (height - above - below) / sheet.height));
    const left = (width - scale * sheet.width) / 2;
    const bottom = height - below - (height - above - below - scale * sheet.height) / 2;
    return {
      width, height, scale, font, line: this.scene.line, pane, theme, ink: ink(theme), quiet: ink(theme, 0.7),
      toPx: ([x, y]) => [left + x * scale, bottom - y * scale],
      toMm: ([x, y]) => [(x - left) / scale, (bottom - y) / scale],
    };
  }

  /** Paints the last frame. */
  paint() {
    const { sheet, frame, scene, canvas } = this;
    if (!this.#size) return;
    const ctx = this.#context;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = scene.ground;
    ctx.fillRect(0, 0, canvas.width, canvas.height);
    if (!sheet) return;
    const ratio = canvas.width / this.#size[0];
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    const view = this.view();
    this.#paintField(ctx, view);
    drawOutline(ctx, view, sheet);
    drawActuators(ctx, view, sheet.actuators, frame?.head.drive, scene.driven);
    for (const layer of scene.layers) {
      ctx.save();
      try {
        layer.draw?.(ctx, view);
      } catch (error) {
        scene.faulty(layer, error);
      }
      ctx.restore();
    }
    drawTargets(ctx, view, frame?.head.targets, sheet.focalRadius);
    drawProbes(ctx, view, scene.probes, scene.probeColour);
    drawFingers(ctx, view, frame?.head.fingers, scene.held(), scene.levels, scene.reach);
    if (scene.cursor && document.activeElement === canvas) drawCursor(ctx, view, scene.cursor, scene.pressing);
    drawScaleBar(ctx, view, sheet);
  }

  #paintField(ctx, view) {
    const { sheet, frame, scene } = this;
    if (this.#theme !== scene.theme) {
      this.#theme = scene.theme;
      this.#colours = divergingPixels(scene.theme);
    }
    const [left, bottom, width, height] = sheet.cover();
    const [x0, y0] = view.toPx([0, 0]);
    ctx.save();
    ctx.transform(view.scale, 0, 0, -view.scale, x0, y0);
    ctx.clip(sheet.path, 'evenodd');
    if (frame) {
      const image = this.#image(frame);
      ctx.transform(1, 0, 0, -1, 0, 0);
      ctx.imageSmoothingEnabled = true;
      ctx.imageSmoothingQuality = 'low';
      ctx.drawImage(image, left, -bottom - height, width, height);
    } else {
      const [r, g, b] = [0, 8, 16].map((shift) => (this.#colours[this.#colours.length / 2] >> shift) & 255);
      ctx.fillStyle = `rgb(${r} ${g} ${b})`;
      ctx.fillRect(left, bottom, width, height);
    }
    ctx.restore();
  }

  #image(frame) {
    const { columns, rows } = frame;
    const most = this.scene.panes > 1 ? MOST_PIXELS * 0.75 : MOST_PIXELS;
    const factor = Math.max(1, Math.min(4, Math.floor(most / Math.max(columns, rows))));
    const old = this.#smooth;
    if (!old || old.columns !== columns || old.rows !== rows || old.factor !== factor) {
      this.#smooth = new Smooth(columns, rows, factor);
    }
    const pairs = this.sheet.fits(frame) ? this.sheet.pairs : [];
    return this.#smooth.draw(frame.values, frame.head.scale / this.scene.full, this.#colours, pairs);
  }
}
