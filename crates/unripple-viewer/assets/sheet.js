// The surface's shape as the page needs it: outline in mm, cells inside, and what lies under a place.

/** Bits of the mask, row by row from the bottom, lowest bit first. */
function bits(base64, count) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  if (bytes.length * 8 < count) throw new Error(`the mask needs ${count} cells, found ${bytes.length * 8}`);
  return Uint8Array.from({ length: count }, (_, i) => (bytes[i >> 3] >> (i & 7)) & 1);
}

/** For cells just outside the outline, the nearest cell inside: pairs of indices. Smooth pictures need values there. */
function beyond(inside, columns, rows) {
  const pairs = [];
  const reach = 3;
  for (let r = 0; r < rows; r += 1) {
    for (let c = 0; c < columns; c += 1) {
      if (inside[r * columns + c]) continue;
      let best = -1;
      let nearest = Infinity;
      for (let y = Math.max(0, r - reach); y <= Math.min(rows - 1, r + reach); y += 1) {
        for (let x = Math.max(0, c - reach); x <= Math.min(columns - 1, c + reach); x += 1) {
          const away = (x - c) ** 2 + (y - r) ** 2;
          if (inside[y * columns + x] && away < nearest) {
            nearest = away;
            best = y * columns + x;
          }
        }
      }
      if (best >= 0) pairs.push(r * columns + c, best);
    }
  }
  return Int32Array.from(pairs);
}

/** A surface made ready for drawing. */
export class Sheet {
  constructor(message) {
    const { grid } = message;
    this.message = message;
    this.name = message.name;
    [this.width, this.height] = message.extent_mm;
    this.rings = message.rings_mm;
    this.actuators = message.actuators ?? [];
    this.focalRadius = message.focal_radius_mm ?? 0;
    this.grid = grid;
    this.inside = message.inside ? bits(message.inside, grid.columns * grid.rows) : null;
    this.pairs = this.inside ? beyond(this.inside, grid.columns, grid.rows) : new Int32Array();
    this.path = new Path2D();
    for (const ring of this.rings) {
      ring.forEach(([x, y], i) => (i ? this.path.lineTo(x, y) : this.path.moveTo(x, y)));
      this.path.closePath();
    }
  }

  /** Whether a place in mm lies on the surface. */
  holds([x, y]) {
    let inside = false;
    for (const ring of this.rings) {
      for (let i = 0, j = ring.length - 1; i < ring.length; j = i, i += 1) {
        const [[ax, ay], [bx, by]] = [ring[i], ring[j]];
        if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
      }
    }
    return inside;
  }

  /** Whether a frame's cells are those of the surface's grid. */
  fits(frame) {
    return frame.columns === this.grid.columns && frame.rows === this.grid.rows;
  }

  /** Rectangle in mm covered by a frame's cells: left, bottom, width, height. */
  cover() {
    const { columns, rows, origin_mm: [x, y], pitch_mm: [px, py] } = this.grid;
    return [x - px / 2, y - py / 2, columns * px, rows * py];
  }

  /** Value of a frame at a place in mm, between its cells; null outside the surface. */
  value(frame, mm) {
    if (!this.holds(mm)) return null;
    const [left, bottom, width, height] = this.cover();
    const x = ((mm[0] - left) / width) * frame.columns - 0.5;
    const y = ((mm[1] - bottom) / height) * frame.rows - 0.5;
    const at = (c, r) =>
      frame.values[Math.min(frame.rows - 1, Math.max(0, r)) * frame.columns + Math.min(frame.columns - 1, Math.max(0, c))];
    const [c, r] = [Math.floor(x), Math.floor(y)];
    const [u, v] = [x - c, y - r];
    const low = at(c, r) * (1 - u) + at(c + 1, r) * u;
    const high = at(c, r + 1) * (1 - u) + at(c + 1, r + 1) * u;
    return (low * (1 - v) + high * v) * frame.head.scale;
  }
}
