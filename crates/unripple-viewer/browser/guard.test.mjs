// Who is let in, and what can be had.

import assert from 'node:assert/strict';
import { request } from 'node:http';
import { connect } from 'node:net';
import { test } from 'node:test';
import { serve } from './program.mjs';
import { Socket } from './socket.mjs';

/** What is answered: status and text. */
function get(port, path, headers = {}, method = 'GET', body = '') {
  return new Promise((done, fail) => {
    const asked = request({ host: '127.0.0.1', port, path, method, headers }, (answer) => {
      let text = '';
      answer.setEncoding('utf8').on('data', (part) => {
        text += part;
      }).on('end', () => done({ status: answer.statusCode, text, headers: answer.headers }));
    });
    asked.on('error', fail);
    asked.end(body);
  });
}

/** The status that is answered to a path that no client would leave as it is. */
function raw(port, path) {
  return new Promise((done, fail) => {
    const socket = connect(port, '127.0.0.1', () => socket.write(`GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nConnection: close\r\n\r\n`));
    let text = '';
    socket.setEncoding('latin1').on('data', (part) => {
      text += part;
    }).on('close', () => done({ status: Number(text.slice(9, 12)), text })).on('error', fail);
  });
}

const linked = (port, headers, path) => Socket.open(port, headers, path).then((socket) => {
  socket.end();
  return 101;
}, ({ status }) => status);

test('only pages of the viewer are let in', async (t) => {
  const { port } = await serve(t, 'hudin-2012');
  const own = `http://127.0.0.1:${port}`;
  assert.equal((await get(port, '/')).status, 200);
  assert.equal((await get(port, '/', { Host: `localhost:${port}`, Origin: `http://localhost:${port}` })).status, 200);
  for (const Host of ['evil.example', `evil.example:${port}`, `127.0.0.1:${port + 1}`, `127.0.0.1.evil.example:${port}`]) {
    assert.equal((await get(port, '/', { Host })).status, 403, Host);
    assert.equal((await get(port, '/surface.toml', { Host })).status, 403, Host);
  }
  for (const Origin of ['http://evil.example', 'null', `https://127.0.0.1:${port}`, `${own}.evil.example`, `http://127.0.0.1:${port + 1}`]) {
    assert.equal((await get(port, '/surface', { Origin }, 'POST', 'format = 1')).status, 403, Origin);
    assert.equal(await linked(port, { Origin }), 403, Origin);
  }
  assert.equal(await linked(port, { Origin: null }), 403, 'a link without an origin');
  assert.equal(await linked(port, { Host: 'evil.example', Origin: 'http://evil.example' }), 403, 'a name that was bent to this machine');
  assert.equal(await linked(port, {}), 101);
});

test('nothing but the page is given out', async (t) => {
  const { port } = await serve(t, 'hudin-2012');
  const paths = [
    '/assets/../../Cargo.toml', '/assets/..%2f..%2fCargo.toml', '/assets/%2e%2e/%2e%2e/Cargo.toml', '/assets/..%5c..%5cCargo.toml',
    '/../Cargo.toml', '/assets//etc/passwd', '/assets/%2fetc%2fpasswd', '/assets/app.js%00.css', '/assets/', '/etc/passwd', '/Cargo.toml',
  ];
  for (const path of paths) {
    const { status, text } = await raw(port, path);
    assert.ok(status === 404 || status === 400, `${path}: ${status}`);
    assert.doesNotMatch(text, /\[package\]|root:/, path);
  }
  const { status, headers } = await get(port, '/assets/app.js');
  assert.equal(status, 200);
  assert.match(headers['content-security-policy'], /default-src 'self'/);
  assert.equal((await raw(port, '/drive.wav')).status, 404, 'nothing has been measured');
});

test('where the network listens, a token is needed', async (t) => {
  const { url, port } = await serve(t, 'hudin-2012', '--listen', '0.0.0.0');
  const token = new URL(url).searchParams.get('token');
  assert.match(token, /^[0-9a-zA-Z]{8,64}$/);
  assert.equal((await get(port, `/?token=${token}`)).status, 200);
  for (const path of ['/', '/?token=', `/?token=${token.slice(1)}`, '/surface.toml', '/report.json']) {
    assert.equal((await get(port, path)).status, 403, path);
  }
  assert.equal(await linked(port, {}), 403);
  assert.equal(await linked(port, {}, `/link?token=${token}`), 101);
});
