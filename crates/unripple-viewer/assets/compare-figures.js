// The figures of two methods on the same act, side by side with their ratio.

import { el, clear } from './dom.js';
import { why } from './why.js';
import { number, metres, speed, seconds, decibels } from './units.js';

const plain = (value) => number(value);
const share = (value) => (Number.isFinite(value) ? `${number(value * 100)} %` : '–');

// [key, label, how it is written, which way is better (0: neither), 'db' where the difference counts rather than the
// ratio]
const TARGET = [
  ['contrast', 'Contrast', plain, 1],
  ['background_contrast', 'Background contrast', plain, 1],
  ['worst_spot', 'Worst spot', plain, 1],
  ['felt_level_db', 'Felt level', decibels, 1, 'db'],
  ['felt_contrast_db', 'Felt contrast', decibels, 1, 'db'],
  ['felt_background_db', 'Felt background', decibels, 1, 'db'],
  ['felt_worst_spot_db', 'Felt worst spot', decibels, 1, 'db'],
  ['peak_displacement_m', 'Peak displacement', metres, 1],
  ['peak_velocity_m_s', 'Peak velocity', speed, 1],
  ['spot_diameter_m', 'Spot diameter', metres, -1],
  ['pulse_duration_s', 'Pulse duration', seconds, -1],
];
const WHOLE = [['felt_outside_db', 'Felt outside at most', decibels, -1, 'db']];
const DRIVE = [
  ['peak', 'Drive, peak', plain, 0],
  ['rms', 'Drive, rms', plain, -1],
  ['energy', 'Drive, energy', plain, -1],
  ['share_above_band', 'Drive, above the band', share, -1],
];

const MAGNITUDES = ['peak_displacement_m', 'peak_velocity_m_s'];

/** A table of both reports; which of two values is the better one is said in words too. */
export class CompareFigures {
  constructor() {
    this.target = 0;
    this.pick = el('select', { on: { change: () => this.picked() } });
    this.pickField = el('label', { class: 'field', hidden: true }, el('span', {}, 'Results at the place'), this.pick);
    this.head = el('tr', { role: 'row' });
    this.body = el('tbody', { role: 'rowgroup' });
    this.table = el('table', { class: 'figures compared stacks', role: 'table' },
      el('caption', { class: 'quiet' }, '● the better of the two'), el('thead', { role: 'rowgroup' }, this.head), this.body);
    this.node = el('div', { class: 'stack', hidden: true }, this.pickField, this.table);
  }

  show(panes) {
    this.panes = panes;
    const targets = panes[0]?.report?.targets ?? [];
    this.target = Math.min(this.target, Math.max(0, targets.length - 1));
    this.node.hidden = panes.length < 2;
    this.pickField.hidden = targets.length < 2;
    clear(this.pick);
    targets.forEach((target, i) => this.pick.append(el('option', { value: i }, place(target))));
    this.pick.value = String(this.target);
    this.fill();
  }

  /** The main result in one sentence. */
  sentence() {
    const [a, b] = this.panes.map((pane) => pane.report?.targets?.[this.target]?.contrast);
    const [nameA, nameB] = this.panes.map((pane) => pane.method);
    if (!Number.isFinite(a) || !Number.isFinite(b)) return `${nameA} and ${nameB} are ready`;
    return `Contrast ${number(a)} by ${nameA}, ${number(b)} by ${nameB}: ${number(b / a)} times`;
  }

  picked() {
    this.target = Number(this.pick.value);
    this.fill();
  }

  fill() {
    const [a, b] = this.panes;
    clear(this.head);
    this.head.append(
      ...['Figure', a.method, b.method, 'ratio'].map((text) => el('th', { scope: 'col', role: 'columnheader' }, text)));
    clear(this.body);
    this.rows(TARGET, (report) => report?.targets?.[this.target]);
    this.rows(WHOLE, (report) => report);
    const units = this.panes.map((pane) => pane.report?.actuators?.[0]?.unit ?? '');
    this.rows(DRIVE, (report) => report?.drive, units);
  }

  rows(list, part, units = ['', '']) {
    const parts = this.panes.map((pane) => part(pane.report));
    for (const [key, label, tell, better, kind] of list) {
      const values = parts.map((each) => (MAGNITUDES.includes(key) && each ? Math.abs(each[key]) : each?.[key]));
      if (values.every((value) => value === undefined || value === null)) continue;
      const best = winner(values, better);
      const unit = (i) => (key === 'peak' || key === 'rms' ? ` ${units[i]}` : key === 'energy' && units[i] ? ` ${units[i]}²s` : '');
      const cell = (i) => el('td', { role: 'cell', class: best === i ? 'is-better' : '' },
        best === i ? el('span', { 'aria-hidden': 'true' }, '● ') : null,
        Number.isFinite(values[i]) ? `${tell(values[i])}${unit(i)}` : '–',
        best === i ? el('span', { class: 'seen-not' }, ' (better)') : null);
      this.body.append(el('tr', { role: 'row' },
        el('th', { scope: 'row', role: 'rowheader' }, label, why(key, label)), cell(0), cell(1), el('td', { role: 'cell' }, ratio(values, kind))));
    }
  }
}

function winner([a, b], better) {
  if (!better || !Number.isFinite(a) || !Number.isFinite(b)) return -1;
  if (Math.abs(a - b) <= 0.005 * Math.max(Math.abs(a), Math.abs(b))) return -1;
  return (b > a) === (better > 0) ? 1 : 0;
}

function ratio([a, b], kind) {
  if (!Number.isFinite(a) || !Number.isFinite(b)) return '–';
  if (kind === 'db') return `${b < a ? '−' : '+'}${Math.abs(b - a).toFixed(1)} dB`;
  return a === 0 ? '–' : `× ${number(Math.abs(b / a))}`;
}

function place({ at_m: at, points }) {
  const text = (at ?? []).map((value) => (value * 1e3).toFixed(0)).join(', ');
  return points > 1 ? `${points} points around ${text} mm` : `${text} mm`;
}
