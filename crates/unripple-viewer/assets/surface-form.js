// The form that says what the sheet is: outline, edge, material and numbers.

import { el, clear } from './dom.js';
import { Quantity } from './quantity.js';
import { area } from './outline.js';

const EDGES = [['clamped', 'clamped'], ['supported', 'supported'], ['free', 'free']];
const SHAPES = { rectangle: 'rectangle', circle: 'circle', stadium: 'stadium' };

const SIZES = {
  rectangle: [['Width', 30, 600], ['Height', 30, 600]],
  circle: [['Radius', 15, 300]],
  stadium: [['Straight length', 0, 500], ['Radius', 15, 300]],
};

const NUMBERS = [
  { key: 'thickness_mm', label: 'Thickness', unit: 'mm', least: 0.001, most: 100, low: 0.02, high: 4, scale: 'log' },
  { key: 'tension_n_per_m', label: 'Tension', unit: 'N/m', least: 0, most: 1e6, low: 0, high: 2000, scale: 'square', hint: '0 for a plate' },
  { key: 'decay_time_ms', label: 'Decay time', unit: 'ms', least: 0.1, most: 100000, low: 3, high: 1000, scale: 'log', hint: 'of the amplitude, to 37 % (1/e)' },
  { key: 'band_top_hz', label: 'Top of the band', unit: 'Hz', least: 50, most: 200000, low: 300, high: 24000, scale: 'log', bound: 'band_most_hz' },
  { key: 'actuators', label: 'Actuators', least: 1, most: 64, low: 1, high: 32, step: 1, hint: 'another number moves them to new places' },
];

/** Every value of the surface that can be edited here. */
export class SurfaceForm {
  constructor(edits) {
    this.edits = edits;
    this.surface = null;
    this.sizes = [];
    this.shape = el('select', { on: { change: () => this.reshape() } });
    this.sizesNode = el('div', { class: 'stack' });
    this.edge = el('select', { title: 'clamped: no displacement, no rotation; supported: no displacement, free to rotate', on: { change: () => this.choose('edge', this.edge) } });
    this.material = el('select', { on: { change: () => this.choose('material', this.material) } });
    this.numbers = NUMBERS.map((each) => ({
      key: each.key,
      bound: each.bound,
      input: new Quantity({ ...each, change: (value, settled) => this.change(each.key, { [each.key]: value }, settled) }),
    }));
    this.fields = el('fieldset', { class: 'plain stack' },
      el('legend', { class: 'seen-not' }, 'The sheet'),
      el('div', { class: 'pair' }, labelled('Outline', this.shape), labelled('Edge', this.edge)),
      this.sizesNode,
      labelled('Material', this.material),
      ...this.numbers.map(({ input }) => input.node));
    this.note = el('p', { class: 'quiet', hidden: true },
      'These responses were measured: there is no model behind them to edit. Open a surface to design one.');
    this.node = el('form', { class: 'stack', on: { submit: (event) => { event.preventDefault(); edits.finish(); } } }, this.note, this.fields);
  }

  /** Shows the surface as it is, but for the value that is being changed here. */
  show(surface) {
    this.surface = surface;
    const { values } = surface;
    this.note.hidden = !surface.library;
    this.fields.disabled = Boolean(surface.library);
    this.showShape(values);
    options(this.edge, EDGES, values.edge, 'one for each side');
    options(this.material, (surface.materials ?? []).map((name) => [name, name]), values.material, 'as its file says');
    for (const { key, bound, input } of this.numbers) {
      // As high as the sample rate lets modes go; a file may go a little higher, and is shown as it is.
      if (bound && values[bound]) input.reach(Math.max(values[bound], values[key] ?? 0));
      if (this.edits.holds(key)) continue;
      const missing = key === 'decay_time_ms' ? 'varies' : '–';
      input.show(values[key] ?? null, missing);
    }
  }

  showShape(values) {
    const known = values.shape in SHAPES;
    options(this.shape, Object.entries(SHAPES), known ? values.shape : null, values.shape || 'of its own');
    const wanted = known ? SIZES[values.shape] : [];
    if (this.shown !== values.shape) {
      this.shown = values.shape;
      this.sizes = wanted.map(([label, low, high]) => new Quantity({
        label, unit: 'mm', least: low === 0 ? 0 : 1, most: 100000, low, high,
        change: (_, settled) => this.resize(values.shape, settled),
      }));
      clear(this.sizesNode);
      this.sizesNode.append(...this.sizes.map((size) => size.node));
    }
    if (this.edits.holds('size')) return;
    this.sizes.forEach((size, i) => size.show(sizesOf(values)[i] ?? null));
  }

  change(key, edit, settled) {
    if (settled) this.edits.settle(key, edit);
    else this.edits.sketch(key, edit);
  }

  choose(key, select) {
    this.edits.now({ [key]: select.value });
  }

  resize(shape, settled) {
    const sizes = this.sizes.map((size) => size.value);
    if (sizes.some((size) => !Number.isFinite(size))) return;
    this.change('size', outlineEdit(shape, sizes), settled);
  }

  // Another shape starts with the area of the one before, so that what is compared is the shape. Its actuators are placed
  // anew, as the old places may lie beyond its edge.
  reshape() {
    const shape = this.shape.value;
    const covered = this.surface ? area(this.surface.rings_mm[0]) : 22500;
    const round = (value) => Math.max(1, Math.round(value * 10) / 10);
    const radius = Math.sqrt(covered / (4 + Math.PI));
    const [width, height] = this.surface?.extent_mm ?? [1, 1];
    const sizes = {
      rectangle: [round(Math.sqrt(covered * width / height)), round(Math.sqrt(covered * height / width))],
      circle: [round(Math.sqrt(covered / Math.PI))],
      stadium: [round(2 * radius), round(radius)],
    };
    const count = this.surface?.values.actuators;
    this.edits.now({ ...outlineEdit(shape, sizes[shape]), ...(count ? { actuators: count } : {}) });
  }
}

function sizesOf(values) {
  return Array.isArray(values.size_mm) ? values.size_mm : [values.size_mm];
}

function outlineEdit(shape, sizes) {
  if (shape === 'circle') return { circle_mm: sizes[0] };
  return { [`${shape}_mm`]: sizes };
}

function labelled(text, control) {
  return el('label', { class: 'field' }, el('span', {}, text), control);
}

function options(select, pairs, value, other) {
  const wanted = pairs.map(([key]) => key).join('\n') + (value ?? other);
  if (select.dataset.made !== wanted) {
    select.dataset.made = wanted;
    clear(select);
    if (value === null || value === undefined || !pairs.some(([key]) => key === value)) {
      select.append(el('option', { value: '', disabled: true }, value ?? other));
    }
    select.append(...pairs.map(([key, text]) => el('option', { value: key }, text)));
  }
  select.value = pairs.some(([key]) => key === value) ? value : '';
}
