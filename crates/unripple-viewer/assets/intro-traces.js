// What actuators hear and play, as small traces beside them on the map.

import { ink, ground, lit } from './marks.js';

/** With more actuators than this, only so many have a trace: else they cover the map. */
const MOST = 12;

/** Width of a trace in shares of the map's, and in CSS pixels at most; its height in shares of its width. */
const WIDE = 0.13;
const WIDEST = 92;
const HIGH = 0.34;

/** Where a trace lies: beside its actuator, towards the middle of the sheet. */
function boxOf(view, sheet, at_mm) {
  const width = Math.min(WIDEST, WIDE * view.width);
  const height = HIGH * width;
  const [x, y] = view.toPx(at_mm);
  const [u, v] = view.toPx([sheet.width / 2, sheet.height / 2]);
  const far = Math.hypot(u - x, v - y) || 1;
  const [dx, dy] = [(u - x) / far, (v - y) / far];
  const away = Math.min(width / 2 / Math.max(1e-6, Math.abs(dx)), height / 2 / Math.max(1e-6, Math.abs(dy))) + 0.9 * view.font;
  return { x: x + dx * away, y: y + dy * away, width, height };
}

/**
 * Draws `heard`, a list of `{at, drive}` with `at` the share of the window since the tap. `turned` goes from 0, as heard, to 1, turned
 * round; `hand` is the share that has been played, or null.
 */
export function drawHeard(ctx, view, sheet, { heard, turned, hand }) {
  const every = Math.ceil(sheet.actuators.length / MOST);
  const most = heard.reduce((m, { drive }) => drive.reduce((n, value) => Math.max(n, Math.abs(value)), m), 1e-12);
  const mirror = Math.cos(Math.PI * turned);
  sheet.actuators.forEach(({ at_mm }, i) => {
    if (i % every) return;
    const box = boxOf(view, sheet, at_mm);
    ctx.save();
    ctx.translate(box.x, box.y);
    ctx.fillStyle = ground(view.theme, 0.78);
    ctx.strokeStyle = ink(view.theme, 0.35);
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.roundRect(-box.width / 2 - 4, -box.height / 2 - 3, box.width + 8, box.height + 6, 5);
    ctx.fill();
    ctx.stroke();
    const path = () => {
      ctx.beginPath();
      for (const { at, drive } of heard) {
        ctx.lineTo((at - 0.5) * mirror * box.width, (-drive[i] / most) * 0.48 * box.height);
      }
      ctx.stroke();
    };
    ctx.lineWidth = 1.3 * view.line;
    ctx.lineJoin = 'round';
    ctx.strokeStyle = hand === null ? lit(view.theme) : ink(view.theme, 0.35);
    path();
    if (hand !== null) {
      const x = (hand - 0.5) * box.width;
      ctx.save();
      ctx.beginPath();
      ctx.rect(-box.width / 2, -box.height, x + box.width / 2, 2 * box.height);
      ctx.clip();
      ctx.strokeStyle = lit(view.theme);
      path();
      ctx.restore();
      ctx.strokeStyle = ink(view.theme, 0.8);
      ctx.beginPath();
      ctx.moveTo(x, -box.height / 2);
      ctx.lineTo(x, box.height / 2);
      ctx.stroke();
    }
    ctx.restore();
  });
}
