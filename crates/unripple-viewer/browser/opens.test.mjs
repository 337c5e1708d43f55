// The page comes up whole, in every tab.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawn, open, shoot, unharmed } from './page.mjs';
import { serve } from './program.mjs';

const TABS = ['Touch', 'Design', 'Compare', 'Stories', 'Rig'];

test('the page opens without a fault, and so does every tab', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  assert.match(await page.title(), /hudin-2012/);
  for (const name of TABS) {
    await page.getByRole('tab', { name }).click();
    await drawn(page, 2);
    const panel = page.locator(`#panel-${name.toLowerCase()}`);
    assert.ok((await panel.innerText()).length > 40, `the tab ${name} says something`);
    await shoot(page, `tab-${name.toLowerCase()}`);
  }
  await page.getByRole('button', { name: 'Relief' }).click();
  await drawn(page, 3);
  await shoot(page, 'relief');
  unharmed(page);
});

test('the address with a token opens the page', async (t) => {
  const { url, port } = await serve(t, 'hudin-2012', '--listen', '0.0.0.0', '--token', 'letters8and9');
  const token = new URL(url).search;
  const page = await open(t, `http://127.0.0.1:${port}/${token}`);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('link', { name: 'surface.toml' }).click()]);
  assert.equal(await download.failure(), null);
  unharmed(page);
});
