// A story leaves everything as it was, but for what others have made of it.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawn, last, open, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';
import { Socket } from './socket.mjs';

/** Steps of the story from which one actuator is left, and in which the picture runs slowly. */
const ALONE_AT = 2;
const LEFT_AT = 3;

/** Begins the story of one actuator and goes on to a step. */
async function begin(page, at) {
  await page.getByRole('tab', { name: 'Stories' }).click();
  await page.locator('#panel-stories article', { hasText: 'One actuator' }).getByRole('button').click();
  const story = page.getByRole('region', { name: 'Story' });
  for (let step = 1; step <= at; step += 1) {
    await until('that a step is ready', () => story.locator('[role=status]').innerText(), (text) => !text.endsWith('…'));
    if (step < at) await story.getByRole('button', { name: 'Next' }).click();
  }
  await told(page, 'surface', ({ actuators }) => actuators.length === 1);
  return story;
}

test('a story that changes the surface puts it back when it is left', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const { toml } = await told(page, 'surface');
  const story = await begin(page, LEFT_AT);
  await drawn(page);
  await shoot(page, 'story');
  await story.getByRole('button', { name: 'Leave' }).click();
  await told(page, 'surface', (surface) => surface.toml === toml);
  await told(page, 'status', ({ fingers, live }) => fingers.length === 0 && live);
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  assert.equal(await page.getByRole('button', { name: 'Put mine back' }).count(), 0);
  unharmed(page);
});

test('what another page makes of the surface during a story stays when it is left', async (t) => {
  const { url, port } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const { toml } = await told(page, 'surface');
  const other = await Socket.open(port);
  t.after(() => other.end());
  const story = await begin(page, ALONE_AT);
  other.send({ do: 'edit', thickness_mm: 0.15 });
  const { toml: edited } = await told(page, 'surface', ({ values }) => values.thickness_mm === 0.15);
  await story.getByRole('button', { name: 'Leave' }).click();
  const back = page.getByRole('button', { name: 'Put mine back' });
  await back.waitFor();
  // The settings that were put back have been answered, as an undo would have been.
  await told(page, 'status', ({ fingers, live }) => fingers.length === 0 && live);
  assert.equal((await last(page, 'surface')).toml, edited);
  await back.click();
  await told(page, 'surface', (surface) => surface.toml === toml);
  unharmed(page);
});
