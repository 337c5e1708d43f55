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
    this.focusPeak = null;
  }

  /** Asks for a measurement under a name. */
  measure(name, request) {
    const id = this.app.nextId();
    this.waiting.set(id, name);
    this.app.link.send({ do: 'measure', id, method: 'time-reversal', window_ms: null, peak_um: null, ...request });
  }

  /** Takes a `measured` message; returns whether it was asked for here. */
  take(message) {
    const name = this.waiting.get(message.id);
    if (!name) return false;
    this.waiting.delete(message.id);
    this.answers.set(name, message);
    return true;
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
