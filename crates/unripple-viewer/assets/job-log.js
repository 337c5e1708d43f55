// One job of the server as it runs: command, progress, last lines, stop.

import { el } from './dom.js';

const STATES = { running: 'runs', done: 'done', failed: 'failed' };

/** What is known of a job from its `job` messages; `stop(id)` and `copy(text)` are called by its buttons. */
export class JobLog {
  constructor(stop, copy) {
    this.id = null;
    this.state = el('p', { role: 'status' });
    this.bar = el('progress', { max: 1 });
    this.stop = el('button', { type: 'button', class: 'button', on: { click: () => stop(this.id) } }, 'Stop');
    this.command = el('code', {});
    this.lines = el('pre', { class: 'mono job-lines', role: 'log', tabindex: '0', 'aria-label': 'Last lines' });
    this.commandRow = el('div', { class: 'command' }, this.command,
      el('button', { type: 'button', class: 'button small', on: { click: () => copy(this.command.textContent) } }, 'Copy'));
    this.node = el('div', { class: 'stack', hidden: true },
      el('div', { class: 'job-bar' }, this.bar, this.stop), this.state, this.commandRow, this.lines);
  }

  show(job) {
    const running = job.state === 'running';
    this.id = job.id;
    this.node.hidden = false;
    if (Number.isFinite(job.progress)) this.bar.value = job.progress;
    else if (running) this.bar.removeAttribute('value');
    else this.bar.value = job.state === 'done' ? 1 : 0;
    this.bar.setAttribute('aria-label', `Progress of ${job.kind}`);
    this.bar.hidden = !running;
    this.stop.hidden = !running;
    this.tell(job);
    this.command.textContent = job.command ?? '';
    this.commandRow.hidden = !job.command;
    const text = (job.lines ?? []).join('\n');
    this.lines.hidden = !text;
    if (this.lines.textContent !== text) {
      const atEnd = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight < 12;
      this.lines.textContent = text;
      if (atEnd) this.lines.scrollTop = this.lines.scrollHeight;
    }
  }

  // In tenths, so that a screen reader does not read every step.
  tell(job) {
    const part = Number.isFinite(job.progress) && job.state === 'running' ? `, ${Math.floor(job.progress * 10) * 10} %` : '';
    const text = `${job.kind}: ${STATES[job.state] ?? job.state}${part}`;
    if (this.state.textContent !== text) this.state.textContent = text;
    this.state.className = job.state === 'failed' ? 'is-bad' : job.state === 'done' ? 'is-good' : 'quiet';
  }
}
