// Every figure says what it means, where that is from, and what a good value is.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { open, press, shoot, told, unharmed } from './page.mjs';
import { serve } from './program.mjs';

/** Figures of a design that are limits of the model, and explain themselves. */
const PLAIN = new Set(['finger_power', 'linear_limit_thickness', 'linear_limit_tension']);

test('a question mark beside each figure unfolds what it means', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  await (await press(page, [62, 90]))();
  await page.getByRole('button', { name: 'Measure', exact: true }).click();
  await told(page, 'measured');
  const rows = await page.locator('#panel-touch .figures:has(.why) tbody th').evaluateAll((heads) => heads.map((head) => [head.innerText, head.querySelector('.why') !== null]));
  assert.ok(rows.length >= 15, `${rows.length} figures`);
  assert.deepEqual(rows.filter(([, known]) => !known), []);
  const mark = page.getByLabel('What is Contrast?').first();
  await mark.focus();
  await page.keyboard.press('Enter');
  const said = await page.locator('#panel-touch .why[open]').innerText();
  for (const words of [/velocity/, /Good:/, /Definition:/]) assert.match(said, words);
  await shoot(page, 'why');

  await page.getByRole('tab', { name: 'Design' }).click();
  const { figures } = await told(page, 'design', ({ done }) => done !== false);
  const wanted = figures.filter(({ key }) => !PLAIN.has(key)).length;
  assert.equal(await page.locator('#panel-design .figures .why').count(), wanted);

  await page.getByRole('tab', { name: 'Stories' }).click();
  const paper = page.locator('#panel-stories a', { hasText: 'Tradeoffs in the Application of Time-Reversed Acoustics' });
  assert.match(await paper.getAttribute('href'), /^https:\/\//);
  unharmed(page);
});
