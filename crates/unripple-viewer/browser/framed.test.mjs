// Which other pages may show the page in a frame.

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { launch, pixel, shoot, told, until } from './page.mjs';
import { serve } from './program.mjs';

const PLACE = [62, 90];

/** A page of another origin that frames what it is told to. */
async function stranger(t) {
  const framing = { url: 'about:blank', port: 0 };
  const server = createServer((_, answer) => {
    answer.writeHead(200, { 'Content-Type': 'text/html' });
    answer.end(`<!doctype html><title>Another page</title><iframe src="${framing.url}" width="1200" height="800"></iframe>`);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  t.after(() => {
    server.closeAllConnections();
    server.close();
  });
  framing.port = server.address().port;
  return framing;
}

/** Opens a page that has a frame; both. `page.said` is what the browser says to whoever looks, and why requests failed. */
async function framed(t, address) {
  const context = await (await launch()).newContext({ viewport: { width: 1280, height: 860 } });
  t.after(() => context.close());
  const page = await context.newPage();
  page.said = [];
  page.on('console', (line) => page.said.push(line.text()));
  page.on('requestfailed', (request) => page.said.push(request.failure()?.errorText ?? ''));
  await page.goto(address);
  const frame = await until('a frame', () => page.frames()[1]);
  return { page, frame };
}

/** The browser shows no other page's frame what it was told to refuse, and says why. */
async function refused(t, address, url) {
  const { page, frame } = await framed(t, address);
  await until('the refusal', () => page.said, (said) => said.some((line) => /frame-ancestors/.test(line)));
  assert.ok(!frame.url().startsWith(url), frame.url());
}

test('nobody frames the page by default', async (t) => {
  const other = await stranger(t);
  other.url = (await serve(t, 'hudin-2012')).url;
  await refused(t, `http://127.0.0.1:${other.port}`, other.url);
  await refused(t, `http://localhost:${other.port}`, other.url);
});

test('an origin that is named frames the page, and no other does', async (t) => {
  const other = await stranger(t);
  const origin = `http://127.0.0.1:${other.port}`;
  other.url = (await serve(t, 'hudin-2012', '--framed-by', origin)).url;
  const { page, frame } = await framed(t, origin);
  await until('a picture', () => frame.evaluate(() => Boolean(window.unripple?.map.field())));
  const { x: left, y: top } = await (await frame.frameElement()).boundingBox();
  const [x, y] = await pixel(frame, PLACE);
  await page.mouse.move(left + x, top + y);
  await page.mouse.down();
  const { fingers: [finger] } = await told(frame, 'status', ({ fingers }) => fingers.length === 1);
  finger.at_mm.forEach((mm, i) => assert.ok(Math.abs(mm - PLACE[i]) < 1, `${finger.at_mm}`));
  await shoot(page, 'framed');
  await page.mouse.up();
  await told(frame, 'status', ({ fingers }) => fingers.length === 0);
  await refused(t, `http://localhost:${other.port}`, other.url);
});

test('any port of this machine frames the page where that is said, by that name alone', async (t) => {
  const other = await stranger(t);
  other.url = (await serve(t, 'hudin-2012', '--framed-by', 'http://localhost:*')).url;
  const { frame } = await framed(t, `http://localhost:${other.port}`);
  await until('a picture', () => frame.evaluate(() => Boolean(window.unripple?.map.field())));
  await refused(t, `http://127.0.0.1:${other.port}`, other.url);
});
