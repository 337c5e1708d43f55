// What each figure means: its definition, where that is from, and what a good value is.

import { el } from './dom.js';

/** The paper whose system this is. Its entry is found by its title. */
const PAPER = {
  text: 'C. Hudin, J. Lozada, M. Wiertlewski and V. Hayward, Tradeoffs in the Application of Time-Reversed Acoustics to Tactile Stimulation, EuroHaptics 2012',
  href: 'https://search.crossref.org/?q=Tradeoffs+in+the+Application+of+Time-Reversed+Acoustics+to+Tactile+Stimulation',
};

const HUDIN = 'Hudin et al. (2012), section 2';
const TOUCH = 'threshold of touch: Verrillo (1963); Bolanowski et al. (1988)';
const OURS = 'docs/measuring.md';
const OUTSIDE = 'Outside is what is farther than 4/3 of the shortest wavelength from every target.';

const PEAK_VELOCITY = ['The velocity at the target at the instant of the focus.', HUDIN, 'As much as is wanted: it grows with the drive, within what linear theory allows.'];
const PEAK_DISPLACEMENT = [
  'The displacement at the target where its magnitude is largest.', OURS,
  'Well below the thickness of the sheet: there linear theory ends.',
];
const SPOT = [
  'The width of the focus: full width at half maximum around the target, at the instant of the focus.', HUDIN,
  'About six tenths of the shortest wavelength or less; no wider than a fingertip, some 10 mm.',
];
const PULSE = [
  'How long the focus lasts: full width at half maximum in time, at the target.', HUDIN, 'About half a period of the top of the band: no drive of the band does better.',
];

/** By the keys of reports and designs: definition, source, a good value. */
const WHY = {
  contrast: [
    `How far the focus stands out at its instant: its velocity over the rms velocity outside. ${OUTSIDE}`, HUDIN,
    'Some 20 to 30 for the paper’s film with its eight actuators. It says nothing of other instants: see background and worst spot.',
  ],
  background_contrast: ['The peak velocity over the rms velocity outside, over the whole time of a focus and not at its instant alone.', OURS, 'Near the contrast. Where it is lower, there is more ripple before or after the focus than at it.'],
  worst_spot: ['The peak velocity over the largest velocity anywhere outside, at any time.', OURS, 'Above 2: below 1 another place moves more than the target.'],
  peak_velocity_m_s: PEAK_VELOCITY,
  peak_displacement_m: PEAK_DISPLACEMENT,
  spot_diameter_m: SPOT,
  pulse_duration_s: PULSE,
  felt_level_db: ['The largest level at the target, weighted by frequency as a fingertip feels it, over what is just felt.', TOUCH, '10 to 30 dB. Persons differ by 6 dB.'],
  felt_contrast_db: ['The felt level over the rms of the level outside, at the same instant.', TOUCH, 'As large as possible; far smaller than the contrast of velocities, since the waves that are felt are long.'],
  felt_background_db: ['The felt level over the rms of the level outside, over the whole time.', TOUCH, 'As large as possible.'],
  felt_worst_spot_db: ['The felt level over the largest level anywhere outside, at any time.', TOUCH, 'Above 6 dB: at 0 dB another place is felt as much.'],
  felt_outside_db: ['The highest level anywhere outside, over what is just felt.', TOUCH, 'Below 0 dB: then nothing is felt but the targets.'],
  peak: ['The largest sample of the drive of any actuator.', OURS, 'Below the limit of the actuators.'],
  rms: ['The rms of the drive over its duration.', OURS, 'Below what actuators bear for long; less is better at the same peak of the focus.'],
  energy: ['The sum of squares of the drive over time, of all actuators.', OURS, 'Less is better at the same peak of the focus.'],
  share_above_band: ['The share of the drive’s energy above the top of the band.', OURS, 'Below 1 %: what is above moves modes that nobody counted on.'],
  contrast_predicted: ['The mean contrast of time reversal over many targets, from the surface’s own modes.', 'docs/contrast.md', 'Some 20 to 30 for the paper’s film.'],
  contrast_endless: ['The contrast that is predicted at the best window of all.', 'docs/contrast.md', 'Little above what the recommended window reaches: it is to reach nine tenths.'],
  window_recommended: ['The shortest window that reaches nine tenths of the largest contrast.', 'docs/contrast.md', 'Below 100 ms: a later answer to a touch is felt as late.'],
  modes: ['The number of natural frequencies in the band: so many waves can be told apart.', 'Weyl’s law; counted where it can be', 'A hundred or more. Below some 50 contrast depends on the place.'],
  celerity_min: ['How fast the crests of the longest waves run.', 'Cremer, Heckl and Petersson (2005)', 'Slow waves are short, and make small spots.'],
  celerity_max: ['How fast the crests of the shortest waves run.', 'Cremer, Heckl and Petersson (2005)', 'Slow waves are short, and make small spots.'],
  lambda_min: ['The wavelength at the top of the band.', 'the dispersion relation of a sheet under tension', '20 mm or less, so that a spot is no wider than a fingertip.'],
  spot_diameter: SPOT,
  pulse_duration: PULSE,
  heisenberg_time: ['The number of modes per hertz: the time in which single modes can be told apart.', 'docs/contrast.md', 'Longer than the decay time: then contrast grows as long as the sheet rings.'],
  decay_time: ['The time in which the amplitude of a free vibration falls to 37 % (1/e).', 'Ewins, Modal Testing (2000)', 'Long waves of thin films: some 70 ms. Longer gives more contrast, and a longer window.'],
  first_mode: ['The lowest natural frequency.', 'the modes of the sheet', 'Well below the top of the band: what lies between carries the focus.'],
};

/** A question mark that unfolds what a figure means; nothing for a figure that is not known. */
export function why(key, label) {
  const known = WHY[key];
  if (!known) return null;
  const [what, source, good] = known;
  return el('details', { class: 'why' },
    el('summary', { 'aria-label': `What is ${label}?`, title: `What is ${label}?` }, '?'),
    el('p', {}, what), el('p', {}, el('b', {}, 'Good: '), good), el('p', { class: 'quiet' }, `Definition: ${source}.`));
}

/** The paper, named and linked. */
export function paper() {
  return el('p', { class: 'quiet' }, 'The system is that of ', el('a', { href: PAPER.href, target: '_blank', rel: 'noopener noreferrer' }, PAPER.text), '.');
}
