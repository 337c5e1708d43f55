// What is not of the protocol is refused and harms nothing.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawn, open, told, unharmed } from './page.mjs';
import { BY_THE_CLOCK, PATIENCE } from './patience.mjs';
import { serve } from './program.mjs';

const MESSAGES = [
  '', '{', 'null', '[]', '7', '"touch"', '{}', '{"do":"nothing"}', '{"do":"touch"}', '{"do":"touch","finger":-1,"phase":"down","at_mm":[1,1]}',
  '{"do":"touch","finger":0,"phase":"down","at_mm":[1e999,1]}', '{"do":"touch","finger":0,"phase":"down","at_mm":[1,1,1]}',
  '{"do":"touch","finger":0,"phase":"sideways","at_mm":[1,1]}', '{"do":"transport","speed":0}', '{"do":"transport","speed":"fast"}',
  '{"do":"transport","back":true}', '{"do":"settings","method":"magic"}', '{"do":"settings","effect":"../../etc/passwd"}',
  '{"do":"settings","rate_hz":-3}', '{"do":"edit","thickness_mm":-1,"settled":true}', '{"do":"edit","actuator":99,"at_mm":[10,10],"settled":true}',
  '{"do":"edit","actuator":0,"at_mm":[1000,10],"settled":true}', '{"do":"edit","material":"unobtainium","settled":true}',
  '{"do":"edit","edge":"loose","settled":true}',
  '{"do":"open","name":"../../etc/passwd"}', '{"do":"measure","id":1,"at":[]}', '{"do":"measure","id":1,"at":[[9999,9999]]}',
  '{"do":"compare","at":[[62,90]],"methods":["inverse"]}', '{"do":"compare","at":[[62,90]],"methods":["inverse","magic"]}',
  '{"do":"job","start":"rm -rf /"}', '{"do":"job","start":"calibrate","name":"../x"}', `{"do":"open","name":"${'x'.repeat(70000)}"}`,
];

test('malformed messages get a fault each and harm nothing', async (t) => {
  const { url } = await serve(t, 'hudin-2012');
  const page = await open(t, url);
  const { toml } = await told(page, 'surface');
  const unanswered = await page.evaluate(async ([messages, longest]) => {
    const silent = [];
    for (const message of [...messages, new Uint8Array([1, 2, 3])]) {
      const socket = new WebSocket(`ws://${location.host}/link`);
      const answered = await new Promise((done) => {
        const late = setTimeout(() => done(false), longest);
        const end = (value) => {
          clearTimeout(late);
          done(value);
        };
        socket.onopen = () => socket.send(message);
        socket.onclose = () => end('closed');
        socket.onmessage = ({ data }) => {
          const read = typeof data === 'string' ? JSON.parse(data) : {};
          if (read.is === 'fault' || (read.is === 'job' && read.state === 'failed')) end(read.text ?? 'failed');
        };
      });
      socket.close();
      if (typeof answered !== 'string' || (answered === 'closed' && message.length < 65536)) silent.push([String(message).slice(0, 80), answered]);
    }
    return silent;
  }, [MESSAGES, BY_THE_CLOCK * PATIENCE]);
  assert.deepEqual(unanswered, []);
  assert.equal((await told(page, 'surface')).toml, toml);
  const { state, fingers } = await told(page, 'status');
  assert.deepEqual([state, fingers], ['running', []]);
  // An edit is still carried out, to the surface that moves.
  const { modes: before } = await told(page, 'settings');
  await page.evaluate(() => document.getElementById('tab-design').click());
  await page.getByLabel('Edge').selectOption('supported');
  await told(page, 'settings', ({ modes: now }) => now !== before);
  await drawn(page, 2);
  unharmed(page);
});
