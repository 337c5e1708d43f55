// The rig panel: the device, its calibration, and a check of each stage between a touch and what is felt.

import { el, clear } from './dom.js';
import { RigState } from './rig-state.js';
import { CalibrateForm } from './calibrate-form.js';
import { JobLog } from './job-log.js';
import { JobMap } from './job-map.js';
import { calibration, devices, doctor } from './job-results.js';

const TELL = { calibrate: calibration, devices, doctor };

/** Fills `root` with the rig panel. */
export function mount(root, app) {
  const begin = (kind, request = {}) => app.link.send({ do: 'job', start: kind, ...request });
  const state = new RigState(app);
  const form = new CalibrateForm(app, (request) => begin('calibrate', request));
  const map = new JobMap(app);
  const button = (text, kind) => el('button', { type: 'button', class: 'button', on: { click: () => begin(kind) } }, text);
  const starts = { devices: button('Look for devices', 'devices'), doctor: button('Check every stage', 'doctor') };
  const jobs = new Map(Object.keys(TELL).map((kind) => [kind, new Job(kind, app)]));
  root.append(el('div', { class: 'panel-parts' },
    section('Device', state.node),
    section('Calibrate', el('p', { class: 'quiet' }, 'Measures what each actuator does at many points, and stores it as a library of responses.'),
      form.node, jobs.get('calibrate').log.node, map.node, jobs.get('calibrate').result),
    section('Devices', el('div', { class: 'row' }, starts.devices), jobs.get('devices').log.node, jobs.get('devices').result),
    section('Why is nothing felt?', el('div', { class: 'row' }, starts.doctor), jobs.get('doctor').log.node, jobs.get('doctor').result)));
  app.state.subscribe('job', (job) => {
    jobs.get(job.kind)?.show(job);
    const running = job.state === 'running';
    if (job.kind === 'calibrate') {
      form.enable(!running);
      if (job.quality) map.show(job.quality);
    } else if (starts[job.kind]) {
      starts[job.kind].disabled = running;
    }
  });
}

class Job {
  constructor(kind, app) {
    this.kind = kind;
    this.log = new JobLog((id) => app.link.send({ do: 'job', stop: id }), (text) => app.copy(text));
    this.result = el('div', { class: 'stack', 'aria-live': 'polite' });
  }

  show(job) {
    this.log.show(job);
    if (job.state === 'running' || !job.result) {
      clear(this.result);
      return;
    }
    clear(this.result).append(TELL[this.kind](job.result));
    this.log.lines.hidden = job.state === 'done' && this.kind !== 'calibrate';
  }
}

function section(title, ...content) {
  return el('section', { class: 'card stack' }, el('h2', {}, title), ...content);
}
