// What is drawn on the field: outline, actuators, focal discs, fingers, probes, cursor, scale bar.

import { css, seriesColour } from './colours.js';
import { fixed, roundUp } from './units.js';

const INK = { dark: [238, 242, 246], light: [20, 25, 31] };
const GROUND = { dark: [14, 17, 22], light: [255, 255, 255] };
const FINGER = { dark: [255, 209, 102], light: [122, 40, 140] };
const SEEN = { dark: [79, 207, 155], light: [0, 105, 76] };

/** Ink of a theme, as CSS. */
export const ink = (theme, alpha = 1) => css(INK[theme] ?? INK.dark, alpha);
/** What lies behind ink, as CSS. */
export const ground = (theme, alpha = 1) => css(GROUND[theme] ?? GROUND.dark, alpha);
/** The colour of an actuator that plays, as CSS. */
export const lit = (theme) => css(SEEN[theme] ?? SEEN.dark);

/** A path on the field in ink over a rim of the ground, so that it reads on any colour. */
function rimmed(ctx, view, width, colour, path) {
  ctx.lineJoin = 'round';
  for (const [w, c] of [[(width + 2) * view.line, ground(view.theme, 0.6)], [width * view.line, colour]]) {
    ctx.lineWidth = w;
    ctx.strokeStyle = c;
    ctx.beginPath();
    path();
    ctx.stroke();
  }
}

function label(ctx, view, text, x, y, { align = 'center', size = 1, colour = ink(view.theme) } = {}) {
  ctx.font = `${Math.round(view.font * size)}px system-ui, sans-serif`;
  ctx.textAlign = align;
  ctx.textBaseline = 'middle';
  ctx.lineWidth = 3;
  ctx.lineJoin = 'round';
  ctx.strokeStyle = ground(view.theme, 0.75);
  ctx.strokeText(text, x, y);
  ctx.fillStyle = colour;
  ctx.fillText(text, x, y);
}

/** The outline and its holes. */
export function drawOutline(ctx, view, sheet) {
  ctx.lineWidth = 1.5 * view.line;
  ctx.strokeStyle = ink(view.theme, 0.75);
  for (const ring of sheet.rings) {
    ctx.beginPath();
    ring.forEach((mm, i) => ctx[i ? 'lineTo' : 'moveTo'](...view.toPx(mm)));
    ctx.closePath();
    ctx.stroke();
  }
}

/** Actuators, lit by their share of the strongest drive of late; the ring around is their share of the limit. */
export function drawActuators(ctx, view, actuators, drive, strongest) {
  const radius = Math.max(4, Math.min(12, 1.7 * view.scale)) * Math.sqrt(view.line);
  actuators.forEach((actuator, i) => {
    const [x, y] = view.toPx(actuator.at_mm);
    const share = Math.min(1, Math.abs(drive?.[i] ?? 0));
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
    ctx.fillStyle = ground(view.theme, 0.85);
    ctx.fill();
    ctx.fillStyle = css(SEEN[view.theme] ?? SEEN.dark, strongest > 0 ? Math.min(1, Math.abs(drive?.[i] ?? 0) / strongest) : 0);
    ctx.fill();
    ctx.lineWidth = 1.2 * view.line;
    ctx.strokeStyle = ink(view.theme, 0.8);
    ctx.stroke();
    if (share > 0.01) {
      ctx.beginPath();
      ctx.arc(x, y, radius + 2.5 * view.line, -Math.PI / 2, -Math.PI / 2 + 2 * Math.PI * share);
      ctx.lineWidth = 2.5 * view.line;
      ctx.strokeStyle = css(SEEN[view.theme] ?? SEEN.dark);
      ctx.stroke();
    }
    if (view.scale > (actuators.length > 24 ? 4 : 1.6)) label(ctx, view, actuator.name, x, y + radius + 0.75 * view.font, { size: 0.8 });
  });
}

/** Targets with the focal disc in which a focus may be. */
export function drawTargets(ctx, view, targets, radius) {
  for (const at of targets ?? []) {
    const [x, y] = view.toPx(at);
    ctx.save();
    ctx.setLineDash([5, 4]);
    ctx.lineWidth = 1.2 * view.line;
    ctx.strokeStyle = ink(view.theme, 0.7);
    ctx.beginPath();
    ctx.arc(x, y, radius * view.scale, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.restore();
    rimmed(ctx, view, 1.5, ink(view.theme), () => {
      for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
        ctx.moveTo(x + 3 * view.line * dx, y + 3 * view.line * dy);
        ctx.lineTo(x + 8 * view.line * dx, y + 8 * view.line * dy);
      }
    });
  }
}

/** Fingers: rings of a radius in mm that `reach` gives from the force, with the level felt. `held` are this page's own, shown before the server answers. */
export function drawFingers(ctx, view, fingers, held, levels, reach) {
  const colour = FINGER[view.theme] ?? FINGER.dark;
  for (const finger of fingers ?? []) {
    const [x, y] = view.toPx(finger.at_mm);
    const radius = Math.max(9, reach(finger) * view.scale);
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
    ctx.fillStyle = css(colour, 0.12);
    ctx.fill();
    rimmed(ctx, view, 2.5, css(colour), () => ctx.arc(x, y, radius, 0, 2 * Math.PI));
    const level = levels?.get(finger.id);
    if (level !== null && level !== undefined) {
      const below = y - radius - view.font < 4;
      label(ctx, view, `${fixed(level, 0)} dB`, x, below ? y + radius + view.font : y - radius - 0.8 * view.font);
    }
  }
  for (const at of held) {
    const [x, y] = view.toPx(at);
    ctx.beginPath();
    ctx.arc(x, y, 3 * view.line, 0, 2 * Math.PI);
    ctx.fillStyle = css(colour);
    ctx.fill();
  }
}

/** Where waves have just met: a ring around the place and what it says. */
export function drawMet(ctx, view, at, text) {
  const [x, y] = view.toPx(at);
  const radius = Math.max(16, 9 * view.scale);
  rimmed(ctx, view, 2, ink(view.theme), () => ctx.arc(x, y, radius, 0, 2 * Math.PI));
  const below = y - radius - 2 * view.font < 0;
  const middle = Math.min(view.width - 5 * view.font, Math.max(5 * view.font, x));
  label(ctx, view, text, middle, below ? y + radius + view.font : y - radius - view.font, { size: 1.1 });
}

/** Probes: numbered diamonds in the colour of their trace. */
export function drawProbes(ctx, view, probes, colourOf) {
  for (const probe of probes ?? []) {
    const [x, y] = view.toPx(probe.at_mm);
    const size = Math.max(6, view.font * 0.5);
    ctx.beginPath();
    ctx.moveTo(x, y - size);
    ctx.lineTo(x + size, y);
    ctx.lineTo(x, y + size);
    ctx.lineTo(x - size, y);
    ctx.closePath();
    ctx.fillStyle = seriesColour(colourOf(probe), view.theme);
    ctx.fill();
    ctx.lineWidth = 1.5;
    ctx.strokeStyle = ground(view.theme);
    ctx.stroke();
    label(ctx, view, `P${probe.id}`, x + size + 3, y - size, { align: 'left', size: 0.85 });
  }
}

/** The keyboard's cursor. */
export function drawCursor(ctx, view, at, pressed) {
  const [x, y] = view.toPx(at);
  rimmed(ctx, view, pressed ? 3 : 1.8, css(FINGER[view.theme] ?? FINGER.dark), () => {
    for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
      ctx.moveTo(x + 4 * view.line * dx, y + 4 * view.line * dy);
      ctx.lineTo(x + 16 * view.line * dx, y + 16 * view.line * dy);
    }
  });
}

/** A round length at the lower left. */
export function drawScaleBar(ctx, view, sheet) {
  const wanted = roundUp(sheet.width / 6);
  const length = [8, 4, 3, 6, 1.5].includes(Number((wanted / 10 ** Math.floor(Math.log10(wanted))).toFixed(1)))
    ? roundUp(wanted * 1.01) : wanted;
  const [x] = view.toPx([0, 0]);
  const y = view.height - 0.9 * view.font;
  const end = x + length * view.scale;
  ctx.lineWidth = 2 * view.line;
  ctx.strokeStyle = ink(view.theme, 0.9);
  ctx.beginPath();
  ctx.moveTo(x, y - 4);
  ctx.lineTo(x, y + 4);
  ctx.moveTo(x, y);
  ctx.lineTo(end, y);
  ctx.moveTo(end, y - 4);
  ctx.lineTo(end, y + 4);
  ctx.stroke();
  label(ctx, view, `${length} mm`, end + 8, y, { align: 'left', size: 0.9 });
}
