// After figure 2a of the paper: one actuator in a reverberant cavity.

const AT = [62, 90];
const PULSES = { method: 'time-reversal', effect: 'pulses', rate_hz: 5, window_ms: null, quantity: 'displacement' };
const ONE = { actuators: 1 };
const LONG = { decay_time_ms: 300 };
const SHORT_MS = 5;

/** The story. */
export const oneActuator = {
  id: 'one-actuator',
  title: 'One actuator is enough',
  about: 'Echoes from the rim stand in for actuators that are not there (figure 2a of the paper).',
  edits: true,
  steps: [
    {
      heading: 'All the actuators',
      scene: { surface: 'hudin-2012', settings: PULSES, fingers: [AT] },
      measure: [{ name: 'all', at: [AT] }],
      text: (f) => [
        `A finger rests on the surface. ${f.surface.actuators?.length ?? '…'} actuators at the rim send waves that meet under it, again and again.`,
        'How well they meet is the contrast: the height of the focus over the ripple everywhere else, at that instant.',
      ],
      figures: (f) => [['Contrast', f.n(f.target('all').contrast)]],
    },
    {
      heading: 'All but one switched off',
      scene: { surface: 'hudin-2012', edits: [ONE], settings: PULSES, fingers: [AT] },
      measure: [{ name: 'one', at: [AT] }],
      text: (f) => [
        `Now ${f.surface.actuators?.length === 1 ? 'one actuator is left' : 'only one is to be left'}, at one place of the rim. The waves still meet under the finger.`,
        `The contrast is less, but far from gone: ${f.n(f.target('one').contrast)} where it was ${f.n(f.target('all').contrast)}.`,
      ],
      figures: (f) => [['Contrast, all', f.n(f.target('all').contrast)], ['Contrast, one', f.n(f.target('one').contrast)]],
    },
    {
      heading: 'Where the focus comes from',
      scene: { surface: 'hudin-2012', edits: [ONE], settings: PULSES, fingers: [AT] },
      show: { at: 'before', run: true },
      control: 'scrub',
      text: (f) => [
        'The picture now runs slowly up to the focus. Waves leave the one actuator, strike the rims and come back from all sides.',
        `The actuator has been sending for ${f.s(f.window('one'))}, so that the echoes of what it sent first and the waves it sends last arrive together.`,
        'Drag the slider to look at any moment.',
      ],
    },
    {
      heading: 'Without time for echoes',
      scene: { surface: 'hudin-2012', edits: [ONE], settings: { ...PULSES, window_ms: SHORT_MS }, fingers: [AT] },
      measure: [{ name: 'short', at: [AT], window_ms: SHORT_MS }],
      text: (f) => [
        `Here the actuator may send for ${f.s(f.window('short'))} only: waves cross the sheet once or twice, and few echoes take part.`,
        `The contrast is ${f.n(f.target('short').contrast)}; with ${f.s(f.window('one'))} it was ${f.n(f.target('one').contrast)}. The difference is what reverberation gives.`,
      ],
      figures: (f) => [[`Contrast, ${f.s(f.window('short'))}`, f.n(f.target('short').contrast)], [`Contrast, ${f.s(f.window('one'))}`, f.n(f.target('one').contrast)]],
    },
    {
      heading: 'A sheet that rings for long',
      scene: { surface: 'hudin-2012', edits: [ONE, LONG], settings: PULSES, fingers: [AT] },
      measure: [{ name: 'long', at: [AT] }],
      text: (f) => [
        `The sheet now rings down in ${f.set(f.surface.values?.decay_time_ms)} ms. One actuator gathers echoes for ${f.s(f.window('long'))} and reaches a contrast of ${f.n(f.target('long').contrast)}.`,
        'The price is a long tail: between two pulses the sheet no longer comes to rest, as figure 2a shows. Watch the trace of the finger.',
      ],
      figures: (f) => [['Contrast, as it was', f.n(f.target('one').contrast)], ['Contrast, ringing', f.n(f.target('long').contrast)]],
    },
    {
      heading: 'Back to all of them',
      scene: { surface: 'hudin-2012', settings: PULSES, fingers: [AT] },
      text: (f) => [
        `All the actuators are back, with ${f.times(f.target('one').contrast, f.target('all').contrast)} the contrast of one.`,
        'Contrast grows with the square root of their number, as long as they are few. One is enough to focus; more give a better contrast.',
      ],
      figures: (f) => [
        [`One, ${f.s(f.window('short'))}`, f.n(f.target('short').contrast)],
        ['One', f.n(f.target('one').contrast)],
        ['One, ringing', f.n(f.target('long').contrast)],
        ['All', f.n(f.target('all').contrast)],
      ],
    },
  ],
};
