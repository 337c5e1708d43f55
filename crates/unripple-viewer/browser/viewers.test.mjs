// Many watch at once.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout } from 'node:timers/promises';
import { serve } from './program.mjs';
import { Socket } from './socket.mjs';

const WATCHERS = 9;
const WATCHED_MS = 4000;

test('a viewer that reads nothing keeps no other waiting', async (t) => {
  const { port } = await serve(t, 'hudin-2012');
  const slow = await Socket.open(port);
  slow.pause();
  const counts = new Array(WATCHERS).fill(0);
  const watchers = await Promise.all(counts.map(async (_, i) => {
    const socket = await Socket.open(port);
    socket.on('frame', ({ frame }) => {
      counts[i] += 1;
      socket.send({ do: 'seen', frame });
    });
    return socket;
  }));
  t.after(() => [slow, ...watchers].forEach((socket) => socket.end()));
  watchers[0].send({ do: 'touch', finger: 0, phase: 'down', at_mm: [62, 90] });
  let viewers = 0;
  watchers[0].on('text', (message) => {
    if (message.is === 'status') viewers = message.viewers;
  });
  counts.fill(0);
  const began = performance.now();
  await setTimeout(WATCHED_MS);
  const rates = counts.map((count) => count / ((performance.now() - began) / 1000));
  t.diagnostic(`frames a second: ${rates.map((rate) => rate.toFixed(1)).join(' ')}`);
  const median = [...rates].sort((a, b) => a - b)[WATCHERS >> 1];
  assert.equal(viewers, WATCHERS + 1);
  assert.ok(median > 2, `${median} frames a second: more than a viewer gets that says nothing`);
  for (const rate of rates) assert.ok(rate >= median / 2, `one gets ${rate} frames a second, the middle one ${median}`);
});
