// A design in the link, and surface files dropped onto the page.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateRawSync } from 'node:zlib';
import { drawn, last, open, shoot, told, unharmed } from './page.mjs';
import { serve } from './program.mjs';

/** A link to a page with bytes as its surface, as raw deflate in base64url. */
const linked = (url, bytes, version = 1) => `${url}#surface-${version}=${deflateRawSync(bytes).toString('base64url')}`;

/** Designs that are passed on by their links. */
const DESIGNS = [
  { thickness_mm: 0.137 }, { tension_n_per_m: 231.25 }, { rectangle_mm: [161.5, 143.25] }, { actuators: 5 }, { decay_time_ms: 61.3 },
];

/** Goes to a link in the page that is open, as when it is typed into the address. */
const follow = (page, link) => page.evaluate((to) => { location.href = to; }, link);

/** What the page says of a surface that it did not take. */
async function refused(page, words) {
  const alert = page.locator('.faults', { hasText: words });
  await alert.waitFor();
  const said = await alert.innerText();
  await page.locator('.faults').getByRole('button', { name: 'Close' }).click();
  assert.doesNotMatch(said, /panicked|TypeError|undefined/);
}

/** Drops files onto the page. */
async function drop(page, files) {
  const transfer = await page.evaluateHandle((named) => {
    const made = new DataTransfer();
    for (const [name, text] of named) made.items.add(new File([text], name));
    return made;
  }, files);
  await page.dispatchEvent('#panes', 'dragover', { dataTransfer: transfer });
  assert.ok(await page.locator('#drop').isVisible(), 'the page says that it takes files');
  await page.dispatchEvent('#panes', 'drop', { dataTransfer: transfer });
  assert.ok(!(await page.locator('#drop').isVisible()));
}

test('a design in the link', async (t) => {
  const { url } = await serve(t, 'hudin-2012');

  await t.test('opens as just the same text', async (t) => {
    const page = await open(t, url);
    await page.getByRole('tab', { name: 'Design' }).click();
    const links = [];
    for (const edit of DESIGNS) {
      const { toml: before } = await told(page, 'surface');
      await page.evaluate((message) => window.unripple.transport.app.link.send(message), { do: 'edit', ...edit, settled: true });
      const { toml } = await told(page, 'surface', (surface) => surface.toml !== before);
      await page.getByRole('button', { name: 'Copy link' }).click();
      const field = page.getByLabel('Link to this surface');
      await field.waitFor();
      links.push([await field.inputValue(), toml]);
    }
    await shoot(page, 'link');
    assert.equal(new Set(links.map(([link]) => link)).size, DESIGNS.length);
    for (const [link, toml] of links) {
      const [address, hash] = link.split('#');
      assert.equal(address, new URL('/', url).href);
      await follow(page, `#${hash}`);
      await told(page, 'surface', (surface) => surface.toml === toml);
      assert.equal(new URL(page.url()).hash, '', 'a reload must not bring it back');
    }
    unharmed(page);
  });

  await t.test('opens with the page', async (t) => {
    const first = await open(t, url);
    const { toml } = await told(first, 'surface');
    const other = toml.replace(/thickness_mm = [\d.]+/, 'thickness_mm = 0.15');
    assert.notEqual(other, toml);
    const page = await open(t, linked(url, other));
    await told(page, 'surface', ({ values }) => values.thickness_mm === 0.15);
    await page.getByRole('tab', { name: 'Design' }).click();
    await page.getByRole('button', { name: 'Undo' }).click();
    await told(page, 'surface', (surface) => surface.toml === toml);
    await drawn(page);
    unharmed(page);
  });

  await t.test('that is malformed or hostile is refused with words', async (t) => {
    const page = await open(t, url);
    const { toml } = await told(page, 'surface');
    const whole = new URL(linked(url, toml)).hash;
    for (const [hash, words] of [
      [new URL(linked(url, toml, 2)).hash, 'version 2'],
      ['#surface-', 'is damaged'],
      ['#surface-1=', 'is damaged'],
      ['#surface-1=%00<script>alert(1)</script>', 'letters, digits'],
      [whole.slice(0, -12), 'cannot be inflated'],
      [`#surface-1=${Buffer.from('no deflate at all, whatever it is').toString('base64url')}`, 'cannot be inflated'],
      [new URL(linked(url, Buffer.from([0xff, 0xfe, 0, 0x80]))).hash, 'expected a text'],
      // A megabyte for a kilobyte of link.
      [new URL(linked(url, '#'.repeat(64 << 20))).hash, 'at most 256 KiB'],
      [`#surface-1=${'A'.repeat(400_000)}`, 'too long'],
      [new URL(linked(url, 'this is no TOML')).hash, 'was not accepted'],
      [new URL(linked(url, toml.replace(/rectangle_mm = .*/, 'svg = "../../etc/passwd"'))).hash, 'was not accepted'],
    ]) {
      await follow(page, hash);
      await refused(page, words);
    }
    assert.equal((await last(page, 'surface')).toml, toml);
    unharmed(page, /^400: .*\/surface$|status of 400/);
  });
});

test('files dropped onto the page', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const { toml } = await told(page, 'surface');

  await t.test('open, when they are surfaces', async () => {
    const changed = toml.replace(/thickness_mm = [\d.]+/, 'thickness_mm = 0.16');
    await drop(page, [['thick.toml', changed]]);
    await told(page, 'surface', ({ values }) => values.thickness_mm === 0.16);
    await page.getByRole('button', { name: 'Undo' }).click();
    await told(page, 'surface', (surface) => surface.toml === toml);
    unharmed(page);
  });

  await t.test('are refused with words, when they are not', async () => {
    for (const [files, words] of [
      [[['notes.txt', 'Dear diary']], 'notes.txt was not accepted'],
      [[['a.toml', toml], ['b.toml', toml]], 'found 2 files'],
      [[['large.toml', `${toml}\n# ${'x'.repeat(300 << 10)}`]], 'large.toml has 30'],
    ]) {
      await page.getByRole('tab', { name: 'Touch' }).click();
      await drop(page, files);
      await refused(page, words);
    }
    assert.equal((await last(page, 'surface')).toml, toml);
    unharmed(page, /^400: .*\/surface$|status of 400/);
  });
});
