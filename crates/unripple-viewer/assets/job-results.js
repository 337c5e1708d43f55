// Answers of `calibrate`, `devices` and `doctor`, from the JSON of each command.

import { el } from './dom.js';
import { number, seconds, decibels } from './units.js';

const VERDICTS = { good: ['✓', 'good'], doubtful: ['!', 'doubtful'], failed: ['✕', 'failed'], skipped: ['–', 'skipped'] };

/** Figures of a calibration. */
export function calibration(result) {
  const rows = [
    ['Library', result.library],
    ['Points measured', counted(result.measured, result.points)],
    ['Bad points', Array.isArray(result.bad) ? String(result.bad.length) : result.bad],
    ['Signal to noise', spread(result.signal_to_noise_db, decibels)],
    ['Distortion', spread(result.distortion_db, decibels)],
    ['Decay time', spread(result.decay_time_s, seconds)],
    ['Reciprocity', Number.isFinite(result.reciprocity_error) ? `within ${number(result.reciprocity_error * 100, 2)} %` : null],
    ['Latency', Number.isFinite(result.latency_samples) ? `${number(result.latency_samples, 2)} samples` : null],
    ['Time taken', Number.isFinite(result.seconds) ? seconds(result.seconds) : null],
    ['The true surface', result.truth],
  ];
  return table('Result of the calibration', rows);
}

/** What drives can be played through. */
export function devices(result) {
  const list = Array.isArray(result) ? result : result.devices ?? [];
  if (!list.length) return rest(result);
  return el('ul', { class: 'checks' }, ...list.map((device) => {
    const there = device.available !== false;
    return check(there ? 'good' : 'skipped', device.device ?? device.name ?? 'device', there ? 'available' : 'not available',
      [device.why ?? device.found ?? details(device, ['device', 'name', 'available', 'why', 'found'])]);
  }));
}

/** The stages that the doctor checks, with the result of each, and likely reasons if nothing is felt. */
export function doctor(result) {
  const checks = result.checks ?? result.stages ?? (Array.isArray(result) ? result : []);
  if (!checks.length) return rest(result);
  const why = result.why_you_may_feel_nothing ?? result.reasons ?? [];
  return el('div', { class: 'stack' },
    el('p', { class: why.length ? '' : 'quiet' }, why.length
      ? 'Why you may feel nothing:'
      : 'No reason found. The threshold differs between persons; rest the finger lightly.'),
    why.length ? el('ol', {}, ...why.map((text) => el('li', {}, text))) : null,
    el('ul', { class: 'checks' }, ...checks.map((each) => {
      const verdict = String(each.verdict ?? each.state ?? (each.ok === false ? 'failed' : 'good')).toLowerCase();
      return check(verdict, each.name ?? each.stage ?? 'stage', VERDICTS[verdict]?.[1] ?? verdict,
        [each.found ?? each.text ?? details(each, ['name', 'stage', 'verdict', 'state', 'ok', 'fix']), each.fix ?? each.advice]);
    })));
}

function check(verdict, name, word, [found, fix]) {
  const [sign] = VERDICTS[verdict] ?? ['·'];
  return el('li', { class: `check-item is-${verdict}` },
    el('span', { class: 'check-sign', 'aria-hidden': 'true' }, sign),
    el('div', {},
      el('strong', {}, name), el('span', { class: 'check-word' }, ` ${word}`),
      found ? el('p', { class: 'quiet' }, found) : null,
      fix ? el('p', {}, fix) : null));
}

function table(caption, rows) {
  const known = rows.filter(([, value]) => value !== null && value !== undefined && value !== '');
  return el('table', { class: 'figures' },
    el('caption', { class: 'seen-not' }, caption),
    ...known.map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, String(value)))));
}

function spread(value, tell) {
  if (!value || !Number.isFinite(value.median)) return null;
  return Number.isFinite(value.worst) ? `${tell(value.median)}, worst ${tell(value.worst)}` : tell(value.median);
}

function counted(measured, points) {
  if (!Number.isFinite(points)) return measured;
  return `${measured ?? '–'} of ${points}`;
}

function details(object, but) {
  const kept = Object.entries(object).filter(([key, value]) => !but.includes(key) && value !== null && value !== undefined);
  return kept.map(([key, value]) => `${key}: ${typeof value === 'object' ? JSON.stringify(value) : value}`).join(', ');
}

// An answer of a shape that is not known here is still an answer.
function rest(result) {
  return el('pre', { class: 'mono job-lines', tabindex: '0', 'aria-label': 'Result' }, JSON.stringify(result, null, 2));
}
