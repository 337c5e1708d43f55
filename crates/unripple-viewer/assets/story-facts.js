// What the texts of stories quote: always the last answers of the server, never numbers of their own.

import { number, metres, seconds, decibels, speed } from './units.js';

const OPEN = '…';

/** Answers gathered while a story runs, read by its texts; what is not there yet reads as an ellipsis. */
export class StoryFacts {
  constructor(app) {
    this.app = app;
    this.clear();
  }

  clear() {
    this.answers = new Map();
    this.compared = null;
    this.waiting = new Map();
    this.later = [];
    this.running = null;
    this.focusPeak = null;
  }

  /** Asks for a measurement under a name, after those that were asked for before: a newer one would take their place. */
  measure(name, request) {
    this.later.push([name, request]);
    this.next();
  }

  next() {
    if (this.running !== null || !this.later.length || !this.app.link.open) return;
    const id = this.app.nextId();
    const [name, request] = this.later.shift();
    this.waiting.set(id, [name, request]);
    this.running = id;
    this.app.link.send({ do: 'measure', id, method: 'time-reversal', window_ms: null, peak_um: null, ...request });
  }

  /** Takes a `measured` message; returns whether it was asked for here. */
  take(message) {
    const asked = this.waiting.get(message.id);
    if (asked) this.answers.set(asked[0], message);
    this.over(message.id);
    return Boolean(asked);
  }

  /** Takes a `stopped` message: what another request of this page took the place of is asked for again after that one. */
  stopped(id) {
    const asked = this.waiting.get(id);
    if (asked) this.later.unshift(asked);
    this.over(id, !asked);
  }

  /** Asks again for what a lost connection has left open. */
  reconnect() {
    this.later = [...this.waiting.values(), ...this.later];
    this.waiting.clear();
    this.running = null;
    this.next();
  }

  /** Asks for nothing more, and gives up what is computed. */
  leave() {
    this.later = [];
    if (this.running !== null && this.app.link.open) this.app.link.send({ do: 'stop', id: this.running });
    this.waiting.clear();
    this.running = null;
  }

  /** Goes on after a refusal, which may be that of the last request. */
  refused() {
    this.running = null;
    this.next();
  }

  over(id, more = true) {
    this.waiting.delete(id);
    if (id === this.running) this.running = null;
    if (more) this.next();
  }

  has(name) {
    return this.answers.has(name);
  }

  get settings() {
    return this.app.state.last('settings') ?? {};
  }

  get surface() {
    return this.app.state.last('surface') ?? {};
  }

  /** Figures at one target of a measurement. */
  target(name, i = 0) {
    return this.answers.get(name)?.report?.targets?.[i] ?? {};
  }

  drive(name) {
    return this.answers.get(name)?.report?.drive ?? {};
  }

  trace(name, i = 0) {
    return this.answers.get(name)?.traces?.[i] ?? null;
  }

  window(name) {
    return this.answers.get(name)?.report?.window_s;
  }

  /** Report of one pane of the comparison. */
  pane(i) {
    return this.compared?.panes?.[i]?.report ?? {};
  }

  paneTarget(i) {
    return this.pane(i).targets?.[0] ?? {};
  }

  design(key) {
    return this.app.state.last('design')?.figures?.find((figure) => figure.key === key)?.value;
  }

  /** A setting as it was set: without zeros that say nothing. */
  set = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : OPEN);
  n = (value, digits = 3) => (Number.isFinite(value) ? number(value, digits) : OPEN);
  m = (value) => (Number.isFinite(value) ? metres(value, 2) : OPEN);
  s = (value) => (Number.isFinite(value) ? seconds(value, 2) : OPEN);
  v = (value) => (Number.isFinite(value) ? speed(value, 2) : OPEN);
  db = (value) => (Number.isFinite(value) ? decibels(value) : OPEN);

  /** How many times as much, in words: 'twice', '2.6 times', 'as much as'. */
  times(a, b) {
    const ratio = b / a;
    if (!Number.isFinite(ratio)) return `${OPEN} times`;
    return `${number(ratio, 2)} times`;
  }
}
