// The actuators' names over the relief, under their rings as on the map.

import { clear, el } from './dom.js';

const MOST = 24;

/** Names that follow the camera. */
export class ReliefNames {
  #seen = '';

  constructor(canvas) {
    this.canvas = canvas;
    this.box = el('div', { class: 'relief-names', 'aria-hidden': 'true', hidden: true });
    canvas.after(this.box);
  }

  set(actuators, unit) {
    // As on the map, many names would hide the surface.
    const named = actuators.length > MOST ? [] : actuators;
    this.places = named.map(({ at_mm }) => unit(at_mm));
    clear(this.box).append(...named.map(({ name }) => el('span', { text: name })));
    this.#seen = '';
  }

  show(on) {
    this.box.hidden = !on;
  }

  /** Moves the names where `camera`, a matrix by columns, puts their actuators. */
  follow(camera) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const seen = `${width} ${height} ${camera.join()}`;
    if (!this.places || seen === this.#seen) return;
    this.#seen = seen;
    this.places.forEach(([x, y], i) => {
      const [across, up, , depth] = [0, 1, 2, 3].map((row) => camera[row] * x + camera[4 + row] * y + camera[12 + row]);
      const [left, top] = [(0.5 + across / depth / 2) * width, (0.5 - up / depth / 2) * height];
      this.box.children[i].style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px) translate(-50%, 35%)`;
    });
  }
}
