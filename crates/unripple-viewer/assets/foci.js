// Focal instants: when the places under fingers move most, found in the traces of the pictures that come.

/** A focus stands out from the motion before and after it: by so many times the rms of the trace it is taken for one. */
const STANDS_OUT = 4;

/** Of the strongest focus that is remembered, a focus has at least this share: what has less is ripple. */
const LEAST_SHARE = 0.4;

/** Nearer to each other than this, in s, two maxima belong to one focus: a pulse has several swings. */
const APART_S = 3e-3;

/** How far two places may be apart, in mm, that are one: they are sent in thousandths. */
const SAME_MM = 0.5;

/** Whether two places in mm are one. */
export const near = ([x, y], [u, v]) => Math.hypot(x - u, y - v) < SAME_MM;

/** The times of a trace's samples, in s of the surface: they end at the moment shown. */
const timeOf = ({ head }, i) => head.time_s - ((head.samples - 1 - i) * head.span_s) / head.samples;

/** Traces of the places under fingers, or of the finger at one place in mm. */
export function fingerTraces({ traces }, at = null) {
  return traces.filter(({ name, at_mm: mm }) => name.startsWith('finger') && (at === null || near(mm, at)));
}

/** Where a trace's magnitude is largest between two times in s: `{time, size, stands}`, `stands` over the trace's rms. */
export function strongest(frame, trace, from = -Infinity, to = Infinity) {
  let [best, square] = [-1, 0];
  const { samples } = trace;
  for (let i = 0; i < samples.length; i += 1) {
    square += samples[i] * samples[i];
    const time = timeOf(frame, i);
    if (time >= from && time <= to && (best < 0 || Math.abs(samples[i]) > Math.abs(samples[best]))) best = i;
  }
  if (best < 0 || square === 0) return null;
  const size = Math.abs(samples[best]);
  return {
    time: timeOf(frame, best), size: size * trace.scale, stands: size / Math.sqrt(square / samples.length),
    // What is largest at an end may be larger beyond it.
    whole: (best > 0 && best < samples.length - 1) || frame.head.strobed,
  };
}

/** Remembers the focal instants of what is kept of the past. */
export class Foci {
  #found = [];
  #quantity = null;
  #compared = null;
  #head = 0;
  #listeners = new Set();

  constructor(state) {
    state.subscribe('frame', (frame) => frame.pane === 0 && this.#look(frame));
    state.subscribe('compare', (compare) => {
      this.#compared = Number.isFinite(compare.focus_s) ? compare.focus_s : null;
    });
    state.subscribe('status', ({ tail_s: tail, head_s: head }) => {
      // A clock that runs back is another surface's.
      const kept = head < this.#head ? [] : this.#found.filter(({ time }) => time >= (tail ?? 0));
      this.#head = head;
      this.#take(kept);
    });
  }

  /** The focal instants, in s of the surface's clock, the oldest first. */
  get times() {
    const most = Math.max(0, ...this.#found.map(({ size }) => size));
    return this.#found.filter(({ size }) => size >= LEAST_SHARE * most).map(({ time }) => time);
  }

  /** Calls `fn(times)` whenever they change. */
  onChange(fn) {
    this.#listeners.add(fn);
    fn(this.times);
  }

  #look(frame) {
    if (frame.panes > 1) {
      this.#take(this.#compared === null ? [] : [{ time: this.#compared, size: 1 }]);
      return;
    }
    const { quantity } = frame.head;
    let found = quantity === this.#quantity ? this.#found : [];
    this.#quantity = quantity;
    for (const trace of fingerTraces(frame)) {
      const one = strongest(frame, trace);
      if (one && one.whole && one.stands >= STANDS_OUT) found = joined(found, one);
    }
    this.#take(found);
  }

  #take(found) {
    const told = (list) => list.map(({ time }) => time).join();
    const changed = told(found) !== told(this.#found);
    this.#found = found;
    if (changed) for (const fn of this.#listeners) fn(this.times);
  }
}

/** Focal instants with one more: of those that are too near to each other the strongest. */
function joined(found, one) {
  const rivals = found.filter(({ time }) => Math.abs(time - one.time) < APART_S);
  if (rivals.some(({ size }) => size >= one.size)) return found;
  return [...found.filter((other) => !rivals.includes(other)), one].sort((a, b) => a.time - b.time);
}
