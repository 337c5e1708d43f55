// How a touch plays out: slowly until the waves meet under it, then a halt at that instant, with a mark; then on as before.

import { fingerTraces, near, strongest } from './foci.js';
import { drawMet } from './marks.js';
import { fieldValue } from './units.js';

/** Time before the focus that is seen slowest, in s of the surface: a ring then closes in from a few centimetres. */
const NEAR_S = 2.5e-3;

/** How much later than a window after the press a focus may come, in s of the surface: a touch waits for a block to begin. */
const LATE_S = 2e-3;

/** Seconds of the page for all that comes before. Whoever waits longer thinks that nothing happens. */
const FAR_TAKES_S = 2.5;

/** Speed at which the waves close in, if no slower one is set: a pulse of 0.17 ms then lasts a twelfth of a second. */
const NEAR_SPEED = 1 / 500;

/** Where less motion is wanted: a few pictures until the focus. Any faster, and a tap may be over before a picture of it is made. */
const STILL_SPEED = 1 / 20;

const SLOWEST = 1 / 2000;

/** From this many times a trace's rms on, what is over is a focus, whatever comes. */
const SURELY = 8;

/** So long after it, in s, a swing is over. */
const OVER_S = 6e-4;

/** How long time stands still at the focus, in ms. */
const HALT_MS = 1600;

/** Longest that a finger is waited for, in ms: it may have been pressed beside the surface, or refused. */
const LOST_MS = 4000;

/** So long, in ms, the session may take to tell how time passes now. */
const TOLD_MS = 1000;

/** Plays touches out, one after the other. `on` says whether it does. */
export class Playout {
  #now = null;
  #mark = null;
  #restored = null;
  #still = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(app, stage) {
    this.app = app;
    this.stage = stage;
    this.button = document.getElementById('playout');
    this.button.addEventListener('click', () => this.set(!this.on));
    app.state.subscribe('frame', (frame) => frame.pane === 0 && this.#look(frame));
    app.state.subscribe('connection', ({ open }) => !open && this.interrupt());
    this.set(app.atRest ? false : app.state.ui.playout !== false);
  }

  set(on) {
    this.on = on;
    this.button.setAttribute('aria-pressed', String(on));
    if (!this.app.atRest) this.app.state.ui.playout = on;
    if (!on) this.interrupt();
  }

  /** Whether time is under way to a focus, or stands still at one. */
  get active() {
    return this.#now !== null;
  }

  /** Whether time is this page's to slow: that of a real surface is not, and others may be looking. */
  get allowed() {
    const { state } = this.app;
    const settings = state.last('settings');
    const alone = (state.last('status')?.viewers ?? 1) <= 1;
    return Boolean(settings) && !settings.device?.real && alone && this.stage.panes === 1 && !document.body.hasAttribute('data-story');
  }

  /** A finger is about to press a place, in mm. */
  press(mm) {
    if (this.on && this.allowed) this.meet(mm);
  }

  /**
   * Lets time pass until the waves of the next press at a place meet there, and stands still at that instant for `halt_ms`. Resolves to
   * `{time, size}` then, or to `null` when that does not come.
   */
  meet(mm, { halt_ms: halt = HALT_MS, hurry = 1 } = {}) {
    const { state } = this.app;
    const { speed, paused, window_ms, window_auto_ms } = state.last('settings');
    // What was set before the touch that is still under way is what comes back.
    const late = this.#restored && performance.now() - this.#restored.since < TOLD_MS ? this.#restored : null;
    const before = this.#now?.before ?? late ?? { speed, paused };
    this.#now?.done(null);
    clearTimeout(this.#now?.timer);
    this.unmark();
    const window = (window_ms ?? window_auto_ms) / 1000;
    const chosen = before.speed < 1 ? before.speed : 0;
    const clamp = (value) => Math.min(1, Math.max(SLOWEST, value));
    const still = this.#still.matches;
    const plan = {
      mm, window, halt, before, touched: null, untouched: state.last('frame')?.head.time_s ?? 0, best: null, halted: false,
      far: still ? STILL_SPEED : clamp(Math.max(hurry * (window - NEAR_S) / FAR_TAKES_S, chosen)),
      near: still ? STILL_SPEED : clamp(hurry * (chosen || NEAR_SPEED)),
    };
    const met = new Promise((done) => { plan.done = done; });
    plan.timer = setTimeout(() => this.#now === plan && plan.touched === null && this.interrupt(), LOST_MS);
    this.#now = plan;
    this.#send({ live: true, paused: false, speed: plan.far });
    plan.speed = plan.far;
    return met;
  }

  /** Somebody else moves time from here on. */
  interrupt() {
    this.#restored = null;
    const plan = this.#now;
    if (!plan) return;
    this.#end();
    this.#send({ speed: plan.before.speed });
    plan.done(null);
  }

  #send(change) {
    if (this.app.link.open) this.app.link.send({ do: 'transport', ...change });
  }

  #end() {
    clearTimeout(this.#now.timer);
    this.#now = null;
    this.unmark();
  }

  #look(frame) {
    const plan = this.#now;
    if (!plan || plan.halted) return;
    const { head } = frame;
    if (plan.touched === null) {
      const there = (head.fingers ?? []).some(({ at_mm: mm }) => near(mm, plan.mm));
      if (!there) {
        plan.untouched = head.time_s;
        return;
      }
      plan.touched = head.time_s;
      // A clock may have begun anew.
      plan.untouched = Math.min(plan.untouched, plan.touched);
    }
    this.#follow(plan, frame);
  }

  #follow(plan, frame) {
    const { time_s: now } = frame.head;
    const due = plan.touched + plan.window;
    const [trace] = fingerTraces(frame, plan.mm);
    const found = trace && strongest(frame, trace, plan.untouched + plan.window - LATE_S, due + LATE_S);
    if (found && found.size > (plan.best?.size ?? 0)) plan.best = found;
    const wanted = due - now > NEAR_S ? plan.far : plan.near;
    const over = plan.best && plan.best.stands > SURELY && now - plan.best.time > OVER_S;
    if (over || now > due + LATE_S) this.#halt(plan);
    else if (wanted !== plan.speed) {
      plan.speed = wanted;
      this.#send({ speed: wanted });
    }
  }

  #halt(plan) {
    if (!plan.best) {
      this.interrupt();
      return;
    }
    plan.halted = true;
    clearTimeout(plan.timer);
    const { time, size } = plan.best;
    this.#send({ paused: true, shown_s: time });
    this.mark(plan.mm, `focus: ${fieldValue(this.stage.quantity, size)}`);
    this.app.announce(`The waves meet: ${fieldValue(this.stage.quantity, size)}`);
    plan.done({ time, size });
    plan.timer = setTimeout(() => this.#now === plan && this.#goOn(plan), plan.halt);
  }

  #goOn({ before }) {
    this.#end();
    this.restore(before);
  }

  /** Lets time pass as it did before, or stand still. */
  restore({ speed, paused }) {
    this.#restored = { speed, paused, since: performance.now() };
    if (paused) this.#send({ speed });
    else this.#send({ live: true, paused: false, speed });
  }

  /** Marks where waves meet, until `interrupt` or the end of the halt. */
  mark(mm, text) {
    this.unmark();
    this.#mark = this.stage.addLayer({ draw: (ctx, view) => drawMet(ctx, view, mm, text) });
  }

  /** Takes the mark away. */
  unmark() {
    this.#mark?.();
    this.#mark = null;
  }
}
