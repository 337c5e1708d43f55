// What the page has to say: toasts that go by themselves, faults that stay until they are read, and the reader's line.

import { el } from './dom.js';

const MOST = 4;

/** Shows a message; `action` is {text, run}. Returns how to take it away. */
export function toast(text, kind = 'notice', action = null) {
  const box = document.getElementById('toasts');
  const same = [...box.children].find((node) => node.dataset.text === text);
  same?.remove();
  const note = el('div', { class: 'toast', role: kind === 'fault' ? 'alert' : 'status', dataset: { kind, text } });
  const close = () => note.remove();
  note.append(el('p', { text }));
  if (action) {
    const run = () => {
      close();
      action.run();
    };
    note.append(el('button', { type: 'button', class: 'button small primary', text: action.text, on: { click: run } }));
  }
  const shut = { type: 'button', class: 'button small', 'aria-label': 'Close this message', text: '×', on: { click: close } };
  note.append(el('button', shut));
  box.append(note);
  while (box.children.length > MOST) box.firstChild.remove();
  if (!action) setTimeout(close, kind === 'fault' ? 15000 : 5000);
  return close;
}

/** Says something to a screen reader only. */
export function announce(text) {
  document.getElementById('announcer').textContent = text;
}

/** Copies text, and says so. */
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    toast('Copied.');
  } catch {
    toast('The browser does not allow copying here. Select the text and copy it by hand.', 'fault');
  }
}
