// How the surface answers a touch: effect, method, window, rate; and what is shown of it.

import { el, setOptions, setText } from './dom.js';
import { fixed } from './units.js';

const FREE = ['Fingers do not load the surface: it moves freely, as ', 'focus', ' computes it.'];
const HELD = 'Each finger loads the film (its mass, damping, stiffness): it holds the place down, and waves meet around it.';

/** Least strength: a hundredth of the full level. */
const SOFTEST_DB = -40;

/** A field with a label; the unit stands in the label. */
function field(text, unit, control) {
  return el('label', { class: 'field' }, el('span', {}, `${text} `, unit ? el('i', { text: unit }) : null), control);
}

/** The settings, with those that were chosen but are not played yet; `null` before any. */
export function chosen(app) {
  const settings = app.state.last('settings');
  const { is, ...later } = app.state.last('chosen') ?? {};
  return settings && { ...settings, ...later };
}

/** The level in words, without the option of the command line that it may end in. */
export function levelText(level) {
  const text = (level ?? '').replace(/\s*\(--full-limit\)\s*$/, '');
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Whether fingers weigh on the surface, and what that means; hidden where the server knows no such setting. */
function weightPart(app, send) {
  const box = el('input', { type: 'checkbox', 'aria-describedby': 'weight-note', on: { change: () => send({ load: box.checked }) } });
  const note = el('p', { class: 'quiet', id: 'weight-note' });
  const part = el('div', { hidden: true }, el('label', { class: 'check' }, box, 'Fingers weigh on the surface'), note);
  const show = () => {
    const load = chosen(app)?.load;
    part.hidden = typeof load !== 'boolean';
    box.checked = load === true;
    if (note.dataset.load === String(load)) return;
    note.dataset.load = String(load);
    note.replaceChildren(...(load ? [HELD] : [FREE[0], el('code', { class: 'mono' }, FREE[1]), FREE[2]]));
  };
  // What was refused is put back to what holds.
  for (const kind of ['settings', 'chosen', 'fault']) app.state.subscribe(kind, show);
  return part;
}

/** The settings of the live surface. */
export function mount(root, app) {
  const send = (change) => app.link.send({ do: 'settings', ...change });
  const effect = el('select', { on: { change: () => send({ effect: effect.value }) } });
  const method = el('select', { on: { change: () => send({ method: method.value }) } });
  const number = (name, props) => {
    const input = el('input', { type: 'number', inputmode: 'decimal', step: 'any', ...props });
    input.addEventListener('change', () => {
      const value = input.value.trim() === '' ? null : Number(input.value);
      if (!input.checkValidity() || (value === null && name !== 'window_ms')) input.reportValidity();
      else send({ [name]: value });
    });
    return input;
  };
  const window = number('window_ms', { min: '0.1', max: '1000' });
  const rate = number('rate_hz', { min: '0.1', max: '500', required: true });
  const level = el('p', { class: 'quiet' });
  const gain = el('input', { type: 'range', min: String(SOFTEST_DB), max: '0', step: '1', value: '0', 'aria-label': 'Strength' });
  const gainText = el('span', { class: 'quiet' });
  const sayGain = (db) => {
    const text = db === 0 ? 'full level' : `${fixed(-db, 0)} dB below full level`;
    setText(gainText, `Strength: ${text}`);
    gain.setAttribute('aria-valuetext', text);
  };
  gain.addEventListener('input', () => sayGain(Number(gain.value)));
  gain.addEventListener('change', () => send({ gain_db: Number(gain.value) }));
  const weight = weightPart(app, send);
  root.append(
    el('h2', { text: 'Answer to a touch' }),
    field('Effect', '', effect),
    el('div', { class: 'grid2' },
      field('Method', '', method),
      field('Window', 'ms', window), field('Rate', 'Hz', rate)),
    el('label', { class: 'field' }, gainText, gain),
    level, weight,
  );
  const quantity = document.getElementById('quantity');
  quantity.addEventListener('change', () => send({ quantity: quantity.value }));
  const show = () => {
    const settings = chosen(app);
    if (!settings) return;
    setOptions(effect, (settings.effects ?? []).map((e) => [e.name, e.title ?? e.name]), settings.effect);
    setOptions(method, (settings.methods ?? []).map((m) => [m.name, m.name]), settings.method);
    if (document.activeElement !== quantity) quantity.value = settings.quantity;
    window.placeholder = `${fixed(settings.window_auto_ms)} (automatic)`;
    if (document.activeElement !== window) window.value = settings.window_ms == null ? '' : String(Number(settings.window_ms.toPrecision(5)));
    if (!gain.matches(':active')) {
      gain.value = String(settings.gain_db ?? 0);
      sayGain(Number(gain.value));
    }
    if (document.activeElement !== rate) rate.value = settings.rate_hz ?? '';
    setText(level, levelText(settings.level));
  };
  for (const kind of ['settings', 'chosen']) app.state.subscribe(kind, show);
}
