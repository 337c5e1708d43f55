// Pages in headless Chromium, watched for faults that nobody would see.

import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { mkdir } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { delimiter, join } from 'node:path';
import { after } from 'node:test';
import { setTimeout } from 'node:timers/promises';
import { BY_THE_CLOCK, PATIENCE, wait } from './patience.mjs';
import { packages, screenshots } from './program.mjs';

const { chromium } = createRequire(packages)('playwright-core');

const ARGS = [
  '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--enable-unsafe-swiftshader',
];
const NAMES = ['chromium', 'chromium-browser', 'google-chrome'];

let browser = null;
after(async () => (await browser)?.close());

/** The browser of all tests. */
export function launch() {
  const found = (process.env.PATH ?? '').split(delimiter).flatMap((place) => NAMES.map((name) => join(place, name))).find(existsSync);
  browser ??= chromium.launch({ executablePath: process.env.CHROMIUM ?? found, headless: true, args: ARGS });
  return browser;
}

/** The address of a page that opens at rest, without its introduction; a touch is then played as fast as time is set to pass. */
export function atRest(url) {
  const address = new URL(url);
  address.searchParams.set('intro', '0');
  return address.href;
}

/** Opens a viewer's page and waits for its first picture; it opens at rest, unless the address says otherwise. `page.faults` collects errors
 * and failed requests. */
export async function open(t, url, options = {}) {
  const context = await (await launch()).newContext({ viewport: { width: 1280, height: 860 }, ...options });
  t.after(() => context.close());
  const page = await context.newPage();
  page.setDefaultTimeout(BY_THE_CLOCK * PATIENCE);
  page.faults = [];
  page.on('console', (line) => line.type() === 'error' && page.faults.push(`console: ${line.text()}`));
  page.on('pageerror', (error) => page.faults.push(`thrown: ${error.message}`));
  page.on('requestfailed', (request) => page.faults.push(`failed: ${request.url()}`));
  page.on('response', (response) => response.status() >= 400 && page.faults.push(`${response.status()}: ${response.url()}`));
  await page.goto(new URL(url).searchParams.has('intro') ? url : atRest(url));
  await drawn(page, 0).catch((error) => {
    throw new Error(`${error.message}; the page had ${JSON.stringify(page.faults)}`);
  });
  return page;
}

/** Asks again and again until the answer holds, and returns it; a page's policy forbids to wait within it. */
export async function until(what, ask, holds = Boolean, patience = PATIENCE) {
  const waiting = wait(patience);
  for (;;) {
    const found = await ask();
    if (holds(found)) return found;
    if (waiting.over()) throw new Error(`waited in vain for ${what}; found last: ${JSON.stringify(found)?.slice(0, 400)}`);
    await setTimeout(40);
  }
}

/** The last message of a kind. */
export function last(page, kind) {
  return page.evaluate((name) => window.unripple?.state.last(name) ?? null, kind);
}

/** Waits until the last message of a kind is as `holds` says; returns it. What the page says to whoever reads it is in the error. */
export async function told(page, kind, holds = Boolean, patience = PATIENCE) {
  try {
    return await until(`a message: ${kind}`, () => last(page, kind), (message) => message !== null && holds(message), patience);
  } catch (error) {
    const says = await page.locator('#connection, #toasts .toast').allInnerTexts();
    throw new Error(`${error.message}; the page says ${JSON.stringify(says)}`, { cause: error });
  }
}

/** Waits until the page has drawn so many more pictures. */
export async function drawn(page, more = 1) {
  const number = () => page.evaluate(() => (window.unripple?.map.field() ? window.unripple.map.frame().head.frame : -1));
  const first = await until('a picture', number, (frame) => frame >= 0);
  await until('newer pictures', number, (frame) => frame >= first + more || (frame >= 0 && frame < first));
}

/** Where a place in mm lies in the window, in CSS pixels. */
export async function pixel(page, mm, pane = 0) {
  return page.evaluate(([at, number]) => {
    const map = window.unripple.map.maps[number];
    const box = map.canvas.getBoundingClientRect();
    const [x, y] = map.view().toPx(at);
    return [box.left + x, box.top + y];
  }, [mm, pane]);
}

/** Presses a place with the mouse; what is returned lifts it. */
export async function press(page, mm) {
  const [x, y] = await pixel(page, mm);
  await page.mouse.move(x, y);
  await page.mouse.down();
  return () => page.mouse.up();
}

/** A picture of the page for whoever wants to look. */
export async function shoot(page, name) {
  await mkdir(screenshots, { recursive: true });
  await page.screenshot({ path: join(screenshots, `${name}.png`) });
}

/** Nothing went wrong unseen, but for what is expected. */
export function unharmed(page, expected = /^$/) {
  assert.deepEqual(page.faults.filter((fault) => !expected.test(fault)), []);
}
