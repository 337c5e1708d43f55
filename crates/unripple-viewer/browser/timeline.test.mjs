// Focal instants on the line of time, the way from one to the next, and the fine scale around one.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart, largest } from './field.mjs';
import { last, open, press, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];

/** A focus stands out from the rms of the field by far more; ripple seldom reaches this. */
const STANDS_OUT = 6;

/** Pulses come at 10 Hz. */
const PERIOD_S = 0.1;

/** Moments are kept so far apart, in s. */
const KEPT_S = 1 / 12000;

const shown = (page) => page.evaluate(() => window.unripple.map.frame().head.time_s);
const focused = ({ at_mm, peak, rms }) => apart(at_mm, PLACE) <= 3 && peak > STANDS_OUT * rms;

test('focal instants are marked on the line of time', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const lift = await press(page, PLACE);
  // Three are gone back to; the moment at which time is stopped may lie some before the last.
  await until('six focal instants', () => page.locator('#ticks i').count(), (count) => count >= 6);
  await page.locator('#map-0').press('k');
  await told(page, 'settings', ({ paused }) => paused);
  await lift();

  const found = [];
  await t.test('the buttons and keys go from one to the next', async () => {
    for (let i = 0; i < 3; i += 1) {
      const before = await shown(page);
      if (i < 2) await page.getByRole('button', { name: 'Previous focus' }).click();
      else await page.locator('#map-0').press('j');
      await until('an earlier moment', () => shown(page), (time) => time < before - KEPT_S);
      assert.ok(focused(await largest(page)), `no focus at ${await shown(page)} s`);
      found.push(await shown(page));
    }
    for (const [i, time] of found.slice(1).entries()) {
      const periods = (found[i] - time) / PERIOD_S;
      assert.ok(Math.abs(periods - Math.round(periods)) < 0.03, `${found}`);
    }
    await page.getByRole('button', { name: 'Next focus' }).click();
    await until('the one after', () => shown(page), (time) => Math.abs(time - found[1]) < KEPT_S);
    await shoot(page, 'timeline');
  });

  await t.test('the fine scale reaches 2 ms to both sides, and what is shown changes within it', async () => {
    const fine = page.getByRole('button', { name: 'Fine' });
    await fine.click();
    const range = () => page.locator('#scrub').evaluate(({ min, max }) => [Number(min), Number(max)]);
    const [from, to] = await until('the fine scale', range, ([low, high]) => high - low < 0.01);
    assert.ok(Math.abs(to - from - 4e-3) < 1e-6 && Math.abs((from + to) / 2 - found[1]) < KEPT_S, `${from} to ${to}`);
    await page.locator('#scrub').focus();
    for (let i = 0; i < 8; i += 1) await page.keyboard.press('ArrowLeft');
    const time = await until('a moment before', () => shown(page), (at) => at < found[1] - KEPT_S);
    assert.ok(time > from - KEPT_S, `${time}`);
    await fine.click();
    await until('the whole scale', range, ([low, high]) => high - low > 0.1);
    unharmed(page);
  });

  await t.test('without a focus the page says so', async () => {
    await page.evaluate(() => window.unripple.transport.app.link.send({ do: 'edit', thickness_mm: 0.12, settled: true }));
    await until('no tick', () => page.locator('#ticks i').count(), (count) => count === 0);
    await page.getByRole('button', { name: 'Next focus' }).click();
    assert.match(await page.locator('#toasts').innerText(), /no focus yet|no later focus/);
    assert.equal((await last(page, 'status')).fingers.length, 0);
    unharmed(page);
  });
});
