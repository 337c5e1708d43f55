// The session in the page, as a worker: the program compiled to WebAssembly, which is given the page's messages and the time.
//
// The page sends texts, its messages, and {ask, path, body} for files; it is sent texts and pictures as the server would send them,
// {is: 'answer', ask, status, body}, and once {is: 'open'}. {is: 'gone', why} is the last that it hears.

const PERIOD_MS = 1000 / 30;
const BREATH_MS = 2;
const SURFACE = 'hudin-2012';
const NOTHING = 0;
const FRAME = 2;
const NEWEST = -1;

let program = null;
let failed = '';

const bytes = (at, length) => new Uint8Array(program.memory.buffer, at >>> 0, length >>> 0);
const text = (array) => new TextDecoder().decode(array);
const imports = {
  page: {
    now_s: () => (performance.timeOrigin + performance.now()) / 1000,
    fail: (at, length) => {
      failed = text(bytes(at, length));
    },
  },
};

function write(words) {
  const array = new TextEncoder().encode(words);
  const at = program.room(array.length);
  bytes(at, array.length).set(array);
}

const said = () => bytes(program.said(), program.said_length()).slice();

/** Sends what waits to be sent. */
function flush() {
  for (let kind = program.next(); kind !== NOTHING; kind = program.next()) {
    const array = said();
    if (kind === FRAME) postMessage(array.buffer, [array.buffer]);
    else postMessage(text(array));
  }
}

/** The answer to a request for a file. */
function answer({ ask, path, body }) {
  const url = new URL(path, 'http://session');
  if (url.pathname === '/surface') {
    write(body ?? '');
    const taken = program.load() === 1;
    return { is: 'answer', ask, status: taken ? 200 : 400, body: JSON.stringify(taken ? {} : { text: text(said()) }) };
  }
  write(url.pathname.slice(1));
  const found = program.file(Number(url.searchParams.get('id') ?? NEWEST)) === 1;
  return { is: 'answer', ask, status: found ? 200 : 404, body: found ? said() : 'nothing of that has been measured' };
}

/** Does something that ends the worker if it fails. */
function safely(act) {
  try {
    act();
    return true;
  } catch (error) {
    postMessage({ is: 'gone', why: failed || String(error) });
    close();
    return false;
  }
}

function beat() {
  const began = performance.now();
  const goes = safely(() => {
    program.tick();
    flush();
    if (program.work() === 1) flush();
  });
  if (goes) setTimeout(beat, Math.max(BREATH_MS, began + PERIOD_MS - performance.now()));
}

async function start() {
  const file = await fetch(new URL('./unripple.wasm', import.meta.url));
  if (!file.ok) throw new Error(`unripple.wasm: ${file.status}`);
  const { instance } = await WebAssembly.instantiate(await file.arrayBuffer(), imports);
  program = instance.exports;
  write(SURFACE);
  if (program.open() !== 1) throw new Error(text(said()));
  onmessage = ({ data }) => safely(() => {
    if (typeof data === 'string') {
      write(data);
      program.hear();
    } else {
      postMessage(answer(data));
    }
    flush();
  });
  postMessage({ is: 'open' });
  beat();
}

start().catch((error) => {
  postMessage({ is: 'gone', why: failed || String(error) });
  close();
});
