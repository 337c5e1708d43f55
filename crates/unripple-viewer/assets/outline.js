// Closed outlines as lists of places in mm: the outer ring first, then holes.

/** Area inside one ring, in mm². */
export function area(ring) {
  let twice = 0;
  for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
    twice += ring[j][0] * ring[i][1] - ring[i][0] * ring[j][1];
  }
  return Math.abs(twice) / 2;
}

/** Whether a place lies within the outline and in none of its holes. */
export function inside(rings, [x, y]) {
  let within = false;
  for (const ring of rings) {
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
      const [xi, yi] = ring[i];
      const [xj, yj] = ring[j];
      if ((yi > y) !== (yj > y) && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) within = !within;
    }
  }
  return within;
}

/** Draws rings into the path of a canvas, through `toPx`. */
export function trace(ctx, rings, toPx) {
  ctx.beginPath();
  for (const ring of rings) {
    ring.forEach((place, i) => {
      const [x, y] = toPx(place);
      if (i) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
    });
    ctx.closePath();
  }
}

/**
 * Fits a surface of `extent` mm into `width` x `height` px with `margin` px around it, y up.
 * Returns its scale in px per mm and the way there and back.
 */
export function fit([across, up], width, height, margin) {
  const scale = Math.max(0, Math.min((width - 2 * margin) / across, (height - 2 * margin) / up));
  const left = (width - scale * across) / 2;
  const bottom = (height + scale * up) / 2;
  return {
    scale,
    toPx: ([x, y]) => [left + x * scale, bottom - y * scale],
    toMm: ([x, y]) => [(x - left) / scale, (bottom - y) / scale],
  };
}

/** A canvas made sharp for the screen it is on: its context in CSS px, and its size. `null` while it is not shown. */
export function sharp(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!width || !height) return null;
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const ctx = canvas.getContext('2d');
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  return { ctx, width, height };
}

/** A place given on a square of `side` mm, carried over to another surface: to the same share of its extent, or, where that
 * is beyond its edge, nearer to the middle. */
export function carried([x, y], side, { extent_mm: extent, rings_mm: rings }) {
  const wanted = [(x / side) * extent[0], (y / side) * extent[1]];
  const middle = extent.map((each) => each / 2);
  for (let part = 0; part <= 1; part += 0.1) {
    const at = wanted.map((each, i) => Math.round((each + (middle[i] - each) * part) * 10) / 10);
    if (inside(rings, at)) return at;
  }
  return wanted;
}
