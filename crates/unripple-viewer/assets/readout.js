// What is going on now: fingers and what they feel, the drive as a share of its limit, counts of what was played, the
// device, drift.

import { clear, el, setText } from './dom.js';
import { decibels, fixed, newtons, number, place } from './units.js';
import { speedText } from './transport.js';

// Share of the wanted speed from which it counts as kept: speeds are told in hundredths, over a second.
const KEPT = 0.9;

/** The fingers on the surface, each with the level it feels. */
function fingersPart(root, app) {
  const list = el('div', { class: 'fingers' });
  const none = el('p', { class: 'quiet', text: 'No finger on the surface.' });
  root.append(el('h2', { text: 'Fingers' }), none, list);
  app.state.subscribe('status', ({ fingers = [] }) => {
    none.hidden = fingers.length > 0;
    while (list.children.length > fingers.length) list.lastChild.remove();
    fingers.forEach((finger, i) => {
      const row = list.children[i] ?? list.appendChild(el('div', { class: 'card finger' },
        el('b'), el('span', { class: 'quiet' }), el('span'), el('span', { class: 'quiet' })));
      const felt = finger.level_db === null || finger.level_db === undefined
        ? 'Not felt yet' : `${decibels(finger.level_db)} above threshold`;
      setText(row.children[0], `Finger ${i + 1}`);
      setText(row.children[1], place(finger.at_mm));
      setText(row.children[2], felt);
      const more = [finger.contrast == null ? '' : `contrast ${number(finger.contrast)}`, finger.force_n == null ? '' : newtons(finger.force_n)];
      setText(row.children[3], more.filter(Boolean).join(', '));
    });
  });
}

/** Peak and effective drive of each actuator as a share of its limit. */
function drivePart(root, app) {
  const bars = el('div', { class: 'bars', role: 'group', 'aria-label': 'Drive of the actuators, share of the limit' });
  root.append(el('h2', { text: 'Drive' }), el('p', { class: 'quiet', text: 'Peak (pale) and rms over the last 0.2 s, against the limit.' }), bars);
  let rows = [];
  app.state.subscribe('surface', ({ actuators = [] }) => {
    clear(bars);
    rows = actuators.map((actuator) => {
      const meter = el('div', { class: 'meter' }, el('i', { class: 'peak' }), el('i', { class: 'rms' }));
      const text = el('span', { class: 'mono' });
      bars.append(el('span', { text: actuator.name }), meter, text);
      return { meter, text, actuator };
    });
  });
  app.state.subscribe('status', ({ drive_peak = [], rms = [] }) => {
    rows.forEach(({ meter, text, actuator }, i) => {
      const peak = drive_peak[i] ?? 0;
      const percent = (share) => `${(100 * Math.min(1, Math.max(0, share))).toFixed(1)}%`;
      meter.children[0].style.width = percent(peak);
      meter.children[1].style.width = percent(rms[i] ?? 0);
      meter.toggleAttribute('data-full', peak >= 0.999);
      setText(text, `${number(peak * actuator.limit, 2)} of ${number(actuator.limit)} ${actuator.unit}`);
    });
  });
}

function tallyText(tally) {
  if (!tally) return '–';
  const parts = [`${tally.started ?? 0} started`, `${tally.limited ?? 0} scaled down to the limit`, `${tally.lost ?? 0} lost`];
  if (tally.failed) parts.push(`${tally.failed} failed${tally.failure ? `: ${tally.failure}` : ''}`);
  return parts.join(', ');
}

function driftText(drift) {
  if (!drift) return 'not followed';
  const change = `${fixed((drift.tension - 1) * 100, 2)} %`;
  const error = drift.error == null ? '' : ` ± ${number(drift.error * 100, 2)} %`;
  return `${change}${error}${drift.explained === false ? ', not explained: calibrate again' : ''}`;
}

/** Device, drift, tally, clock: a table of figures. */
function devicePart(root, app) {
  const cells = {};
  const table = el('table', { class: 'figures' });
  for (const name of ['Device', 'State', 'Pulses', 'Drift of tension', 'Speed of the surface']) {
    cells[name] = el('td');
    table.append(el('tr', {}, el('th', { scope: 'row', text: name }), cells[name]));
  }
  root.append(el('h2', { text: 'Device' }), table);
  app.state.subscribe('settings', ({ device }) => {
    setText(cells.Device, device ? `${device.name}${device.real ? '' : ' (no hardware)'}` : '–');
  });
  app.state.subscribe('status', (status) => {
    const { tally, drift, state, speed_real } = status;
    setText(cells.State, state ?? '–');
    setText(cells.Pulses, tallyText(tally));
    setText(cells['Drift of tension'], driftText(drift));
    setText(cells['Speed of the surface'], speed_real == null ? '–' : `${fixed(speed_real, 2)} × real time`);
  });
}

/** The line at the foot of the page. */
export function mountFoot(app, cost) {
  const [clock, device, viewers, spent] = ['clock', 'device', 'viewers', 'cost'].map((id) => document.getElementById(`foot-${id}`));
  let wanted = null;
  // What is asked for, and beside it what this machine gives where that is less.
  const sayRate = (real) => {
    const asked = speedText(wanted.speed).toLowerCase();
    const short = real != null && !wanted.paused && real < KEPT * wanted.speed;
    setText(device, `${wanted.device?.name ?? 'no device'}, ${short ? `${number(real, 2)} of real time (slower than asked)` : asked}`);
  };
  app.state.subscribe('status', (status) => {
    setText(clock, `${fixed(status.clock_s, 1)} s`);
    if (wanted) sayRate(status.speed_real);
    setText(viewers, status.viewers === 1 ? '1 viewer' : `${status.viewers} viewers`);
  });
  app.state.subscribe('settings', (settings) => {
    wanted = settings;
    sayRate(app.state.last('status')?.speed_real);
  });
  setInterval(() => {
    setText(spent, `${fixed(cost.mean_ms, 1)} ms per frame, ${fixed(cost.frames_per_s, 0)} frames/s`);
  }, 1000);
}

/** The live read-outs of the panel Touch. */
export function mount(root, app) {
  const part = (fill) => {
    const box = el('div', { class: 'stack' });
    root.append(box);
    fill(box, app);
  };
  part(fingersPart);
  part(drivePart);
  part(devicePart);
}
