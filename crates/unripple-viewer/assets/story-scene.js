// What a story asks of the server, step by step, and the way back to how everything was.

import { chosen } from './settings.js';
import { putSurface } from './recall.js';

const FIRST_FINGER = 900;
const ALIVE_MS = 500;
const SURFACE_MS = 8000;

/**
 * Brings the server into the scene of a step: surface, settings, fingers, comparison. Every change of the surface is one
 * undo step, so scenes that share their first changes share them on the server too, and leaving undoes them all. A surface that
 * somebody else changes meanwhile stays as it is.
 */
export class StoryScene {
  constructor(app) {
    this.app = app;
    this.before = null;
    this.changes = [];
    // Number of the newest edit that is the story's, the largest that the changes under way can have, and who waits for these.
    this.edit = null;
    this.most = 0;
    this.coming = 0;
    this.fingers = [];
    this.beats = [];
    this.compared = null;
    this.comparing = null;
    this.alive = 0;
  }

  /** Remembers what is to be put back. */
  begin() {
    const surface = this.app.state.last('surface');
    this.before = { surface, settings: chosen(this.app) };
    this.edit = surface?.edit;
    this.alive = setInterval(() => this.touch('move', this.fingers), ALIVE_MS);
  }

  /** Whether the surface as it was can be put back: one made of measured responses cannot be sent anew. */
  get surfaceReturns() {
    return !this.app.state.last('surface')?.library;
  }

  /** Whether the surface was changed since by others than the story. */
  get touched() {
    return !this.coming && this.app.state.last('surface')?.edit !== this.edit;
  }

  /** Brings about a scene; resolves when the surface is the one it asks for. */
  async enter(scene, live) {
    if (this.compared && !scene.compare) this.leaveComparison();
    this.settle(scene.settings ?? {});
    const changed = this.reshape(this.wanted(scene));
    if (changed) await this.surfaceFrom(changed);
    if (!live()) return;
    this.press(scene.fingers ?? []);
    this.beat(scene.beats ?? []);
  }

  /** Puts everything back. */
  leave() {
    if (!this.before) return;
    clearInterval(this.alive);
    this.beat([]);
    this.press([]);
    if (this.compared) this.leaveComparison();
    const kept = this.changes.length > 0 && this.touched;
    const changed = this.reshape([]);
    const { settings, surface } = this.before;
    this.before = null;
    this.changes = [];
    if (settings) {
      const { method, effect, window_ms, rate_hz, quantity } = settings;
      this.app.link.send(given({ do: 'settings', method, effect, window_ms, rate_hz, quantity }));
      this.app.link.send({ do: 'transport', live: true, speed: settings.speed ?? 1, paused: Boolean(settings.paused) });
    }
    if (!surface || surface.library) return;
    if (kept) this.offer(surface);
    else if (changed) this.makeSure(surface, changed);
  }

  /** Starts a comparison; the answer comes as a `compare` message. */
  compare(at, methods) {
    this.compared = methods;
    this.comparing = this.app.nextId();
    this.app.link.send({ do: 'compare', id: this.comparing, at, methods, window_ms: null });
  }

  leaveComparison() {
    this.compared = null;
    this.comparing = null;
    this.app.link.send({ do: 'compare', off: true });
  }

  /** Presses again what was pressed before the connection broke. */
  reconnect() {
    if (this.before) this.touch('down', this.fingers);
  }

  wanted({ surface, edits = [] }) {
    const there = this.before.surface;
    const opened = surface && !(there?.source === surface && !there.can_undo) ? [{ do: 'open', name: surface }] : [];
    return [...opened, ...edits.map((edit) => ({ do: 'edit', ...edit, settled: true }))];
  }

  // Undoes what the new list does not share with the old one, and does the rest. Returns the message that held before, if
  // anything changes. On top of what somebody else has made of the story's surface nothing can be undone.
  reshape(wanted) {
    const held = this.app.state.last('surface');
    if (this.touched) {
      if (this.changes.length) return null;
      this.before.surface = held;
      this.edit = held?.edit;
    }
    let shared = 0;
    while (shared < wanted.length && JSON.stringify(wanted[shared]) === JSON.stringify(this.changes[shared])) shared++;
    if (shared === wanted.length && shared === this.changes.length) return null;
    this.press([]);
    this.beat([]);
    for (let i = this.changes.length; i > shared; i--) this.app.link.send({ do: 'undo' });
    for (const change of wanted.slice(shared)) this.app.link.send(change);
    this.steps = this.changes.length - shared + wanted.length - shared;
    this.most = (this.coming ? this.most : held?.edit ?? 0) + this.steps;
    this.changes = wanted;
    return held;
  }

  // One `surface` message may answer several changes, so what counts is a moment of quiet after the first.
  surfaceFrom(held) {
    this.coming += 1;
    return new Promise((resolve) => {
      let quiet = 0;
      const done = () => {
        clearTimeout(limit);
        stop();
        this.coming -= 1;
        resolve();
      };
      const limit = setTimeout(done, SURFACE_MS);
      const stop = this.app.state.subscribe('surface', (surface) => {
        if (surface === held) return;
        if (surface.edit <= this.most) this.edit = surface.edit;
        clearTimeout(quiet);
        quiet = setTimeout(done, this.steps > 1 ? 400 : 50);
      });
    });
  }

  // A change that was refused has left one undo step too many.
  async makeSure(before, held) {
    await this.surfaceFrom(held);
    if (this.before) return;
    if (this.touched) this.offer(before);
    else if (this.app.state.last('surface')?.toml !== before.toml) this.putBack(before);
  }

  offer(before) {
    if (this.app.state.last('surface')?.toml === before.toml) return;
    const back = { text: 'Put mine back', run: () => this.putBack(before) };
    this.app.toast('The surface was changed from elsewhere during the story: it stays as it is.', 'notice', back);
  }

  putBack({ toml }) {
    putSurface(toml).catch((error) => this.app.toast(`The earlier surface could not be restored: ${error.message}`, 'fault'));
  }

  settle(settings) {
    const told = chosen(this.app);
    if (!told) return;
    const wanted = { ...settings };
    if (wanted.effect) wanted.effect = named(told.effects, wanted.effect);
    if (wanted.method && !told.methods?.some(({ name }) => name === wanted.method)) delete wanted.method;
    const differs = Object.fromEntries(Object.entries(given(wanted)).filter(([key, value]) => told[key] !== value));
    if (Object.keys(differs).length) this.app.link.send({ do: 'settings', ...differs });
  }

  press(places) {
    const lifted = this.fingers.slice(places.length);
    lifted.forEach(({ id, at }) => this.tell(id, 'up', at));
    this.fingers = places.map((at, i) => {
      const held = this.fingers[i];
      const id = FIRST_FINGER + i;
      if (!held) this.tell(id, 'down', at);
      else if (held.at[0] !== at[0] || held.at[1] !== at[1]) this.tell(id, 'move', at);
      return { id, at };
    });
    if (places.length) this.app.state.publish('place', { at_mm: places[0] });
  }

  beat(beats) {
    this.beats.forEach(({ timer, lift, id, at }) => {
      clearInterval(timer);
      clearTimeout(lift);
      this.tell(id, 'up', at);
    });
    this.beats = beats.map(({ at, hz, hold_ms: hold }, i) => {
      const one = { id: FIRST_FINGER + 50 + i, at };
      const strike = () => {
        this.tell(one.id, 'down', at);
        one.lift = setTimeout(() => this.tell(one.id, 'up', at), hold);
      };
      strike();
      one.timer = setInterval(strike, 1000 / hz);
      return one;
    });
  }

  touch(phase, fingers) {
    if (!this.app.link.open) return;
    fingers.forEach(({ id, at }) => this.tell(id, phase, at));
  }

  tell(finger, phase, at) {
    if (this.app.link.open) this.app.link.send({ do: 'touch', finger, phase, at_mm: at });
  }
}

function given(object) {
  return Object.fromEntries(Object.entries(object).filter(([, value]) => value !== undefined));
}

// The effect of that name, or the first whose name holds it; undefined leaves the effect as it is.
function named(list, wanted) {
  const names = (list ?? []).map(({ name }) => name);
  return names.find((name) => name === wanted) ?? names.find((name) => name.includes(wanted.replace(/s$/, '')));
}
