// Surfaces that come to the page: in its link, and as files dropped onto it; and the link to the surface that is shown.

import { fromHash, holdsSurface, toHash } from './design-link.js';
import { el, setText } from './dom.js';

/** Characters of a link from which on some programs for mail and chat cut it. */
const OFTEN_CUT = 2000;

/** The address of this page without its token, which is not for whoever gets the link, and without what it was opened with. */
const plain = () => `${location.origin}${location.pathname}`;

/** A button that copies a link to the surface that is shown, and the link for copying by hand. */
export class CopyLink {
  constructor(app) {
    this.app = app;
    this.button = el('button', { type: 'button', class: 'button', on: { click: () => this.copy() } }, 'Copy link');
    this.text = el('input', { type: 'text', readonly: true, 'aria-label': 'Link to this surface', on: { focus: () => this.text.select() } });
    this.note = el('p', { class: 'quiet' });
    this.node = el('div', { class: 'stack', hidden: true }, this.text, this.note);
  }

  /** Offers the link of a surface; measured responses are no surface file. */
  show({ toml, library }) {
    if (toml !== this.toml) this.node.hidden = true;
    this.toml = library ? null : toml;
    this.button.disabled = typeof this.toml !== 'string';
  }

  async copy() {
    const link = `${plain()}${await toHash(this.toml)}`;
    this.text.value = link;
    const often = link.length > OFTEN_CUT ? ' Some programs for mail and chat cut links this long.' : '';
    setText(this.note, `The link holds the whole surface, in ${link.length} characters.${often}`);
    this.node.hidden = false;
    await this.app.copy(link);
  }
}

/** Opens the surface in the page's link, now and whenever another link is typed. `put(text, name)` sends it, `refuse(why)` says why not. */
export class OpenLink {
  #busy = false;

  constructor(app, { put, refuse }) {
    this.app = app;
    this.put = put;
    this.refuse = refuse;
    addEventListener('hashchange', () => this.look());
    app.state.subscribe('surface', () => this.look());
  }

  async look() {
    const { hash } = location;
    // The first surface says that the session hears this page.
    if (this.#busy || !holdsSurface(hash) || !this.app.state.last('surface')) return;
    this.#busy = true;
    // A reload must not undo what is edited afterwards.
    history.replaceState(history.state, '', `${location.pathname}${location.search}`);
    try {
      const text = await fromHash(hash);
      if (this.app.state.last('settings')?.device?.real) this.#ask(text);
      else await this.put(text, 'The surface in the link');
    } catch (error) {
      this.refuse(`The surface in the link was not opened: ${error.message}.`);
    } finally {
      this.#busy = false;
    }
  }

  /** A link may come from anybody: what moves a real surface is asked for. */
  #ask(text) {
    this.app.toast('A link wants to open its surface on the real device.', 'notice', {
      text: 'Open it', run: () => this.put(text, 'The surface in the link'),
    });
  }
}

const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes('Files');

/** Takes files dropped anywhere on the page, one at a time. `take(file)` opens one, `refuse(why)` says why not. */
export function takeDrops({ take, refuse }) {
  const note = document.getElementById('drop');
  const over = (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = 'copy';
    note.hidden = false;
  };
  addEventListener('dragenter', over);
  addEventListener('dragover', over);
  addEventListener('dragleave', (event) => {
    // Between elements of the page there is a next one.
    if (event.relatedTarget === null) note.hidden = true;
  });
  addEventListener('drop', (event) => {
    note.hidden = true;
    if (!hasFiles(event)) return;
    event.preventDefault();
    const { files } = event.dataTransfer;
    if (files.length === 1) take(files[0]);
    else refuse(`Expected one surface file, found ${files.length} files.`);
  });
}
