// The stories panel: the list of stories, and the one that is running.

import { el } from './dom.js';
import { again } from './intro.js';
import { StoryPlayer } from './story-player.js';
import { oneActuator } from './story-one-actuator.js';
import { paper } from './why.js';
import { twoFingers } from './story-two-fingers.js';
import { backwards } from './story-backwards.js';
import { better } from './story-better.js';

const STORIES = [oneActuator, twoFingers, backwards, better];

/** Fills `root` with the stories panel. */
export function mount(root, app) {
  const entries = new Map();
  const list = el('section', { class: 'stack' },
    el('p', { class: 'quiet' }, 'Each story shows something on the surface itself, step by step, and puts everything back when it is left.'),
    el('div', { class: 'row' }, again(app)), paper());
  const player = new StoryPlayer(app, (story) => {
    list.hidden = false;
    entries.get(story.id)?.button.focus({ preventScroll: true });
  });
  for (const story of STORIES) {
    const why = el('p', { class: 'quiet', hidden: true });
    const button = el('button', {
      type: 'button', class: 'button',
      on: {
        click: () => {
          list.hidden = true;
          player.start(story);
        },
      },
    }, 'Begin', el('span', { class: 'seen-not' }, `: ${story.title}`));
    entries.set(story.id, { story, button, why });
    list.append(el('article', { class: 'card stack' },
      el('h2', {}, story.title), el('p', {}, story.about), why,
      el('div', { class: 'row' }, button, el('span', { class: 'quiet' }, `${story.steps.length} steps`))));
  }
  root.append(el('div', { class: 'panel-parts' }, list, player.node));
  const judge = () => entries.forEach((entry) => allow(entry, app));
  app.state.subscribe('surface', judge);
  app.state.subscribe('connection', judge);
  judge();
}

// A story that changes the surface could not give measured responses back.
function allow({ story, button, why }, app) {
  const surface = app.state.last('surface');
  const measured = Boolean(surface?.library) && (story.model || story.steps.some(({ scene }) => scene.surface));
  button.disabled = !surface || measured;
  why.hidden = !measured;
  why.textContent = measured ? 'Needs a surface with a model: these responses were measured.' : '';
}
