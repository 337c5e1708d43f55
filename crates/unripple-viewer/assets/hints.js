// Hints for a newcomer, once each: to press, then to slow time down.

import { setText } from './dom.js';

const SHOWN_MS = 8000;
const SLOW = 'Slow time down to see the waves';

/** Shows the hint over the map until the first press, and after it, for a while, the one at the named speeds. */
export class Hints {
  #timer = null;

  constructor(app, stage) {
    this.app = app;
    this.stage = stage;
    this.press = document.getElementById('hint');
    this.slow = document.getElementById('slow-hint');
    for (const kind of ['surface', 'view', 'tab', 'intro']) app.state.subscribe(kind, () => this.show());
    app.state.subscribe('settings', (settings) => this.#passing(settings));
  }

  /** Shows the first hint where it belongs. */
  show() {
    const { app, stage } = this;
    const introduced = app.state.last('intro')?.on === true;
    this.press.hidden = introduced || app.state.ui.pressed === true || !stage.sheet || stage.view !== 'map' || app.shown() !== 'touch';
  }

  /** A finger is down. */
  pressed() {
    const { ui } = this.app.state;
    if (ui.pressed) return;
    ui.pressed = true;
    this.show();
    if (this.app.playout.active || this.#slowed(this.app.state.last('settings'))) return;
    setText(this.slow, SLOW);
    this.slow.hidden = false;
    this.app.announce(SLOW);
    this.#timer = setTimeout(() => this.#done(), SHOWN_MS);
  }

  #slowed(settings) {
    return !settings || settings.speed < 1 || settings.paused;
  }

  #passing(settings) {
    if (this.#timer !== null && this.#slowed(settings)) this.#done();
  }

  #done() {
    clearTimeout(this.#timer);
    this.#timer = null;
    this.slow.hidden = true;
  }
}
