// Measuring what is on the surface: the same act as `unripple focus`, with the same figures and the command to repeat it.

import { Chart } from './chart.js';
import { el, setText } from './dom.js';
import { chosen } from './settings.js';
import { why } from './why.js';
import { decibels, fieldUnit, metres, number, place, seconds, speed } from './units.js';

const FIGURES = [
  ['Contrast', 'contrast', number], ['Background', 'background_contrast', number], ['Worst spot', 'worst_spot', number],
  ['Peak velocity', 'peak_velocity_m_s', speed], ['Peak displacement', 'peak_displacement_m', metres],
  ['Spot diameter', 'spot_diameter_m', metres], ['Pulse duration', 'pulse_duration_s', seconds],
  ['Felt level', 'felt_level_db', decibels], ['Felt contrast', 'felt_contrast_db', decibels],
  ['Felt background', 'felt_background_db', decibels], ['Felt worst spot', 'felt_worst_spot_db', decibels],
];

/** The figures of a report, a column per target. */
function figures(report) {
  const targets = report.targets ?? [];
  const table = el('table', { class: 'figures' });
  if (targets.length > 1) {
    table.append(el('thead', {}, el('tr', {}, el('th', { text: 'Target' }), targets.map((t, i) => el('th', { scope: 'col', text: String(i + 1) })))));
  }
  const body = el('tbody');
  for (const [name, key, say] of FIGURES) {
    body.append(el('tr', {}, el('th', { scope: 'row' }, name, why(key, name)), targets.map((target) => el('td', { text: say(target[key]) }))));
  }
  const { drive = {}, actuators = [] } = report;
  const unit = actuators[0]?.unit ?? '';
  const whole = (name, key, text) => body.append(el('tr', {}, el('th', { scope: 'row' }, name, why(key, name)), el('td', { colspan: Math.max(1, targets.length), text })));
  whole('Drive peak', 'peak', `${number(drive.peak)} ${unit}`);
  whole('Drive rms', 'rms', `${number(drive.rms)} ${unit}`);
  whole('Drive energy', 'energy', `${number(drive.energy)} ${unit}²·s`);
  whole('Felt outside', 'felt_outside_db', decibels(report.felt_outside_db));
  table.append(body);
  return table;
}

/** The form: where, how strong, and the buttons; `begun(id)` is called for what is asked, `stop()` to give it up. */
function form(app, begun, stop) {
  const peak = el('input', { type: 'number', min: '0.001', step: 'any', placeholder: 'as linear theory allows', inputmode: 'decimal' });
  const where = el('p', { class: 'quiet' });
  let places = [];
  const button = el('button', {
    type: 'button', class: 'button primary', text: 'Measure',
    on: {
      click: () => {
        const settings = chosen(app);
        const id = app.nextId();
        const sent = app.link.send({
          do: 'measure', id, at: places, method: settings?.method ?? 'time-reversal',
          window_ms: settings?.window_ms ?? null, peak_um: peak.value === '' ? null : Number(peak.value),
        });
        if (sent) begun(id);
      },
    },
  });
  const stopper = el('button', { type: 'button', class: 'button', hidden: true, 'aria-label': 'Stop measuring', text: 'Stop', on: { click: stop } });
  const round = ([x, y]) => [Math.round(x * 100) / 100, Math.round(y * 100) / 100];
  app.state.subscribe('surface', ({ extent_mm: [w, h] }) => {
    if (places.length === 0) places = [round([w / 2, h / 2])];
    setText(where, `At ${places.map(place).join('; ')} (the places pressed last).`);
  });
  app.state.subscribe('place', ({ at_mm, all_mm }) => {
    places = (all_mm ?? [at_mm]).slice(0, 8).map(round);
    setText(where, `At ${places.map(place).join('; ')} (the places pressed last).`);
  });
  const wanted = el('label', { class: 'field' }, el('span', {}, 'Peak wanted ', el('i', { text: 'µm' })), peak);
  return { button, stopper, parts: [where, el('div', { class: 'row' }, button, stopper), wanted] };
}

/** Charts of a measured act: motion at targets, drive, spectrum. */
function charts() {
  const make = (axes) => {
    const canvas = el('canvas', { class: 'plot' });
    return { canvas, chart: new Chart(canvas, axes) };
  };
  const motion = make({ x: 'Time', xUnit: 'ms', y: 'Displacement', yUnit: 'µm', label: 'Displacement at the targets' });
  const drive = make({ x: 'Time', xUnit: 'ms', y: 'Drive', yUnit: '', label: 'Drive of the actuators over its duration' });
  const spectrum = make({ x: 'Frequency', xUnit: 'Hz', y: 'Level', yUnit: 'dB', log: true, label: 'Spectrum of the drive and at the target' });
  const draw = (message) => {
    const { traces = [], spectrum: lines, drive: driven, report } = message;
    const most = traces.reduce((m, t) => t.displacement_um.reduce((n, um) => Math.max(n, Math.abs(um)), m), 0);
    const { factor, unit } = fieldUnit('displacement', 1e-6 * most);
    motion.chart.axes.yUnit = unit;
    motion.chart.draw({
      series: traces.map((t) => ({
        name: t.name, y: t.displacement_um.map((um) => (1e-6 * um) / factor),
        x: t.displacement_um.map((_, i) => 1e3 * (t.start_s + i / t.rate)),
      })),
      marks: report?.window_s ? [{ x: 1e3 * report.window_s, text: 'focus' }] : [],
    });
    const preview = driven?.preview ?? [];
    drive.chart.axes.yUnit = report?.actuators?.[0]?.unit ?? '';
    const length = 1e3 * (report?.drive?.duration_s ?? 0);
    drive.chart.draw({
      series: preview.map((y) => ({ name: '', y, x: y.map((_, i) => (length * i) / Math.max(1, y.length - 1)), width: 1 })),
    });
    spectrum.canvas.hidden = !lines;
    if (!lines) return;
    const atTargets = Array.isArray(lines.target_db?.[0]) ? lines.target_db : [lines.target_db ?? []];
    const top = Math.max(-200, ...[...(lines.drive_db ?? []), ...atTargets].flat().filter(Number.isFinite));
    const hz = lines.hz.map((f) => Math.max(1, f));
    spectrum.chart.draw({
      xRange: [Math.max(20, hz[1] ?? hz[0]), hz[hz.length - 1]], yRange: [top - 80, top + 5],
      series: [
        ...(lines.drive_db ?? []).map((y) => ({ x: hz, y, width: 0.8 })),
        ...atTargets.map((y) => ({ x: hz, y, width: 2.2, colour: 'currentColor' })),
      ],
    });
  };
  return { draw, parts: [motion, drive, spectrum].map((c) => c.canvas) };
}

/** Measuring, in the panel Touch. */
export function mount(root, app) {
  const busyText = el('p', { class: 'quiet', role: 'status' });
  let asked = null;
  const busy = (id, text) => {
    asked = id;
    button.disabled = id !== null;
    stopper.hidden = id === null;
    setText(busyText, text);
  };
  const over = (text) => asked !== null && busy(null, text);
  const stop = () => app.link.send({ do: 'stop', id: asked }) && setText(busyText, 'Stopping …');
  const { button, stopper, parts } = form(app, (id) => busy(id, 'Measuring …'), stop);
  const table = el('div');
  const code = el('code');
  const command = el('div', { class: 'command' }, code,
    el('button', { type: 'button', class: 'button small', text: 'Copy', on: { click: () => app.copy(code.textContent) } }));
  const notes = el('ul', { class: 'notes' });
  const drawn = charts();
  const files = ['drive.wav', 'report.md', 'report.json'].map((name) => el('a', { class: 'button small', download: name, text: name }));
  const links = el('div', { class: 'row' }, files);
  const stale = el('p', { class: 'quiet', hidden: true, text: 'The surface has been changed since: measure again for its results.' });
  let of = null;
  const compared = () => {
    stale.hidden = of === null || of === app.state.last('surface')?.edit;
  };
  const found = el('div', { class: 'stack', hidden: true }, stale, table, el('h3', { text: 'The same from the command line' }), command,
    notes, drawn.parts, el('p', { class: 'quiet', text: 'Spectrum: thin lines are the drives, thick lines the motion at the targets.' }), links);
  root.append(el('h2', { text: 'Measure' }), ...parts, busyText, found);
  app.state.subscribe('measured', (message) => {
    found.hidden = false;
    of = message.edit ?? null;
    compared();
    for (const file of files) file.href = app.line.address(`/${file.download}?id=${message.id}`);
    table.replaceChildren(figures(message.report ?? {}));
    setText(code, message.command ?? '');
    notes.replaceChildren(...(message.report?.notes ?? []).map((note) => el('li', { text: `${note.topic}: ${note.text}` })));
    drawn.draw(message);
    // A story of this page measures too; what was asked for here still comes.
    if (asked === null || asked === message.id) busy(null, `Measured in ${seconds(message.seconds)}.`);
  });
  app.state.subscribe('stopped', ({ id }) => id === asked && over('Stopped.'));
  app.state.subscribe('surface', compared);
  app.state.subscribe('fault', () => over(''));
  app.state.subscribe('connection', ({ open }) => !open && over(''));
}
