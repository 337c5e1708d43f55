//! The fit of a surface to frequencies: quantities that are told, the surface that explains most, and others that explain as much.

use super::arranged::Arrangements;
use super::explained::weakest;
use super::losses::FittedLosses;
use super::model::Model;
use super::solve::{Problem, Solved};
use super::starts::minima;
use super::telling::compared;
use super::{Explained, Heard, Quantity, Telling};
use crate::CalibrateError;
use unripple_core::{Observed, OutOfRange, Surface};

/// A direction in the logarithms of the quantities with a larger standard deviation is not told: its 95 % interval is more than a factor of
/// two either way.
const UNTOLD: f64 = 0.35;

/// A part of a direction that is left out when it is told in words.
const SLIGHT: f64 = 0.1;

/// Excess of the cost up to which another surface explains frequencies as well: the 95 % quantile of χ² with two degrees of freedom.
const AS_WELL: f64 = 5.99;

/// Two surfaces are different ones where a quantity differs by more than this many of its standard deviations.
const DIFFERENT: f64 = 3.0;

/// Most frequencies of a fit: with more, it is fitted to a recording.
const MOST: usize = 200;

/// What is fitted to frequencies, and how far they are trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyOptions {
    /// Quantities to fit; if empty, those that are [usual](Quantity::usual) for the surface.
    pub free: Vec<Quantity>,
    /// Relative standard deviation of the measured frequencies, and of the model itself.
    pub error: f64,
    /// Whether it is certain which side is held in which way; if not, other arrangements are tried.
    pub sides_known: bool,
}

impl Default for FrequencyOptions {
    fn default() -> Self {
        Self { free: Vec::new(), error: 0.01, sides_known: false }
    }
}

/// A quantity that frequencies do not tell, and that keeps its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Untold {
    /// The quantity that keeps the value of the file.
    pub held: Quantity,
    /// The product of powers of quantities that is not told, by its exponents, the largest of which is 1.
    pub direction: Vec<(Quantity, f64)>,
    /// The standard deviation of its logarithm; `None` if frequencies tell nothing of it.
    pub deviation: Option<f64>,
}

/// Another surface that explains the frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Other {
    /// The surface and how it explains them.
    pub explained: Explained,
    /// Whether it is a mirror image, which no frequency tells from the first.
    pub mirrored: bool,
    /// What would tell it from the first; `None` if neither a frequency nor the motion at a place does.
    pub telling: Option<Telling>,
}

/// A surface fitted to frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyFit {
    /// The surface that explains most, held as in its file.
    pub best: Explained,
    /// Other surfaces that explain as much, or more because their sides are held otherwise.
    pub others: Vec<Other>,
    /// What frequencies do not tell.
    pub untold: Vec<Untold>,
    /// Damping by the decay times, if there were any.
    pub losses: Option<FittedLosses>,
    /// Number of starts of the fit.
    pub starts: usize,
}

/// Fits quantities of a surface to measured frequencies, in any order.
///
/// The cost is the sum of the squared relative residuals over the stated error, and a price for each mode that was not heard and for each
/// frequency that is no mode. It is lowered from several starts, over three octaves either way. An interval of a quantity holds under the
/// stated error, or under the residuals' own where these are larger.
///
/// # Errors
/// [`CalibrateError::Count`] of too few or too many frequencies; [`CalibrateError::Range`] of a frequency, decay time or error that is
/// none; [`CalibrateError::Unsolvable`] of a quantity that the surface does not have, or if frequencies tell none; those of computing
/// modes.
pub fn fit_frequencies(
    surface: &Surface,
    heard: &[Heard],
    options: &FrequencyOptions,
) -> Result<FrequencyFit, CalibrateError> {
    let (problem, order) = problem(heard, options)?;
    let mut free = free(surface, options)?;
    let mut untold = Vec::new();
    let (model, found, starts) = loop {
        let model = Model::new(surface, &free);
        let (found, starts) = minima(&model, &problem)?;
        let first = found.first().ok_or_else(|| untellable("no frequency is near a mode"))?;
        let Some(weak) = untold_of(&model, &problem, first) else { break (model, found, starts) };
        free.retain(|quantity| *quantity != weak.held);
        untold.push(weak);
        if free.is_empty() {
            return Err(untellable("frequencies that tell none of them"));
        }
    };
    let mut best = Explained::of(&model, &problem, &order, &found[0]);
    let losses = FittedLosses::of(&best, heard, &found[0].computed.bending);
    if let Some(losses) = &losses {
        losses.put(&mut best.surface);
    }
    let allowed = best.cost + AS_WELL * best.excess.max(1.0).powi(2);
    let mut others = Vec::new();
    for solved in found.iter().skip(1).filter(|solved| explains(solved, allowed)) {
        let explained = Explained::of(&model, &problem, &order, solved);
        if differs(&explained, &best) {
            others.push((explained, false));
        }
    }
    if !options.sides_known {
        others.extend(arranged_otherwise(&best, surface, &free, (&problem, order.as_slice()), allowed));
    }
    let others = told(&best, others, &problem)?;
    Ok(FrequencyFit { best, others, untold, losses, starts })
}

/// The frequencies as a fit takes them, ascending, and the index of each in the order given.
fn problem(heard: &[Heard], options: &FrequencyOptions) -> Result<(Problem, Vec<usize>), CalibrateError> {
    if !(1..=MOST).contains(&heard.len()) {
        let (what, expected) = ("measured frequencies", format!("1 to {MOST}"));
        return Err(CalibrateError::Count { what, expected, found: heard.len() });
    }
    if !(1e-5..=0.2).contains(&options.error) {
        let (what, expected) = ("relative error of the frequencies", "0.00001 to 0.2");
        return Err(OutOfRange::new(what, expected, options.error).into());
    }
    for Heard { hz, decay_time } in heard {
        if !(0.1..=1e6).contains(hz) {
            return Err(OutOfRange::new("measured frequency in Hz", "0.1 to 1e6", *hz).into());
        }
        if let Some(time) = decay_time.filter(|time| !(1e-5..=1e3).contains(time)) {
            return Err(OutOfRange::new("measured decay time in s", "0.00001 to 1000", time).into());
        }
    }
    let mut order: Vec<usize> = (0..heard.len()).collect();
    order.sort_by(|a, b| heard[*a].hz.total_cmp(&heard[*b].hz));
    let logs = order.iter().map(|i| heard[*i].hz.ln()).collect();
    Ok((Problem { logs, deviation: options.error }, order))
}

/// The quantities to fit, each once.
fn free(surface: &Surface, options: &FrequencyOptions) -> Result<Vec<Quantity>, CalibrateError> {
    let mut free = match options.free.is_empty() {
        true => Quantity::usual(surface),
        false => options.free.clone(),
    };
    free.sort_unstable();
    free.dedup();
    match free.iter().find(|quantity| quantity.value(surface).is_none()) {
        Some(quantity) => Err(CalibrateError::Unsolvable {
            what: "quantities to fit",
            expected: "some that the surface has, with values above 0 to begin with",
            found: quantity.name(),
        }),
        None => Ok(free),
    }
}

/// The direction that frequencies do not tell, if there is one, and which quantity is held for it.
fn untold_of(model: &Model<'_>, problem: &Problem, solved: &Solved) -> Option<Untold> {
    let (direction, deviation) = weakest(solved, problem)?;
    if deviation <= UNTOLD {
        return None;
    }
    let (held, largest) =
        model.free.iter().zip(&direction).fold((model.free[0], 0.0_f64), |most, (quantity, part)| {
            if part.abs() > most.1.abs() { (*quantity, *part) } else { most }
        });
    let parts = model.free.iter().zip(&direction).map(|(quantity, part)| (*quantity, part / largest));
    Some(Untold {
        held,
        direction: parts.filter(|(_, part)| part.abs() >= SLIGHT).collect(),
        deviation: deviation.is_finite().then_some(deviation),
    })
}

/// Surfaces whose sides are held as others are, and whether each is only mirrored.
fn arranged_otherwise(
    best: &Explained,
    surface: &Surface,
    free: &[Quantity],
    (problem, order): (&Problem, &[usize]),
    allowed: f64,
) -> Vec<(Explained, bool)> {
    let mut others = Vec::new();
    for mirrored in Arrangements::of(&best.surface).mirrored {
        let sides = super::arranged::words(&mirrored.outline);
        let explained = Explained { surface: mirrored, sides, ..best.clone() };
        others.push((explained, true));
    }
    for arranged in Arrangements::of(surface).others {
        Observed::here()
            .part(|| format!("sides held otherwise: {}", super::arranged::words(&arranged.outline)));
        let model = Model::new(&arranged, free);
        // An arrangement that cannot be computed, as one that nothing holds, is none.
        let Ok((found, _)) = minima(&model, problem) else { continue };
        let Some(solved) = found.first().filter(|solved| explains(solved, allowed)) else { continue };
        others.push((Explained::of(&model, problem, order, solved), false));
    }
    others
}

/// Other surfaces, and whether each is only mirrored, with what would tell them from the best one.
fn told(
    best: &Explained,
    others: Vec<(Explained, bool)>,
    problem: &Problem,
) -> Result<Vec<Other>, CalibrateError> {
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let first = compared(&best.surface, problem)?;
    let one = |(explained, mirrored): (Explained, bool)| {
        let own = compared(&explained.surface, problem)?;
        let telling = Telling::of(&best.surface, [&first, &own], problem);
        Ok(Other { explained, mirrored, telling })
    };
    others.into_iter().map(one).collect()
}

/// Whether a solution explains frequencies at an allowed cost, and not by taking all of them for something else.
fn explains(solved: &Solved, allowed: f64) -> bool {
    solved.matching.cost <= allowed && !solved.matching.pairs.is_empty()
}

/// Whether two surfaces of one arrangement are different: in a value, or in which mode a frequency is.
fn differs(one: &Explained, other: &Explained) -> bool {
    let pairs = |of: &Explained| of.modes.iter().map(|mode| (mode.heard, mode.mode)).collect::<Vec<_>>();
    let far = one.values.iter().zip(&other.values).any(|(a, b)| {
        let half = (b.interval[1] / b.value).ln();
        (a.value / b.value).ln().abs() > 0.5 * DIFFERENT * half
    });
    far || pairs(one) != pairs(other)
}

fn untellable(found: &str) -> CalibrateError {
    CalibrateError::Unsolvable {
        what: "quantities of the surface",
        expected: "frequencies that tell at least one of them",
        found: found.to_owned(),
    }
}
