// Time: speed, pause, single samples, any kept moment, back to now.

import { el, setText } from './dom.js';
import { seconds } from './units.js';

const SLOWEST = 1 / 2000;
const STOPS = [2000, 500, 200, 50, 10, 1];

/** Words for a speed. */
export function speedText(speed) {
  if (speed > 0.995) return 'Real time';
  return `1/${Math.round(1 / speed)} of real time`;
}

const toSlider = (speed) => 1000 * (1 - Math.log(speed) / Math.log(SLOWEST));
const toSpeed = (slider) => (slider >= 999.5 ? 1 : SLOWEST ** (1 - slider / 1000));

/** The controls of time under the stage. */
export class Transport {
  /** What the slider of time reaches, {from, to} in s; `null` for all that is kept. */
  zoom = null;
  #wanted = null;

  constructor(app) {
    this.app = app;
    const get = (id) => document.getElementById(id);
    this.parts = {
      back: get('back'), pause: get('pause'), forward: get('forward'), now: get('now'), shown: get('shown'),
      scrub: get('scrub'), speed: get('speed'), text: get('speed-text'), stops: get('stops'),
    };
    this.#listen();
    app.state.subscribe('settings', (settings) => this.#settings(settings));
    app.state.subscribe('status', (status) => this.#status(status));
    app.state.subscribe('frame', ({ head, pane }) => pane === 0 && this.#tellShown(head.time_s));
    get('stage').addEventListener('keydown', (event) => this.#key(event));
  }

  get paused() {
    return this.app.state.last('settings')?.paused ?? false;
  }

  /** Changes how time passes, as a person asks for it. */
  send(change) {
    this.app.playout.interrupt();
    this.app.link.send({ do: 'transport', ...change });
  }

  #listen() {
    const { back, pause, forward, now, scrub, speed, stops } = this.parts;
    back.addEventListener('click', (event) => this.#step(event.shiftKey ? -10 : -1));
    forward.addEventListener('click', (event) => this.#step(event.shiftKey ? 10 : 1));
    pause.addEventListener('click', () => this.send({ paused: !this.paused }));
    now.addEventListener('click', () => this.send({ live: true, paused: false }));
    speed.addEventListener('input', () => {
      const value = toSpeed(Number(speed.value));
      this.#sayRate(value);
      this.#soon({ speed: value });
    });
    scrub.addEventListener('input', () => {
      this.#tellShown(Number(scrub.value));
      this.#soon({ shown_s: Number(scrub.value) });
    });
    for (const stop of STOPS) {
      stops.append(el('button', {
        type: 'button', class: 'button small', text: stop === 1 ? 'Real time' : `1/${stop}`, dataset: { speed: 1 / stop },
        'aria-pressed': 'false', on: { click: () => this.send({ speed: 1 / stop }) },
      }));
    }
  }

  /** At most one message per animation frame while a slider moves. */
  #soon(change) {
    const first = this.#wanted === null;
    this.#wanted = { ...this.#wanted, ...change };
    if (!first) return;
    requestAnimationFrame(() => {
      const wanted = this.#wanted;
      this.#wanted = null;
      this.send(wanted);
    });
  }

  #step(count) {
    this.send({ step: count });
  }

  #settings({ speed, paused }) {
    const { pause, speed: slider, stops } = this.parts;
    setText(pause, paused ? 'Play' : 'Pause');
    pause.setAttribute('aria-pressed', String(paused));
    if (document.activeElement !== slider || !slider.matches(':active')) slider.value = String(toSlider(speed));
    this.#sayRate(speed);
    for (const stop of stops.children) {
      stop.setAttribute('aria-pressed', String(Math.abs(Number(stop.dataset.speed) / speed - 1) < 0.01));
    }
  }

  #sayRate(speed) {
    setText(this.parts.text, speedText(speed));
    this.parts.speed.setAttribute('aria-valuetext', speedText(speed));
  }

  /** Lets the slider of time reach what it is to reach. */
  reach() {
    const { scrub } = this.parts;
    const { tail_s: tail, head_s: head, shown_s: shown } = this.app.state.last('status') ?? {};
    scrub.min = String(this.zoom?.from ?? tail ?? 0);
    scrub.max = String(this.zoom?.to ?? head ?? 1);
    scrub.value = String(shown ?? head ?? 1);
  }

  #status({ shown_s }) {
    const { scrub } = this.parts;
    if (scrub.matches(':active')) return;
    this.reach();
    scrub.setAttribute('aria-valuetext', this.#ago(shown_s));
  }

  #ago(time) {
    const head = this.app.state.last('status')?.head_s;
    if (!(head - time > 5e-4)) return 'now';
    return `${seconds(head - time, 4)} ago`;
  }

  #tellShown(time) {
    const ago = this.app.state.last('settings')?.speed === 1 && !this.paused ? 'now' : this.#ago(time);
    setText(this.parts.shown, `${(time ?? 0).toFixed(5)} s, ${ago}`);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('select, input[type="text"]')) return;
    const many = event.shiftKey ? 10 : 1;
    const actions = {
      k: () => this.send({ paused: !this.paused }), n: () => this.send({ live: true, paused: false }),
      ',': () => this.#step(-1), '<': () => this.#step(-many), ';': () => this.#step(-many),
      '.': () => this.#step(1), '>': () => this.#step(many), ':': () => this.#step(many),
      j: () => this.app.timeline.go(-1), l: () => this.app.timeline.go(1),
      '[': () => this.#faster(1 / 2), ']': () => this.#faster(2),
    };
    const action = actions[event.key.toLowerCase()];
    if (!action) return;
    action();
    event.preventDefault();
  }

  #faster(factor) {
    const speed = this.app.state.last('settings')?.speed ?? 1;
    this.send({ speed: Math.min(1, Math.max(SLOWEST, speed * factor)) });
  }
}
