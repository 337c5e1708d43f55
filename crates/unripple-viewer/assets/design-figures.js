// The figures of a design, each beside what it was before the last edit.

import { el, clear } from './dom.js';
import { why } from './why.js';
import { number } from './units.js';

/** Headline and table of a `design` message; `before` is the message that held when the last edit began. */
export class DesignFigures {
  constructor() {
    this.headline = el('div', { class: 'headline card' });
    this.told = el('p', { class: 'seen-not', role: 'status' });
    this.body = el('tbody', {});
    this.beforeHead = el('th', { scope: 'col' }, 'before');
    this.table = el('table', { class: 'figures compared' },
      el('caption', { class: 'seen-not' }, 'Results of the design'),
      el('thead', {}, el('tr', {}, el('th', { scope: 'col' }, 'Figure'), this.beforeHead, el('th', { scope: 'col' }, 'now'))),
      this.body);
    this.busy = el('p', { class: 'quiet', hidden: true }, 'Computing the rest…');
    this.table.hidden = true;
    this.headline.append(el('p', { class: 'quiet' }, 'Results appear as soon as the surface is computed.'));
  }

  show(now, before) {
    const figures = now.figures ?? [];
    const old = new Map((before?.figures ?? []).map((figure) => [figure.key, figure]));
    this.table.hidden = !figures.length;
    this.table.classList.toggle('has-before', old.size > 0);
    this.beforeHead.hidden = !old.size;
    this.busy.hidden = now.done !== false;
    clear(this.body);
    for (const figure of figures) {
      const was = old.get(figure.key);
      const changed = was && told(was) !== told(figure);
      this.body.append(el('tr', { class: changed ? 'is-changed' : '' },
        el('th', { scope: 'row' }, figure.label ?? figure.key, why(figure.key, figure.label ?? figure.key)),
        old.size ? el('td', { class: 'was' }, changed ? told(was) : was ? '=' : '–') : null,
        el('td', {}, told(figure))));
    }
    this.head(now, before);
  }

  head(now, before) {
    const act = now.act ?? {};
    const rows = [
      ['contrast', act.at_mm ? `Contrast at ${act.at_mm.map((value) => Math.round(value)).join(', ')} mm` : 'Contrast', act.contrast, before?.act?.contrast],
      ['background_contrast', 'Background contrast', act.background_contrast, before?.act?.background_contrast],
    ].filter(([, , value]) => Number.isFinite(value));
    clear(this.headline);
    for (const [key, label, value, was] of rows) {
      this.headline.append(el('div', { class: 'headline-figure' },
        el('span', { class: 'quiet' }, label, why(key, label)),
        el('strong', {}, Number.isFinite(was) ? `${number(was)} → ${number(value)}` : number(value)),
        change(was, value)));
    }
    if (!rows.length) this.headline.append(el('p', { class: 'quiet' }, 'No focus computed yet.'));
    if (now.done !== false && rows.length) {
      const [, label, value, was] = rows[0];
      this.told.textContent = Number.isFinite(was) ? `${label}: ${number(was)} before, ${number(value)} now` : `${label}: ${number(value)}`;
    }
  }
}

function told(figure) {
  if (figure.text !== undefined && figure.text !== null) {
    return figure.unit && !String(figure.text).endsWith(figure.unit) ? `${figure.text} ${figure.unit}` : String(figure.text);
  }
  return `${number(figure.value)} ${figure.unit ?? ''}`.trim();
}

function change(was, value) {
  if (!Number.isFinite(was) || was === 0) return null;
  const percent = (value / was - 1) * 100;
  if (Math.abs(percent) < 0.5) return el('span', { class: 'chip' }, 'as before');
  const up = percent > 0;
  return el('span', { class: `chip ${up ? 'is-better' : 'is-worse'}` }, `${up ? '▲ +' : '▼ −'}${Math.abs(percent).toFixed(Math.abs(percent) < 10 ? 1 : 0)} %`);
}
