// Time reversal beside the inverse.

const AT = [62, 90];
const METHODS = ['time-reversal', 'inverse'];
const PULSES = { method: 'time-reversal', effect: 'pulses', rate_hz: 5, window_ms: null, quantity: 'velocity' };
const PAIR = { at: [AT], methods: METHODS };

const contrasts = (f) => [
  ['Contrast, time reversal', f.n(f.paneTarget(0).contrast)],
  ['Contrast, inverse', f.n(f.paneTarget(1).contrast)],
];

// Energy for the same velocity of the peak, the first method's being 1.
function cost(f) {
  const [a, b] = [0, 1].map((i) => f.pane(i).drive?.energy / f.paneTarget(i).peak_velocity_m_s ** 2);
  return b / a;
}

/** The story. */
export const better = {
  id: 'better',
  title: 'Better than time reversal',
  about: 'The inverse knows the modes of the sheet and cancels ripple that time reversal leaves.',
  model: true,
  steps: [
    {
      heading: 'Time reversal',
      scene: { settings: PULSES, fingers: [AT] },
      measure: [{ name: 'reversal', at: [AT] }],
      text: (f) => [
        `Time reversal is simple: it plays recorded responses backwards. It gives the highest peak for the energy, and here a contrast of ${f.n(f.target('reversal').contrast)}.`,
        'It does nothing about the waves elsewhere: they nearly cancel there only because their phases are random.',
      ],
      figures: (f) => [['Contrast', f.n(f.target('reversal').contrast)]],
    },
    {
      heading: 'Beside it, the inverse',
      scene: { compare: PAIR, settings: PULSES },
      show: { at: 'focus' },
      text: (f) => [
        'Left or above time reversal, right or below the inverse: for the same place, each as strong as linear theory and the actuators allow, at the instant of the focus.',
        `The inverse asks for a field that is a point and nothing else. Of all drives that come near it takes the one of least energy. Its contrast is ${f.n(f.paneTarget(1).contrast)}: ${f.times(f.paneTarget(0).contrast, f.paneTarget(1).contrast)} that of time reversal.`,
      ],
      figures: contrasts,
    },
    {
      heading: 'Look around the instant',
      scene: { compare: PAIR, settings: PULSES },
      show: { at: 'focus', run: [-0.05, 0.05] },
      control: 'scrub',
      text: () => [
        'Both are now shown slowly through the focus. The stillness around the inverse’s peak lasts for an instant only: before and after, the wave that makes the focus must be somewhere.',
        'Drag the slider to find the moment when it is most still.',
      ],
    },
    {
      heading: 'What it costs',
      scene: { compare: PAIR, settings: PULSES },
      show: { at: 'focus' },
      text: (f) => [
        `Both move the sheet by no more than half its thickness: the inverse’s peak is ${f.v(f.paneTarget(1).peak_velocity_m_s)} where time reversal has ${f.v(f.paneTarget(0).peak_velocity_m_s)}.`,
        `For the same peak it takes ${f.n(cost(f), 2)} times the energy.`,
      ],
      figures: (f) => [
        ['Peak velocity, time reversal', f.v(f.paneTarget(0).peak_velocity_m_s)],
        ['Peak velocity, inverse', f.v(f.paneTarget(1).peak_velocity_m_s)],
        ['Energy for the same peak', `× ${f.n(cost(f), 2)}`],
      ],
    },
    {
      heading: 'What it does not change',
      scene: { compare: PAIR, settings: PULSES },
      show: { at: 'focus', run: [-1, 1] },
      control: 'scrub',
      text: (f) => [
        `Over the whole time little of this is left: the background contrast is ${f.n(f.paneTarget(0).background_contrast)} and ${f.n(f.paneTarget(1).background_contrast)}. A finger elsewhere feels all of that time, not the one instant.`,
        'Which method suits best depends on what is wanted. The Compare panel sets any two side by side.',
      ],
      figures: (f) => [
        ...contrasts(f),
        ['Background, time reversal', f.n(f.paneTarget(0).background_contrast)],
        ['Background, inverse', f.n(f.paneTarget(1).background_contrast)],
      ],
    },
  ],
};
