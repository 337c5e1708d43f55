// The surface as a file: built-in ones to open, one's own to load, the present one to save.

import { el, clear, setText } from './dom.js';
import { LARGEST } from './design-link.js';
import { changedHere } from './recall.js';
import { CopyLink, OpenLink, takeDrops } from './share.js';

const BUILT_IN = [
  ['hudin-2012', 'hudin-2012: the film of the paper'],
  ['drum', 'drum: the film on a round frame'],
  ['glass-plate', 'glass-plate: the glass of a touch screen'],
  ['picture-frame', 'picture-frame: one to build at home'],
  ['stadium-film', 'stadium-film: the film cut as a stadium'],
];

/** Open, load, save and share, with undo and redo of every edit. */
export class SurfaceFile {
  constructor(app, edits) {
    this.app = app;
    this.edits = edits;
    this.undoButton = el('button', { type: 'button', class: 'button', title: 'Ctrl+Z', on: { click: () => this.step('undo') } }, '↶ Undo');
    this.redoButton = el('button', { type: 'button', class: 'button', title: 'Ctrl+Shift+Z', on: { click: () => this.step('redo') } }, '↷ Redo');
    this.open = el('select', { on: { change: () => this.opened() } });
    this.save = el('a', { class: 'button', href: app.line.address('/surface.toml'), download: 'surface.toml' }, 'Save as TOML');
    this.input = el('input', { type: 'file', class: 'seen-not', accept: '.toml,text/plain', on: { change: () => this.chosen() } });
    this.link = new CopyLink(app);
    this.faults = el('div', { class: 'faults', role: 'alert', hidden: true });
    this.source = el('p', { class: 'quiet' });
    this.surface = null;
    this.modes = null;
    this.node = el('div', { class: 'stack' },
      el('div', { class: 'row' }, this.undoButton, this.redoButton, this.save,
        el('label', { class: 'button file-button' }, 'Load a file…', this.input), this.link.button),
      this.link.node,
      el('label', { class: 'field' }, el('span', {}, 'Open a built-in surface'), this.open),
      this.source, this.faults);
    document.addEventListener('keydown', (event) => this.shortcut(event));
    takeDrops({ take: (file) => this.dropped(file), refuse: (why) => this.refuse(why) });
    this.opener = new OpenLink(app, { put: (text, name) => this.put(text, name), refuse: (why) => this.refuse(why) });
    app.state.subscribe('settings', ({ modes }) => {
      this.modes = modes ?? null;
      this.tell();
    });
  }

  show(surface) {
    this.surface = surface;
    this.link.show(surface);
    this.undoButton.disabled = !surface.can_undo;
    this.redoButton.disabled = !surface.can_redo;
    const known = BUILT_IN.some(([name]) => name === surface.source);
    clear(this.open);
    if (!known) this.open.append(el('option', { value: '', disabled: true }, surface.source ?? surface.name));
    this.open.append(...BUILT_IN.map(([name, text]) => el('option', { value: name }, text)));
    this.open.value = known ? surface.source : '';
    this.tell();
    this.save.setAttribute('download', `${String(surface.name).replace(/[^\w.-]+/g, '-') || 'surface'}.toml`);
  }

  tell() {
    if (!this.surface) return;
    const { name, can_undo: edited } = this.surface;
    const modes = this.modes === null ? '' : `: ${this.modes} modes in the band`;
    setText(this.source, `${name}${edited ? ', edited' : ''}${modes}`);
  }

  step(which) {
    this.edits.finish();
    this.edits.begin();
    this.app.link.send({ do: which });
  }

  opened() {
    if (!this.open.value) return;
    this.edits.finish();
    this.edits.begin();
    this.complain(null);
    this.app.link.send({ do: 'open', name: this.open.value });
  }

  shortcut(event) {
    if (this.app.shown() !== 'design' || !(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    const which = key === 'z' ? (event.shiftKey ? 'redo' : 'undo') : key === 'y' ? 'redo' : null;
    if (!which || writes(event.target)) return;
    event.preventDefault();
    const button = which === 'undo' ? this.undoButton : this.redoButton;
    if (!button.disabled) this.step(which);
  }

  chosen() {
    const [file] = this.input.files;
    this.input.value = '';
    if (file) this.take(file);
  }

  dropped(file) {
    this.app.show('design');
    this.take(file);
  }

  /** Reads a surface file and opens what it says. */
  async take(file) {
    if (file.size > LARGEST) {
      this.complain(`${file.name} has ${Math.ceil(file.size / 1024)} KiB, at most ${LARGEST / 1024} are taken`);
      return;
    }
    let text = '';
    try {
      text = await file.text();
    } catch {
      this.complain(`${file.name} cannot be read: expected a surface file. Is it a folder?`);
      return;
    }
    await this.put(text, file.name);
  }

  /** Opens the surface of a text, which is called by a name. */
  async put(text, name) {
    this.edits.finish();
    this.edits.begin();
    changedHere();
    try {
      const answer = await this.app.line.ask('/surface', { method: 'POST', headers: { 'content-type': 'application/toml' }, body: text });
      if (answer.ok) {
        changedHere();
        this.complain(null);
        this.app.toast(`${name} is loaded`);
        return;
      }
      const said = await answer.json().catch(() => null);
      this.app.show('design');
      this.complain(said?.text ?? `the server refused it (${answer.status})`, text, name);
    } catch (error) {
      this.app.show('design');
      this.complain(`no answer from the server: ${error.message}`);
    }
  }

  /** Says why something that came to the page is not taken. */
  refuse(why) {
    this.app.show('design');
    this.complain(why);
  }

  complain(text, source = '', name = '') {
    clear(this.faults);
    this.faults.hidden = !text;
    if (!text) return;
    this.faults.append(
      el('strong', {}, name ? `${name} was not accepted` : 'Not taken'),
      el('pre', { class: 'mono', tabindex: '0', 'aria-label': 'What is wrong with the file' }, text));
    const lines = source && !text.includes('│') ? cited(text, source) : [];
    if (lines.length) {
      this.faults.append(el('ol', { class: 'cited mono' }, ...lines.map(([line, content]) => el('li', { value: line }, content))));
    }
    this.faults.append(el('button', { type: 'button', class: 'button small', on: { click: () => this.complain(null) } }, 'Close'));
    this.faults.scrollIntoView({ block: 'center' });
  }
}

// The lines of a file that its faults speak of, as [number, text].
function cited(text, source) {
  const lines = source.split('\n');
  const numbers = [...text.matchAll(/(?:line |:)(\d+)(?::\d+)?/g)].map((match) => Number(match[1]));
  const known = [...new Set(numbers)].filter((line) => line >= 1 && line <= lines.length);
  return known.sort((a, b) => a - b).slice(0, 20).map((line) => [line, lines[line - 1]]);
}

// Whether Ctrl+Z in this element undoes typing.
function writes(target) {
  if (!(target instanceof Element)) return false;
  if (target.closest('textarea, [contenteditable]')) return true;
  const input = target.closest('input');
  return Boolean(input) && !['range', 'checkbox', 'radio', 'file', 'button'].includes(input.type);
}
