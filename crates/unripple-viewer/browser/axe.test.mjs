// The rules of axe-core for pages that everybody can use: no violation in any tab, dark and light, and on a telephone.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { drawn, launch, open, press, told, unharmed, until } from './page.mjs';
import { packages, serve } from './program.mjs';

const TABS = ['Touch', 'Design', 'Compare', 'Stories', 'Rig'];

/** What breaks a rule, in words. */
async function violations(page) {
  const { violations: found } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return found.map(({ id, help, nodes }) => `${id}: ${help}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 120)).join(' ')}`);
}

/** Opens a page with axe-core in it, which the page's policy would not let in by a script of its own. */
async function checked(t, url, options) {
  const page = await open(t, url, options);
  const axe = await readFile(createRequire(packages).resolve('axe-core/axe.min.js'), 'utf8');
  await page.evaluate(axe);
  return page;
}

test('axe finds nothing', async (t) => {
  await launch();
  const { url } = await serve(t, 'hudin-2012');
  for (const [colorScheme, viewport] of [['dark', { width: 1280, height: 860 }], ['light', { width: 320, height: 640 }]]) {
    await t.test(`${colorScheme}, ${viewport.width} pixels wide`, async (t) => {
      const page = await checked(t, url, { colorScheme, viewport });
      const lift = await press(page, [62, 90]);
      await until('a tick', () => page.locator('#ticks i').count());
      await lift();
      if (viewport.width < 1000) {
        await page.getByRole('button', { name: 'Measure', exact: true }).click();
        await told(page, 'measured');
        await page.locator('#panel-touch .why summary').first().click();
      }
      for (const name of TABS) {
        await page.getByRole('tab', { name }).click();
        await drawn(page);
        if (name === 'Design') await told(page, 'design', ({ done }) => done !== false);
        assert.deepEqual(await violations(page), [], name);
      }
      await page.getByRole('button', { name: 'Relief' }).click();
      assert.deepEqual(await violations(page), [], 'Relief');
      await page.getByRole('button', { name: 'Map' }).click();
      unharmed(page);
    });
  }

  await t.test('nor in the introduction', async (t) => {
    const page = await checked(t, `${url}?intro=1`, { colorScheme: 'light' });
    await until('the introduction', () => page.locator('#intro').isVisible());
    assert.deepEqual(await violations(page), []);
    unharmed(page);
  });
});
