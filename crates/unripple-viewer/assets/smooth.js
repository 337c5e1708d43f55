// Smooth pictures of a coarse grid: values (not colours) interpolated by Catmull-Rom, then coloured.

const TAPS = 4;

/** For each fine cell the four coarse cells around it and their weights. */
function taps(count, factor) {
  const index = new Int32Array(count * factor * TAPS);
  const weight = new Float32Array(count * factor * TAPS);
  for (let i = 0; i < count * factor; i += 1) {
    const at = (i + 0.5) / factor - 0.5;
    const base = Math.floor(at);
    const t = at - base;
    const w = [
      ((-t + 2) * t - 1) * t, (3 * t - 5) * t * t + 2, ((-3 * t + 4) * t + 1) * t, (t - 1) * t * t,
    ];
    for (let k = 0; k < TAPS; k += 1) {
      index[i * TAPS + k] = Math.min(count - 1, Math.max(0, base + k - 1));
      weight[i * TAPS + k] = w[k] / 2;
    }
  }
  return { index, weight };
}

/** Turns cells into an image of `factor` times as many pixels each way. */
export class Smooth {
  constructor(columns, rows, factor) {
    this.columns = columns;
    this.rows = rows;
    this.factor = factor;
    this.width = columns * factor;
    this.height = rows * factor;
    this.across = taps(columns, factor);
    this.up = taps(rows, factor);
    this.cells = new Float32Array(columns * rows);
    this.half = new Float32Array(this.width * rows);
    this.canvas = document.createElement('canvas');
    this.canvas.width = this.width;
    this.canvas.height = this.height;
    this.context = this.canvas.getContext('2d');
    this.image = this.context.createImageData(this.width, this.height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  /** Draws counts scaled by `share` (full scale = 1) in colours; `pairs` fills cells from others first. */
  draw(counts, share, colours, pairs) {
    const { cells } = this;
    cells.set(counts);
    for (let i = 0; i < pairs.length; i += 2) cells[pairs[i]] = cells[pairs[i + 1]];
    this.#widen();
    this.#paint(share * (colours.length / 2), colours);
    this.context.putImageData(this.image, 0, 0);
    return this.canvas;
  }

  #widen() {
    const { cells, half, width, columns, rows } = this;
    const { index, weight } = this.across;
    for (let r = 0; r < rows; r += 1) {
      const from = r * columns;
      for (let x = 0, k = 0; x < width; x += 1, k += TAPS) {
        half[r * width + x] =
          cells[from + index[k]] * weight[k] + cells[from + index[k + 1]] * weight[k + 1] +
          cells[from + index[k + 2]] * weight[k + 2] + cells[from + index[k + 3]] * weight[k + 3];
      }
    }
  }

  #paint(scale, colours) {
    const { half, pixels, width, height } = this;
    const { index, weight } = this.up;
    const top = colours.length - 1;
    const middle = colours.length / 2;
    for (let y = 0; y < height; y += 1) {
      const k = y * TAPS;
      const [a, b, c, d] = [index[k] * width, index[k + 1] * width, index[k + 2] * width, index[k + 3] * width];
      const [p, q, r, s] = [weight[k] * scale, weight[k + 1] * scale, weight[k + 2] * scale, weight[k + 3] * scale];
      const row = (height - 1 - y) * width;
      for (let x = 0; x < width; x += 1) {
        const level = (middle + half[a + x] * p + half[b + x] * q + half[c + x] * r + half[d + x] * s) | 0;
        pixels[row + x] = colours[level < 0 ? 0 : level > top ? top : level];
      }
    }
  }
}
