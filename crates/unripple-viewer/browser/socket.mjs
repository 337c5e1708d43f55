// A link to the viewer without a browser: as much of WebSocket as that takes.

import { randomBytes } from 'node:crypto';
import { EventEmitter } from 'node:events';
import { connect } from 'node:net';

const TEXT = 1;
const BINARY = 2;
const CLOSE = 8;
const PING = 9;
const PONG = 10;

/** A link that emits `text` with a message, `frame` with the head of a picture, and `close`. */
export class Socket extends EventEmitter {
  #raw;
  #held = Buffer.alloc(0);

  constructor(raw, rest) {
    super();
    this.#raw = raw;
    raw.on('data', (part) => this.#take(part));
    raw.on('error', () => {});
    raw.on('close', () => this.emit('close'));
    this.#take(rest);
  }

  /** Connects; what the server answers if it refuses is in the error. */
  static open(port, headers = {}, path = '/link') {
    const lines = {
      Host: `127.0.0.1:${port}`, Origin: `http://127.0.0.1:${port}`, Connection: 'Upgrade', Upgrade: 'websocket',
      'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': randomBytes(16).toString('base64'), ...headers,
    };
    const asked = Object.entries(lines).filter(([, value]) => value !== null).map(([name, value]) => `${name}: ${value}\r\n`);
    return new Promise((done, fail) => {
      const raw = connect(port, '127.0.0.1', () => raw.write(`GET ${path} HTTP/1.1\r\n${asked.join('')}\r\n`));
      let answer = Buffer.alloc(0);
      const read = (part) => {
        answer = Buffer.concat([answer, part]);
        const end = answer.indexOf('\r\n\r\n');
        if (end < 0) return;
        raw.off('data', read);
        const status = Number(answer.toString('latin1', 9, 12));
        if (status === 101) done(new Socket(raw, answer.subarray(end + 4)));
        else {
          raw.destroy();
          fail(Object.assign(new Error(answer.toString('utf8')), { status }));
        }
      };
      raw.on('data', read);
      raw.on('error', fail);
    });
  }

  /** Sends JSON. */
  send(message) {
    this.#put(TEXT, Buffer.from(JSON.stringify(message)));
  }

  /** Reads nothing any more. */
  pause() {
    this.#raw.pause();
  }

  /** Ends the link. */
  end() {
    this.#raw.destroy();
  }

  #put(kind, body) {
    const head = body.length < 126 ? Buffer.from([0x80 | kind, 0x80 | body.length]) : Buffer.from([0x80 | kind, 0x80 | 126, body.length >> 8, body.length & 255]);
    // A mask of zeros is a mask.
    this.#raw.write(Buffer.concat([head, Buffer.alloc(4), body]));
  }

  #take(part) {
    this.#held = this.#held.length ? Buffer.concat([this.#held, part]) : part;
    for (;;) {
      const held = this.#held;
      if (held.length < 2) return;
      let [length, at] = [held[1] & 127, 2];
      if (held.length < 10 && length > 125) return;
      if (length === 126) [length, at] = [held.readUInt16BE(2), 4];
      else if (length === 127) [length, at] = [Number(held.readBigUInt64BE(2)), 10];
      if (held.length < at + length) return;
      this.#held = held.subarray(at + length);
      this.#heard(held[0] & 15, held.subarray(at, at + length));
    }
  }

  #heard(kind, body) {
    if (kind === TEXT) this.emit('text', JSON.parse(body.toString('utf8')));
    else if (kind === BINARY) this.emit('frame', JSON.parse(body.toString('utf8', 4, 4 + body.readUInt32LE(0))));
    else if (kind === PING) this.#put(PONG, body);
    else if (kind === CLOSE) this.#raw.end();
  }
}
