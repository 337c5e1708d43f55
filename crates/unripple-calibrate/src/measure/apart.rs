//! Delay and change of tension between two takes of the same responses.

use super::law::Law;
use crate::signals::{Band, Moves, Remap};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use unripple_dsp::Complex;

/// Largest relative change of tension that is searched: twice the specified range, and more than the warmth
/// of a hand causes.
const MOST_CHANGE: f64 = 0.016;

/// Phase by which the end of a response turns from one tried change to the next, in radians. With twice as much a maximum of
/// the correlation may be missed, half as much takes twice as long.
const TURN: f64 = 1.0;

/// Number of steps on either side of an expected change that are tried first, and the smallest correlation
/// at which the best of them is accepted: no other change reaches as high a correlation then. With fewer
/// steps a slow drift from sweep to sweep is lost.
const NEAR: i64 = 5;
const ALIKE: f64 = 0.95;

/// Largest delay that is searched, either way, in samples: whole ones are removed beforehand.
const MOST_DELAY: f64 = 2.5;

/// Accuracy of a delay, in samples, and that with which changes are compared before the best is refined: at the top of the band, which is
/// below half the rate, a sixteenth of a sample turns the phase by a fifth of a radian.
const FINEST: f64 = 1e-5;
const COARSE: f64 = 1.0 / 16.0;

/// Number of lines whose phases are rotated side by side: two registers of AVX2 for each part. With twice
/// this value nothing is gained.
const BESIDE: usize = 8;

/// Delay and relative change of tension between two takes of the same responses, with standard errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Apart {
    /// Delay of the found responses relative to the known ones, in samples.
    pub late: f64,
    /// Relative change of tension (or stiffness) from known to found.
    pub change: f64,
    /// Correlation of the two takes after delay and change are removed, from -1 to 1.
    pub likeness: f64,
    /// Standard errors of `late` and of `change`, from the part of the responses that both leave
    /// unexplained.
    pub errors: [f64; 2],
}

/// Which change of tension (or stiffness) is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// No change of tension is searched.
    None,
    /// Any change is searched, first near this relative change, which was found for an earlier sweep.
    Near(f64),
}

impl Change {
    /// The search for the next sweep: near the change found for the one before, if any was found.
    pub fn after(self, found: Option<Apart>) -> Self {
        match (self, found) {
            (Self::Near(_), Some(apart)) => Self::Near(apart.change),
            (change, _) => change,
        }
    }
}

/// Pairs of a known and a found response, as spectra to be compared.
pub(super) struct Pairs<'a> {
    known: Vec<Remap>,
    found: Vec<Vec<Complex<f64>>>,
    law: &'a Law,
    /// First and last frequency, in Hz.
    band: [f64; 2],
    /// Phase per sample of delay, in radians: at the first line, and the increment from line to line.
    turns: [f64; 2],
    samples: usize,
    rate: f64,
}

impl<'a> Pairs<'a> {
    /// Prepares pairs, each known and found, of responses of equal length whose time 0 is sample `origin`. Pairs with a
    /// silent response are left out; `None` if no pair is left.
    pub fn of(
        pairs: &[(&[f64], &[f64])],
        origin: usize,
        rate: f64,
        band: Band,
        law: &'a Law,
    ) -> Option<Self> {
        let within = [band.low[0], band.high[1]];
        let samples = pairs.first()?.0.len();
        let mut made =
            Self { known: Vec::new(), found: Vec::new(), law, band: within, turns: [0.0; 2], samples, rate };
        for (known, found) in pairs {
            let [known, found] = [*known, *found].map(|signal| faded(signal, band, rate));
            if [&known, &found].iter().any(|signal| !signal.iter().any(|x| *x != 0.0)) {
                continue;
            }
            let known = Remap::new(&known, rate, origin as f64);
            let lines = Remap::new(&found, rate, origin as f64).lines(within, |hz| [hz, 1.0]);
            let first = known.within(within)[0];
            let step = TAU * known.hz(1) / rate;
            made.turns = [step * first as f64, step];
            made.known.push(known);
            made.found.push(normed(lines));
        }
        (!made.known.is_empty()).then_some(made)
    }

    /// The delay and the change of tension with which the pairs agree best; with [`Change::None`] no change is searched.
    pub fn apart(&self, change: Change) -> Apart {
        let top = TAU * self.band[1] * self.samples as f64 / self.rate;
        let step = (2.0 * TURN / top).min(MOST_CHANGE / 4.0);
        let count = (MOST_CHANGE / step).ceil() as i64;
        let mut best = match change {
            Change::None => 0.0,
            Change::Near(near) => {
                let middle = ((near / step).round() as i64).clamp(-count, count);
                let [from, to] = [middle - NEAR, middle + NEAR].map(|i| i.clamp(-count, count));
                let found = self.best(step, from..=to);
                let within = |(change, likeness): &(f64, f64)| {
                    let at = (change / step).round() as i64;
                    *likeness >= ALIKE && (at > from || from == -count) && (at < to || to == count)
                };
                Some(found).filter(within).unwrap_or_else(|| self.best(step, -count..=count)).0
            }
        };
        let [mut late, mut most] = self.at(best, FINEST);
        let mut reach = step;
        while change != Change::None && reach > 1e-8 {
            reach /= 2.0;
            for change in [best - reach, best + reach] {
                let [at, likeness] = self.at(change, FINEST);
                if likeness > most {
                    (best, late, most) = (change, at, likeness);
                }
            }
        }
        Apart { late, change: best, likeness: most, errors: self.errors(best, late, most, step) }
    }

    /// The change, a multiple of `step` among `steps`, at which the pairs agree best, and their correlation
    /// there.
    fn best(&self, step: f64, steps: RangeInclusive<i64>) -> (f64, f64) {
        let tried = steps.map(|i| (step * i as f64, self.at(step * i as f64, COARSE)[1]));
        tried.fold((0.0, f64::NEG_INFINITY), |best, one| if one.1 > best.1 { one } else { best })
    }

    /// The delay (samples) at which the pairs agree best with a given change, to an accuracy of `finest` samples, and their correlation
    /// there.
    fn at(&self, change: f64, finest: f64) -> [f64; 2] {
        let cross = self.cross(change);
        let (mut best, mut most) = (0.0, f64::NEG_INFINITY);
        let mut reach = 0.5;
        let count = (MOST_DELAY / reach) as i64;
        for i in -count..=count {
            let late = reach * i as f64;
            let likeness = self.read(&cross, late);
            if likeness > most {
                (best, most) = (late, likeness);
            }
        }
        while reach > finest {
            reach /= 2.0;
            for late in [best - reach, best + reach] {
                let likeness = self.read(&cross, late);
                if likeness > most {
                    (best, most) = (late, likeness);
                }
            }
        }
        [best, most]
    }

    /// Sum of the cross-spectra of all pairs, each normalised to power 1.
    fn cross(&self, change: f64) -> Vec<Complex<f64>> {
        let mut sum: Vec<Complex<f64>> = Vec::new();
        let Some(moves) = self.moves(change) else { return sum };
        for pair in 0..self.known.len() {
            let own = self.crossed(pair, &moves);
            sum.resize(own.len(), Complex::default());
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
        sum
    }

    /// Original frequency of each line of the band under a change of tension, equal for all pairs; `None`
    /// without pairs.
    fn moves(&self, change: f64) -> Option<Moves> {
        let known = self.known.first()?;
        Some(known.moves(self.band, |hz| self.law.unchanged(hz, change)))
    }

    /// Cross-spectrum of one pair, of power 1.
    fn crossed(&self, pair: usize, moves: &Moves) -> Vec<Complex<f64>> {
        let moved = normed(self.known[pair].lines_by(moves));
        moved.iter().zip(&self.found[pair]).map(|(known, found)| found * known.conj()).collect()
    }

    /// Whether each pair (silent ones left out) has a correlation below `least` (-1 to 1) after the common
    /// delay and change are removed.
    pub fn strange(&self, apart: &Apart, least: f64) -> Vec<bool> {
        let Some(moves) = self.moves(apart.change) else { return Vec::new() };
        let count = self.known.len() as f64;
        let likeness = |pair: usize| count * self.read(&self.crossed(pair, &moves), apart.late);
        (0..self.known.len()).map(|pair| likeness(pair) < least).collect()
    }

    /// These pairs without those marked `true` in `strange`; `None` unless more than half of the pairs
    /// remain.
    pub fn without(mut self, strange: &[bool]) -> Option<Self> {
        let keep = |n: usize| !strange.get(n).copied().unwrap_or(false);
        let count = self.known.len();
        let mut numbers = 0..;
        self.known.retain(|_| numbers.next().is_some_and(keep));
        let mut numbers = 0..;
        self.found.retain(|_| numbers.next().is_some_and(keep));
        (2 * self.known.len() > count).then_some(self)
    }

    /// Mean correlation of all pairs at a delay (samples).
    fn read(&self, cross: &[Complex<f64>], late: f64) -> f64 {
        // Several turns side by side, since each product waits for the one before.
        let turn_of =
            |line: usize| Complex::from_polar(1.0, (self.turns[0] + line as f64 * self.turns[1]) * late);
        let mut turns: [Complex<f64>; BESIDE] = std::array::from_fn(turn_of);
        let step = Complex::from_polar(1.0, BESIDE as f64 * self.turns[1] * late);
        let mut sums = [0.0; BESIDE];
        for lines in cross.chunks(BESIDE) {
            for ((sum, line), turn) in sums.iter_mut().zip(lines).zip(&mut turns) {
                *sum += line.re * turn.re - line.im * turn.im;
                *turn *= step;
            }
        }
        sums.iter().sum::<f64>() / self.known.len() as f64
    }

    /// Standard errors of delay and change, from the curvature of the correlation and its distance from 1.
    fn errors(&self, change: f64, late: f64, likeness: f64, step: f64) -> [f64; 2] {
        let left = (1.0 - likeness * likeness).max(1e-12);
        let width = self.band[1] - self.band[0];
        let freedom = (2.0 * width * self.samples as f64 / self.rate * self.known.len() as f64).max(2.0);
        let error = |fall: f64, reach: f64| {
            let curvature = 2.0 * fall.max(1e-15) / (reach * reach);
            (left / (likeness.max(0.1) * curvature * freedom)).sqrt()
        };
        let (near, cross) = (0.25 * step, self.cross(change));
        let sides = [change - near, change + near].map(|change| self.at(change, FINEST)[1]);
        let around = [late - 0.5, late + 0.5].map(|late| self.read(&cross, late));
        let fall = |sides: [f64; 2]| likeness - 0.5 * (sides[0] + sides[1]);
        [error(fall(around), 0.5), error(fall(sides), near)]
    }
}

/// A response in its band, faded at its end so that the cut there does not count.
fn faded(signal: &[f64], band: Band, rate: f64) -> Vec<f64> {
    let mut signal = signal.to_vec();
    let length = signal.len() as f64;
    let gate = crate::signals::Gate { begin: -1.0, rise: 1.0, end: length, fall: length / 4.0 };
    gate.apply(&mut signal);
    // A band out of range leaves the signal unchanged: its lines are taken within the band anyway.
    let _ = band.limit(&mut signal, rate);
    signal
}

fn normed(mut lines: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    let power: f64 = lines.iter().map(Complex::norm_sqr).sum();
    let scale = if power > 0.0 { 1.0 / power.sqrt() } else { 0.0 };
    lines.iter_mut().for_each(|x| *x *= scale);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::shift;
    use unripple_core::Sheet;
    use unripple_physics::design::papers_surface;

    fn film() -> Sheet {
        papers_surface().sheet
    }

    /// Modes whose frequencies follow the dispersion relation, under a change of tension.
    fn ringing(seed: u64, law: &Law, change: f64) -> Vec<f64> {
        let hz = |m: u64| 150.0 + 2500.0 * ((m * 7919 + seed * 104_729) % 1009) as f64 / 1009.0;
        let weight = |m: u64| ((m * 31 + seed * 17) % 13) as f64 / 6.0 - 1.0;
        let modes: Vec<[f64; 2]> = (0..120).map(|m| [law.changed(hz(m), change)[0], weight(m)]).collect();
        (0..4800)
            .map(|i| {
                let t = i as f64 / 48e3;
                modes.iter().map(|[hz, w]| w * (-t / 0.07).exp() * (TAU * hz * t).cos()).sum()
            })
            .collect()
    }

    #[test]
    fn delay_and_tension_are_told_apart() {
        let (rate, band) = (48e3, Band::within(60.0, 3600.0));
        let law = Law::of(&film(), 4000.0);
        for (late, change) in [(0.0, 0.0), (0.37, 0.005), (-0.8, -0.003), (0.02, 0.01)] {
            let known: Vec<Vec<f64>> = (1..4).map(|seed| ringing(seed, &law, 0.0)).collect();
            let found: Vec<Vec<f64>> = (1..4).map(|seed| shift(&ringing(seed, &law, change), late)).collect();
            let pairs: Vec<_> = known.iter().zip(&found).map(|(a, b)| (&a[..], &b[..])).collect();
            let apart = Pairs::of(&pairs, 0, rate, band, &law).unwrap().apart(Change::Near(0.0));
            assert!((apart.late - late).abs() < 0.02, "{late} {change}: {apart:?}");
            assert!((apart.change - change).abs() < 2e-5, "{late} {change}: {apart:?}");
            assert!(apart.likeness > 0.995, "{late} {change}: {apart:?}");
        }
    }
}
