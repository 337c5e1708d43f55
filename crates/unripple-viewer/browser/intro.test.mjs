// The introduction: it runs by itself, says what happens, shows it, and gives way to whoever presses.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart, largest, watch } from './field.mjs';
import { last, open, press, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];

/** A focus stands out from the rms of the field by far more; ripple seldom reaches this. */
const STANDS_OUT = 6;

const alive = (url) => `${url}?intro=1`;
const says = (page, words) => until(words, () => page.locator('#intro-text').innerText(), (text) => text.includes(words));
const focused = ({ at_mm, peak, rms }) => apart(at_mm, PLACE) <= 3 && peak > STANDS_OUT * rms;

/** It takes 18 s by the clock, and longer where the surface is slow to run to its focus, in ms of processor time. */
const WHOLE = 60_000;

test('the page opens alive, and the waves meet where the tap was', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, alive(url));
  const seen = await watch(page);
  await until('its beginning', () => page.locator('#intro').isVisible());
  await until('your turn', () => page.locator('#hint').isVisible(), Boolean, WHOLE);
  assert.ok(!(await page.locator('#intro').isVisible()));
  const { shown, words } = await seen();
  const parts = ['taps', 'hears', 'turned round', 'run back', 'meet where the tap was'];
  const order = parts.map((part) => words.findIndex((said) => said.includes(part)));
  assert.ok(order.every((at, i) => at >= 0 && (i === 0 || at > order[i - 1])), JSON.stringify(words));
  const during = (part) => shown.filter((picture) => picture.words.includes(part));
  assert.ok(during('hears').some((picture) => !focused(picture)), 'the ring ran out');
  assert.ok(during('run back').some((picture) => !focused(picture)), 'the waves began far away');
  assert.ok(during('meet where the tap was').some(focused), 'the waves met');
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  await told(page, 'status', ({ fingers, live }) => live && fingers.length === 0);
  await shoot(page, 'intro-turn-yours');
  unharmed(page);
});

test('the introduction gives way to a press, which plays out, and to a key', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, alive(url));
  await says(page, 'taps');
  const seen = await watch(page);
  const lift = await press(page, [100, 60]);
  await lift();
  assert.ok(!(await page.locator('#intro').isVisible()));
  const there = ({ paused, at_mm }) => paused && apart(at_mm, [100, 60]) <= 3;
  await until('the focus', async () => (await seen()).shown.some(there));
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
