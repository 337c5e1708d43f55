// Two methods side by side.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart, largest } from './field.mjs';
import { drawn, open, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

test('two methods are shown side by side, and left again', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  await page.getByRole('tab', { name: 'Compare' }).click();
  await page.getByRole('button', { name: 'Run both' }).click();
  const { panes } = await told(page, 'compare', (message) => message.panes?.length === 2);
  assert.deepEqual(panes.map(({ method }) => method), ['time-reversal', 'inverse']);
  await until('two panes', () => page.evaluate(() => window.unripple.map.panes), (count) => count === 2);
  assert.ok(await page.locator('#pane-1').isVisible());
  await page.getByRole('button', { name: 'To the focal instant' }).click();
  const { focus_s: focus } = await told(page, 'compare');
  await until('the focal instant', () => page.evaluate(() => [0, 1].map((pane) => window.unripple.map.field(pane).time_s)),
    (times) => times.every((time) => Math.abs(time - focus) < 3e-4));
  const found = await largest(page);
  assert.ok(apart(found.at_mm, [62, 90]) <= 3, `the field is largest at ${found.at_mm} mm`);
  const fields = await page.evaluate(() => [0, 1].map((pane) => [...window.unripple.map.field(pane).values]));
  assert.notDeepEqual(fields[0], fields[1], 'both panes show the same');
  await shoot(page, 'compare');
  await page.getByRole('button', { name: 'Leave the comparison' }).click();
  await until('one pane', () => page.evaluate(() => window.unripple.map.panes), (count) => count === 1);
  await drawn(page, 2);
  unharmed(page);
});
