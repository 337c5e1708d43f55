// Actuators moved about: on the map by pointer, in a list by keyboard.

import { el, clear } from './dom.js';
import { inside } from './outline.js';

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const REACH_PX = 18;

/** The list of actuators, and handles on the map while `app.shown()` is the design panel. */
export class ActuatorPlaces {
  constructor(app, edits) {
    this.app = app;
    this.edits = edits;
    this.rings = [];
    this.actuators = [];
    this.chosen = -1;
    this.dragged = -1;
    this.locked = false;
    this.list = el('ul', { class: 'places' });
    this.told = el('p', { class: 'seen-not', role: 'status' });
    this.hint = el('p', { class: 'quiet', id: 'actuators-hint' },
      'Drag them on the map, or choose one here and move it with the arrow keys: 1 mm, with Shift 10 mm.');
    this.node = el('div', { class: 'stack' }, this.hint, this.list, this.told);
    app.map.addLayer({
      draw: (ctx, view) => this.draw(ctx, view),
      pointer: (kind, mm, view) => this.pointer(kind, mm, view),
    });
  }

  /** Shows the places as they are, but for the one that is being moved here. */
  show(surface) {
    this.rings = surface.rings_mm ?? [];
    this.locked = Boolean(surface.library);
    this.hint.hidden = this.locked;
    const old = this.actuators;
    this.actuators = surface.actuators.map((actuator, i) => (
      this.edits.holds(key(i)) && old[i] ? { ...actuator, at_mm: old[i].at_mm } : { ...actuator }
    ));
    if (this.actuators.length !== this.list.children.length || this.actuators.some((a, i) => a.name !== old[i]?.name)) this.rebuild();
    this.actuators.forEach((_, i) => this.tell(i));
  }

  rebuild() {
    clear(this.list);
    this.chosen = -1;
    this.actuators.forEach((_, i) => {
      const button = el('button', {
        type: 'button', class: 'button small place', 'aria-describedby': 'actuators-hint',
        on: {
          keydown: (event) => this.pressed(event, i),
          focus: () => this.choose(i),
          click: () => this.choose(i),
          blur: () => this.edits.holds(key(i)) && this.edits.finish(),
        },
      });
      this.list.append(el('li', {}, button));
    });
  }

  tell(i) {
    const button = this.list.children[i]?.firstChild;
    if (!button) return;
    const { name, at_mm: [x, y], kind, limit, unit } = this.actuators[i];
    const unseen = (text) => el('span', { class: 'seen-not' }, text);
    button.replaceChildren(el('span', {}, `${name} `, unseen('at '), `${round(x)}, ${round(y)}`, unseen(' mm')));
    button.disabled = this.locked;
    button.title = `${kind ?? 'actuator'}${limit ? `, up to ${limit} ${unit}` : ''}`;
    button.classList.toggle('is-chosen', i === this.chosen);
  }

  choose(i) {
    const before = this.chosen;
    this.chosen = i;
    if (before >= 0) this.tell(before);
    if (i >= 0) this.tell(i);
    this.app.map.redraw();
  }

  pressed(event, i) {
    const step = STEPS[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    const [x, y] = this.actuators[i].at_mm;
    const moved = this.move(i, [x + step[0] * far, y + step[1] * far]);
    if (moved) this.edits.settle(key(i), this.edit(i));
    const [newX, newY] = this.actuators[i].at_mm;
    this.told.textContent = moved ? `${round(newX)}, ${round(newY)} mm` : 'the edge is in the way';
  }

  move(i, at) {
    const place = at.map((value) => Math.round(value * 10) / 10);
    const [x, y] = this.actuators[i].at_mm;
    if ((place[0] === x && place[1] === y) || !inside(this.rings, place)) return false;
    this.actuators[i].at_mm = place;
    this.tell(i);
    this.app.map.redraw();
    return true;
  }

  edit(i) {
    return { actuator: i, at_mm: this.actuators[i].at_mm };
  }

  pointer(kind, mm, view) {
    if (this.app.shown() !== 'design' || this.locked) return false;
    if (kind === 'hover') return this.near(mm, view) >= 0 ? 'grab' : undefined;
    if (kind === 'down') return this.grasp(mm, view);
    if (this.dragged < 0) return false;
    const i = this.dragged;
    if (kind === 'move' && this.move(i, [mm[0] + this.offset[0], mm[1] + this.offset[1]])) {
      this.edits.sketch(key(i), this.edit(i));
    }
    if (kind === 'up') {
      this.dragged = -1;
      if (this.edits.holds(key(i))) this.edits.finish();
      this.app.map.redraw();
    }
    return true;
  }

  grasp(mm, view) {
    const i = this.near(mm, view);
    if (i < 0) return false;
    const [x, y] = this.actuators[i].at_mm;
    this.offset = [x - mm[0], y - mm[1]];
    this.dragged = i;
    this.choose(i);
    return true;
  }

  near(mm, view) {
    let best = -1;
    let least = REACH_PX / view.scale;
    this.actuators.forEach(({ at_mm: [x, y] }, i) => {
      const away = Math.hypot(x - mm[0], y - mm[1]);
      if (away <= least) [best, least] = [i, away];
    });
    return best;
  }

  draw(ctx, view) {
    if (this.app.shown() !== 'design' || this.locked) return;
    this.actuators.forEach(({ name, at_mm }, i) => {
      const [x, y] = view.toPx(at_mm);
      const chosen = i === this.chosen;
      ctx.lineWidth = chosen ? 3 : 1.5;
      ctx.strokeStyle = view.ink;
      ctx.beginPath();
      ctx.arc(x, y, chosen ? 13 : 10, 0, 2 * Math.PI);
      ctx.stroke();
      if (!chosen) return;
      ctx.fillStyle = view.ink;
      ctx.font = '600 12px system-ui, sans-serif';
      const leftwards = x > view.width / 2;
      ctx.textAlign = leftwards ? 'right' : 'left';
      ctx.fillText(`${name} ${round(at_mm[0])}, ${round(at_mm[1])}`, x + (leftwards ? -17 : 17), y - 9);
    });
  }
}

function key(i) {
  return `actuator ${i}`;
}

function round(value) {
  return String(Math.round(value * 10) / 10);
}
