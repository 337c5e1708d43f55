//! The decaying tones in a surface's responses, found in the part after their beginning.

use std::f64::consts::{FRAC_PI_2, TAU};
use unripple_dsp::FourierPlanner;
use unripple_linalg::{General, Lu, Mat, adjoint_times, c64, general, product, symmetric, times_adjoint};

/// Time that the soft edges of a part of the band ring for, times their width in Hz: a thousandth is left then.
const RINGING: f64 = 2.5;

/// Largest number of rows of the system that is solved, and (`FEWEST`) the smallest number of time steps. Work grows as the cube of
/// the rows.
const ROWS: usize = 240;
const FEWEST: usize = 12;

/// Smallest power of a direction of the signal space that is used: relative to the strongest, and
/// (`OVER_NOISE`) relative to the lower quartile of all, which is noise.
const LEAST: f64 = 1e-9;
const OVER_NOISE: f64 = 20.0;

/// Largest decay of a tone over the beginning that is left out, in nepers. One that decays more is not extrapolated back to time 0.
const DEEPEST: f64 = 2.5;

/// A part of a frequency band: all between `low` and `high`, with soft edges of width `edge` outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Lowest frequency, in Hz.
    pub low: f64,
    /// Highest frequency, in Hz.
    pub high: f64,
    /// Width of each soft edge, in Hz.
    pub edge: f64,
}

impl Part {
    /// The part of a band from `low` to `high` (Hz) whose soft edges ring for `passed` seconds.
    pub fn new(low: f64, high: f64, passed: f64) -> Self {
        Self { low, high, edge: RINGING / passed }
    }

    fn weight(&self, hz: f64) -> f64 {
        let off = (self.low - hz).max(hz - self.high).max(0.0) / self.edge;
        // Three derivatives are smooth, so that little rings for long.
        if off < 1.0 { (FRAC_PI_2 * (FRAC_PI_2 * off).sin().powi(2)).cos().powi(2) } else { 0.0 }
    }
}

/// A decaying tone Re(own · e^{st}) in the response of each actuator at itself.
#[derive(Clone, Debug)]
pub(super) struct Tone {
    /// Complex frequency, in 1/s.
    pub s: c64,
    /// Complex amplitude at time 0 in the response of each actuator at itself.
    pub own: Vec<c64>,
}

/// Impulse responses of sensors to drives, as many sensors as drives, and the sample that is their time 0.
pub(super) struct Heard<'a> {
    /// The responses, `[sensor][drive][sample]`.
    pub responses: &'a [Vec<Vec<f64>>],
    /// Sample, possibly fractional, that is time 0 of the responses.
    pub zero: f64,
    /// Samples per second.
    pub rate: f64,
}

/// The responses after their beginning in a part of the band, shifted in frequency so that its lowest line
/// is at 0 Hz: sensors x drives at each instant.
struct Baseband {
    instants: Vec<Mat<c64>>,
    /// Time of each instant, in s.
    times: Vec<f64>,
    /// Frequency that is shifted to 0 Hz, in Hz.
    base: f64,
}

/// Finds the tones within a part of the band; `expected` is the approximate number of tones including those
/// at its edges.
///
/// Responses between several places that share their tones are those of a linear system: a shift by dt in
/// time multiplies the directions of the signal space by the tones' e^{s dt} (the eigensystem realization
/// algorithm: J.-N. Juang and R. S. Pappa, *J. Guidance* 8, 620, 1985). Tones that overlap are separated by
/// their different amplitudes at the places; if two cannot be separated, their sum is still right. The
/// beginning is not used, since it holds the quasi-static response of all modes above this band.
pub(super) fn tones(heard: &Heard, part: &Part, expected: usize) -> Vec<Tone> {
    let count = heard.responses.len();
    let baseband = Baseband::of(heard, part);
    let instants = baseband.instants.len();
    if count == 0 || instants < FEWEST {
        return Vec::new();
    }
    let blocks = (3 * expected / count + 4).min(ROWS / count).clamp(2, instants / 2);
    let Some((poles, shapes)) = directions(&baseband.instants, blocks) else { return Vec::new() };
    let step = baseband.times[1] - baseband.times[0];
    let passed = RINGING / part.edge;
    let lasted = step * instants as f64;
    let kept: Vec<(usize, c64)> = poles
        .iter()
        .enumerate()
        .map(|(m, pole)| (m, pole.ln() / step))
        .filter(|(_, s)| s.re.is_finite() && s.re * lasted < 1.0 && -s.re * passed < DEEPEST)
        .collect();
    let amplitudes = amplitudes(&baseband, &shapes, &kept);
    // The shift to 0 Hz has its phase 0 at the signals' first sample, not at time 0.
    let base = c64::new(0.0, TAU * baseband.base);
    let turn = (base * (heard.zero / heard.rate)).exp();
    kept.iter()
        .zip(amplitudes)
        .map(|((_, s), own)| Tone { s: s + base, own: own.iter().map(|x| x * turn).collect() })
        .filter(|tone| (part.low..part.high).contains(&(tone.s.im / TAU)))
        .collect()
}

impl Baseband {
    fn of(heard: &Heard, part: &Part) -> Self {
        let Heard { responses, zero, rate } = *heard;
        let length = responses.iter().flatten().map(Vec::len).min().unwrap_or(0);
        let size = (2 * length).next_power_of_two().max(2);
        let line = |hz: f64| hz * size as f64 / rate;
        let first = line((part.low - part.edge).max(0.0)).floor() as usize;
        let lines = (line(part.high + part.edge).ceil() as usize).min(size / 2) - first.min(size / 2);
        let spacing = size as f64 / (lines.max(1) as f64 * rate);
        let passed = RINGING / part.edge;
        let begin = ((zero / rate + passed) / spacing).ceil() as usize;
        let end = ((length as f64 / rate - passed) / spacing).max(0.0) as usize;
        let plan = FourierPlanner::new().forward(size);
        let turns: Vec<c64> =
            (0..lines).map(|k| c64::new(0.0, TAU * k as f64 / lines as f64).exp() / lines as f64).collect();
        let weights: Vec<f64> =
            (0..lines).map(|k| part.weight((first + k) as f64 * rate / size as f64)).collect();
        let narrow = |signal: &Vec<f64>| -> Vec<c64> {
            let (mut time, mut spectrum) = (plan.make_input_vec(), plan.make_output_vec());
            time[..length].copy_from_slice(&signal[..length]);
            // Sizes come from the plan itself.
            let _ = plan.process(&mut time, &mut spectrum);
            weights.iter().zip(&spectrum[first..]).map(|(w, x)| x * *w).collect()
        };
        let (count, kept) = (responses.len(), end.saturating_sub(begin));
        let bands: Vec<Vec<c64>> = responses.iter().flatten().map(narrow).collect();
        // All inverse transforms at once, of only the instants that count.
        let spectra = Mat::from_fn(bands.len(), lines, |of, k| bands[of][k]);
        let back = Mat::from_fn(lines, kept, |k, i| turns[k * (begin + i) % lines]);
        let all = product(spectra.as_ref(), back.as_ref());
        let instants =
            (0..kept).map(|i| Mat::from_fn(count, count, |b, a| all[(b * count + a, i)])).collect();
        let times = (begin..begin + kept).map(|i| i as f64 * spacing - zero / rate).collect();
        Self { instants, times, base: first as f64 * rate / size as f64 }
    }
}

/// The factor of each tone from instant to instant, and its complex amplitude at each place (places x tones).
fn directions(instants: &[Mat<c64>], blocks: usize) -> Option<(Vec<c64>, Mat<c64>)> {
    let count = instants[0].nrows();
    let (rows, starts) = (count * blocks, instants.len() - blocks + 1);
    let stacked =
        Mat::from_fn(rows, count * starts, |r, c| instants[r / count + c / count][(r % count, c % count)]);
    let gram = times_adjoint(stacked.as_ref(), stacked.as_ref());
    let (powers, directions) = symmetric(gram.as_ref())?;
    let mut order: Vec<usize> = (0..rows).collect();
    order.sort_unstable_by(|a, b| powers[*b].total_cmp(&powers[*a]));
    let strongest = powers[order[0]];
    let noise = powers[order[rows - rows / 4 - 1]].max(0.0);
    let most = count * (blocks - 1) * 3 / 4;
    let least = (LEAST * strongest).max(OVER_NOISE * noise);
    let kept: Vec<usize> = order.into_iter().take(most).filter(|i| powers[*i] > least).collect();
    if kept.is_empty() || strongest.is_nan() {
        return None;
    }
    let span = Mat::from_fn(rows, kept.len(), |r, c| directions[(r, kept[c])]);
    let before = span.subrows(0, rows - count);
    let after = span.subrows(count, rows - count);
    let mut turn = adjoint_times(before, after);
    Lu::new(adjoint_times(before, before).as_ref()).solve(turn.as_mut());
    let General { values: poles, vectors } = general(turn.as_ref())?;
    let shapes = product(span.subrows(0, count), vectors.as_ref());
    Some((poles, shapes))
}

/// Complex amplitude at time 0 of each tone in each actuator's response at itself, `[tone][actuator]`: the least-squares fit to all
/// instants, given the tones' amplitudes at the places.
fn amplitudes(baseband: &Baseband, shapes: &Mat<c64>, tones: &[(usize, c64)]) -> Vec<Vec<c64>> {
    let (count, tones_found) = (shapes.nrows(), tones.len());
    let going =
        Mat::from_fn(baseband.times.len(), tones_found, |i, m| (tones[m].1 * baseband.times[i]).exp());
    let places = Mat::from_fn(count, tones_found, |b, m| shapes[(b, tones[m].0)]);
    let time = adjoint_times(going.as_ref(), going.as_ref());
    let place = adjoint_times(places.as_ref(), places.as_ref());
    let size = |m: usize| (time[(m, m)].re * place[(m, m)].re).max(f64::MIN_POSITIVE).sqrt();
    let sizes: Vec<f64> = (0..tones_found).map(size).collect();
    let normal = Mat::from_fn(tones_found, tones_found, |m, n| {
        let ridge = if m == n { 1e-12 } else { 0.0 };
        time[(m, n)] * place[(m, n)] / (sizes[m] * sizes[n]) + ridge
    });
    let mut right = Mat::<c64>::zeros(tones_found, count);
    for (i, instant) in baseband.instants.iter().enumerate() {
        let seen = adjoint_times(places.as_ref(), instant.as_ref());
        for m in 0..tones_found {
            let weight = going[(i, m)].conj() / sizes[m];
            (0..count).for_each(|a| right[(m, a)] += weight * seen[(m, a)]);
        }
    }
    let mut found = right;
    Lu::new(normal.as_ref()).solve(found.as_mut());
    // Twice, since the negative frequencies are left out.
    let own = |m: usize| (0..count).map(|a| places[(a, m)] * found[(m, a)] * (2.0 / sizes[m])).collect();
    (0..tones_found).map(own).collect()
}
