// What the page shows of the field, as numbers; and the moment that it shows.

import { last, told, until } from './page.mjs';

/** The paper's surface goes to 3 kHz: so long lasts a swing, in s, and so far apart are remembered moments. */
const SWING = 1 / 2000;
const KEPT = 1 / 12000;

/** Where the field shown has its largest magnitude, in all or within `reach` mm of `around`; and its rms, SI. */
export function largest(page, around = null, reach = Infinity) {
  return page.evaluate(([from, most]) => {
    const { values, at_mm, time_s } = window.unripple.map.field();
    const near = ([x, y]) => from === null || Math.hypot(x - from[0], y - from[1]) <= most;
    let cell = -1;
    let square = 0;
    values.forEach((value, i) => {
      square += value * value;
      if ((cell < 0 || Math.abs(value) > Math.abs(values[cell])) && near(at_mm(i))) cell = i;
    });
    return { peak: Math.abs(values[cell]), at_mm: at_mm(cell), rms: Math.sqrt(square / values.length), time_s };
  }, [around, reach]);
}

/**
 * Notes of each picture, as it comes, where its field is largest, its rms, whether time stands still, and the words of the introduction; and all
 * these words. The function returned gives what was noted. On a busy machine much goes by between two looks from outside.
 */
export async function watch(page) {
  await page.evaluate(() => {
    const { map, state } = window.unripple;
    const text = document.getElementById('intro-text');
    [window.shown, window.words] = [[], [text.innerText]];
    new MutationObserver(() => window.words.push(text.innerText)).observe(text, { childList: true, characterData: true, subtree: true });
    state.subscribe('frame', () => requestAnimationFrame(() => {
      const { values, at_mm } = map.field();
      let [cell, square] = [0, 0];
      values.forEach((value, i) => {
        square += value * value;
        if (Math.abs(value) > Math.abs(values[cell])) cell = i;
      });
      const peak = Math.abs(values[cell]);
      const { paused } = state.last('settings');
      window.shown.push({ at_mm: at_mm(cell), peak, rms: Math.sqrt(square / values.length), paused, words: text.innerText });
    }));
  });
  return () => page.evaluate(() => ({ shown: window.shown, words: window.words }));
}

/** How far two places are apart. */
export const apart = ([x, y], [u, v]) => Math.hypot(x - u, y - v);

/**
 * Remembers the last picture in which no finger rests and the first in which so many do. The function returned waits for the latter; it
 * gives the times of both, in s: fingers came down between them. On a busy machine pictures are 5 ms of the surface apart.
 */
export async function whenTouched(page, fingers = 1) {
  await page.evaluate((count) => {
    const { map, state } = window.unripple;
    // The picture shown may be of a clock that was begun anew since.
    window.touched = [Math.min(map.frame().head.time_s, state.last('status').head_s), null];
    const stop = state.subscribe('frame', ({ head }) => {
      if (window.touched[1] !== null) return;
      if (head.fingers.length === 0) window.touched[0] = head.time_s;
      if (head.fingers.length < count) return;
      window.touched[1] = head.time_s;
      stop?.();
    });
  }, fingers);
  return () => until('a picture of the fingers', () => page.evaluate(() => window.touched), ([, time]) => time !== null);
}

/** Lets time pass at about a fiftieth of its pace, by the button that is nearest. */
export async function slow(page) {
  const speeds = await page.locator('#stops button').evaluateAll((stops) => stops.map((stop) => Number(stop.dataset.speed)));
  const away = speeds.map((speed) => Math.abs(Math.log(speed * 50)));
  const nearest = away.indexOf(Math.min(...away));
  await page.locator('#stops button').nth(nearest).click();
  await told(page, 'settings', ({ speed }) => Math.abs(speed / speeds[nearest] - 1) < 1e-6);
}

/** Shows a moment, in s, by the slider: that which is remembered nearest to it. */
export async function scrub(page, time) {
  const shown = () => page.evaluate(() => window.unripple.map.frame().head.time_s);
  await page.evaluate((value) => {
    const slider = document.getElementById('scrub');
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    // The page sends what a slider says once per animation frame.
    return new Promise((sent) => { requestAnimationFrame(() => sent()); });
  }, time);
  await until(`the moment ${time}`, shown, (found) => Math.abs(found - time) <= 0.6 * KEPT);
}

/** Waits until the surface has got to a time, in s. */
export function passed(page, time) {
  return until(`${time} s on the surface`, () => last(page, 'status'), (status) => status.head_s > time);
}

/** For each place the instant between two, in s, in which the field moves most there. */
export async function strongest(page, places, from, to) {
  const search = async (sought, first, last, step) => {
    const best = sought.map(() => [0, first]);
    for (let time = first; time <= last; time += step) {
      await scrub(page, time);
      const found = await Promise.all(sought.map((at) => largest(page, at, 1)));
      found.forEach(({ peak, time_s: shown }, i) => {
        if (peak > best[i][0]) best[i] = [peak, shown];
      });
    }
    return best.map(([, time]) => time);
  };
  const near = await search(places, from, to, SWING / 2);
  const best = [];
  for (const [i, time] of near.entries()) {
    best.push(...await search([places[i]], time - SWING / 2, time + SWING / 2, KEPT));
  }
  return best;
}
