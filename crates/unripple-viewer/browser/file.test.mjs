// Surfaces go out as files and come in as files; what is no surface is refused.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { drawn, open, shoot, told, unharmed } from './page.mjs';
import { serve } from './program.mjs';

const INPUT = 'input[type=file]';
const named = (name, text) => ({ name, mimeType: 'application/toml', buffer: Buffer.from(text) });

test('surfaces as files', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  await page.getByRole('tab', { name: 'Design' }).click();
  let saved = '';

  await t.test('a saved surface loads again, changed, and undo goes back', async () => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('link', { name: 'Save as TOML' }).click()]);
    saved = await readFile(await download.path(), 'utf8');
    const changed = saved.replace(/tension_n_per_m = [\d.]+/, 'tension_n_per_m = 230');
    assert.notEqual(changed, saved);
    const { values: { tension_n_per_m: before } } = await told(page, 'surface');
    await page.locator(INPUT).setInputFiles(named('changed.toml', changed));
    await told(page, 'surface', ({ values }) => values.tension_n_per_m === 230);
    await page.getByRole('button', { name: 'Undo' }).click();
    await told(page, 'surface', ({ values, can_redo: redo }) => values.tension_n_per_m === before && redo);
    await page.getByRole('button', { name: 'Redo' }).click();
    await told(page, 'surface', ({ values }) => values.tension_n_per_m === 230);
    await drawn(page);
    unharmed(page);
  });

  await t.test('what is no surface is refused with words, and nothing else happens', async () => {
    const bad = [
      ['broken.toml', saved.replace('[sheet]', '[sheet'), /line|:\d+/],
      ['unknown.toml', saved.replace('tension_n_per_m', 'tensoin_n_per_m'), /tension_n_per_m/],
      ['outline.toml', saved.replace(/rectangle_mm = .*/, 'svg = "../../etc/passwd"'), /svg|outline|file/],
      ['large.toml', `${saved}\n# ${'x'.repeat(300 << 10)}`, /256|KiB/],
      ['bytes.toml', Buffer.from([0xff, 0xfe, 0x00, 0x80]), /.../],
    ];
    const { toml } = await told(page, 'surface');
    for (const [name, text, words] of bad) {
      await page.locator(INPUT).setInputFiles(named(name, text));
      const alert = page.locator('.faults', { hasText: name });
      await alert.waitFor();
      const said = await alert.innerText();
      assert.match(said, words, name);
      assert.doesNotMatch(said, /root:|panicked/, name);
      if (name === 'broken.toml') await shoot(page, 'refused');
    }
    assert.equal((await told(page, 'surface')).toml, toml);
    // By hand, as no page would.
    const status = await page.evaluate(async (size) => {
      const answer = await fetch('/surface', { method: 'POST', body: 'x'.repeat(size) });
      return answer.status;
    }, 300 << 10);
    assert.ok(status === 413 || status === 400, String(status));
    await drawn(page);
    unharmed(page, /^(400|413): .*\/surface$|status of (400|413)/);
  });
});
