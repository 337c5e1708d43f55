// Everything can be done without a pointer.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart } from './field.mjs';
import { last, open, pixel, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

/** Presses Tab until the element of this name has the focus. */
async function tabTo(page, id) {
  for (let i = 0; i < 80; i += 1) {
    await page.keyboard.press('Tab');
    if (await page.evaluate(() => document.activeElement?.id) === id) return;
  }
  throw new Error(`Tab never comes to ${id}`);
}

test('keys alone', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);

  await t.test('press the surface, move along it and lift', async () => {
    await tabTo(page, 'map-0');
    const [width, height] = (await last(page, 'surface')).extent_mm;
    for (const key of ['Shift+ArrowLeft', 'Shift+ArrowUp', 'ArrowUp', 'ArrowUp', 'ArrowRight']) await page.keyboard.press(key);
    const place = [width / 2 - 9, height / 2 + 12];
    await page.keyboard.press('Enter');
    await told(page, 'status', ({ fingers }) => fingers.length === 1 && apart(fingers[0].at_mm, place) < 0.1);
    await shoot(page, 'keyboard');
    await page.keyboard.press('ArrowDown');
    await told(page, 'status', ({ fingers }) => fingers.length === 1 && apart(fingers[0].at_mm, [place[0], place[1] - 1]) < 0.1);
    await page.keyboard.press('Enter');
    await told(page, 'status', ({ fingers }) => fingers.length === 0);
    await page.keyboard.down('Space');
    await told(page, 'status', ({ fingers }) => fingers.length === 1);
    await page.keyboard.up('Space');
    await told(page, 'status', ({ fingers }) => fingers.length === 0);
    unharmed(page);
  });

  await t.test('a finger of the keys is lifted where the mouse presses', async () => {
    await page.focus('#map-0');
    await page.keyboard.press('Enter');
    await told(page, 'status', ({ fingers }) => fingers.length === 1);
    await page.mouse.move(...(await pixel(page, [40, 60])));
    await page.mouse.down();
    await told(page, 'status', ({ fingers }) => fingers.length === 1 && apart(fingers[0].at_mm, [40, 60]) < 1);
    await page.mouse.up();
    await told(page, 'status', ({ fingers }) => fingers.length === 0);
    unharmed(page);
  });

  await t.test('pause and step through time', async () => {
    await page.keyboard.press('k');
    await told(page, 'settings', ({ paused }) => paused);
    await page.keyboard.press('Comma');
    await told(page, 'status', ({ live, head_s: head, shown_s: shown }) => !live && shown < head);
    await page.keyboard.press('n');
    await told(page, 'status', ({ live }) => live);
    unharmed(page);
  });

  await t.test('move an actuator', async () => {
    await tabTo(page, 'tab-touch');
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.evaluate(() => window.unripple.state.last('tab').name), 'design');
    const place = page.getByRole('button', { name: /^a1 at/ });
    await until('the first actuator', async () => {
      await page.keyboard.press('Tab');
      return place.evaluate((button) => button === document.activeElement);
    });
    const { actuators: [{ at_mm: [x, y] }] } = await told(page, 'surface');
    await page.keyboard.press('Shift+ArrowRight');
    await told(page, 'surface', ({ actuators: [{ at_mm }] }) => apart(at_mm, [x + 10, y]) < 0.2);
    unharmed(page);
  });
});
