// Turning a scene by drag, wheel, pinch and keys, and the camera that follows from it.

const START = { turn: -0.5, tilt: 0.85, away: 1.95 };
const KEYS = {
  ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.08, 1], ArrowDown: [0, -0.08, 1],
  '+': [0, 0, 0.9], '=': [0, 0, 0.9], '-': [0, 0, 1.1],
};

/** A camera that looks at the middle of the scene; `changed()` after each turn. */
export class Orbit {
  #pointers = new Map();

  constructor(canvas, state, changed) {
    Object.assign(this, START, state.ui.orbit ?? {});
    this.save = () => {
      state.ui.orbit = { turn: this.turn, tilt: this.tilt, away: this.away };
      changed();
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener('pointermove', (event) => this.#drag(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      canvas.addEventListener(end, (event) => this.#pointers.delete(event.pointerId));
    }
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.#turnBy(0, 0, Math.exp(Math.max(-0.3, Math.min(0.3, event.deltaY * 0.0015))));
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => {
      if (event.key === '0') Object.assign(this, START);
      const turn = KEYS[event.key];
      if (!turn && event.key !== '0') return;
      event.preventDefault();
      this.#turnBy(...(turn ?? [0, 0, 1]));
    });
  }

  #drag(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.#pointers.set(event.pointerId, now);
    if (others.length > 0) {
      const reach = (at) => Math.max(20, Math.hypot(at[0] - others[0][0], at[1] - others[0][1]));
      this.#turnBy(0, 0, reach(before) / reach(now));
    } else this.#turnBy((now[0] - before[0]) * 0.008, (now[1] - before[1]) * 0.006, 1);
  }

  #turnBy(turn, tilt, factor) {
    this.turn = (this.turn + turn) % (2 * Math.PI);
    this.tilt = Math.min(1.55, Math.max(0.08, this.tilt + tilt));
    this.away = Math.min(4, Math.max(0.7, this.away * factor));
    this.save();
  }

  /** The camera of a picture of some shape, column by column; z is up. */
  matrix(width, height) {
    const field = 0.75;
    const near = 0.05;
    const far = 10;
    const away = this.away * Math.max(1, 0.95 * (height / width));
    const f = 1 / Math.tan(field / 2);
    const [ct, st, ce, se] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt), Math.sin(this.tilt)];
    const right = [ct, st, 0];
    const up = [-st * se, ct * se, ce];
    const back = [st * ce, -ct * ce, se];
    const a = (far + near) / (near - far);
    const b = (2 * far * near) / (near - far);
    const out = new Float32Array(16);
    for (let k = 0; k < 3; k += 1) {
      out[4 * k] = (f * height * right[k]) / width;
      out[4 * k + 1] = f * up[k];
      out[4 * k + 2] = a * back[k];
      out[4 * k + 3] = -back[k];
    }
    out[14] = -a * away + b;
    out[15] = away;
    return out;
  }
}
