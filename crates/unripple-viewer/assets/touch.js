// Fingers: pointers and the keyboard on the map become touches of the surface.

import { Hints } from './hints.js';
import { fieldValue, place, seconds } from './units.js';

const KEY_FINGER = 20;

// The server lifts a finger of which it hears nothing for 30 s.
const HELD_MS = 5000;

// Whoever waits longer for a focus would think that nothing happens.
const LONG_S = 2;

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Turns what happens on the maps into touch messages. */
export class Touch {
  #pointers = new Map();
  #moves = new Map();
  #group = [];
  #sending = false;
  #keyHeld = null;
  #over = null;
  #pointing = false;

  constructor(app, stage) {
    this.app = app;
    this.stage = stage;
    this.probing = false;
    this.tool = document.getElementById('probe-tool');
    this.hints = new Hints(app, stage);
    this.hover = document.getElementById('hover');
    stage.held = () => this.places();
    for (const map of stage.maps) this.#listen(map);
    const all = () => this.releaseAll();
    setInterval(() => this.#sayHeld(), HELD_MS);
    addEventListener('blur', all);
    addEventListener('pagehide', all);
    document.addEventListener('visibilitychange', () => document.hidden && all());
    this.tool.addEventListener('click', () => this.#setProbing(!this.probing));
    app.state.subscribe('connection', ({ open }) => !open && this.#forget());
    app.state.subscribe('frame', ({ pane }) => this.#over?.[1].pane === pane && this.#tell(...this.#over));
  }

  /** Places held by this page, mm. */
  places() {
    const held = [...this.#pointers.values()].filter((p) => p.finger !== null && p.down).map((p) => p.mm);
    return this.#keyHeld ? [...held, this.stage.cursor] : held;
  }

  /** Lifts every finger of this page. */
  releaseAll() {
    for (const [id, pointer] of [...this.#pointers]) this.#end(id, pointer, pointer.mm);
    this.#keyUp();
  }

  /** Without a connection no finger is held; what a layer drags goes on. */
  #forget() {
    for (const [id, pointer] of [...this.#pointers]) if (!pointer.layer) this.#pointers.delete(id);
    this.#moves.clear();
    this.#keyHeld = null;
    this.stage.pressing = false;
    this.stage.redraw();
  }

  #setProbing(on) {
    this.probing = on;
    this.tool.setAttribute('aria-pressed', String(on));
  }

  #listen(map) {
    const { canvas } = map;
    const on = (type, fn) => canvas.addEventListener(type, (event) => fn(event, map));
    on('pointerdown', (event) => this.#down(event, map));
    on('pointermove', (event) => this.#move(event, map));
    on('pointerup', (event) => this.#up(event, map));
    on('pointercancel', (event) => this.#up(event, map));
    on('lostpointercapture', (event) => this.#up(event, map));
    on('pointerleave', () => this.#tell(null));
    on('contextmenu', (event) => event.preventDefault());
    on('keydown', (event) => this.#key(event, map));
    on('keyup', (event) => event.key === ' ' && this.#keyHeld === 'space' && this.#keyUp());
    on('blur', () => {
      this.#keyUp();
      this.stage.redraw();
    });
    on('focus', () => {
      map.canvas.toggleAttribute('data-keys', !this.#pointing);
      this.stage.redraw();
    });
  }

  #at(event, map) {
    const box = map.canvas.getBoundingClientRect();
    const view = map.view();
    return [view.toMm([event.clientX - box.left, event.clientY - box.top]), view];
  }

  #down(event, map) {
    if (event.button !== 0 || !this.stage.sheet || this.#pointers.has(event.pointerId)) return;
    const [mm, view] = this.#at(event, map);
    this.#pointing = true;
    map.canvas.focus({ preventScroll: true });
    map.canvas.removeAttribute('data-keys');
    this.#pointing = false;
    map.canvas.setPointerCapture(event.pointerId);
    const layer = [...this.stage.layers].reverse().find((l) => l.pointer?.('down', mm, view, event) === true);
    if (layer) {
      this.#pointers.set(event.pointerId, { layer, mm, finger: null });
      return;
    }
    if (this.probing) {
      this.#probe(mm);
      this.#setProbing(false);
      return;
    }
    // A finger of the keys is where the cursor is: it goes with it.
    this.#keyUp();
    this.stage.cursor = null;
    const pointer = { finger: this.#freeFinger(), mm, down: false };
    this.#pointers.set(event.pointerId, pointer);
    this.#press(pointer, mm);
    this.#tell(mm, map);
  }

  #freeFinger() {
    const used = new Set([...this.#pointers.values()].map((p) => p.finger));
    let finger = 0;
    while (used.has(finger)) finger += 1;
    return finger;
  }

  /** Puts a finger down where it lies on the surface. */
  #press(pointer, mm) {
    pointer.mm = mm;
    if (!this.stage.sheet.holds(mm)) return;
    this.app.playout.press(mm);
    pointer.down = this.#send(pointer.finger, 'down', mm);
    if (pointer.down) this.#pressed();
  }

  /** In slow motion the waves take as many times longer to meet. */
  #sayWhen() {
    if (this.app.playout.active) return;
    const { speed, paused, window_ms, window_auto_ms } = this.app.state.last('settings') ?? {};
    const wait = (window_ms ?? window_auto_ms) / 1000 / speed;
    if (!paused && wait > LONG_S) this.app.toast(`At this speed the waves meet in ${seconds(wait, 2)}.`);
  }

  #pressed() {
    this.hints.pressed();
    this.#sayWhen();
    const places = this.places();
    this.#group = places.length > 1 ? places : places.slice(-1);
    const last = this.#group[this.#group.length - 1];
    if (last) this.app.state.publish('place', { at_mm: last, all_mm: this.#group });
    this.stage.redraw();
  }

  #move(event, map) {
    const pointer = this.#pointers.get(event.pointerId);
    const [mm, view] = this.#at(event, map);
    if (!pointer) {
      if (event.pointerType === 'mouse' && event.buttons === 0) this.#hovering(event, mm, view, map);
      return;
    }
    if (pointer.layer) {
      pointer.mm = mm;
      pointer.layer.pointer('move', mm, view, event);
      return;
    }
    this.#drag(pointer, mm);
    this.#tell(mm, map);
  }

  /** A finger that slides off the surface leaves it, and comes down again where it returns. */
  #drag(pointer, mm) {
    const inside = this.stage.sheet.holds(mm);
    if (pointer.down && !inside) {
      this.#lift(pointer);
    } else if (!pointer.down && inside) {
      this.#press(pointer, mm);
    } else if (pointer.down) {
      this.#moves.set(pointer.finger, mm);
      this.#soon();
    }
    pointer.mm = mm;
    this.stage.redraw();
  }

  #hovering(event, mm, view, map) {
    let cursor = '';
    for (const layer of [...this.stage.layers].reverse()) {
      const wanted = layer.pointer?.('hover', mm, view, event);
      if (typeof wanted === 'string') {
        cursor = wanted;
        break;
      }
    }
    map.canvas.style.cursor = cursor;
    this.#tell(mm, map);
  }

  /** One move per finger and animation frame. */
  #soon() {
    if (this.#sending) return;
    this.#sending = true;
    requestAnimationFrame(() => {
      this.#sending = false;
      this.#flush();
    });
  }

  /** Says which fingers rest, so that none is left on the surface when this page comes to a standstill. */
  #sayHeld() {
    if (!this.app.link.open) return;
    for (const { finger, mm, down } of this.#pointers.values()) if (down) this.#send(finger, 'move', mm);
    if (this.#keyHeld) this.#send(KEY_FINGER, 'move', this.stage.cursor);
  }

  #flush() {
    for (const [finger, mm] of this.#moves) this.#send(finger, 'move', mm);
    if (this.#moves.size > 0) this.app.state.publish('place', { at_mm: this.places().at(-1), all_mm: this.places() });
    this.#moves.clear();
  }

  #up(event, map) {
    const pointer = this.#pointers.get(event.pointerId);
    if (!pointer) return;
    const [mm, view] = this.#at(event, map);
    this.#end(event.pointerId, pointer, mm, view, event);
  }

  #end(id, pointer, mm, view, event) {
    this.#pointers.delete(id);
    if (pointer.layer) pointer.layer.pointer('up', mm, view ?? this.stage.maps[0].view(), event);
    else if (pointer.down) this.#lift(pointer);
    this.stage.redraw();
  }

  #lift(pointer) {
    const last = this.#moves.get(pointer.finger) ?? pointer.mm;
    this.#moves.delete(pointer.finger);
    pointer.down = false;
    this.#send(pointer.finger, 'up', last);
  }

  #send(finger, phase, [x, y]) {
    const round = (v) => Math.round(v * 1000) / 1000;
    return this.app.link.send({ do: 'touch', finger, phase, at_mm: [round(x), round(y)] });
  }

  #probe([x, y]) {
    if (this.stage.sheet.holds([x, y])) this.app.link.send({ do: 'probe', add: [Math.round(x * 10) / 10, Math.round(y * 10) / 10] });
  }

  #key(event, map) {
    const { stage } = this;
    if (!stage.sheet || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = ARROWS[event.key];
    if (!step && ![' ', 'enter', 'p'].includes(event.key.toLowerCase())) return;
    stage.cursor ??= [stage.sheet.width / 2, stage.sheet.height / 2];
    if (step) this.#step(step, event.shiftKey ? 10 : 1, map);
    else if (event.key === ' ' || event.key === 'Enter') this.#keyPress(event);
    else this.#probe(stage.cursor);
    event.preventDefault();
    map.canvas.setAttribute('data-keys', '');
    stage.redraw();
  }

  #step([dx, dy], size, map) {
    const { stage } = this;
    const [x, y] = stage.cursor;
    const clamp = (v, most) => Math.min(most, Math.max(0, v));
    const next = [clamp(x + dx * size, stage.sheet.width), clamp(y + dy * size, stage.sheet.height)];
    if (this.#keyHeld && !stage.sheet.holds(next)) return;
    stage.cursor = next;
    if (this.#keyHeld) {
      this.#moves.set(KEY_FINGER, next);
      this.#soon();
    }
    this.#tell(next, map);
    this.app.announce(place(next));
  }

  #keyPress(event) {
    if (event.repeat) return;
    if (this.#keyHeld) {
      this.#keyUp();
      return;
    }
    if (!this.stage.sheet.holds(this.stage.cursor)) return;
    this.app.playout.press(this.stage.cursor);
    if (!this.#send(KEY_FINGER, 'down', this.stage.cursor)) return;
    this.#keyHeld = event.key === ' ' ? 'space' : 'enter';
    this.stage.pressing = true;
    this.#pressed();
    this.app.announce(`Pressed at ${place(this.stage.cursor)}`);
  }

  #keyUp() {
    if (!this.#keyHeld) return;
    this.#keyHeld = null;
    this.stage.pressing = false;
    this.#moves.delete(KEY_FINGER);
    this.#send(KEY_FINGER, 'up', this.stage.cursor);
    this.stage.redraw();
  }

  /** Shows the place under the pointer and the field's value there. */
  #tell(mm, map) {
    const frame = map?.frame;
    this.#over = mm && map ? [mm, map] : null;
    if (!mm || !this.stage.sheet?.holds(mm)) {
      this.hover.textContent = '';
      return;
    }
    const value = frame ? this.stage.sheet.value(frame, mm) : null;
    this.hover.textContent = value === null ? place(mm) : `${place(mm)}: ${fieldValue(frame.head.quantity, value)}`;
  }
}
