// Time reversal, seen by moving time to and fro.

const AT = [62, 90];
const PULSES = { method: 'time-reversal', effect: 'pulses', rate_hz: 2, window_ms: null, quantity: 'displacement' };

/** The story. */
export const backwards = {
  id: 'backwards',
  title: 'Backwards in time',
  about: 'A focus is a ripple that runs backwards. Stop the time and see.',
  steps: [
    {
      heading: 'A pulse under the finger',
      scene: { settings: PULSES, fingers: [AT] },
      measure: [{ name: 'pulse', at: [AT] }],
      text: (f) => [
        `A finger rests on the surface and feels ${f.set(f.settings.rate_hz)} pulses a second. Each lasts ${f.s(f.target('pulse').pulse_duration_s)}: too short to be seen.`,
        'The next step stops the time.',
      ],
      figures: (f) => [['Pulse', f.s(f.target('pulse').pulse_duration_s)], ['Spot', f.m(f.target('pulse').spot_diameter_m)]],
    },
    {
      heading: 'The instant of the focus',
      scene: { settings: PULSES, fingers: [AT] },
      show: { at: 'focus' },
      text: (f) => [
        'This is the instant at which all waves meet. Elsewhere waves from all directions overlap and nearly cancel.',
        `The spot is ${f.m(f.target('pulse').spot_diameter_m)} wide and stands out by a contrast of ${f.n(f.target('pulse').contrast)}.`,
      ],
    },
    {
      heading: 'Backwards',
      scene: { settings: PULSES, fingers: [AT] },
      show: { at: 'focus', run: [0, -0.15, 0] },
      control: 'scrub',
      text: () => [
        'Drag the slider to the left, or press Play it. Seen backwards, the focus is a stone that fell into water: a ring runs out, strikes the rims and is broken up.',
        'That is just how the drive was made. What a sensor at each actuator would record of a tap at the finger, that actuator plays in reverse.',
      ],
    },
    {
      heading: 'Forwards, through the focus',
      scene: { settings: PULSES, fingers: [AT] },
      show: { at: 'focus', run: [-0.15, 0.15] },
      control: 'scrub',
      text: () => [
        'Forwards, a ring closes around the finger, meets itself, and opens again on the other side of the instant.',
        'Just before and just after look alike. A wave obeys the same law in both directions of time, so the motion could be shown either way.',
      ],
      chart: (f) => pulseChart(f),
    },
    {
      heading: 'What tells the direction',
      scene: { settings: PULSES, fingers: [AT] },
      show: { at: 'focus', run: [-1, 1] },
      control: 'scrub',
      text: (f) => [
        `Over the whole window of ${f.s(f.window('pulse'))} the two halves differ: waves die away${decay(f)}, and with losses the law is not the same in both directions of time.`,
        `The actuators put in what is lost, from the start of the window to the focus; afterwards nothing is sent and the sheet rings down. So ripple remains over the whole time: the focus is ${f.n(f.target('pulse').background_contrast)} times its rms.`,
      ],
      figures: (f) => [['Contrast at the focus', f.n(f.target('pulse').contrast)], ['Over the whole time', f.n(f.target('pulse').background_contrast)]],
    },
  ],
};

function decay(f) {
  const time = f.surface.values?.decay_time_ms;
  return Number.isFinite(time) ? `, to 37 % in ${f.set(time)} ms` : '';
}

// The displacement at the finger, 2 ms either side of the focus.
function pulseChart(f) {
  const trace = f.trace('pulse');
  const instant = f.target('pulse').instant_s;
  if (!trace?.displacement_um || !Number.isFinite(instant)) return null;
  const x = trace.displacement_um.map((_, i) => ((trace.start_s ?? 0) + i / trace.rate - instant) * 1000);
  const kept = x.map((time, i) => [time, trace.displacement_um[i]]).filter(([time]) => Math.abs(time) <= 2);
  if (kept.length < 2) return null;
  return {
    axes: { x: 'Time from the focus', xUnit: 'ms', y: 'Displacement', yUnit: 'µm', label: 'Displacement at the finger around the focus' },
    data: { series: [{ name: 'at the finger', x: kept.map(([time]) => time), y: kept.map(([, value]) => value) }] },
  };
}
