// The connection to the session. It comes back by itself: after a loss, a silence of three seconds, a sleep, a network change.

import { line } from './line.js';

const LOOK_MS = 500;
const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 4000;

/** A link that calls `on.text(message)`, `on.frame(buffer)`, `on.change({open, text})` and `on.refused()`. */
export class Link {
  #socket = null;
  #heard = 0;
  #looked = 0;
  #silence = 0;
  #tries = 0;
  #waiting = null;
  #on;

  constructor(on) {
    this.#on = on;
    setInterval(() => this.#listen(), LOOK_MS);
    const wake = () => this.#wake();
    addEventListener('online', wake);
    addEventListener('pageshow', wake);
    document.addEventListener('visibilitychange', () => document.visibilityState === 'visible' && wake());
    this.connect();
  }

  get open() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Sends an object; false when there is no connection. */
  send(message) {
    if (!this.open) {
      this.#on.refused(message);
      return false;
    }
    this.#socket.send(JSON.stringify(message));
    this.#on.sent(message);
    return true;
  }

  /** Says that a frame was taken: the server sends no more than a page can draw. */
  seen(frame) {
    if (this.open) this.#socket.send(JSON.stringify({ do: 'seen', frame }));
  }

  connect() {
    clearTimeout(this.#waiting);
    this.#waiting = null;
    this.#drop();
    const socket = line.connect();
    this.#socket = socket;
    this.#hear();
    socket.onopen = () => {
      this.#hear();
      this.#on.change({ open: true, text: line.connected });
    };
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = () => this.#lost('Connection lost');
    socket.onerror = () => {};
  }

  #receive(data) {
    if (typeof data !== 'string') {
      this.#on.frame(data);
      return;
    }
    let message;
    try {
      message = JSON.parse(data);
    } catch (error) {
      console.error('a message that is no JSON:', error);
      return;
    }
    if (message.is === 'status') {
      this.#hear();
      this.#tries = 0;
    }
    this.#on.text(message);
  }

  #hear() {
    this.#heard = performance.now();
    this.#silence = 0;
  }

  // While the page itself stands still it hears nothing either, and what came meanwhile still waits: a late look counts no more than two.
  #listen() {
    const now = performance.now();
    this.#silence += Math.min(now - this.#looked, 2 * LOOK_MS);
    this.#looked = now;
    if (this.#socket && this.#silence > line.silence_ms) this.#lost('No answer for 3 s');
  }

  #wake() {
    this.#tries = 0;
    const coming = this.#socket?.readyState === WebSocket.CONNECTING;
    const stale = performance.now() - this.#heard > line.silence_ms;
    if (stale || !(this.open || coming)) this.connect();
  }

  #lost(text) {
    this.#drop();
    this.#on.change({ open: false, text: `${text}, trying again` });
    const wait = Math.min(LONGEST_WAIT_MS, FIRST_WAIT_MS * 2 ** this.#tries) * (0.8 + 0.4 * Math.random());
    this.#tries = Math.min(this.#tries + 1, 10);
    clearTimeout(this.#waiting);
    this.#waiting = setTimeout(() => this.connect(), wait);
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    if (!socket) return;
    socket.onopen = null;
    socket.onmessage = null;
    socket.onclose = null;
    socket.close();
  }
}
