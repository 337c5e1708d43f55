// The keys, for those who look for them.

import { el } from './dom.js';

const KEYS = [
  [['Arrows'], 'move the cursor by 1 mm; with Shift by 10 mm'],
  [['Space'], 'press while held'],
  [['Enter'], 'press and hold until Enter again'],
  [['P'], 'drop a probe at the cursor'],
  [['K'], 'pause or play'],
  [[',', '.'], 'one stored sample back or forward; with Shift 10'],
  [['J', 'L'], 'to the previous or the next focus'],
  [['[', ']'], 'half or twice the speed'],
  [['N'], 'back to now'],
  [['Arrows', '+', '−', '0'], 'in the relief: turn, zoom, start view'],
];

/** A folded table of the keys that work while the stage has the focus. */
export function mount(root) {
  root.append(el('details', {}, el('summary', { text: 'Keys on the stage' }), el('table', { class: 'figures' },
    KEYS.map(([keys, what]) => el('tr', {},
      el('th', { scope: 'row' }, keys.flatMap((key) => [el('kbd', { text: key }), ' '])), el('td', { text: what }))))));
}
