// One number of a form: a field to type in and, beside it, a slider.

import { el } from './dom.js';

const STEPS = 200;

const SCALES = {
  linear: { up: (t, low, high) => low + t * (high - low), down: (v, low, high) => (v - low) / (high - low) },
  log: {
    up: (t, low, high) => low * (high / low) ** t,
    down: (v, low, high) => Math.log(Math.max(v, low) / low) / Math.log(high / low),
  },
  square: {
    up: (t, low, high) => low + t * t * (high - low),
    down: (v, low, high) => Math.sqrt(Math.max(0, (v - low) / (high - low))),
  },
};

let made = 0;

/**
 * A labelled number with its unit. `least` and `most` bound what may be typed, `low` and `high` what the slider reaches;
 * `step` makes the slider move in whole steps, otherwise `scale` ('linear', 'log', 'square') and three digits.
 * `change(value, settled)` is called with legal values only.
 */
export class Quantity {
  constructor({ label, unit = '', least, most, low = least, high = most, step = null, scale = 'linear', hint = '', change }) {
    Object.assign(this, { label, unit, least, most, low, high, step, change });
    this.scale = SCALES[scale];
    const id = `quantity-${++made}`;
    this.number = el('input', {
      type: 'number', id, inputmode: 'decimal', step: step ?? 'any', min: least, max: most, autocomplete: 'off',
      'aria-describedby': `${id}-fault`,
      on: {
        input: () => this.typed(false),
        change: () => this.typed(true),
        keydown: (event) => this.nudge(event),
        blur: () => this.rest(),
      },
    });
    this.slider = el('input', {
      type: 'range', 'aria-label': unit ? `${label}, slider, ${unit}` : `${label}, slider`,
      min: step ? low : 0, max: step ? high : STEPS, step: step ?? 1,
      on: { input: () => this.slid(false), change: () => this.slid(true) },
    });
    this.fault = el('p', { class: 'quantity-fault', id: `${id}-fault`, role: 'status' });
    this.node = el('div', { class: 'quantity' },
      el('label', { for: id }, label, unit ? el('i', {}, ` ${unit}`) : null),
      this.number, this.slider,
      hint ? el('p', { class: 'quiet quantity-hint' }, hint) : null,
      this.fault);
    this.value = null;
  }

  /** Puts in what is true now; `missing` stands where there is no single number. */
  show(value, missing = '') {
    this.value = value;
    this.loose = false;
    this.complain('');
    this.number.placeholder = missing;
    this.number.value = value === null || value === undefined ? '' : String(short(value));
    this.place();
  }

  /** Sets the most that may be typed and that the slider reaches. */
  reach(most) {
    if (most === this.most) return;
    Object.assign(this, { most, high: most });
    this.number.max = most;
    if (this.step) this.slider.max = most;
    this.place();
  }

  /** Switches both controls on or off. */
  enable(on) {
    this.number.disabled = !on;
    this.slider.disabled = !on;
  }

  place() {
    const known = Number.isFinite(this.value);
    const at = known ? this.value : this.low;
    this.slider.value = String(this.step ? at : Math.round(STEPS * this.scale.down(at, this.low, this.high)));
    this.slider.setAttribute('aria-valuetext', known ? `${short(this.value)} ${this.unit}`.trim() : 'not a single number');
  }

  // Arrow keys in a field without a step would move by 1, whatever the size of the number.
  nudge(event) {
    if (this.step || (event.key !== 'ArrowUp' && event.key !== 'ArrowDown')) return;
    event.preventDefault();
    const now = Number.isFinite(this.value) ? this.value : this.low;
    const unit = 10 ** Math.floor(Math.log10(Math.max(Math.abs(now), this.least, 1e-3)) - 1) * (event.shiftKey ? 10 : 1);
    const moved = Math.round(now / unit + (event.key === 'ArrowUp' ? 1 : -1)) * unit;
    this.take(short(Math.min(this.most, Math.max(this.least, moved))), true);
    this.number.value = String(this.value);
  }

  typed(settled) {
    const text = this.number.value.trim();
    const value = Number(text);
    const legal = text !== '' && Number.isFinite(value) && value >= this.least && value <= this.most
      && (!this.step || Number.isInteger(value / this.step));
    if (legal) {
      this.take(value, settled);
    } else if (text !== '' || settled) {
      this.complain(`expected ${this.step ? 'a whole number' : 'a number'} from ${this.least} to ${this.most}${this.unit ? ` ${this.unit}` : ''}`);
    }
  }

  slid(settled) {
    const at = Number(this.slider.value);
    const value = this.step ? at : short(this.scale.up(at / STEPS, this.low, this.high));
    this.number.value = String(value);
    this.take(value, settled);
  }

  // Typing that ends with the number it began with causes no `change` event.
  rest() {
    if (this.loose) this.take(this.value, true);
  }

  take(value, settled) {
    this.value = value;
    this.loose = !settled;
    this.complain('');
    this.place();
    this.change(value, settled);
  }

  complain(text) {
    this.fault.textContent = text;
    if (text) this.number.setAttribute('aria-invalid', 'true');
    else this.number.removeAttribute('aria-invalid');
  }
}

function short(value) {
  return Number(value.toPrecision(Math.abs(value) >= 1000 ? 4 : 3));
}
