// The full scale of the colours: it rises at once to a round number, and falls only when peaks have been low for a while.

import { roundUp } from './units.js';

const HOLD_MS = 4000;
const LOW = 0.5;
const FLOOR = 1e-9;

/** Share of the largest peak of a surface below which the scale does not fall: what is left of a touch is shown as next to nothing. */
const LEFT = 1e-3;

/** An automatic scale that stays put while values only wander. */
export class Scale {
  full = FLOOR;
  held = false;
  #most = 0;
  #peaks = [];
  #quantity = null;

  /** Takes a frame's largest value; true when the full scale changed. */
  take(peak, quantity, now) {
    const other = quantity !== this.#quantity;
    if (other) {
      this.#quantity = quantity;
      this.#peaks = [];
      this.#most = 0;
      this.full = FLOOR;
    }
    this.#most = Math.max(this.#most, peak);
    if (this.held && this.full > FLOOR) return other;
    const before = this.full;
    this.#peaks.push([now, peak]);
    while (this.#peaks[0][0] < now - HOLD_MS) this.#peaks.shift();
    if (peak > this.full) this.full = Math.max(FLOOR, roundUp(peak));
    else if (now - this.#peaks[0][0] > 0.9 * HOLD_MS) this.#lower();
    return other || this.full !== before;
  }

  #lower() {
    const most = this.#peaks.reduce((m, [, p]) => Math.max(m, p), 0);
    if (most >= LOW * this.full) return;
    this.full = Math.max(FLOOR, roundUp(Math.max(most, this.full / 5, LEFT * this.#most) * 1.05));
    this.#peaks = this.#peaks.slice(-1);
  }

  /** Starts afresh, as after another surface. */
  reset() {
    this.#quantity = null;
  }
}
