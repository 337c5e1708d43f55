// The introduction: it runs by itself, says what happens, shows it, and gives way to whoever presses.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart, largest } from './field.mjs';
import { last, open, press, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];

/** A focus stands out from the rms of the field by far more; ripple seldom reaches this. */
const STANDS_OUT = 6;

const alive = (url) => `${url}?intro=1`;
const says = (page, words) => until(words, () => page.locator('#intro-text').innerText(), (text) => text.includes(words));
const focused = ({ at_mm, peak, rms }) => apart(at_mm, PLACE) <= 3 && peak > STANDS_OUT * rms;

test('the page opens alive, and the waves meet where the tap was', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, alive(url));
  await says(page, 'taps');
  await until('the tap', () => largest(page), focused);
  await shoot(page, 'intro-tap');
  await says(page, 'hears');
  await until('the waves far away', () => largest(page), (found) => !focused(found));
  await page.waitForTimeout(1500);
  await shoot(page, 'intro-hear');
  await says(page, 'turned round');
  await page.waitForTimeout(1300);
  await shoot(page, 'intro-turn');
  await says(page, 'run back');
  await page.waitForTimeout(3500);
  await shoot(page, 'intro-play');
  await says(page, 'meet where the tap was');
  await until('the focus', () => largest(page), focused);
  await shoot(page, 'intro-meet');
  await until('your turn', () => page.locator('#hint').isVisible());
  assert.ok(!(await page.locator('#intro').isVisible()));
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  await told(page, 'status', ({ fingers, live }) => live && fingers.length === 0);
  await shoot(page, 'intro-turn-yours');
  unharmed(page);
});

test('the introduction gives way to a press, which plays out, and to a key', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, alive(url));
  await says(page, 'taps');
  const lift = await press(page, [100, 60]);
  await lift();
  assert.ok(!(await page.locator('#intro').isVisible()));
  await told(page, 'settings', ({ paused }) => paused);
  await until('the focus', () => largest(page), ({ at_mm }) => apart(at_mm, [100, 60]) <= 3);
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  await page.getByRole('tab', { name: 'Stories' }).click();
  await page.getByRole('button', { name: 'Watch the introduction' }).click();
  await says(page, 'taps');
  await page.keyboard.press('Escape');
  await until('its end', () => page.locator('#intro').isVisible(), (visible) => !visible);
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  await told(page, 'status', ({ fingers }) => fingers.length === 0);
  unharmed(page);
});

test('where less motion is wanted, the introduction has stills', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, alive(url), { reducedMotion: 'reduce' });
  await says(page, 'hears');
  const shown = new Set();
  await until('the next part', async () => {
    shown.add((await last(page, 'status')).shown_s);
    return page.locator('#intro-text').innerText();
  }, (text) => !text.includes('hears'));
  // Three stills, the one before and the one after.
  assert.ok(shown.size >= 2 && shown.size <= 5, `${shown.size} moments were shown`);
  await page.getByRole('button', { name: 'Skip' }).click();
  await told(page, 'settings', ({ paused }) => !paused);
  unharmed(page);
});
