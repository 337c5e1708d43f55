// The page on a telephone, dark and light.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawn, open, shoot, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const TABS = ['Touch', 'Design', 'Compare', 'Stories', 'Rig'];

test('a page of 320 pixels never scrolls sideways', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  for (const colorScheme of ['dark', 'light']) {
    const page = await open(t, url, { viewport: { width: 320, height: 640 }, colorScheme, hasTouch: true, isMobile: true });
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), colorScheme);
    for (const name of TABS) {
      await page.getByRole('tab', { name }).click();
      await drawn(page);
      const wide = await page.evaluate(() => {
        const most = document.documentElement.clientWidth;
        const out = [...document.querySelectorAll('body *')].filter((node) => node.getBoundingClientRect().right > most + 1 && !node.closest('[hidden], .seen-not, .skip'));
        return [document.documentElement.scrollWidth, most, out.slice(0, 5).map((node) => node.outerHTML.slice(0, 120))];
      });
      assert.ok(wide[0] <= wide[1], `${name}, ${colorScheme}: ${JSON.stringify(wide)}`);
      await shoot(page, `narrow-${colorScheme}-${name.toLowerCase()}`);
    }
    unharmed(page);
    await page.context().close();
  }
});

test('the map stays in sight while its story is read on a telephone', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url, { viewport: { width: 390, height: 760 }, hasTouch: true, isMobile: true });
  await page.getByRole('tab', { name: 'Stories' }).click();
  await page.locator('#panel-stories article', { hasText: 'One actuator' }).getByRole('button').click();
  const leave = page.getByRole('region', { name: 'Story' }).getByRole('button', { name: 'Leave' });
  await leave.scrollIntoViewIfNeeded();
  await drawn(page);
  const seen = () => page.evaluate(() => {
    const { top, bottom } = document.getElementById('panes').getBoundingClientRect();
    return { top, bottom, height: innerHeight, wide: document.documentElement.scrollWidth - document.documentElement.clientWidth };
  });
  const { top, bottom, height, wide } = await seen();
  await shoot(page, 'narrow-story');
  assert.ok(top >= 0 && bottom < 0.6 * height, `the map reaches from ${top} to ${bottom} of ${height} pixels`);
  assert.ok(wide <= 0, `${wide} pixels too wide`);
  await leave.click();
  await until('the page as it was', () => page.evaluate(() => getComputedStyle(document.getElementById('panes')).position === 'relative'));
  unharmed(page);
});
