//! Exchanged, reversed and dead wires: the permutation of the drive that explains the recordings best.

use super::agreement::Agreement;
use super::lines::Spectrum;
use super::model::Model;
use unripple_dsp::Complex;

/// Largest number of faults that are searched for one after another: with more, most of the drive is another.
const MOST: usize = 3;

/// Share of the unexplained energy that may stay when a fault is assumed for it to be kept. A change that is none of the
/// real ones leaves nearly all.
const KEPT: f64 = 0.6;

/// A fault of the wires between amplifiers and actuators; actuators by their index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WireFault {
    /// Two actuators got each other's drive.
    Swapped(usize, usize),
    /// An actuator got its drive with the other sign.
    Reversed(usize),
    /// An actuator got no drive.
    Dead(usize),
}

/// Which drive each actuator gets, and with which factor.
type Wiring = Vec<(usize, f64)>;

impl WireFault {
    fn all(actuators: usize) -> impl Iterator<Item = Self> {
        let single = (0..actuators).flat_map(|a| [Self::Reversed(a), Self::Dead(a)]);
        single.chain((0..actuators).flat_map(move |a| (a + 1..actuators).map(move |b| Self::Swapped(a, b))))
    }

    fn apply(self, wiring: &mut Wiring) {
        match self {
            Self::Swapped(a, b) => wiring.swap(a, b),
            Self::Reversed(a) => wiring[a].1 = -wiring[a].1,
            Self::Dead(a) => wiring[a].1 = 0.0,
        }
    }

    /// The actuators that it concerns.
    pub fn actuators(self) -> Vec<usize> {
        match self {
            Self::Swapped(a, b) => vec![a, b],
            Self::Reversed(a) | Self::Dead(a) => vec![a],
        }
    }
}

/// Finds faults one after another, each the one that explains most, while they explain much; returns them with the agreement
/// under all of them.
pub(super) fn search(
    model: &Model,
    heard: &[Spectrum],
    responses: &[Spectrum],
    drive: &[Spectrum],
    before: Agreement,
) -> (Vec<WireFault>, Agreement) {
    let mut wiring: Wiring = (0..model.actuators()).map(|a| (a, 1.0)).collect();
    let mut predicted = model.sums(responses, drive);
    let (mut faults, mut now) = (Vec::new(), before);
    while faults.len() < MOST {
        let tried = WireFault::all(model.actuators()).map(|fault| {
            let mut other = wiring.clone();
            fault.apply(&mut other);
            let sums = moved(model, &predicted, responses, drive, [&wiring, &other], fault);
            (Agreement::of(model.lines(), heard, &sums), fault, other, sums)
        });
        let best = tried.min_by(|a, b| a.0.left.total_cmp(&b.0.left));
        let Some((found, fault, other, sums)) = best.filter(|best| best.0.left < KEPT * now.left) else {
            break;
        };
        (now, wiring, predicted) = (found, other, sums);
        faults.push(fault);
    }
    (faults, now)
}

/// The predicted spectra after a change of the wiring at the actuators of a fault.
fn moved(
    model: &Model,
    predicted: &[Spectrum],
    responses: &[Spectrum],
    drive: &[Spectrum],
    [before, after]: [&Wiring; 2],
    fault: WireFault,
) -> Vec<Spectrum> {
    let mut sums = predicted.to_vec();
    for a in fault.actuators() {
        let got = |line: usize, (from, factor): (usize, f64)| drive[from][line] * factor;
        let change: Vec<Complex<f64>> =
            (0..model.lines().count()).map(|line| got(line, after[a]) - got(line, before[a])).collect();
        for (place, sum) in sums.iter_mut().enumerate() {
            let response = &responses[place * model.actuators() + a];
            sum.iter_mut().zip(response).zip(&change).for_each(|((to, h), d)| *to += h * d);
        }
    }
    sums
}
