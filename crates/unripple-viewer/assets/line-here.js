// The way to a session in this page, which a worker holds (session-worker.js). A worker that fails is replaced by a new one.

import { save } from './dom.js';

const { CONNECTING, OPEN, CLOSED } = WebSocket;

/** A worker, seen as a WebSocket. */
class Socket {
  readyState = CONNECTING;
  onopen = null;
  onmessage = null;
  onclose = null;
  #worker = new Worker(new URL('./session-worker.js', import.meta.url), { type: 'module' });
  #asked = new Map();
  #count = 0;

  constructor() {
    this.#worker.onmessage = ({ data }) => this.#take(data);
    this.#worker.onerror = (event) => this.#lost(event.message);
  }

  send(text) {
    this.#worker.postMessage(text);
  }

  close() {
    this.readyState = CLOSED;
    this.#worker.terminate();
    for (const { fail } of this.#asked.values()) fail(new Error('the session has ended'));
    this.#asked.clear();
  }

  /** What the worker answers to a request for a file: `{status, body}`. */
  ask(path, options = {}) {
    this.#count += 1;
    const ask = this.#count;
    return new Promise((settle, fail) => {
      if (this.readyState !== OPEN) {
        fail(new Error('the session is not ready yet'));
        return;
      }
      this.#asked.set(ask, { settle, fail });
      this.#worker.postMessage({ ask, path, body: options.body ?? null });
    });
  }

  #take(data) {
    if (typeof data === 'string' || data instanceof ArrayBuffer) {
      this.onmessage?.({ data });
    } else if (data.is === 'open') {
      this.readyState = OPEN;
      this.onopen?.();
    } else if (data.is === 'answer') {
      this.#asked.get(data.ask)?.settle(data);
      this.#asked.delete(data.ask);
    } else if (data.is === 'gone') {
      this.#lost(data.why);
    }
  }

  #lost(why) {
    console.error('the session in this page failed:', why);
    const { onclose } = this;
    this.close();
    onclose?.();
  }
}

/** A worker, and files from its memory. */
export class Here {
  // The worker is silent while it computes.
  silence_ms = Infinity;
  connected = 'Computed in this page';
  #socket = null;

  constructor() {
    document.addEventListener('click', (event) => this.#save(event));
  }

  address(path) {
    return path;
  }

  async ask(path, options) {
    if (!this.#socket) throw new Error('there is no session');
    const { status, body } = await this.#socket.ask(path, options);
    return new Response(body, { status });
  }

  connect() {
    this.#socket = new Socket();
    return this.#socket;
  }

  // There is nothing at the addresses of the session's files: what such a link would save is asked of the worker.
  async #save(event) {
    const link = event.target instanceof Element ? event.target.closest('a[download][href^="/"]') : null;
    if (!link) return;
    event.preventDefault();
    try {
      const answer = await this.ask(link.getAttribute('href'));
      if (!answer.ok) throw new Error(await answer.text());
      save(await answer.blob(), link.download);
    } catch (error) {
      console.error(`${link.download} could not be saved:`, error);
    }
  }
}
