// Fingers make waves run together where they are.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout } from 'node:timers/promises';
import { apart, largest, passed, scrub, slow, strongest, whenTouched } from './field.mjs';
import { last, open, pixel, press, shoot, told, unharmed } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];
const FIVE = [[30, 110], [62, 90], [75, 40], [110, 60], [118, 118]];

/** How long a quick tap takes, in ms: a tenth of a block of the surface at 1/200. */
const TAP_MS = 30;

/** A touch waits for a block of the surface to begin, its picture for the next: at most so long, in s. */
const BLOCKS = 4e-3;

/**
 * Stops the surface when the first pulses of touches are over; returns when each comes to its focus, and how still it was before. The
 * touches came between two times, in s.
 */
async function focuses(page, [untouched, touched], places) {
  const window = (await last(page, 'settings')).window_auto_ms / 1e3;
  const [from, to] = [untouched + window - BLOCKS / 2, touched + window + BLOCKS / 2];
  await passed(page, to + BLOCKS / 2);
  await page.locator('#map-0').press('k');
  await told(page, 'settings', ({ paused }) => paused);
  await scrub(page, from - 2 * BLOCKS);
  const before = await largest(page, places[0], 3);
  const instants = await strongest(page, places, from, to);
  await scrub(page, instants[0]);
  return { before, instants };
}

/** Lets time pass again, for whoever comes next. */
async function goOn(page) {
  await page.locator('#map-0').press('n');
  await told(page, 'settings', ({ paused }) => !paused);
}

/** Whether fingers weigh on the sheet. Its clock begins anew: a page that is told so must not hold the one before for it. */
async function weigh(page, load) {
  const { head_s: before } = await told(page, 'status');
  await page.evaluate((wanted) => {
    const { state } = window.unripple;
    window.begun = null;
    state.subscribe('settings', (settings) => {
      if (settings.load === wanted) window.begun ??= state.last('status').head_s;
    });
  }, load);
  await page.getByLabel('Fingers weigh').setChecked(load);
  await told(page, 'settings', (settings) => settings.load === load);
  const begun = await page.evaluate(() => window.begun);
  assert.ok(begun < before, `the clock stands at ${begun} s, where it stood at ${before} s before`);
}

test('fingers', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  let light = 0;

  await t.test('one makes the field largest where it presses, a window later', async (t) => {
    const page = await open(t, url);
    await slow(page);
    const touch = await whenTouched(page);
    const lift = await press(page, PLACE);
    const touched = await touch();
    const { before, instants: [focus] } = await focuses(page, touched, [PLACE]);
    const found = await largest(page);
    await shoot(page, 'focus');
    t.diagnostic(`largest at ${found.at_mm.map((mm) => mm.toFixed(1))} mm, ${((focus - touched[1]) * 1e3).toFixed(1)} ms after the first picture of the touch`);
    assert.ok(apart(found.at_mm, PLACE) <= 3, `the field is largest at ${found.at_mm} mm`);
    assert.ok(found.peak > 2 * before.peak, `${found.peak} m at the focus, ${before.peak} m before it`);
    light = (await largest(page, PLACE, 1)).peak;
    await lift();
    unharmed(page);
    await goOn(page);
  });

  await t.test('one that weighs on the sheet stills it', async (t) => {
    const page = await open(t, url);
    await weigh(page, true);
    await slow(page);
    const touch = await whenTouched(page);
    const lift = await press(page, PLACE);
    await focuses(page, await touch(), [PLACE]);
    const { peak } = await largest(page, PLACE, 1);
    await shoot(page, 'focus-weighed');
    t.diagnostic(`${(peak * 1e6).toFixed(1)} µm under a finger that weighs, ${(light * 1e6).toFixed(1)} µm under one that does not`);
    assert.ok(peak < 0.7 * light, `${peak} m under a finger that weighs, ${light} m under one that does not`);
    await lift();
    // What is chosen while time stands still is played when it goes on.
    await goOn(page);
    await weigh(page, false);
    unharmed(page);
  });

  await t.test('five at once have five focuses', async (t) => {
    const page = await open(t, url, { hasTouch: true });
    await slow(page);
    const touchPoints = await Promise.all(FIVE.map(async (mm, id) => {
      const [x, y] = await pixel(page, mm);
      return { x, y, id };
    }));
    const cdp = await page.context().newCDPSession(page);
    const touch = await whenTouched(page, FIVE.length);
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints });
    const touched = await touch();
    const { fingers } = await told(page, 'status', (status) => status.fingers.length === FIVE.length);
    for (const mm of FIVE) assert.ok(fingers.some(({ at_mm }) => apart(at_mm, mm) < 0.5), `${mm} is none of ${JSON.stringify(fingers)}`);
    const { instants } = await focuses(page, touched, FIVE);
    await shoot(page, 'five-focuses');
    for (const [i, mm] of FIVE.entries()) {
      await scrub(page, instants[i]);
      const found = await largest(page, mm, 9);
      assert.ok(apart(found.at_mm, mm) <= 3, `about ${mm} the field is largest at ${found.at_mm} mm`);
      assert.ok(found.peak > 3 * found.rms, `${found.peak} m at ${mm} mm, ${found.rms} m everywhere`);
    }
    await goOn(page);
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await told(page, 'status', (status) => status.fingers.length === 0);
    unharmed(page);
  });
});

test('a tap in slow motion has its focus', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  await page.locator('#stops').getByRole('button', { name: '1/200', exact: true }).click();
  await told(page, 'settings', ({ speed }) => Math.abs(200 * speed - 1) < 1e-6);
  const touch = await whenTouched(page);
  const lift = await press(page, PLACE);
  await setTimeout(TAP_MS);
  await lift();
  assert.match(await page.locator('#toasts').innerText(), /At this speed the waves meet in [\d.]+ s/);
  const { before, instants: [focus] } = await focuses(page, await touch(), [PLACE]);
  const found = await largest(page);
  await shoot(page, 'tap');
  t.diagnostic(`largest at ${found.at_mm.map((mm) => mm.toFixed(1))} mm, ${focus.toFixed(4)} s`);
  assert.ok(apart(found.at_mm, PLACE) <= 3, `the field is largest at ${found.at_mm} mm`);
  assert.ok(found.peak > 2 * before.peak, `${found.peak} m at the focus, ${before.peak} m before it`);
  await goOn(page);
  await told(page, 'status', ({ fingers }) => fingers.length === 0);
  unharmed(page);
});
