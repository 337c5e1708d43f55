// The compare panel: two methods on the same touch.

import { el, setText } from './dom.js';
import { seconds } from './units.js';
import { inside } from './outline.js';
import { CompareFigures } from './compare-figures.js';

const SLOW_S = 8;

/** Fills `root` with the compare panel. */
export function mount(root, app) {
  const panel = new Comparison(app);
  root.append(el('div', { class: 'panel-parts' },
    el('section', { class: 'card stack' }, el('h2', {}, 'Two methods, one touch'), panel.form, panel.state),
    panel.resultNode));
}

class Comparison {
  constructor(app) {
    this.app = app;
    this.result = null;
    this.waiting = null;
    this.figures = new CompareFigures();
    this.state = el('p', { role: 'status', class: 'quiet' }, 'Choose two methods and run them.');
    this.makeForm();
    this.makeResult();
    app.state.subscribe('settings', (settings) => this.showMethods(settings));
    app.state.subscribe('surface', () => this.showMethods(app.state.last('settings')));
    app.state.subscribe('place', ({ at_mm: at, all_mm: all }) => this.showTouches(all?.length ? all : [at]));
    app.state.subscribe('status', (status) => this.showFingers(status.fingers ?? []));
    app.state.subscribe('compare', (result) => this.show(result));
    app.state.subscribe('stopped', ({ id }) => id === this.waiting && this.refused('Stopped.'));
    app.state.subscribe('fault', ({ text }) => this.refused(text));
    app.state.subscribe('connection', ({ open }) => !open && this.refused('The connection broke: run it again.'));
  }

  makeForm() {
    const { ui } = this.app.state;
    this.first = el('select', { 'aria-label': 'First method' });
    this.second = el('select', { 'aria-label': 'Second method' });
    const [x, y] = ui.compare_at ?? [62, 90];
    const coordinate = (value, label) => el('input', { type: 'number', step: 'any', value, 'aria-label': `${label} in mm`, inputmode: 'decimal' });
    this.x = coordinate(x, 'X');
    this.y = coordinate(y, 'Y');
    this.byTouch = el('input', { type: 'radio', name: 'compare-where', disabled: true });
    this.byPlace = el('input', { type: 'radio', name: 'compare-where', checked: true });
    this.touchText = el('span', {}, 'the last touch (none yet)');
    for (const input of [this.x, this.y]) input.addEventListener('input', () => this.typed());
    this.run = el('button', { type: 'submit', class: 'button primary' }, 'Run both');
    this.stop = el('button', { type: 'button', class: 'button', hidden: true, 'aria-label': 'Stop comparing', on: { click: () => this.giveUp() } }, 'Stop');
    this.form = el('form', { class: 'stack', on: { submit: (event) => { event.preventDefault(); this.start(); } } },
      el('div', { class: 'pair' },
        el('label', { class: 'field' }, el('span', {}, 'First'), this.first),
        el('label', { class: 'field' }, el('span', {}, 'Second'), this.second)),
      el('fieldset', { class: 'plain stack' }, el('legend', {}, 'Where'),
        el('label', { class: 'check' }, this.byTouch, ' ', this.touchText),
        el('div', { class: 'row' },
          el('label', { class: 'check' }, this.byPlace, ' at'),
          el('label', { class: 'check xy' }, 'x ', this.x), el('label', { class: 'check xy' }, 'y ', this.y), el('span', { class: 'quiet' }, 'mm'))),
      el('div', { class: 'row' }, this.run, this.stop));
  }

  makeResult() {
    const button = (text, act) => el('button', { type: 'button', class: 'button', on: { click: act } }, text);
    this.instants = el('p', { class: 'quiet' });
    this.actions = el('div', { class: 'row' },
      button('To the focal instant', () => this.jump()),
      button('Play slowly through it', () => this.play()),
      button('Leave the comparison', () => this.leave()));
    this.resultNode = el('section', { class: 'card stack', hidden: true },
      el('h2', {}, 'Side by side'), this.actions, this.instants, this.figures.node);
  }

  showMethods(settings) {
    if (!settings) return;
    const library = Boolean(this.app.state.last('surface')?.library);
    const methods = settings.methods ?? [];
    const [a, b] = this.app.state.ui.compare_methods ?? [];
    const names = methods.filter((each) => !(library && each.needs_modes)).map((each) => each.name);
    const other = ['inverse', ...names].find((name) => names.includes(name) && name !== (a ?? 'time-reversal'));
    this.fill(this.first, methods, library, names.includes(a) ? a : names.includes('time-reversal') ? 'time-reversal' : names[0]);
    this.fill(this.second, methods, library, names.includes(b) ? b : other);
  }

  fill(select, methods, library, value) {
    const made = JSON.stringify([methods, library]);
    if (select.dataset.made !== made) {
      const kept = select.value;
      select.dataset.made = made;
      select.replaceChildren(...methods.map(({ name, needs_modes: needs }) => {
        const off = library && needs;
        return el('option', { value: name, disabled: off }, off ? `${name} (needs a model)` : name);
      }));
      const still = methods.some((each) => each.name === kept && !(library && each.needs_modes));
      select.value = still ? kept : value ?? '';
    }
  }

  typed() {
    this.byPlace.checked = true;
    this.ownPlace = true;
  }

  showTouches(places) {
    this.touches = places.slice(0, 8);
    this.tellTouch();
  }

  showFingers(fingers) {
    if (this.app.map.panes === 2) this.seenTwo = true;
    else if (this.result && this.seenTwo) this.close();
    if (fingers.length) this.showTouches(fingers.map((finger) => finger.at_mm));
  }

  tellTouch() {
    const places = this.touches.map((at) => at.map((value) => value.toFixed(0)).join(', '));
    const text = `${places.length > 1 ? `the last ${places.length} touches` : 'the last touch'}, ${places.join(' and ')} mm`;
    setText(this.touchText, text);
    if (this.byTouch.disabled) {
      this.byTouch.disabled = false;
      this.byTouch.checked = !this.ownPlace;
    }
  }

  where() {
    if (this.byTouch.checked && this.touches?.length) return this.touches;
    const at = [this.x, this.y].map((input) => (input.value.trim() === '' ? NaN : Number(input.value)));
    if (!at.every(Number.isFinite)) throw new Error('Type both coordinates of the place, in mm.');
    const rings = this.app.state.last('surface')?.rings_mm;
    if (rings && !inside(rings, at)) throw new Error(`${at.join(', ')} mm is not on the surface.`);
    this.app.state.ui.compare_at = at;
    return [at];
  }

  start() {
    let at;
    try {
      at = this.where();
    } catch (error) {
      this.say(error.message);
      return;
    }
    const methods = [this.first.value, this.second.value];
    if (methods[0] === methods[1]) {
      this.say('Choose two methods that differ.');
      return;
    }
    this.app.state.ui.compare_methods = methods;
    const id = this.app.nextId();
    if (!this.app.link.send({ do: 'compare', id, at, methods, window_ms: null })) return;
    this.wait(id);
    this.say(`Computing ${methods.join(' and ')}…`);
  }

  giveUp() {
    if (this.app.link.send({ do: 'stop', id: this.waiting })) this.say('Stopping…');
  }

  // Waits for the answer to a request of this number, or for none any more.
  wait(id) {
    this.waiting = id;
    this.run.disabled = id !== null;
    this.stop.hidden = id === null;
  }

  say(text) {
    this.state.textContent = text;
  }

  refused(text) {
    if (this.waiting === null) return;
    this.wait(null);
    this.say(text);
  }

  show(result) {
    if (result.id === this.waiting) this.wait(null);
    const panes = result.panes ?? [];
    if (result.off || panes.length < 2) {
      this.close();
      return;
    }
    this.result = result;
    this.seenTwo = false;
    this.resultNode.hidden = false;
    this.figures.show(panes);
    if (this.waiting === null) this.say(this.figures.sentence());
    const { from_s: from, to_s: to, focus_s: focus, dropped_s: dropped } = result;
    this.instants.textContent = dropped > 0
      ? `The last ${seconds(to - from)} of the waves are shown, the focus is ${seconds(focus - from)} after their beginning. The ${seconds(dropped)} before would take too much memory.`
      : `The waves run for ${seconds(to - from)}, the focus is ${seconds(focus - from)} after their start.`;
  }

  jump() {
    this.app.link.send({ do: 'transport', paused: true, shown_s: this.result.focus_s });
  }

  play() {
    const { from_s: from, to_s: to } = this.result;
    const speed = Math.min(1, Math.max(0.0005, (to - from) / SLOW_S));
    this.app.link.send({ do: 'transport', shown_s: from });
    this.app.link.send({ do: 'transport', speed: Number(speed.toPrecision(3)), paused: false });
  }

  leave() {
    this.app.link.send({ do: 'compare', off: true });
    this.close();
    this.run.focus({ preventScroll: true });
  }

  close() {
    this.result = null;
    this.resultNode.hidden = true;
    if (this.waiting === null) this.say('Choose two methods and run them.');
  }
}
