// The design panel: the surface as it is, what may be changed, and what each change does to its figures.

import { el } from './dom.js';
import { Edits } from './edits.js';
import { SurfaceForm } from './surface-form.js';
import { ActuatorPlaces } from './actuator-places.js';
import { DesignFigures } from './design-figures.js';
import { ContrastMap } from './contrast-map.js';
import { SurfaceFile } from './surface-file.js';

/** Fills `root` with the design panel. */
export function mount(root, app) {
  const edits = new Edits(app);
  const file = new SurfaceFile(app, edits);
  const form = new SurfaceForm(edits);
  const figures = new DesignFigures();
  const map = new ContrastMap(app);
  const places = new ActuatorPlaces(app, edits);
  root.append(el('div', { class: 'panel-parts' },
    figures.headline, figures.told,
    section('Surface', file.node),
    section('Contrast, place by place', map.node),
    section('Sheet', form.node),
    section('Places of the actuators', places.node),
    section('Figures', figures.busy, figures.table)));
  follow(app, { edits, file, form, places, figures, map });
}

function follow(app, { edits, file, form, places, figures, map }) {
  let now = null;
  let before = null;
  let drawn = null;
  let newest = -Infinity;
  edits.onBegin(() => {
    before = now;
  });
  const show = (surface) => {
    file.show(surface);
    form.show(surface);
    places.show(surface);
  };
  app.state.subscribe('surface', (surface) => {
    show(surface);
    // A map of another shape would be clipped into this one.
    const same = drawn && shape(drawn) === shape(surface);
    drawn = surface;
    if (now && !same) now = { ...now, map: null };
    map.show(now?.map, surface);
  });
  app.state.subscribe('connection', () => {
    newest = -Infinity;
  });
  app.state.subscribe('design', (design) => {
    if (design.edit < newest) return;
    newest = design.edit ?? newest;
    now = design.map || !now?.map ? design : { ...design, map: now.map };
    figures.show(now, before);
    map.show(now.map, app.state.last('surface'));
  });
  // What was refused is put back to what holds.
  app.state.subscribe('fault', () => {
    const surface = app.state.last('surface');
    if (surface && app.shown() === 'design' && edits.idle) show(surface);
  });
}

/** What tells one outline from another. */
const shape = ({ extent_mm, rings_mm }) => JSON.stringify([extent_mm, rings_mm]);

function section(title, ...content) {
  return el('section', { class: 'card stack' }, el('h2', {}, title), ...content);
}
