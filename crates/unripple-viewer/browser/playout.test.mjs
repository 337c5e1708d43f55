// A quick tap ends in a focus that is seen, whatever the speed.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout } from 'node:timers/promises';
import { apart, largest, watch } from './field.mjs';
import { last, open, press, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];

/** Length of a click, in ms. */
const CLICK_MS = 150;

/** A focus stands out from the rms of the field by far more; ripple seldom reaches this. */
const STANDS_OUT = 6;

test('a click ends in a focus that is seen, at every speed', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  await page.getByRole('button', { name: 'Slow touches' }).click();
  const speeds = await page.locator('#stops button').evaluateAll((stops) => stops.map((stop) => Number(stop.dataset.speed)));
  for (const [i, wanted] of speeds.entries()) {
    await page.locator('#stops button').nth(i).click();
    await told(page, 'settings', ({ speed }) => Math.abs(speed / wanted - 1) < 1e-6);
    const seen = await watch(page);
    const lift = await press(page, PLACE);
    await setTimeout(CLICK_MS);
    await lift();
    const focused = ({ paused, at_mm, peak, rms }) => paused && apart(at_mm, PLACE) <= 3 && peak > STANDS_OUT * rms;
    const found = await until('the focus', async () => (await seen()).shown.find(focused));
    t.diagnostic(`1/${Math.round(1 / wanted)}: ${(found.peak * 1e6).toFixed(1)} µm, ${(found.peak / found.rms).toFixed(1)} times the rms`);
    if (wanted === 1) await shoot(page, 'played-out');
    // Then time passes as it was set to.
    await told(page, 'settings', ({ paused, speed }) => !paused && Math.abs(speed / wanted - 1) < 1e-6);
  }
  unharmed(page);
});

test('a click while time stands still is played, and time stands still again', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url, { reducedMotion: 'reduce' });
  await page.getByRole('button', { name: 'Slow touches' }).click();
  await page.locator('#map-0').press('k');
  await told(page, 'settings', ({ paused }) => paused);
  const { head_s: before } = await last(page, 'status');
  const lift = await press(page, PLACE);
  await lift();
  await told(page, 'status', ({ live, head_s: head }) => !live && head > before);
  await until('the focus', () => largest(page), ({ at_mm, peak, rms }) => apart(at_mm, PLACE) <= 3 && peak > STANDS_OUT * rms);
  await page.locator('#map-0').press('n');
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  unharmed(page);
});
