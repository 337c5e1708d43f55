// A story leaves everything as it was.

import { test } from 'node:test';
import { drawn, open, shoot, told, unharmed, until } from './page.mjs';
import { serve } from './program.mjs';

/** A step of the story in which one actuator is left. */
const LEFT_AT = 3;

test('a story that changes the surface puts it back when it is left', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const { toml } = await told(page, 'surface');
  await page.getByRole('tab', { name: 'Stories' }).click();
  await page.locator('#panel-stories article', { hasText: 'One actuator' }).getByRole('button').click();
  const story = page.getByRole('region', { name: 'Story' });
  for (let step = 1; step <= LEFT_AT; step += 1) {
    await until('that a step is ready', () => story.locator('[role=status]').innerText(), (text) => !text.endsWith('…'));
    if (step === LEFT_AT) break;
    await story.getByRole('button', { name: 'Next' }).click();
  }
  await told(page, 'surface', ({ actuators }) => actuators.length === 1);
  await drawn(page);
  await shoot(page, 'story');
  await story.getByRole('button', { name: 'Leave' }).click();
  await told(page, 'surface', (surface) => surface.toml === toml);
  await told(page, 'status', ({ fingers, live }) => fingers.length === 0 && live);
  await told(page, 'settings', ({ paused, speed }) => !paused && speed === 1);
  unharmed(page);
});
