// What showing frames costs: milliseconds of parsing and drawing per frame, frames per second, over the last five seconds.

const SPAN_MS = 5000;

/** Timing of the frames shown. */
export class Cost {
  #marks = [];
  #parsing = 0;

  parsed(ms) {
    this.#parsing += ms;
  }

  drawn(ms, frames) {
    const now = performance.now();
    this.#marks.push({ now, ms: ms + this.#parsing, frames });
    this.#parsing = 0;
    while (this.#marks[0].now < now - SPAN_MS) this.#marks.shift();
  }

  get frames() {
    const since = performance.now() - SPAN_MS;
    return this.#marks.filter((mark) => mark.now >= since);
  }

  /** Mean time per frame, ms; null before any. */
  get mean_ms() {
    const marks = this.frames;
    const count = marks.reduce((sum, mark) => sum + mark.frames, 0);
    return count > 0 ? marks.reduce((sum, mark) => sum + mark.ms, 0) / count : null;
  }

  /** Animation frames painted with fresh data, per second. */
  get frames_per_s() {
    const marks = this.frames;
    if (marks.length < 2) return 0;
    const span = Math.max(1000, performance.now() - marks[0].now);
    return (1000 * marks.length) / span;
  }
}
