// After figure 4 of the paper: two foci, each with its own rhythm.

const E = [62, 90];
const D = [100, 48];
const FAST = { method: 'time-reversal', effect: 'pulses', rate_hz: 5, window_ms: null, quantity: 'displacement' };
const SLOW = { at: D, hz: 2, hold_ms: 120 };

/** The story. */
export const twoFingers = {
  id: 'two-fingers',
  title: 'Two fingers, two rhythms',
  about: 'Two places of one sheet, each with pulses of its own (figure 4 of the paper).',
  steps: [
    {
      heading: 'One finger',
      scene: { surface: 'hudin-2012', settings: FAST, fingers: [E] },
      measure: [{ name: 'first', at: [E] }],
      text: (f) => [
        `A finger at ${E.join(', ')} mm feels ${f.set(f.settings.rate_hz)} pulses a second. In the paper this is point E.`,
        `Alone it has a contrast of ${f.n(f.target('first').contrast)}.`,
      ],
      figures: (f) => [['Contrast, alone', f.n(f.target('first').contrast)]],
    },
    {
      heading: 'A second one, slower',
      scene: { surface: 'hudin-2012', settings: FAST, fingers: [E], beats: [SLOW] },
      measure: [{ name: 'second', at: [D] }],
      text: (f) => [
        `The story now taps at ${D.join(', ')} mm as well, ${SLOW.hz} times a second: point D of the paper. The first finger keeps its own ${f.set(f.settings.rate_hz)}.`,
        'Both use the same actuators at the same time. Waves pass through each other unchanged, so what is sent for one is simply added to what is sent for the other.',
      ],
      figures: (f) => [['Contrast at E, alone', f.n(f.target('first').contrast)], ['Contrast at D, alone', f.n(f.target('second').contrast)]],
    },
    {
      heading: 'When both strike at once',
      scene: { surface: 'hudin-2012', settings: FAST, fingers: [E, D] },
      measure: [{ name: 'both', at: [E, D] }],
      text: (f) => [
        'The hardest case: both pulses at the same instant. Each focus lies in the ripple of the other, and both share what the actuators give.',
        `Measured together: ${f.n(f.target('both', 0).contrast)} at E and ${f.n(f.target('both', 1).contrast)} at D, where E alone had ${f.n(f.target('first').contrast)}.`,
      ],
      figures: (f) => [
        ['Contrast at E, together', f.n(f.target('both', 0).contrast)],
        ['Contrast at D, together', f.n(f.target('both', 1).contrast)],
        ['Contrast at E alone, over √2', f.n(f.target('first').contrast / Math.SQRT2)],
      ],
    },
    {
      heading: 'Both foci, stopped',
      scene: { surface: 'hudin-2012', settings: FAST, fingers: [E, D] },
      show: { at: 'focus' },
      control: 'scrub',
      text: (f) => [
        'Time stands still at the instant of both foci. Each is about seven tenths of the shortest wavelength wide, and no wider for being one of two.',
        `The focus at E is ${f.m(f.target('both', 0).spot_diameter_m)} wide. Drag the slider to see both grow out of the same ripple.`,
      ],
    },
    {
      heading: 'Two rhythms again',
      scene: { surface: 'hudin-2012', settings: FAST, fingers: [E], beats: [SLOW] },
      text: () => [
        'Most of the time the two rhythms miss each other, and each pulse is as clean as if it were alone.',
        'Two more fingers, a palm or a shape are no different: every place adds its own waves, and some ripple to all others.',
      ],
    },
  ],
};
