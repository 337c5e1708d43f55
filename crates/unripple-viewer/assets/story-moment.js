// Moments of a story: when the waves met last, and moving the picture around that instant.

const KEPT_S = 2.5;
const APART_MS = 80;
const LONGEST_MS = 15_000;
const YOUNG_S = 0.6;

/** Follows frames to know the last focal instant, and moves the shown time around it. */
export class StoryMoment {
  constructor(app) {
    this.app = app;
    this.peaks = [];
    this.clock = 0;
    this.fixed = null;
    this.sweep = 0;
    this.sentAt = 0;
    app.state.subscribe('frame', ({ head, pane }) => {
      if (pane || head.strobed !== true) return;
      // A clock that runs back is another surface's.
      if (head.time_s < this.clock) this.peaks = [];
      this.clock = head.time_s;
      if (!(head.peak > 0)) return;
      this.peaks.push({ time: head.time_s, peak: head.peak, seen: performance.now() });
      this.peaks = this.peaks.filter(({ time }) => Math.abs(head.time_s - time) < KEPT_S);
    });
  }

  /** Half the span worth looking at on either side of the focus, in s. */
  get reach() {
    if (this.fixed) return Math.max(this.fixed.focus_s - this.fixed.from_s, 1e-3);
    const settings = this.app.state.last('settings');
    return (settings?.window_ms ?? settings?.window_auto_ms ?? 30) / 1000;
  }

  /** Focal instant, in s of the shown clock; `null` before any. */
  get focus() {
    if (this.fixed) return this.fixed.focus_s;
    return this.found ?? null;
  }

  // Live waves are kept for a while only.
  get forgotten() {
    const tail = this.app.state.last('status')?.tail_s;
    return !this.fixed && Number.isFinite(tail) && this.found < tail;
  }

  /** Takes the instants of a comparison, or goes back to those of live frames with `null`. */
  pin(compare) {
    this.fixed = compare;
  }

  /** Lets real time run for a while of the surface's own clock and finds the strongest focus in it. Resolves to whether there was one. */
  async find(wait_ms, live) {
    this.fixed = null;
    const from = performance.now();
    this.app.link.send({ do: 'transport', live: true, speed: 1, paused: false });
    // A machine that has much to do makes new surfaces late, and runs them slowly.
    let [last, ran] = [null, 0];
    const stop = this.app.state.subscribe('frame', ({ head }) => {
      const step = last === null ? 0 : head.time_s - last;
      if (step > 0 && step < 1) ran += step;
      else if (step < 0) ran = 0;
      last = head.time_s;
    });
    while (live() && ran * 1000 < wait_ms && performance.now() - from < LONGEST_MS) await sleep(50);
    stop();
    if (!live()) return false;
    // The surface goes on until it hears that it is to stop, and forgets what is too old.
    const fresh = this.peaks.filter(({ seen, time }) => seen > from + 150 && time > this.clock - YOUNG_S);
    const best = fresh.reduce((most, each) => (each.peak > (most?.peak ?? 0) ? each : most), null);
    this.found = best?.time ?? null;
    return this.found !== null;
  }

  /** Shows one instant, `offset` s from the focus, and stops there. */
  show(offset) {
    if (this.focus === null) return;
    if (this.forgotten) {
      this.stop();
      this.lost?.();
      return;
    }
    this.offset = offset;
    this.app.link.send({ do: 'transport', paused: true, shown_s: this.focus + offset });
    this.moved?.(offset);
  }

  /** As `show`, for a slider: the last of many is always sent. */
  drag(offset) {
    clearTimeout(this.late);
    const wait = this.sentAt + APART_MS - performance.now();
    if (wait > 0) {
      this.late = setTimeout(() => this.drag(offset), wait);
      return;
    }
    this.sentAt = performance.now();
    this.show(offset);
  }

  /** Moves through offsets from first to last within `taken_ms`. */
  run(offsets, taken_ms) {
    this.stop();
    const from = performance.now();
    const step = () => {
      const part = Math.min(1, (performance.now() - from) / taken_ms);
      const at = part * (offsets.length - 1);
      const i = Math.min(offsets.length - 2, Math.floor(at));
      this.show(offsets[i] + (offsets[i + 1] - offsets[i]) * (at - i));
      if (part === 1) this.stop();
    };
    step();
    this.sweep = setInterval(step, APART_MS);
  }

  /** Whether it moves by itself. */
  get moving() {
    return this.sweep !== 0;
  }

  stop() {
    clearInterval(this.sweep);
    clearTimeout(this.late);
    this.sweep = 0;
    this.moved?.(this.offset ?? 0);
  }
}

/** Resolves after some ms. */
export function sleep(ms) {
  return new Promise((resolve) => { setTimeout(resolve, ms); });
}
