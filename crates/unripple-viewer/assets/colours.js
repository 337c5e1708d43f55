// Colour maps computed in Oklab (B. Ottosson, 2020), where equal distances look equal. Blue against orange stays apart
// under every common colour blindness; lightness alone already shows the size of a value.

const LEVELS = 1024;

/** Arms of the diverging maps and paths of the sequential ones: lightness, chroma and hue (degrees) at control points. */
const PATHS = {
  dark: {
    minus: [[0.19, 0.012, 262], [0.36, 0.095, 258], [0.6, 0.135, 248], [0.88, 0.075, 215]],
    plus: [[0.19, 0.012, 262], [0.36, 0.085, 42], [0.6, 0.145, 52], [0.88, 0.12, 88]],
    rising: [[0.23, 0.03, 262], [0.42, 0.11, 285], [0.66, 0.14, 15], [0.9, 0.13, 90]],
  },
  light: {
    minus: [[0.985, 0.003, 250], [0.84, 0.07, 240], [0.62, 0.13, 250], [0.36, 0.13, 264]],
    plus: [[0.985, 0.003, 250], [0.86, 0.075, 72], [0.66, 0.14, 55], [0.38, 0.11, 38]],
    rising: [[0.97, 0.02, 95], [0.8, 0.12, 75], [0.55, 0.15, 20], [0.28, 0.1, 290]],
  },
};

/** Eight line colours after Okabe and Ito (2008), shifted in lightness to read on each ground. */
const SERIES = {
  dark: ['#56b4e9', '#e69f00', '#35c79a', '#e58cc0', '#f0e442', '#ff8552', '#a9b4ff', '#d5dbe3'],
  light: ['#0067a3', '#b35900', '#007a59', '#a8447e', '#7a6a00', '#b03a1c', '#4a54b8', '#3d444d'],
};

function toLab([lightness, chroma, hue]) {
  const angle = (hue * Math.PI) / 180;
  return [lightness, chroma * Math.cos(angle), chroma * Math.sin(angle)];
}

function linearRgb([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

function encode(x) {
  const c = Math.min(1, Math.max(0, x));
  return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
}

/** The nearest colour of less chroma that a screen can show. */
function toRgb(lab) {
  let [low, high] = [0, 1];
  const shown = (share) => linearRgb([lab[0], lab[1] * share, lab[2] * share]);
  const fits = (rgb) => rgb.every((c) => c >= -1e-4 && c <= 1.0001);
  if (fits(shown(1))) low = 1;
  else {
    for (let i = 0; i < 20; i += 1) {
      const middle = (low + high) / 2;
      if (fits(shown(middle))) low = middle;
      else high = middle;
    }
  }
  return shown(low).map(encode);
}

/** A smooth path through control points in Oklab, at equal distances along it. */
function tabulate(points, count) {
  const labs = points.map(toLab);
  const fine = [];
  const per = 256;
  for (let i = 0; i + 1 < labs.length; i += 1) {
    for (let j = 0; j < per; j += 1) fine.push(between(labs, i, j / per));
  }
  fine.push(labs[labs.length - 1]);
  const travelled = [0];
  for (let i = 1; i < fine.length; i += 1) {
    travelled.push(travelled[i - 1] + Math.hypot(...fine[i].map((c, k) => c - fine[i - 1][k])));
  }
  const whole = travelled[travelled.length - 1];
  let at = 1;
  return Array.from({ length: count }, (_, i) => {
    const wanted = (whole * i) / (count - 1);
    while (at < fine.length - 1 && travelled[at] < wanted) at += 1;
    const share = (wanted - travelled[at - 1]) / (travelled[at] - travelled[at - 1]);
    return toRgb(fine[at].map((c, k) => fine[at - 1][k] + (c - fine[at - 1][k]) * Math.min(1, Math.max(0, share))));
  });
}

function between(labs, i, t) {
  const at = (k) => labs[Math.min(labs.length - 1, Math.max(0, k))];
  const [p, q, r, s] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
  return q.map((_, k) => {
    const slope = (r[k] - p[k]) / 2;
    const next = (s[k] - q[k]) / 2;
    const t2 = t * t;
    const t3 = t2 * t;
    return q[k] * (2 * t3 - 3 * t2 + 1) + slope * (t3 - 2 * t2 + t) + r[k] * (3 * t2 - 2 * t3) + next * (t3 - t2);
  });
}

const tables = new Map();

function table(name, theme) {
  const key = `${name} ${theme}`;
  if (!tables.has(key)) tables.set(key, make(name, PATHS[theme] ?? PATHS.dark));
  return tables.get(key);
}

function make(name, paths) {
  if (name === 'rising') return tabulate(paths.rising, LEVELS);
  const minus = tabulate(paths.minus, LEVELS / 2);
  const plus = tabulate(paths.plus, LEVELS / 2);
  return [...minus.reverse(), ...plus];
}

const pick = (colours, share) => {
  const level = Math.round(share * (LEVELS - 1));
  return colours[Math.min(LEVELS - 1, Math.max(0, Number.isFinite(level) ? level : 0))];
};

/** Colour of a signed share of the full scale, -1 to 1. */
export const diverging = (t, theme) => pick(table('diverging', theme), (t + 1) / 2);
/** Colour of a share of the full scale, 0 (near the ground) to 1. */
export const sequential = (t, theme) => pick(table('rising', theme), t);
/** A colour as CSS text. */
export const css = ([r, g, b], alpha = 1) => `rgb(${r} ${g} ${b} / ${alpha})`;
/** Colour of the i-th line of a chart. */
export const seriesColour = (i, theme) => (SERIES[theme] ?? SERIES.dark)[((i % 8) + 8) % 8];

/** The diverging map as pixels for an image's memory: red in the lowest byte. */
export function divergingPixels(theme) {
  return Uint32Array.from(table('diverging', theme), ([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
}

/** The diverging map as bytes for a texture, RGBA. */
export const divergingBytes = (theme) => new Uint8Array(divergingPixels(theme).buffer);
