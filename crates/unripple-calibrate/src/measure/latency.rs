//! Latency of a device, found from the phases of tones at its actuators.

use super::Hearing;
use super::tones::{Heard, Part, Tone, tones};
use crate::CalibrateError;
use crate::signals::{Band, Delay};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use unripple_dsp::{DspError, median};
use unripple_linalg::c64;
use unripple_physics::Sensor;

/// Largest number of actuators that are used: the median of a dozen is reliable enough, and the work grows with their square.
const ACTUATORS: usize = 12;

/// Approximate number of tones in a part of the band with its edges, and (`FEWEST`) the smallest number that is searched. More in a
/// part take larger systems, whose work grows as the cube; with fewer, parts get narrow and their edges ring long.
const TONES: usize = 60;
const FEWEST: usize = 8;

/// Time after which the beginning of a response counts as over: at most `PASSED` seconds and `OF_RINGING` decay times, but at least
/// `PERIODS` periods. Earlier, what modes above the band leave still disturbs the phases; later, tones have died away.
const PASSED: f64 = 0.025;
const OF_RINGING: f64 = 0.8;
const PERIODS: f64 = 2.0;

/// Ratio of frequencies up to which tones determine the decay time in a part of the band. With fewer tones
/// the estimate depends on chance; with more, decay times of other frequencies are mixed in.
const NEAR: f64 = 1.3;

/// Multiple of the highest resonance of exciters' housings above which tones are used. Nearer to that
/// resonance, the phase of an exciter's signal changes within the width of a tone, more than the model can
/// correct; doubled, tones of the lowest modes are lost.
const CLEAR_OF_HOUSINGS: f64 = 3.0;

/// Longest part of the model's responses, in s, in which tones are searched, and (`IN_CELL`) number of them in a cell of the band.
/// Longer responses take longer and contain the same tones.
const SAID: f64 = 2.0;
const IN_CELL: usize = 8;

/// Largest error of the first estimate, in periods of the band's top: half a period away, a signal seems to
/// have the opposite sign.
const WITHIN: f64 = 0.75;

/// Lengths of the model's responses, in periods of the band's top, with which the first estimate is tried,
/// the longest first. If the surface differs from its file, the model's tones soon get out of step with the
/// recorded ones, so that shorter responses agree better.
const BEGINNINGS: [f64; 5] = [f64::INFINITY, 64.0, 32.0, 16.0, 8.0];

/// Smallest share of the sums over cells of the band that must agree on a latency for it to count.
const AGREED: f64 = 0.3;

/// Latency of a device and its uncertainty, both in samples, from responses between actuators. `heard` is `[sensor][drive][sample]`
/// with `lead` samples before time 0; it is empty for an actuator that is left out.
///
/// An actuator senses each mode in phase with its own drive: the velocity at the driven place is a sum of w² e^{-σt} (cos ωt - (σ/ω)
/// sin ωt) for any sheet, modes above the band included. Decaying tones are therefore fitted to the responses after their beginning and
/// extrapolated back to time 0, where their phases are those of a delay alone. The frequencies come from the recording, not from a
/// model. The phase of a circuit is known from the surface file and removed. Damping by voltage-driven coils, and masses without
/// damping, shift the phases of tones; this is corrected, cell by cell of the band, by the phases of the model's own tones.
///
/// The uncertainty is half the interquartile range of the estimates from single actuators, or of the first, rough ones where these differ
/// by more than tones can correct.
///
/// # Errors
/// [`CalibrateError::Recording`] if no actuator has a signal; [`CalibrateError::Dsp`] for a band out of range.
pub fn latency(
    heard: &[Vec<Vec<f64>>],
    model: &Hearing,
    lead: usize,
    rate: f64,
    band: Band,
) -> Result<[f64; 2], CalibrateError> {
    let count = heard.len().min(model.actuators());
    let alive: Vec<usize> = (0..count).filter(|a| !heard[*a].is_empty()).collect();
    if alive.is_empty() {
        let (what, expected) = ("actuators with sensors".into(), "at least one".into());
        return Err(CalibrateError::Recording { what, expected, found: "none".into() });
    }
    let chosen = alive.len().min(ACTUATORS);
    let some: Vec<usize> = (0..chosen).map(|i| alive[i * alive.len() / chosen]).collect();
    let chosen: Vec<Vec<Vec<f64>>> =
        some.iter().map(|b| some.iter().map(|a| heard[*b][*a].clone()).collect()).collect();
    let (delays, signs) = roughly(&chosen, &some, model, (lead, rate), band)?;
    let coarse = delays[delays.len() / 2];
    let parts = parts(model, band);
    let found = Heard { responses: &chosen, zero: lead as f64 + coarse, rate };
    let sensors: Vec<&Sensor> = some.iter().map(|a| &model.sensors()[*a]).collect();
    let mut all = rung(&found, &parts, &sensors);
    let cells = Cells::new(all.len(), band);
    let mut said = Vec::new();
    if !model.in_step() {
        let responses = self::said(&chosen, &some, model, (lead, rate), band)?;
        said = rung(&Heard { responses: &responses, zero: lead as f64, rate }, &parts, &sensors);
        let reference = said.clone();
        cells.lead(&mut all, &reference);
        cells.lead(&mut said, &reference);
    }
    let most = WITHIN * rate / band.high[0].min(rate / 2.0);
    let whole: Vec<usize> = (0..some.len()).collect();
    // A sensor may be reversed: each gets the sign with which its own tones agree best in phase.
    let sign =
        |a: usize| delay(&all, &[a], &cells, rate, most).map_or(signs[a], |(_, sign)| sign * signs[a].abs());
    let signs: Vec<f64> = whole.iter().map(|a| sign(*a)).collect();
    for (own, sign) in all.iter_mut().flat_map(|tone| tone.own.iter_mut().zip(&signs)) {
        *own *= *sign;
    }
    let of = |actuators: &[usize]| {
        let (late, _) = delay(&all, actuators, &cells, rate, most)?;
        // Within a cell, phase shifts that depend on frequency look like a delay: that of the model is subtracted.
        let own = if said.is_empty() { 0.0 } else { delay(&said, actuators, &cells, rate, most)?.0 };
        Some(late - own)
    };
    // If too little rings for a finer estimate, the first one is returned.
    let Some(late) = of(&whole) else { return Ok([coarse, disagreement(&delays)]) };
    let mut alone: Vec<f64> = whole.iter().filter_map(|a| of(&[*a])).collect();
    alone.sort_unstable_by(f64::total_cmp);
    // Tones correct the first estimate by a period alone: if that one is uncertain by more, so is the latency.
    let (first, own) = (disagreement(&delays), disagreement(&alone));
    Ok([coarse + late, if first > most { own.max(first) } else { own }])
}

/// Half the interquartile range of sorted values.
fn disagreement(sorted: &[f64]) -> f64 {
    let quantile = |share: f64| sorted.get(((sorted.len().max(1) - 1) as f64 * share).round() as usize);
    quantile(0.75).zip(quantile(0.25)).map_or(0.0, |(high, low)| (high - low) / 2.0)
}

/// First estimate, to about a sample: the delays between recorded and modelled responses, ascending, at least one; and the sign of each
/// actuator, 0 if it is silent.
///
/// From the response of each actuator at itself; where voltage-driven coils or the housings of exciters damp
/// the surface, from responses at other actuators, since the beginning of such an actuator's response at
/// itself is mostly strongly damped motion that no mode of the band describes. The model's responses are cut
/// off at the length at which they resemble the recorded ones most: the whole response of a surface that
/// differs may resemble the recorded one most at any delay.
fn roughly(
    heard: &[Vec<Vec<f64>>],
    some: &[usize],
    model: &Hearing,
    (lead, rate): (usize, f64),
    band: Band,
) -> Result<(Vec<f64>, Vec<f64>), CalibrateError> {
    let away = usize::from(model.has_voltage_driven_coils() || highest_housing(model) > 0.0);
    let pairs: Vec<(&[f64], Vec<f64>)> = (0..some.len())
        .map(|b| {
            let a = (b + away) % some.len();
            let found = &heard[b][a];
            (&found[..], model.response(some[b], some[a], found.len().saturating_sub(lead)))
        })
        .collect();
    let mut best: Option<Rough> = None;
    for periods in BEGINNINGS {
        let mut rough = Rough { delays: Vec::new(), signs: Vec::new(), alike: 0.0 };
        for (found, said) in &pairs {
            let mut known = vec![0.0; lead];
            known.extend(beginning(said, periods * rate / band.high[0]));
            band.limit(&mut known, rate)?;
            // A silent actuator gives no estimate; others may.
            let delay = Delay::between(found, &known, rate, band).ok();
            rough.signs.push(delay.map_or(0.0, |delay| if delay.inverted && away == 0 { -1.0 } else { 1.0 }));
            rough.delays.extend(delay.map(|delay| delay.samples));
            rough.alike += delay.map_or(0.0, |delay| delay.correlation);
        }
        if !rough.delays.is_empty() && best.as_ref().is_none_or(|best| rough.alike > best.alike) {
            best = Some(rough);
        }
    }
    let mut best = best.ok_or_else(|| CalibrateError::Recording {
        what: "latency".into(),
        expected: "actuators whose own sensor receives their drive".into(),
        found: "silence".into(),
    })?;
    best.delays.sort_unstable_by(f64::total_cmp);
    Ok((best.delays, best.signs))
}

/// First estimates of the latency, with one length of the model's responses.
struct Rough {
    /// Delays in samples, of actuators that are not silent.
    delays: Vec<f64>,
    /// Sign of each actuator, 0 if it is silent.
    signs: Vec<f64>,
    /// Sum of the correlations at those delays.
    alike: f64,
}

/// The first `length` samples of a response, faded out.
fn beginning(response: &[f64], length: f64) -> impl Iterator<Item = f64> {
    let fade = move |i: usize| 0.5 + 0.5 * (PI * i as f64 / length).cos();
    response.iter().take(length as usize).enumerate().map(move |(i, x)| x * fade(i))
}

/// Parts of the band, each with about as many tones as can be resolved at once, and the number of tones of
/// the model in each part including its edges.
fn parts(model: &Hearing, band: Band) -> Vec<(Part, usize)> {
    let mut known: Vec<[f64; 2]> = model.tones().filter(|[hz, _]| *hz > 0.0).collect();
    known.dedup_by(|a, b| (a[0] - b[0]).abs() < 1e-9 * b[0]);
    let place = |hz: f64| known.partition_point(|tone| tone[0] < hz);
    let top = band.high[0];
    let lowest = known.first().map_or(0.0, |tone| tone[0]);
    let mut low =
        band.low[1].max(0.8 * lowest).max(CLEAR_OF_HOUSINGS * highest_housing(model)).min(0.9 * top);
    let mut parts = Vec::new();
    while low < top {
        let rates = known[place(low)..place(NEAR * low)].iter().map(|tone| tone[1]);
        let rate = median(rates).unwrap_or(0.0);
        let passed = (OF_RINGING / rate).min(PASSED).max(PERIODS / low);
        let edge = Part::new(low, top, passed).edge;
        let last = known.get(place(low - edge) + TONES).map_or(top, |tone| tone[0]);
        let mut high = (last - edge).max(low + edge);
        // A short last part is joined to the one before.
        if top - high < 0.3 * (high - low) {
            high = top;
        }
        let part = Part::new(low, high, passed);
        parts.push((part, (place(high + edge) - place(low - edge)).max(FEWEST)));
        low = high;
    }
    parts
}

/// Highest resonance of the exciters' housings on their springs, in Hz; 0 without exciters.
fn highest_housing(model: &Hearing) -> f64 {
    let housings = model.sensors().iter().filter_map(|sensor| sensor.housing);
    housings.map(|housing| (housing.stiffness / housing.mass).sqrt() / TAU).fold(0.0, f64::max)
}

/// The tones of all parts of the band, with the phase of circuits removed and turned so that the velocity after an impulse at time 0
/// has a positive real amplitude. Phase shifts by damping remain.
fn rung(heard: &Heard, parts: &[(Part, usize)], sensors: &[&Sensor]) -> Vec<Tone> {
    let mut all: Vec<Tone> =
        parts.par_iter().flat_map_iter(|(part, expected)| tones(heard, part, *expected)).collect();
    for tone in &mut all {
        let (s, struck) = (tone.s, c64::new(1.0, tone.s.re / tone.s.im));
        for (own, sensor) in tone.own.iter_mut().zip(sensors) {
            // Once for the drive and once for the sensor.
            let through = sensor.per_velocity(s);
            let turn = through / through.norm().max(f64::MIN_POSITIVE);
            *own *= struck * (turn * turn).conj();
        }
    }
    all
}

/// Cells of the band, each with several tones. Tones that one damper couples have different phase shifts, which cancel in their sum:
/// sums over cells are compared.
#[derive(Clone, Copy)]
struct Cells {
    low: f64,
    width: f64,
    count: usize,
}

impl Cells {
    /// Cells of a band in which there are about `tones` tones in all.
    fn new(tones: usize, band: Band) -> Self {
        let (low, count) = (band.low[1], (tones / IN_CELL).max(1));
        Self { low, width: (band.high[0] - low) / count as f64, count }
    }

    fn of(&self, tone: &Tone) -> usize {
        (((tone.s.im / TAU - self.low) / self.width).max(0.0) as usize).min(self.count - 1)
    }

    /// For each cell, the sum of an actuator's amplitudes at itself, and the sum of their magnitudes.
    fn sums(&self, tones: &[Tone], actuator: usize) -> Vec<(c64, f64)> {
        let mut sums = vec![(c64::new(0.0, 0.0), f64::MIN_POSITIVE); self.count];
        for tone in tones {
            let (sum, size) = &mut sums[self.of(tone)];
            *sum += tone.own[actuator];
            *size += tone.own[actuator].norm();
        }
        sums
    }

    /// Removes from `tones` the phase shifts of the model's tones, `said`, cell by cell; the less the model's tones in a cell agree in
    /// phase, the less the cell counts.
    fn lead(&self, tones: &mut [Tone], said: &[Tone]) {
        let actuators = tones.first().map_or(0, |tone| tone.own.len());
        for actuator in 0..actuators {
            let sums = self.sums(said, actuator);
            for tone in tones.iter_mut() {
                let (sum, size) = sums[self.of(tone)];
                tone.own[actuator] *= sum.conj() / size;
            }
        }
    }
}

/// Modelled responses of the chosen actuators at each other, within the band.
fn said(
    heard: &[Vec<Vec<f64>>],
    some: &[usize],
    model: &Hearing,
    (lead, rate): (usize, f64),
    band: Band,
) -> Result<Vec<Vec<Vec<f64>>>, CalibrateError> {
    let samples = heard[0][0].len().min(lead + (SAID * rate) as usize);
    let count = some.len();
    let one = |n: usize| {
        let (b, a) = (n / count, n % count);
        // By reciprocity one response of each pair is enough.
        let mut said = vec![0.0; if b <= a { lead } else { 0 }];
        if b <= a {
            said.extend(model.response(some[b], some[a], samples.saturating_sub(lead)));
            band.limit(&mut said, rate)?;
        }
        Ok(said)
    };
    let upper: Vec<Vec<f64>> =
        (0..count * count).into_par_iter().map(one).collect::<Result<_, DspError>>()?;
    let of = |b: usize, a: usize| upper[b.min(a) * count + b.max(a)].clone();
    Ok((0..count).map(|b| (0..count).map(|a| of(b, a)).collect()).collect())
}

/// The delay in samples, at most `most` either way, at which the tones of these actuators at themselves agree best in phase, and their
/// sign; `None` if they do not agree.
fn delay(tones: &[Tone], actuators: &[usize], cells: &Cells, rate: f64, most: f64) -> Option<(f64, f64)> {
    let parts: Vec<(f64, c64)> = tones
        .iter()
        .map(|tone| {
            let own: c64 = actuators.iter().map(|a| tone.own[*a]).sum();
            (tone.s.im / rate, own)
        })
        .collect();
    // Sum of the tones' real parts after a delay, and its first two derivatives.
    let at = |late: f64| {
        parts.iter().fold([0.0; 3], |[value, first, second], (omega, own)| {
            let turned = own * c64::new(0.0, omega * late).exp();
            [value + turned.re, first - omega * turned.im, second - omega * omega * turned.re]
        })
    };
    let steps = 64;
    let grid = (-steps..=steps).map(|i| most * f64::from(i) / f64::from(steps));
    let mut late = grid.max_by(|a, b| at(*a)[0].abs().total_cmp(&at(*b)[0].abs()))?;
    let sign = at(late)[0].signum();
    for _ in 0..20 {
        let [_, first, second] = at(late);
        if sign * second >= 0.0 {
            break;
        }
        late -= (first / second).clamp(-most / 32.0, most / 32.0);
    }
    let size = |a: &usize| cells.sums(tones, *a).iter().map(|(sum, _)| sum.norm()).sum::<f64>();
    let whole: f64 = actuators.iter().map(size).sum();
    (whole > 0.0 && at(late)[0].abs() > AGREED * whole && late.abs() <= 1.1 * most).then_some((late, sign))
}
