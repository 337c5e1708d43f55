// A story as it runs: its steps, what each asks of the server, and the way out.

import { el, clear } from './dom.js';
import { Chart } from './chart.js';
import { StoryScene } from './story-scene.js';
import { StoryMoment } from './story-moment.js';
import { StoryFacts } from './story-facts.js';
import { StoryScrub } from './story-scrub.js';
import { carried } from './outline.js';

const RUN_MS = 9000;
const FIND_MS = 1400;
const PAPER_MM = 150;

/** Runs one story at a time; `left()` is called when it is over. */
export class StoryPlayer {
  constructor(app, left) {
    this.app = app;
    this.left = left;
    this.story = null;
    this.turn = 0;
    this.scene = new StoryScene(app);
    this.moment = new StoryMoment(app);
    this.facts = new StoryFacts(app);
    this.scrub = new StoryScrub(this.moment);
    this.moment.lost = () => this.again();
    this.make();
    this.listen();
  }

  make() {
    const button = (text, act, primary) => el('button', { type: 'button', class: `button${primary ? ' primary' : ''}`, on: { click: act } }, text);
    this.title = el('p', { class: 'quiet' });
    this.bar = el('progress', { max: 1, value: 0, 'aria-hidden': 'true' });
    this.heading = el('h2', { tabindex: '-1' });
    this.words = el('div', { class: 'stack story-text' });
    this.state = el('p', { class: 'quiet', role: 'status' });
    this.figures = el('table', { class: 'figures' });
    this.figuresTold = el('div', { 'aria-live': 'polite' }, this.figures);
    this.chartNode = el('div', {});
    this.back = button('Back', () => this.go(this.at - 1));
    this.next = button('Next', () => this.forward(), true);
    this.out = button('Leave', () => this.leave());
    this.node = el('section', { class: 'card stack story', hidden: true, 'aria-label': 'Story' },
      el('div', { class: 'story-head' }, this.title, this.bar),
      this.heading, this.words, this.figuresTold, this.chartNode, this.scrub.node, this.state,
      el('div', { class: 'row story-nav' }, this.back, this.next, this.out));
  }

  listen() {
    const { state } = this.app;
    state.subscribe('measured', (message) => this.facts.take(message) && this.tell());
    state.subscribe('compare', (message) => this.compared(message));
    state.subscribe('stopped', ({ id }) => this.stopped(id));
    for (const kind of ['surface', 'settings', 'design']) state.subscribe(kind, () => this.tell());
    state.subscribe('connection', ({ open }) => {
      if (!open || !this.story) return;
      this.scene.reconnect();
      this.facts.reconnect();
    });
    state.subscribe('fault', ({ text }) => {
      if (!this.story) return;
      this.facts.refused();
      this.state.textContent = text;
    });
    window.addEventListener('pagehide', () => this.story && this.leave());
  }

  start(story) {
    this.story = story;
    this.facts.clear();
    this.scene.begin();
    this.node.hidden = false;
    document.body.toggleAttribute('data-story', true);
    this.go(0);
  }

  forward() {
    if (this.at === this.story.steps.length - 1) this.leave();
    else this.go(this.at + 1);
  }

  leave() {
    const { story } = this;
    if (!story) return;
    this.turn += 1;
    this.story = null;
    this.moment.stop();
    this.moment.pin(null);
    this.facts.leave();
    this.scene.leave();
    this.node.hidden = true;
    document.body.toggleAttribute('data-story', false);
    this.left(story);
  }

  async go(at) {
    const turn = ++this.turn;
    const live = () => turn === this.turn;
    const { steps, title } = this.story;
    this.at = Math.max(0, Math.min(steps.length - 1, at));
    const step = this.placed(steps[this.at]);
    this.moment.stop();
    this.scrub.show(false);
    this.title.textContent = `${title} · step ${this.at + 1} of ${steps.length}`;
    this.bar.value = (this.at + 1) / steps.length;
    this.heading.textContent = step.heading;
    this.back.disabled = this.at === 0;
    this.next.textContent = this.at === steps.length - 1 ? 'Finish' : 'Next';
    this.say('');
    this.clearChart();
    this.tell();
    this.heading.focus({ preventScroll: true });
    await this.play(step, live);
  }

  // Steps name places of the paper's surface; on another one they are carried over.
  placed(step) {
    const surface = this.app.state.last('surface');
    const { scene } = step;
    if (scene.surface || !surface) return step;
    const there = (places) => places?.map((at) => carried(at, PAPER_MM, surface));
    const compare = scene.compare && { ...scene.compare, at: there(scene.compare.at) };
    return {
      ...step,
      scene: { ...scene, fingers: there(scene.fingers), compare },
      measure: step.measure?.map((each) => ({ ...each, at: there(each.at) })),
    };
  }

  async play(step, live) {
    const { scene } = step;
    if (!step.show) this.app.link.send({ do: 'transport', live: true, speed: 1, paused: false });
    const changes = this.scene.changes.length;
    await this.scene.enter(scene, live);
    if (!live()) return;
    for (const { name, ...request } of step.measure ?? []) {
      if (!this.facts.has(name)) this.facts.measure(name, request);
    }
    if (scene.compare) {
      if (!(await this.comparison(scene.compare, live))) return;
    } else if (step.show) {
      // The first pulse after a change of the surface comes once the new one is ready.
      if (!(await this.meet(changes ? 400 : 0, live))) return;
    }
    if (step.show) this.present(step);
  }

  async meet(more_ms, live) {
    this.say('Waiting for the waves to meet…');
    const found = await this.moment.find(FIND_MS + more_ms, live);
    if (live() && !found) this.say('No focus was seen: is the finger on the surface, and is there an actuator?');
    return live() && found;
  }

  // The moment shown is older than what is kept: the next one will do.
  async again() {
    if (!this.story) return;
    const turn = ++this.turn;
    if (!(await this.meet(0, () => turn === this.turn))) return;
    this.say('');
    this.moment.show(0);
  }

  present({ show, control }) {
    this.scrub.show(control === 'scrub');
    const { reach } = this.moment;
    const offsets = show.at === 'before' ? [-1, 0] : Array.isArray(show.run) ? show.run : [0, 0];
    this.scrub.range(reach, offsets);
    this.say('');
    const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (show.run && !still) this.moment.run(offsets.map((part) => part * reach), RUN_MS);
    else this.moment.show(0);
  }

  comparison({ at, methods }, live) {
    if (this.scene.compared && this.facts.compared) {
      this.moment.pin(this.facts.compared);
      return true;
    }
    this.say(`Computing ${methods.join(' and ')}…`);
    if (!this.scene.compared) {
      this.facts.compared = null;
      this.scene.compare(at, methods);
    }
    return new Promise((resolve) => {
      this.answered = () => resolve(live());
    });
  }

  compared(message) {
    // What another page compares is shown to all.
    if (!this.story || !this.scene.compared || message.id !== this.scene.comparing || (message.panes ?? []).length < 2) return;
    if (message === this.facts.compared) return;
    this.facts.compared = message;
    this.moment.pin(message);
    this.answered?.();
    this.answered = null;
    this.tell();
  }

  // The page has compared something else meanwhile: the step computes it again when it is entered again.
  stopped(id) {
    this.facts.stopped(id);
    if (!this.story || id !== this.scene.comparing) return;
    this.scene.compared = null;
    this.say('Stopped.');
  }

  say(text) {
    this.state.textContent = text;
  }

  // Texts are made anew with every answer, and written only where they differ.
  tell() {
    if (!this.story || this.at === undefined) return;
    const step = this.story.steps[this.at];
    const texts = step.text(this.facts);
    if (this.words.dataset.told !== texts.join('\n')) {
      this.words.dataset.told = texts.join('\n');
      clear(this.words).append(...texts.map((text) => el('p', {}, text)));
    }
    const rows = step.figures?.(this.facts) ?? [];
    const told = JSON.stringify(rows);
    if (this.figures.dataset.told !== told) {
      this.figures.dataset.told = told;
      clear(this.figures).append(...rows.map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value))));
    }
    this.figures.hidden = !rows.length;
    this.tellChart(step);
  }

  tellChart(step) {
    const wanted = step.chart?.(this.facts);
    if (!wanted || this.chart) return;
    const canvas = el('canvas', { class: 'plot' });
    this.chartNode.append(canvas);
    this.chart = new Chart(canvas, wanted.axes);
    this.chart.draw(wanted.data);
  }

  clearChart() {
    this.chart = null;
    clear(this.chartNode);
  }
}
