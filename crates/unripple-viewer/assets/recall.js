// The surface a person made must not be lost when the server starts afresh: the last one is kept in this tab of the browser.

import { store } from './state.js';
import { line } from './line.js';
import { toast } from './faults.js';

const KEY = 'unripple.surface';
const SEEN = 'unripple.surface.seen';
const CHANGES = new Set(['edit', 'undo', 'redo', 'open']);
const ANSWER_MS = 5000;

let asked = -Infinity;

/** Notes that this page asks for another surface: what comes soon after is its own. */
export function changedHere() {
  asked = performance.now();
}

/** Sends a surface file to the server. */
export async function putSurface(toml) {
  changedHere();
  const answer = await line.ask('/surface', { method: 'POST', body: toml, headers: { 'content-type': 'application/toml' } });
  if (answer.ok) {
    changedHere();
    return;
  }
  const told = await answer.json().catch(() => ({}));
  throw new Error(told.text ?? `The server refused the surface (${answer.status}).`);
}

/** Keeps the surface as this page last changed it, and offers it when, after a reconnection, the server has another than was last
 * seen here. */
export class Recall {
  #asking = false;
  #offer = null;

  constructor(state) {
    state.subscribe('connection', ({ open }) => {
      this.#asking = open;
    });
    state.subscribe('surface', ({ toml }) => this.#take(toml));
  }

  /** An edit made here answers the offer. */
  sent(message) {
    if (!CHANGES.has(message.do)) return;
    changedHere();
    this.#offer?.();
    this.#offer = null;
  }

  #take(toml) {
    if (typeof toml !== 'string') return;
    const mine = store.get(KEY);
    if (this.#asking) {
      this.#asking = false;
      if (mine !== null && mine !== toml && store.get(SEEN) !== toml) this.#ask(mine);
      return;
    }
    store.set(SEEN, toml);
    if (performance.now() - asked < ANSWER_MS) store.set(KEY, toml);
  }

  #ask(mine) {
    this.#offer?.();
    this.#offer = toast('The server shows another surface than the one you had.', 'notice', {
      text: 'Bring back my surface',
      run: () => putSurface(mine).catch((error) => toast(error.message, 'fault')),
    });
  }
}
