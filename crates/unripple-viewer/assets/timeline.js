// The line of time: ticks at focal instants, the way from one to the next, and a fine scale around one.

import { clear, el } from './dom.js';

/** How far the fine scale reaches to both sides, in s: a pulse of some swings. */
const FINE_S = 2e-3;

/** A moment is at a focal instant if it is no farther from it than this, in s: kept moments are 0.08 ms apart. */
const HERE_S = 1.2e-4;

/** Most ticks that are drawn: more would be a bar. */
const MOST = 120;

/** Half the width of the slider's thumb in CSS pixels: its middle goes no nearer to the ends. */
const THUMB = 8;

/** So long, in ms, a moment that was asked for counts as shown: its picture is on the way. */
const COMING_MS = 400;

/** Marks focal instants on the slider of time, and goes to them. */
export class Timeline {
  #asked = null;

  constructor(app, foci, transport) {
    this.app = app;
    this.foci = foci;
    this.transport = transport;
    this.ticks = document.getElementById('ticks');
    this.fine = document.getElementById('fine');
    document.getElementById('focus-before').addEventListener('click', () => this.go(-1));
    document.getElementById('focus-after').addEventListener('click', () => this.go(1));
    this.fine.addEventListener('click', () => this.zoom(!transport.zoom));
    foci.onChange(() => this.draw());
    app.state.subscribe('status', ({ live }) => {
      const { zoom } = transport;
      // Where time goes on, or has begun anew, there is nothing to look at finely.
      if (zoom && live && performance.now() > zoom.until) this.zoom(false);
      this.draw();
    });
  }

  /** The moment shown, or one that was just asked for, in s. */
  get shown() {
    if (this.#asked && performance.now() < this.#asked.until) return this.#asked.time;
    return this.app.state.last('frame')?.head.time_s ?? 0;
  }

  #show(time) {
    this.#asked = { time, until: performance.now() + COMING_MS };
    this.transport.send({ shown_s: time });
  }

  /** Shows the previous (-1) or the next (1) focal instant. */
  go(direction) {
    const { shown } = this;
    const { times } = this.foci;
    const found = direction < 0 ? times.filter((time) => time < shown - HERE_S).at(-1) : times.find((time) => time > shown + HERE_S);
    if (found === undefined) {
      const which = direction < 0 ? 'earlier' : 'later';
      this.app.toast(times.length ? `There is no ${which} focus in what is kept.` : 'There is no focus yet: press the surface.');
      return;
    }
    this.#show(found);
    if (this.transport.zoom) this.#around(found);
    const at = times.indexOf(found) + 1;
    this.app.announce(`Focus ${at} of ${times.length}`);
  }

  /** Makes the slider of time fine around the nearest focal instant, or as wide as what is kept. */
  zoom(on) {
    const { shown } = this;
    const nearest = this.foci.times.reduce((best, time) => (Math.abs(time - shown) < Math.abs(best - shown) ? time : best), Infinity);
    if (on && nearest === Infinity) {
      this.app.toast('There is no focus yet: press the surface.');
      return;
    }
    if (on) {
      this.#show(nearest);
      this.#around(nearest);
    } else {
      this.transport.zoom = null;
    }
    this.fine.setAttribute('aria-pressed', String(on));
    this.transport.reach();
    this.draw();
  }

  #around(time) {
    this.transport.zoom = { from: time - FINE_S, to: time + FINE_S, until: performance.now() + COMING_MS };
    this.transport.reach();
    this.draw();
  }

  draw() {
    const { scrub } = this.transport.parts;
    const [from, to] = [Number(scrub.min), Number(scrub.max)];
    const times = this.foci.times.filter((time) => time >= from && time <= to).slice(-MOST);
    const told = `${from} ${to} ${times.join()}`;
    if (this.ticks.dataset.told === told) return;
    this.ticks.dataset.told = told;
    clear(this.ticks);
    for (const time of times) {
      const share = (time - from) / (to - from || 1);
      const tick = el('i');
      tick.style.left = `calc(${THUMB}px + ${share} * (100% - ${2 * THUMB}px))`;
      this.ticks.append(tick);
    }
  }
}
