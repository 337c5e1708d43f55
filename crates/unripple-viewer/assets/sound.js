// Hearing the surface. Off until asked for. In real time the chosen trace is streamed; in slow motion its last window is
// played once, at its true pitch. A measured drive can be heard too.

import { el, setOptions, setText } from './dom.js';

const AHEAD_S = 0.12;
const LOUDEST = 0.35;

/** Samples of a trace from `from_s` on; the frame's trace ends at its time. */
function part(frame, trace, from_s) {
  const { samples, span_s, time_s } = frame.head;
  const rate = samples / span_s;
  const fresh = Math.min(samples, Math.max(0, Math.round((time_s - from_s) * rate)));
  const values = trace.samples.subarray(samples - fresh);
  return { rate, values: Float32Array.from(values, (count) => count * trace.scale) };
}

/** Lets a part begin without a click. */
function fadeIn(values) {
  const ramp = Math.min(16, values.length >> 1);
  for (let i = 0; i < ramp; i += 1) values[i] *= i / ramp;
}

/** A player with a gain that follows the loudest sample and comes back slowly. */
class Player {
  #offset = null;
  #loud = 0;
  #heard = null;

  constructor() {
    this.context = new AudioContext();
    this.volume = this.context.createGain();
    this.volume.connect(this.context.destination);
    this.volume.gain.value = LOUDEST;
  }

  #level(values) {
    let most = 0;
    for (const value of values) most = Math.max(most, Math.abs(value));
    this.#loud = Math.max(most, this.#loud * 0.995);
    const gain = this.#loud > 0 ? 1 / this.#loud : 0;
    for (let i = 0; i < values.length; i += 1) values[i] *= gain;
  }

  #play(values, rate, when) {
    if (values.length < 2) return;
    // A Web Audio buffer takes 8 to 96 kHz; other rates are played faster or slower by as much.
    const taken = Math.min(96000, Math.max(8000, rate));
    const buffer = this.context.createBuffer(1, values.length, taken);
    buffer.copyToChannel(values, 0);
    const source = this.context.createBufferSource();
    source.buffer = buffer;
    source.playbackRate.value = rate / taken;
    source.connect(this.volume);
    source.start(when);
  }

  /** Streams what is new in a frame's trace. */
  stream(frame, trace) {
    const { time_s, span_s } = frame.head;
    const { currentTime } = this.context;
    const lost = this.#heard === null || time_s - this.#heard > 1 || time_s < this.#heard - 0.001;
    const from = lost ? time_s - span_s : Math.max(this.#heard, time_s - span_s);
    const { rate, values } = part(frame, trace, from);
    this.#heard = time_s;
    if (values.length < 2) return;
    this.#level(values);
    const when = this.#offset === null ? -1 : from + this.#offset;
    const adrift = when < currentTime || when > currentTime + 4 * AHEAD_S;
    if (adrift) this.#offset = currentTime + AHEAD_S - from;
    if (adrift || from === time_s - span_s) fadeIn(values);
    this.#play(values, rate, from + this.#offset);
  }

  /** Plays the whole of a frame's trace once. */
  once(frame, trace) {
    const { rate, values } = part(frame, trace, -Infinity);
    this.whole(values, rate);
  }

  /** Plays samples once, as loud as they can be. */
  whole(samples, rate) {
    const values = Float32Array.from(samples);
    this.#loud = 0;
    this.#level(values);
    fadeIn(values);
    this.#play(values, rate, this.context.currentTime + 0.03);
  }

  /** Plays a file's channels, mixed. */
  async file(asked) {
    const answer = await asked;
    if (!answer.ok) throw new Error('There is no measured drive yet: measure first.');
    const decoded = await this.context.decodeAudioData(await answer.arrayBuffer());
    const mixed = new Float32Array(decoded.length);
    for (let c = 0; c < decoded.numberOfChannels; c += 1) {
      decoded.getChannelData(c).forEach((value, i) => { mixed[i] += value; });
    }
    this.whole(mixed, decoded.sampleRate);
  }

  forget() {
    this.#heard = null;
    this.#offset = null;
  }
}

/** The controls, each calling one of `on`. */
function controls(root, on) {
  const button = (text, run, more = {}) => el('button', { type: 'button', class: 'button', text, ...more, on: { click: run } });
  const toggle = button('Hear it', on.toggle, { 'aria-pressed': 'false' });
  const source = el('select', { on: { change: on.another } });
  const volume = el('input', { type: 'range', min: '0', max: '1', step: '0.01', value: String(LOUDEST), on: { input: on.turn } });
  const told = el('p', { class: 'quiet' });
  const field = (text, control) => el('label', { class: 'field' }, el('span', { text }), control);
  root.append(
    el('h2', { text: 'Sound' }),
    el('div', { class: 'row' }, toggle, button('Play the last window', on.once),
      button('Play the measured motion', on.motion), button('Play the measured drive', on.drive)),
    el('div', { class: 'grid2' }, field('Place', source), field('Volume', volume)),
    told,
  );
  return { button: toggle, source, volume, told };
}

/** Sound, in the panel Touch. */
export function mount(root, app) {
  let player = null;
  let on = false;
  const ready = async () => {
    player ??= new Player();
    await player.context.resume();
    return player;
  };
  const { button, source, volume, told } = controls(root, {
    toggle, once: playOnce, motion: playMotion, drive: playDrive, turn: () => turn(), another: () => player?.forget(),
  });
  const live = () => {
    const settings = app.state.last('settings');
    return settings?.speed === 1 && !settings.paused;
  };
  const chosen = (frame) => frame?.traces.find((t) => t.name === source.value) ?? frame?.traces[0];
  const say = () => setText(told, !on ? 'Off. The motion of a place can be heard as it is.'
    : live() ? 'On: the motion of the chosen place, streamed.' : 'On in real time only; in slow motion play the last window.');
  const turn = () => {
    if (player) player.volume.gain.value = Number(volume.value) ** 2;
  };
  async function toggle() {
    on = !on;
    button.setAttribute('aria-pressed', String(on));
    say();
    if (on) await ready();
    else player?.forget();
    turn();
  }
  async function playOnce() {
    const frame = app.state.last('frame');
    const trace = chosen(frame);
    if (!trace) return void app.toast('There is no trace yet: press the surface or drop a probe.');
    await ready();
    turn();
    player.once(frame, trace);
  }
  async function playMotion() {
    const trace = app.state.last('measured')?.traces?.[0];
    if (!trace) return void app.toast('There is no measured motion yet: measure first.');
    await ready();
    turn();
    player.whole(trace.velocity_m_s, trace.rate);
  }
  async function playDrive() {
    try {
      await ready();
      turn();
      await player.file(app.line.ask('/drive.wav'));
    } catch (error) {
      app.toast(error.message, 'fault');
    }
  }
  app.state.subscribe('frame', (frame) => {
    if (frame.pane !== 0) return;
    const trace = chosen(frame);
    setOptions(source, trace ? frame.traces.map((t) => [t.name, t.name]) : [['', 'none yet']], trace?.name ?? '');
    if (on && trace && live()) player?.stream(frame, trace);
  });
  app.state.subscribe('settings', say);
}
