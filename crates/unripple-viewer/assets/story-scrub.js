// A slider of time around the focus.

import { el } from './dom.js';
import { seconds } from './units.js';

const STEPS = 200;

/** Moves a `StoryMoment` by hand, or lets it run. */
export class StoryScrub {
  constructor(moment) {
    this.moment = moment;
    this.reach = 0.03;
    this.slider = el('input', {
      type: 'range', min: -STEPS, max: STEPS, step: 1, value: 0, 'aria-label': 'Time from the focus',
      on: { input: () => this.drag() },
    });
    this.read = el('output', { class: 'mono' });
    this.play = el('button', { type: 'button', class: 'button small', on: { click: () => this.toggle() } }, 'Play it');
    const home = el('button', { type: 'button', class: 'button small', on: { click: () => this.home() } }, 'To the focus');
    this.node = el('div', { class: 'stack scrub', hidden: true },
      this.slider,
      el('div', { class: 'scrub-ends quiet', 'aria-hidden': 'true' }, el('span', {}, 'before'), el('span', {}, 'focus'), el('span', {}, 'after')),
      el('div', { class: 'row' }, this.play, home, this.read));
    moment.moved = (offset) => this.follow(offset);
  }

  show(on) {
    this.node.hidden = !on;
  }

  /** Sets how far the slider reaches in s, and the shares of that which `Play it` runs through. */
  range(whole, offsets) {
    const furthest = Math.max(...offsets.map(Math.abs)) || 1;
    this.reach = whole * furthest;
    this.path = offsets.some((part) => part !== offsets[0]) ? offsets.map((part) => part * whole) : [-this.reach, this.reach];
  }

  drag() {
    this.moment.stop();
    this.moment.drag((Number(this.slider.value) / STEPS) * this.reach);
  }

  home() {
    this.moment.stop();
    this.moment.show(0);
  }

  toggle() {
    if (this.moment.moving) this.moment.stop();
    else this.moment.run(this.path, 9000);
  }

  follow(offset) {
    const text = offset === 0 ? 'at the focus' : `${seconds(Math.abs(offset))} ${offset < 0 ? 'before' : 'after'} the focus`;
    if (document.activeElement !== this.slider || this.moment.moving) this.slider.value = String(Math.round((offset / this.reach) * STEPS));
    this.slider.setAttribute('aria-valuetext', text);
    this.read.textContent = text;
    this.play.textContent = this.moment.moving ? 'Stop' : 'Play it';
  }
}
