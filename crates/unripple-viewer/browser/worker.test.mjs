// The worker that holds the session of a page without a server: what it makes of the page's messages, with a program that answers at once.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout } from 'node:timers/promises';

const AT = 16;

/** A program of the exports that the worker calls, in a memory of one page. */
function program() {
  const memory = { buffer: new ArrayBuffer(1 << 16) };
  const waiting = [];
  let length = 0;
  let failed = false;
  const heard = () => new TextDecoder().decode(new Uint8Array(memory.buffer, AT, length));
  const tell = (text) => {
    length = new TextEncoder().encodeInto(text, new Uint8Array(memory.buffer, AT)).written;
  };
  return {
    memory,
    room: (bytes) => {
      length = bytes;
      return AT;
    },
    said: () => AT,
    said_length: () => length,
    open: () => waiting.push([1, `open ${heard()}`]) && 1,
    hear: () => {
      failed = heard() === 'fail';
      if (failed) throw new Error('unreachable');
      waiting.push([1, `heard ${heard()}`]);
    },
    load: () => {
      const taken = heard() === 'good';
      tell(taken ? '' : 'line 1: nothing');
      return Number(taken);
    },
    file: (id) => {
      const name = heard();
      tell(`${name} of ${id}`);
      return Number(name === 'drive.wav');
    },
    tick: () => {
      if (failed) throw new Error('unreachable');
      waiting.push([2, 'picture']);
    },
    work: () => 0,
    next: () => {
      const [kind, text] = waiting.shift() ?? [0, ''];
      if (kind) tell(text);
      return kind;
    },
  };
}

test('a worker gives the page what a server would, and says when it has failed', async (t) => {
  const posted = [];
  let closed = false;
  Object.assign(globalThis, { onmessage: null, close: () => (closed = true), postMessage: (message) => posted.push(message) });
  t.mock.method(globalThis, 'fetch', async () => new Response(new Uint8Array()));
  const { instantiate } = WebAssembly;
  t.mock.method(WebAssembly, 'instantiate', async (bytes, imports) => {
    // Node itself has modules, too.
    if (!imports?.page) return instantiate(bytes, imports);
    assert.ok(imports.page.now_s() > 1.7e9);
    return { instance: { exports: program() } };
  });
  await import('../assets/session-worker.js');
  while (!posted.some((message) => message instanceof ArrayBuffer)) await setTimeout(5);
  assert.deepEqual(posted.slice(0, 2), [{ is: 'open' }, 'open hudin-2012']);
  const answer = (data) => {
    globalThis.onmessage({ data });
    return posted.at(-1);
  };
  assert.equal(answer('a message'), 'heard a message');
  const body = (answered) => [answered.ask, answered.status, new TextDecoder().decode(answered.body)];
  assert.deepEqual(body(answer({ ask: 1, path: '/drive.wav?id=7', body: null })), [1, 200, 'drive.wav of 7']);
  assert.equal(answer({ ask: 2, path: '/report.md', body: null }).status, 404);
  assert.equal(answer({ ask: 3, path: '/surface', body: 'good' }).status, 200);
  const refused = answer({ ask: 4, path: '/surface', body: 'bad' });
  assert.deepEqual([refused.status, JSON.parse(refused.body).text], [400, 'line 1: nothing']);
  assert.equal(answer('fail').is, 'gone');
  assert.ok(closed);
});
