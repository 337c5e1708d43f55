// The page comes back from whatever interrupts it.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout } from 'node:timers/promises';
import { drawn, open, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

const ASLEEP_MS = 5000;
const BUSY_MS = 3800;
const REFUSED = /ERR_CONNECTION_REFUSED|WebSocket/;

const connection = (page) => page.evaluate(() => window.unripple.state.last('connection'));

test('interruptions', async (t) => {
  const server = await serve(t, 'hudin-2012');
  const page = await open(t, server.url);

  await t.test('a reload comes back to the same tab and surface', async () => {
    await page.getByRole('tab', { name: 'Design' }).click();
    await page.getByLabel('Edge').selectOption('supported');
    const { toml } = await told(page, 'surface', ({ values }) => values.edge === 'supported');
    await page.reload();
    await drawn(page);
    assert.equal(await page.getByRole('tab', { selected: true }).innerText(), 'Design');
    assert.ok(await page.locator('#panel-design').isVisible());
    assert.equal((await told(page, 'surface')).toml, toml);
    unharmed(page, REFUSED);
  });

  await t.test('a machine that sleeps for a while', async () => {
    const cdp = await page.context().newCDPSession(page);
    await cdp.send('Page.setWebLifecycleState', { state: 'frozen' });
    server.signal('SIGSTOP');
    await setTimeout(ASLEEP_MS);
    server.signal('SIGCONT');
    await cdp.send('Page.setWebLifecycleState', { state: 'active' });
    await until('the connection', () => connection(page), ({ open }) => open);
    await drawn(page, 3);
    unharmed(page, REFUSED);
  });

  await t.test('a page that stands still itself keeps its connection', async () => {
    await page.evaluate(() => {
      window.losses = 0;
      window.unripple.state.subscribe('connection', ({ open }) => {
        window.losses += Number(!open);
      });
    });
    for (let i = 0; i < 3; i += 1) {
      await page.evaluate((still) => {
        const began = performance.now();
        while (performance.now() - began < still);
      }, BUSY_MS);
      await drawn(page, 3);
    }
    assert.equal(await page.evaluate(() => window.losses), 0);
    unharmed(page, REFUSED);
  });

  await t.test('a server that gives no answer for a while', async () => {
    server.signal('SIGSTOP');
    await until('that the page notices', () => connection(page), ({ open }) => !open);
    server.signal('SIGCONT');
    await until('the connection', () => connection(page), ({ open }) => open);
    await drawn(page, 3);
    unharmed(page, REFUSED);
  });

  await t.test('a server that dies and is started again', async (t) => {
    await server.kill();
    await until('that the page notices', () => connection(page), ({ open }) => !open);
    await shoot(page, 'connection-lost');
    const began = Date.now();
    await serve(t, 'hudin-2012', '--port', String(server.port));
    await until('the connection', () => connection(page), ({ open }) => open);
    await drawn(page, 3);
    t.diagnostic(`back after ${((Date.now() - began) / 1000).toFixed(1)} s, the start of the program included`);
    const mine = page.getByRole('button', { name: 'Bring back my surface' });
    await mine.waitFor();
    await shoot(page, 'server-back');
    await mine.click();
    await told(page, 'surface', ({ values }) => values.edge === 'supported');
    unharmed(page, REFUSED);
  });
});
