// Numbers as text, always with their unit.

const NONE = '–';

/** Fewest ticks of an axis, and the number of wanted ticks beyond which no more are tried. */
const FEWEST = 3;
const MOST = 20;

const missing = (value) => value === null || value === undefined || !Number.isFinite(value);

/** A number to some significant digits, with a true minus sign; nothing known is a dash. */
export function number(value, digits = 3) {
  if (missing(value)) return NONE;
  if (value === 0) return '0';
  const size = Math.abs(value);
  let text;
  if (size >= 1e6 || size < 1e-4) text = value.toExponential(Math.max(0, digits - 1)).replace('e+', 'e');
  else {
    const rounded = Number(size.toPrecision(digits));
    const places = Math.max(0, digits - 1 - Math.floor(Math.log10(rounded)));
    text = value.toFixed(Math.min(places, 8));
  }
  return text.replace(/-/g, '−');
}

/** A number to fixed decimal places, with a true minus sign. */
export function fixed(value, places = 1) {
  if (missing(value)) return NONE;
  const text = value.toFixed(places);
  return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', '−');
}

function prefixed(value, digits, steps) {
  if (missing(value)) return NONE;
  const size = Math.abs(value);
  const last = size === 0 ? steps.length - 2 : steps.length - 1;
  const [factor, unit] = steps.find(([scale]) => size >= scale * 0.9995) ?? steps[last];
  return `${number(value / factor, digits)} ${unit}`;
}

const LENGTHS = [[1, 'm'], [1e-3, 'mm'], [1e-6, 'µm'], [1e-9, 'nm']];
const SPEEDS = [[1, 'm/s'], [1e-3, 'mm/s'], [1e-6, 'µm/s']];
const FORCES = [[1, 'N'], [1e-3, 'mN'], [1e-6, 'µN']];
const TIMES = [[1, 's'], [1e-3, 'ms'], [1e-6, 'µs']];

/** A length given in metres. */
export const metres = (value, digits = 3) => prefixed(value, digits, LENGTHS);
/** A velocity given in m/s. */
export const speed = (value, digits = 3) => prefixed(value, digits, SPEEDS);
/** A force given in newtons. */
export const newtons = (value, digits = 2) => prefixed(value, digits, FORCES);
/** A duration given in seconds. */
export const seconds = (value, digits = 3) => prefixed(value, digits, TIMES);
/** A level given in decibels. */
export const decibels = (value, places = 1) => (missing(value) ? NONE : `${fixed(value, places)} dB`);
/** A place given in mm. */
export const place = ([x, y]) => `${fixed(x)}, ${fixed(y)} mm`;

/** Units of a field's values: those in which `full` reads between 1 and 1000. */
export function fieldUnit(quantity, full) {
  const steps = quantity === 'velocity' ? SPEEDS : LENGTHS;
  const [factor, unit] = steps.find(([scale]) => full >= scale * 0.9995) ?? steps[steps.length - 1];
  return { factor, unit };
}

/** A field's value in the unit that suits it. */
export const fieldValue = (quantity, value, digits = 3) =>
  quantity === 'velocity' ? speed(value, digits) : metres(value, digits);

/** The next round number at or above: 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten. */
export function roundUp(value) {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value) + 1e-12);
  const step = [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((s) => value <= s * power * (1 + 1e-9));
  return (step ?? 10) * power;
}

/** Round ticks between two values, about `count` of them, and three or more: zero alone would tell no scale. */
export function ticks(from, to, count = 5) {
  const span = to - from;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const raw = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((s) => raw <= s * power * (1 + 1e-9)) ?? 10) * power;
  const out = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + span * 1e-9; i += 1) out.push(i === 0 ? 0 : i * step);
  return out.length < FEWEST && count < MOST ? ticks(from, to, 2 * count) : out;
}

/** Texts of ticks with just as many decimals as they need. */
export function tickTexts(values) {
  const texts = (places) => values.map((v) => v.toFixed(places));
  let places = 0;
  while (places < 6 && texts(places).some((t, i) => Math.abs(Number(t) - values[i]) > 1e-6 * Math.abs(values[i]))) {
    places += 1;
  }
  return texts(places).map((t) => t.replace('-', '−'));
}
