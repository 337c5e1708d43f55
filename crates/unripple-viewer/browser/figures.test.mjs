// The page's figures are those of the command line.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { last, open, pixel, press, shoot, told, unharmed } from './page.mjs';
import { answer, folder, serve } from './program.mjs';

/** Where two values differ by more than a share of them, as text; nothing if nowhere. */
function differences(found, wanted, share, path = '') {
  if (typeof wanted === 'number' && typeof found === 'number') {
    const scale = Math.max(Math.abs(wanted), Math.abs(found), 1e-30);
    return Math.abs(found - wanted) <= share * scale ? [] : [`${path}: ${found}, not ${wanted}`];
  }
  if (wanted === null || typeof wanted !== 'object') return Object.is(found, wanted) ? [] : [`${path}: ${found}, not ${wanted}`];
  const keys = new Set([...Object.keys(wanted), ...Object.keys(found ?? {})]);
  return [...keys].flatMap((key) => differences(found?.[key], wanted[key], share, `${path}.${key}`));
}

test('figures of the page and of the command line', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const saved = await folder(t);
  const files = await folder(t);

  await t.test('what is measured is what `unripple focus` measures', async (t) => {
    const page = await open(t, url);
    const lift = await press(page, [62, 90]);
    await lift();
    await page.getByRole('button', { name: 'Measure', exact: true }).click();
    const { command, report } = await told(page, 'measured');
    const [, ...args] = command.split(' ');
    assert.match(command, /^unripple focus hudin-2012 --at 62,90 .*-o \S+$/);
    const wanted = await answer(...args.slice(0, -1), join(saved, 'measured'));
    assert.ok(report.targets[0].contrast > 1);
    // The command line writes files and the record of its run; the page gives its own files out one by one.
    const figures = (all) => ({ ...all, files: null, run: null });
    assert.deepEqual(differences(figures(report), figures(wanted), 1e-6), []);
    await page.locator('.command').first().scrollIntoViewIfNeeded();
    await shoot(page, 'measured');
    unharmed(page);
  });

  await t.test('an actuator that is dragged changes the figures as the command line says', async (t) => {
    const page = await open(t, url);
    await page.getByRole('tab', { name: 'Design' }).click();
    const before = await told(page, 'design', ({ act, done }) => act && done !== false);
    const [x, y] = await pixel(page, (await last(page, 'surface')).actuators[0].at_mm);
    const [toX, toY] = await pixel(page, [6, 6]);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(toX, toY, { steps: 12 });
    await shoot(page, 'actuator-dragged');
    await page.mouse.up();
    await told(page, 'surface', ({ actuators: [{ at_mm }], can_undo: settled }) => settled && Math.hypot(at_mm[0] - 6, at_mm[1] - 6) < 1);
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('link', { name: 'Save as TOML' }).click()]);
    const file = join(files, 'dragged.toml');
    await download.saveAs(file);
    const at = before.act.at_mm.join(',');
    // What follows an edit is computed on the modes of the band alone.
    const wanted = await answer('focus', file, '--at', at, '--judge-hz', '3000', '-o', join(saved, 'dragged'));
    const { contrast } = wanted.targets[0];
    assert.ok(Math.abs(contrast / before.act.contrast - 1) > 0.02, `${contrast} after, ${before.act.contrast} before: too alike to tell`);
    const now = await told(page, 'design', ({ act, done }) => done !== false && Math.abs(act.contrast / contrast - 1) < 0.01);
    assert.deepEqual(now.act.at_mm, before.act.at_mm);
    t.diagnostic(`contrast ${before.act.contrast} before, ${now.act.contrast} now, ${contrast} by the command line`);
    await shoot(page, 'actuator-moved');
    await page.getByRole('button', { name: 'Undo' }).click();
    await told(page, 'surface', ({ actuators: [{ at_mm }] }) => Math.hypot(at_mm[0] - 6, at_mm[1] - 6) > 10);
    unharmed(page);
  });
});
