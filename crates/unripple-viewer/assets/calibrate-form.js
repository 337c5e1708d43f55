// What a calibration is started with.

import { el } from './dom.js';

const NAME = /^[\p{L}\p{N}][\p{L}\p{N}_.-]{0,63}$/u;

/** Grid, name of the library, and whether the true surface is another than its file says; `start(request)` sends it. */
export class CalibrateForm {
  constructor(app, start) {
    this.app = app;
    const { jobs_grid: grid = 20, jobs_seed: seed = 7, jobs_name: name = 'my-surface' } = app.state.ui;
    this.grid = el('input', { type: 'number', min: 1, max: 200, step: 'any', required: true, inputmode: 'decimal', value: grid, on: { input: () => this.count() } });
    this.name = el('input', { type: 'text', required: true, maxlength: 64, autocomplete: 'off', spellcheck: 'false', value: name, 'aria-describedby': 'calibrate-fault' });
    this.other = el('input', { type: 'checkbox', checked: true, on: { change: () => { this.seed.disabled = !this.other.checked; } } });
    this.seed = el('input', { type: 'number', min: 0, max: 4294967295, step: 1, inputmode: 'numeric', value: seed, 'aria-label': 'Seed of the random differences' });
    this.counted = el('p', { class: 'quiet' });
    this.fault = el('p', { class: 'is-bad', id: 'calibrate-fault', role: 'status' });
    this.run = el('button', { type: 'submit', class: 'button primary' }, 'Calibrate');
    this.node = el('form', { class: 'stack', novalidate: true, on: { submit: (event) => { event.preventDefault(); this.submit(start); } } },
      el('div', { class: 'pair' },
        el('label', { class: 'field' }, el('span', {}, 'Points every ', el('i', {}, 'mm')), this.grid),
        el('label', { class: 'field' }, el('span', {}, 'Name of the library'), this.name)),
      this.counted,
      el('div', { class: 'row' },
        el('label', { class: 'check' }, this.other, ' the simulated surface differs from its file, by seed'), this.seed),
      this.fault,
      el('div', { class: 'row' }, this.run));
    app.state.subscribe('surface', () => this.count());
    app.state.subscribe('settings', ({ device }) => this.real(Boolean(device?.real)));
  }

  enable(on) {
    this.run.disabled = !on;
  }

  // The truth of a real device cannot be chosen.
  real(real) {
    this.other.disabled = real;
    if (real) this.other.checked = false;
    this.seed.disabled = real || !this.other.checked;
  }

  count() {
    const surface = this.app.state.last('surface');
    const pitch = Number(this.grid.value);
    if (!surface || !(pitch > 0)) {
      this.counted.textContent = '';
      return;
    }
    const wavelength = surface.lambda_min_mm;
    const fine = Number.isFinite(wavelength) && pitch <= wavelength / 2;
    this.counted.textContent = Number.isFinite(wavelength)
      ? `Shortest wave ${wavelength.toFixed(1)} mm: ${fine ? 'fine enough to focus between the points' : 'focus at the points only; to focus between them, half a wavelength or less is needed'}.`
      : '';
  }

  submit(start) {
    const grid = Number(this.grid.value);
    const seed = Number(this.seed.value);
    const name = this.name.value.trim();
    const wrong = !(grid >= 1 && grid <= 200) ? 'The distance of the points: expected 1 to 200 mm.'
      : !NAME.test(name) ? 'The name: expected letters, digits, dots, dashes, and a letter or digit first.'
        : this.other.checked && !(Number.isInteger(seed) && seed >= 0 && this.seed.value !== '') ? 'The seed: expected a whole number from 0.' : '';
    this.fault.textContent = wrong;
    if (wrong) return;
    Object.assign(this.app.state.ui, { jobs_grid: grid, jobs_seed: seed, jobs_name: name });
    start({ unknowns: this.other.checked ? seed : null, grid_mm: grid, name });
  }
}
