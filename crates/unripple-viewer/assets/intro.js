// The introduction: a tap, its ring, what each actuator hears of it, that turned round, and the waves that meet. It takes some 17 s.
//
// The tap is the focus of this very surface run backwards, which is the same but for losses; what an actuator would hear of the tap is what
// it plays for the focus, turned round: its drive, which comes with the pictures.

import { holdsSurface } from './design-link.js';
import { el, setText } from './dom.js';
import { drawHeard } from './intro-traces.js';
import { carried } from './outline.js';
import { fieldValue } from './units.js';

/** The place of the tap, on a square of so many mm. */
const PLACE = [62, 90];
const SQUARE_MM = 150;

/** A number that no finger of a person has. */
const FINGER = 950;

/** How many times as fast as for a touch the waves are let run together at first: they are seen slowly afterwards. */
const HURRY = 4;

/** Longest that the surface stands still for it, in ms. */
const LONGEST_MS = 120_000;

/** Between two pictures, in ms: as often as the surface makes them. */
const STEP_MS = 40;

/** Where less motion is wanted, a part is so many stills. */
const STILLS = 3;

const FOCUS = 0;

/** While the ring runs out it grows weaker: so many times the colours follow it. */
const RESCALED = 5;

/** Parts one after the other: words, length in ms, and where in the window time is, from 0 (the focus) to 1, at each share of the part: slowest
 * near the focus, where a ring can be seen. */
const PARTS = [
  { name: 'tap', ms: 2000, text: 'Somebody taps a sheet.', at: () => FOCUS },
  { name: 'hear', ms: 5500, text: 'A ring runs out and breaks up at the rim. Each actuator hears it pass.', at: (u) => u ** 3 },
  { name: 'turn', ms: 2500, text: 'What each has heard is turned round in time …', at: () => 1 },
  { name: 'play', ms: 5500, text: '… and played. The waves run back together,', at: (u) => (1 - u) ** 3 },
  { name: 'meet', ms: 2500, text: 'meet where the tap was, and nearly cancel everywhere else.', at: () => FOCUS },
];

/** Runs the introduction once in a tab of the browser, or when it is asked for. */
export class Intro {
  #running = null;
  #still = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(app, stage) {
    this.app = app;
    this.stage = stage;
    this.box = document.getElementById('intro');
    this.text = document.getElementById('intro-text');
    this.skip = document.getElementById('intro-skip');
    this.skip.addEventListener('click', () => this.end());
    document.addEventListener('pointerdown', () => this.end(), true);
    document.addEventListener('keydown', (event) => {
      if (!['Tab', 'Shift', 'Control', 'Alt', 'Meta'].includes(event.key)) this.end();
    }, true);
    app.state.subscribe('connection', ({ open }) => !open && this.end());
    app.state.subscribe('frame', (frame) => this.#hear(frame));
    // Whoever opens a link wants to see what it holds.
    if (app.atRest || app.state.ui.introduced || holdsSurface(location.hash)) return;
    const stop = app.state.subscribe('frame', () => {
      if (!app.state.last('status')) return;
      stop();
      if (!document.hidden && app.state.last('status').fingers.length === 0) this.start();
    });
  }

  /** Begins, if time is this page's to slow. */
  async start() {
    const { app, stage } = this;
    const surface = app.state.last('surface');
    if (this.#running || !surface || !app.playout.allowed) return;
    stage.show('map');
    const { speed } = app.state.last('settings');
    const run = { mm: carried(PLACE, SQUARE_MM, surface), speed, surface, heard: [], at: null, part: null, share: 0, sent: null, rescaled: 0 };
    this.#running = run;
    app.state.publish('intro', { on: true });
    this.box.hidden = false;
    setText(this.text, 'How waves are made to meet, in a quarter of a minute.');
    const met = app.playout.meet(run.mm, { halt_ms: LONGEST_MS, hurry: HURRY });
    this.#touch('down', run.mm);
    const focus = await met;
    if (this.#running !== run) return;
    this.#touch('up', run.mm);
    app.playout.unmark();
    if (!focus) {
      this.end();
      return;
    }
    run.focus = focus;
    const { window_ms, window_auto_ms } = app.state.last('settings');
    run.window = (window_ms ?? window_auto_ms) / 1000;
    run.began = performance.now();
    run.layer = stage.addLayer({ draw: (ctx, view) => this.#draw(ctx, view, run) });
    run.timer = setInterval(() => this.#step(run), STEP_MS);
  }

  /** Ends it, wherever it is: everything is as before. */
  end() {
    const run = this.#running;
    if (!run) return;
    this.#running = null;
    clearInterval(run.timer);
    run.layer?.();
    const { app } = this;
    app.state.ui.introduced = true;
    this.box.hidden = true;
    app.playout.interrupt();
    if (app.link.open) {
      if (!run.focus) this.#touch('up', run.mm);
      app.playout.restore({ speed: run.speed, paused: false });
    }
    app.state.publish('intro', { on: false });
  }

  #touch(phase, at_mm) {
    this.app.link.send({ do: 'touch', finger: FINGER, phase, at_mm });
  }

  #step(run) {
    let gone = performance.now() - run.began;
    const part = PARTS.find(({ ms }) => {
      gone -= ms;
      return gone < 0;
    });
    // Another surface has another focus.
    if (!part || this.app.state.last('surface') !== run.surface) {
      this.end();
      this.app.announce('Your turn: press anywhere on the surface.');
      return;
    }
    const share = 1 + gone / part.ms;
    run.share = this.#still.matches ? (Math.floor(share * STILLS) + 0.5) / STILLS : share;
    if (part !== run.part) this.#enter(run, part);
    run.at = part.at(run.share);
    const rescaled = part.name === 'hear' ? Math.floor(RESCALED * run.share) : 0;
    if (rescaled > run.rescaled) this.stage.rescale();
    run.rescaled = rescaled;
    const shown_s = run.focus.time - run.at * run.window;
    if (shown_s !== run.sent) this.app.link.send({ do: 'transport', paused: true, shown_s });
    run.sent = shown_s;
    this.stage.redraw();
  }

  #enter(run, part) {
    run.part = part;
    setText(this.text, part.text);
    const say = { tap: 'tap', meet: `focus: ${fieldValue(this.stage.quantity, run.focus.size)}` }[part.name];
    if (say) this.app.playout.mark(run.mm, say);
    else this.app.playout.unmark();
  }

  /** Keeps what the actuators play at the moments that are shown: as they would hear it, time from the focus backwards. */
  #hear({ pane, head }) {
    const run = this.#running;
    if (pane !== 0 || run?.part?.name !== 'hear' || this.#still.matches) return;
    const at = (run.focus.time - head.time_s) / run.window;
    if (at > (run.heard.at(-1)?.at ?? -1)) run.heard.push({ at, drive: head.drive });
  }

  #draw(ctx, view, { part, share, at, heard }) {
    if (!part || part.name === 'tap' || heard.length < 2) return;
    // First as heard, then mirrored, then as played: a hand goes along.
    const turned = part.name === 'hear' ? 0 : part.name === 'turn' ? Math.min(1, Math.max(0, 2 * share - 0.5)) : 1;
    const hand = part.name === 'play' ? 1 - at : part.name === 'meet' ? 1 : null;
    drawHeard(ctx, view, this.stage.sheet, { heard, turned, hand });
  }
}

/** A button that begins the introduction again. */
export function again(app) {
  return el('button', { type: 'button', class: 'button', on: { click: () => app.intro.start() } }, 'Watch the introduction');
}
