// Starts the page: state, link, stage, panels.

import { mount as mountCompare } from './compare.js';
import { Cost } from './cost.js';
import { mount as mountDesign } from './design.js';
import { el, setText } from './dom.js';
import { mount as mountExport } from './export.js';
import { announce, copy, toast } from './faults.js';
import { Foci } from './foci.js';
import { parseFrame } from './frame.js';
import { Intro } from './intro.js';
import { mount as mountJobs } from './jobs.js';
import { mount as mountKeys } from './keys.js';
import { line } from './line.js';
import { Link } from './link.js';
import { mount as mountMeasured } from './measured.js';
import { Playout } from './playout.js';
import { mount as mountReadout, mountFoot } from './readout.js';
import { Recall } from './recall.js';
import { mount as mountSettings } from './settings.js';
import { mount as mountSound } from './sound.js';
import { Stage } from './stage.js';
import { createState } from './state.js';
import { mount as mountStories } from './stories.js';
import { Tabs } from './tabs.js';
import { startTheme } from './theme.js';
import { Timeline } from './timeline.js';
import { Touch } from './touch.js';
import { mount as mountTraces } from './traces.js';
import { Transport } from './transport.js';

const state = createState((kind, error) => toast(`A part of the page failed at “${kind}”: ${error.message}`, 'fault'));
const cost = new Cost();
const recall = new Recall(state);
const tabs = new Tabs(state);
/** Files are fetched, and comparisons shown to all pages, by these numbers: no two should give the same. */
let ids = Math.floor(Math.random() * 2 ** 48);
/** A request about the surface names the edit of it that is shown here. */
const ABOUT = new Set(['measure', 'compare']);
const about = (message) => (ABOUT.has(message.do) ? { ...message, edit: state.last('surface')?.edit } : message);

/** What the address asks of the introduction: '0' for none, '1' for it even in a frame. */
const introduction = new URLSearchParams(location.search).get('intro');

const app = {
  state,
  // A page that is opened to be measured or photographed does nothing of its own accord, and neither does one within another page.
  atRest: introduction === '0' || (introduction !== '1' && window.self !== window.top),
  line,
  toast,
  announce,
  copy,
  nextId: () => (ids += 1),
  shown: () => tabs.shown,
  show: (name) => tabs.show(name),
  onShow: (name, fn) => state.subscribe('tab', (tab) => tab.name === name && fn()),
  link: {
    send: (message) => link.send(about(message)),
    get open() {
      return link.open;
    },
  },
};
const stage = new Stage(app, cost);
app.map = stage;
app.playout = new Playout(app, stage);
const touch = new Touch(app, stage);
const transport = new Transport(app);
app.timeline = new Timeline(app, new Foci(state), transport);

/** Fills a panel; a fault in one leaves the others whole. */
function fill(name, mount, root, ...more) {
  try {
    mount(root, app, ...more);
  } catch (error) {
    console.error(`${name}:`, error);
    toast(`The part ${name} could not start: ${error.message}`, 'fault');
  }
}

function fillTouch() {
  const root = document.getElementById('panel-touch');
  const part = (name, mount, ...more) => {
    const box = el('div', { class: 'stack' });
    root.append(box);
    fill(name, mount, box, ...more);
  };
  part('Settings', mountSettings);
  part('Motion', mountTraces);
  fill('Read-out', mountReadout, root);
  part('Measure', mountMeasured);
  part('Sound', mountSound);
  part('Files', mountExport, stage);
  part('Keys', mountKeys);
  mountFoot(app, cost);
}

/** How time passes comes in messages of its own; panels read it together with how the surface is played. */
const START = { speed: 1, paused: false, quantity: 'displacement', gain_db: 0, probes: [] };
let passing = {};

function takeText(message) {
  if (message.is === 'transport') {
    const { is, ...rest } = message;
    passing = { ...passing, ...rest };
    const settings = state.last('settings');
    if (settings) state.publish('settings', { ...settings, ...passing });
    return;
  }
  state.publish(message.is, message.is === 'settings' ? { ...START, ...message, ...passing } : message);
}

/** Faults of frames are reported once, not sixty times a second. */
let frameFault = '';

function takeFrame(buffer) {
  const started = performance.now();
  try {
    const frame = parseFrame(buffer);
    stage.take(frame);
    if (!document.hidden) link.seen(frame.head.frame);
  } catch (error) {
    if (error.message === frameFault) return;
    frameFault = error.message;
    console.error(error);
    toast(`A picture could not be read: ${error.message}.`, 'fault');
  }
  cost.parsed(performance.now() - started);
}

state.subscribe('fault', ({ text }) => toast(text, 'fault'));
state.subscribe('notice', ({ text }) => text && toast(text));
state.subscribe('surface', ({ name }) => {
  setText(document.getElementById('surface-name'), name);
  document.title = `${name} – Unripple`;
});
state.subscribe('connection', ({ open, text }) => {
  const chip = document.getElementById('connection');
  chip.dataset.state = open ? 'good' : 'bad';
  setText(chip, text);
});

startTheme(state);
const link = new Link({
  text: takeText,
  frame: takeFrame,
  change: (connection) => state.publish('connection', connection),
  refused: (message) => message.do !== 'touch' && toast('Not connected: nothing was sent.', 'fault'),
  sent: (message) => recall.sent(message),
});
fillTouch();
fill('Design', mountDesign, document.getElementById('panel-design'));
fill('Compare', mountCompare, document.getElementById('panel-compare'));
fill('Stories', mountStories, document.getElementById('panel-stories'));
fill('Rig', mountJobs, document.getElementById('panel-rig'));

app.intro = new Intro(app, stage);

window.unripple = { state, map: stage, cost, touch, transport };
