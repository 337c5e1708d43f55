// What the page says is what is.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { last, open, press, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

test('what the page says is what is', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);

  await t.test('a speed that is not kept is told beside the one that is asked for', async () => {
    for (const [real, wanted] of [[0.05, /0\.05\d* of real time \(slower than asked\)$/], [1, /real time$/]]) {
      // What this machine gives is another thing: as a message it is as good.
      const said = await page.evaluate((speed_real) => {
        const { state } = window.unripple;
        state.publish('settings', { ...state.last('settings'), speed: 1, paused: false });
        state.publish('status', { ...state.last('status'), speed_real });
        return document.getElementById('foot-device').textContent;
      }, real);
      assert.match(said, wanted);
      assert.equal(said.includes('slower'), real < 1);
    }
  });

  await t.test('an axis has three ticks or more', async () => {
    const found = await page.evaluate(async () => {
      const { ticks } = await import('/assets/units.js');
      return [[40, 2], [62.5, 2], [1, 3], [9, 2], [1, 2]].map(([full, count]) => ticks(-full, full, count));
    });
    for (const values of found) assert.ok(values.length >= 3 && values.includes(0), JSON.stringify(values));
  });

  await t.test('fingers count from one, and a picture of real time is called no focus', async () => {
    const lift = await press(page, [62, 90]);
    await told(page, 'status', ({ fingers }) => fingers.length === 1);
    assert.equal(await page.locator('.finger b').innerText(), 'Finger 1');
    const label = await until('a peak', () => page.locator('#pane-0 .pane-label').innerText(), (text) => /peak/.test(text));
    assert.match(label, /strongest since the last picture/);
    assert.doesNotMatch(label, /focus/);
    await lift();
  });

  await t.test('a choice stays chosen while it is built', async () => {
    const method = page.locator('#panel-touch').getByLabel('Method');
    const before = await method.evaluate((select) => {
      const { state } = window.unripple;
      window.methods = [];
      for (const kind of ['settings', 'chosen', 'status']) state.subscribe(kind, () => window.methods.push(select.value));
      return select.value;
    });
    await method.selectOption('one-bit');
    // How time passes is told meanwhile, together with what still plays.
    await page.locator('#map-0').press(']');
    await told(page, 'settings', (settings) => settings.method === 'one-bit');
    const shown = await page.evaluate(() => window.methods);
    const from = shown.indexOf('one-bit');
    assert.ok(from >= 0 && !shown.slice(from).includes(before), `${shown}`);
  });

  await t.test('a surface that takes long to build is told, and neither undo nor a press waits for it', async () => {
    const { toml } = await last(page, 'surface');
    const note = page.locator('#building');
    await page.evaluate(() => window.unripple.transport.app.link.send({ do: 'edit', circle_mm: 75 }));
    await told(page, 'surface', (surface) => surface.values.shape === 'circle');
    await until('the note', () => note.isVisible());
    const lift = await press(page, [62, 90]);
    await told(page, 'status', ({ fingers }) => fingers.length === 1);
    await page.evaluate(() => window.unripple.transport.app.link.send({ do: 'undo' }));
    await told(page, 'surface', (surface) => surface.toml === toml);
    assert.ok(await note.isVisible(), 'the undone surface was waited for');
    await until('the end of it', () => note.isVisible(), (visible) => !visible);
    await told(page, 'status', ({ fingers }) => fingers.length === 1);
    await lift();
    await told(page, 'status', ({ fingers }) => fingers.length === 0);
    unharmed(page);
  });
});
