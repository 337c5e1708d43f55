// The program under test: `unripple view`, started and ended; and its other commands.

import { execFile, spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const root = fileURLToPath(new URL('../../..', import.meta.url));

/** The program's file. */
export const program = resolve(process.env.UNRIPPLE ?? join(root, 'target/release/unripple'));

/** Where the packages of package-lock.json are, and the file that names them. */
export const packages = join(root, 'target/browser/package.json');

/** Where pictures of the page go. */
export const screenshots = join(root, 'target/screenshots');

/** A folder that is gone after the test. */
export async function folder(t) {
  const made = await mkdtemp(join(tmpdir(), 'unripple-page-'));
  t.after(() => rm(made, { recursive: true, force: true }));
  return made;
}

/** What a command of the program answers as JSON. */
export async function answer(...args) {
  const { stdout } = await promisify(execFile)(program, [...args, '--json'], { maxBuffer: 64 << 20 });
  return JSON.parse(stdout);
}

/** What a program has told as JSON, once all of it has come. */
function whole(text) {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

/** A viewer that serves until the test ends; `url` is where, `said()` what it wrote on standard error. */
export async function serve(t, ...args) {
  const child = spawn(program, ['view', ...args, '--no-browser', '--json', ...(args.includes('--port') ? [] : ['--port', '0'])],
    { stdio: ['ignore', 'pipe', 'pipe'] });
  let said = '';
  child.stderr.setEncoding('utf8').on('data', (text) => {
    said += text;
  });
  const ended = new Promise((done) => child.once('exit', done));
  const kill = async (signal = 'SIGKILL') => {
    child.kill(signal);
    await ended;
  };
  t.after(() => kill());
  let out = '';
  let told = null;
  for await (const text of child.stdout.setEncoding('utf8')) {
    out += text;
    told = whole(out);
    if (told) break;
  }
  if (!told) throw new Error(`the program ended before it told its address: ${said}`);
  const { url } = told;
  return { url, port: Number(new URL(url).port), kill, signal: (name) => child.kill(name), said: () => said };
}
