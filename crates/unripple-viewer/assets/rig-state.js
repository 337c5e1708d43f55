// The device that plays, and how the sheet has drifted.

import { el, setText } from './dom.js';
import { number } from './units.js';

/** State of the device from `settings` and `status`. */
export class RigState {
  constructor(app) {
    this.told = el('p', { role: 'status' });
    this.table = el('table', { class: 'figures' });
    this.address = el('code', {});
    this.elsewhere = el('div', { class: 'command', hidden: true }, this.address,
      el('button', {
        type: 'button', class: 'button small', 'aria-label': 'Copy the address', on: { click: () => app.copy(this.link) },
      }, 'Copy'));
    this.node = el('div', { class: 'stack' }, this.told, this.elsewhere, this.table);
    this.rows = new Map();
    app.state.subscribe('settings', ({ device, address }) => {
      this.device(device);
      this.reach(address);
    });
    app.state.subscribe('status', (status) => this.status(status));
  }

  device(device) {
    if (device) this.row('Device', `${device.name}${device.real ? '' : ' (computed)'}`);
  }

  // Where another machine of this network opens the page, if it may.
  reach(address) {
    this.link = address ?? null;
    this.elsewhere.hidden = !this.link;
    setText(this.address, this.link ? `From elsewhere on this network: ${this.link}` : '');
  }

  status({ state, tally, drift, drive_peak: peaks, rms, speed_real: speed }) {
    const well = state === 'running';
    setText(this.told, well ? 'Running' : String(state ?? 'nothing is known'));
    this.told.className = well ? 'is-good' : 'is-bad';
    if (Number.isFinite(speed)) this.row('Speed of the clock', `${number(speed * 100)} %`);
    if (peaks?.length) this.row('Drive, highest peak', `${number(Math.max(...peaks) * 100, 2)} % of the limit`);
    if (rms?.length) this.row('Drive, highest rms', `${number(Math.max(...rms) * 100, 2)} % of the limit`);
    if (tally) {
      this.row('Pulses started', tally.started);
      this.row('Scaled down to the limit', tally.limited);
      this.row('Blocks lost', tally.lost);
    }
    this.drift(drift);
  }

  drift(drift) {
    if (!drift) {
      this.row('Drift of the tension', 'not followed');
      return;
    }
    const percent = (drift.tension - 1) * 100;
    const error = Number.isFinite(drift.error) ? ` ± ${number(drift.error * 100, 2)}` : '';
    this.row('Drift of the tension', Number.isFinite(percent) ? `${percent < 0 ? '−' : '+'}${number(Math.abs(percent), 2)}${error} %` : '–');
  }

  row(name, value) {
    if (value === undefined || value === null) return;
    if (!this.rows.has(name)) {
      const cell = el('td', {});
      this.rows.set(name, cell);
      this.table.append(el('tr', {}, el('th', { scope: 'row' }, name), cell));
    }
    setText(this.rows.get(name), String(value));
  }
}
