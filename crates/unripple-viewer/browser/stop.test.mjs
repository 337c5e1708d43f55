// What takes long can be stopped, and something else is measured at once.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { open, shoot, told, unharmed, until } from './page.mjs';
import { PATIENCE } from './patience.mjs';
import { serve } from './program.mjs';

/** A surface that needs a mesh, and modes up to twice its band for a measurement: that takes many seconds. */
const HEAVY = 'stadium-film';

test('a measurement that takes long is stopped by its button', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const measure = page.getByRole('button', { name: 'Measure', exact: true });
  const stop = page.getByRole('button', { name: 'Stop measuring' });
  const says = (text) => until(text, () => page.locator('#panel-touch [role=status]').allInnerTexts(), (texts) => texts.includes(text));
  await told(page, 'design', ({ done }) => done === true);
  assert.ok(await stop.isHidden(), 'a button that stops nothing');

  await page.getByRole('tab', { name: 'Design' }).click();
  await page.getByLabel('Open a built-in surface').selectOption(HEAVY);
  await told(page, 'surface', ({ name }) => name === HEAVY);
  await page.getByRole('tab', { name: 'Touch' }).click();
  await measure.click();
  await says('Measuring …');
  // At once: a picture first takes a slow browser as long as the measurement takes.
  await stop.click();
  await told(page, 'stopped', ({ id }) => Number.isSafeInteger(id));
  await says('Stopped.');
  assert.ok(await stop.isHidden() && await measure.isEnabled());
  await shoot(page, 'measuring-stopped');

  await page.getByRole('tab', { name: 'Design' }).click();
  await page.getByRole('button', { name: 'Undo' }).click();
  const { edit } = await told(page, 'surface', ({ name }) => name === 'hudin-2012');
  await page.getByRole('tab', { name: 'Touch' }).click();
  await measure.click();
  // The modes that nobody wants any more are computed to their end on the same cores, for up to half a minute on a slow machine.
  const { report, edit: of } = await told(page, 'measured', Boolean, 4 * PATIENCE);
  assert.equal(of, edit);
  assert.ok(report.targets[0].contrast > 1);
  unharmed(page);
});
