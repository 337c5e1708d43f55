// Edits of the surface on their way to the server.

const APART_MS = 125;
const QUIET_MS = 300;

/** Sends edits while they are being made: at most 8 a second, unsettled until they come to rest. */
export class Edits {
  constructor(app) {
    this.app = app;
    this.listeners = new Set();
    this.key = null;
    this.next = null;
    this.sentAt = -Infinity;
    this.sending = 0;
    this.resting = 0;
  }

  /** Whether nothing is being changed here. */
  get idle() {
    return this.key === null;
  }

  /** Calls `fn()` whenever something new is about to change: a drag, a typed number, an undo. */
  onBegin(fn) {
    this.listeners.add(fn);
  }

  /** Whether the value named `key` is being changed here at this moment. */
  holds(key) {
    return this.key === key;
  }

  /** Marks the start of a change that is sent by other means. */
  begin() {
    for (const listener of this.listeners) listener();
  }

  /** A value on its way: figures follow, the surface that moves does not yet. */
  sketch(key, edit) {
    if (this.key !== key) {
      this.finish();
      this.key = key;
      this.begin();
    }
    clearTimeout(this.resting);
    this.next = edit;
    const wait = this.sentAt + APART_MS - performance.now();
    if (wait <= 0) this.send(false);
    else if (!this.sending) this.sending = setTimeout(() => this.send(false), wait);
  }

  /** A value that is meant to stay, sent when nothing newer has come for a moment. */
  settle(key, edit) {
    this.sketch(key, edit);
    this.latest = edit;
    this.resting = setTimeout(() => this.finish(), QUIET_MS);
  }

  /** A choice that needs no trying out: settled at once. */
  now(edit) {
    this.finish();
    this.begin();
    this.app.link.send({ do: 'edit', ...edit, settled: true });
  }

  /** Settles what is under way, at once. */
  finish() {
    clearTimeout(this.resting);
    if (this.key === null) return;
    this.key = null;
    this.next ??= this.latest;
    this.send(true);
  }

  send(settled) {
    clearTimeout(this.sending);
    this.sending = 0;
    if (!this.next) return;
    this.latest = this.next;
    this.next = null;
    this.sentAt = performance.now();
    this.app.link.send({ do: 'edit', ...this.latest, settled });
    if (settled) this.latest = null;
  }
}
