//! Choice of the shifts that divide a spectrum into parts (spectrum slicing).

use super::SpectrumError;
use super::factor::Factor;
use super::pencil::Pencil;
use rayon::prelude::*;
use unripple_core::Observed;
use unripple_linalg::Par;

/// Approximate number of eigenpairs computed at each shift. With twice this value, there are half as many
/// factorisations, and bases of about twice as many vectors, each of which is made orthogonal to all
/// vectors before it.
pub(super) const SHARE: usize = 160;
/// Growth of the factors ([`Factor::growth`]), per eigenvalue below the shift, above which another shift is
/// tried.
const GROWTH: f64 = 16.0;
/// Number of shifts tried, each a little above the previous one; if none is acceptable, the one of least
/// growth is used.
const TRIES: usize = 6;
/// Relative distance between successive shifts that are tried. With twice this value, shifts may be 1 %
/// from their intended positions.
pub(super) const STEP: f64 = 1e-3;
/// Number of rounds of placing shifts: each replaces those too far from their intended positions. More
/// rounds only make the parts of the spectrum more equal.
const ROUNDS: usize = 4;
/// Accepted distance of a shift from its intended position, relative to the number of eigenpairs per shift.
/// With twice this value, fewer shifts are placed again, and the parts of the spectrum are less equal.
const SLACK: f64 = 0.1;
/// Memory in bytes for factors that are stored for later use, a quarter of a GiB; if they need more, they
/// are computed again. With twice this value, fewer are computed twice, for more memory.
pub(super) const KEPT: usize = 1 << 28;

/// A shift and the number of eigenvalues below it.
#[derive(Debug)]
pub(super) struct Shift<'a> {
    /// The shift σ.
    pub(super) at: f64,
    /// Number of eigenvalues below the shift.
    pub(super) below: usize,
    /// Factors of K - σM at the shift, if they fit into the memory for stored factors.
    pub(super) factor: Option<Factor<'a>>,
}

/// Shifts, ascending, with about equal numbers of eigenvalues between neighbouring shifts, and half as many
/// at the ends.
#[derive(Debug)]
pub(super) struct Plan<'a> {
    /// The shifts, ascending.
    pub(super) shifts: Vec<Shift<'a>>,
    /// The bound below which eigenpairs are requested, moved slightly if it is an eigenvalue.
    pub(super) top: f64,
    /// Number of eigenvalues below the bound.
    pub(super) below: usize,
}

/// Factors of K - σM at a shift σ or, if pivots are close to zero there, at a shift that is one to five
/// times `step` higher.
///
/// The growth of factors is about proportional to the number of eigenvalues below, except for shifts where it is far larger by
/// chance. These are avoided, since growth loses accuracy.
///
/// # Errors
/// [`SpectrumError::Factors`] if there are none.
pub(super) fn factor_near(pencil: &Pencil, shift: f64, step: f64) -> Result<Factor<'_>, SpectrumError> {
    let mut best: Option<Factor> = None;
    for nudge in 0..TRIES {
        let factor = Factor::new(pencil, shift + nudge as f64 * step, Par::Seq)?;
        let Some(factor) = factor else { continue };
        if factor.growth < GROWTH * (factor.below + 16) as f64 {
            return Ok(factor);
        }
        if best.as_ref().is_none_or(|best| factor.growth < best.growth) {
            best = Some(factor);
        }
    }
    best.ok_or(SpectrumError::Factors { shift })
}

impl<'a> Plan<'a> {
    /// Chooses shifts for all eigenvalues below a bound.
    ///
    /// # Errors
    /// [`SpectrumError::Factors`] if K - σM cannot be factorised at a bound or shift.
    pub(super) fn new(pencil: &'a Pencil, top: f64, observed: &Observed) -> Result<Self, SpectrumError> {
        observed.part(|| "counting modes".into());
        let first = [1.0, 0.25].par_iter().map(|part| factor_near(pencil, top * part, top * part * STEP));
        let first = first.collect::<Result<Vec<_>, _>>()?;
        let (top, below) = (first[0].shift, first[0].below);
        let count = below.div_ceil(SHARE);
        let kept = count * pencil.factor_bytes() <= KEPT;
        let shift = |factor: Factor<'a>| Shift {
            at: factor.shift,
            below: factor.below,
            factor: kept.then_some(factor),
        };
        let mut known: Vec<Shift> = first.into_iter().map(shift).collect();
        let share = below as f64 / count.max(1) as f64;
        let places: Vec<f64> = (0..count).map(|i| (i as f64 + 0.5) * share).collect();
        for round in 1..=ROUNDS {
            known.sort_by(|a, b| a.at.total_cmp(&b.at));
            let off = |place: &&f64| {
                known.iter().all(|k| (k.below as f64 - **place).abs() > SLACK * share || k.at >= top)
            };
            let wanted: Vec<f64> = places.iter().filter(off).map(|place| guess(&known, *place)).collect();
            if wanted.is_empty() {
                break;
            }
            observed.part(|| format!("placing shifts, round {round} of {ROUNDS} at most"));
            let steps = observed.steps(wanted.len());
            let more =
                wanted.par_iter().map(|at| factor_near(pencil, *at, at * STEP)).inspect(|_| steps.take(1.0));
            known.extend(more.collect::<Result<Vec<_>, _>>()?.into_iter().map(shift));
        }
        known.retain(|k| k.at < top);
        let mut shifts: Vec<Shift> = Vec::new();
        for place in places {
            let distance = |k: &Shift| (k.below as f64 - place).abs();
            let nearest =
                (0..known.len()).min_by(|a, b| distance(&known[*a]).total_cmp(&distance(&known[*b])));
            shifts.extend(nearest.map(|i| known.swap_remove(i)));
        }
        shifts.sort_by(|a, b| a.at.total_cmp(&b.at));
        shifts.dedup_by_key(|shift| shift.below);
        Ok(Self { shifts, top, below })
    }
}

/// Estimated shift with `place` eigenvalues below it: their number is interpolated as a power of the shift between two known shifts.
fn guess(known: &[Shift], place: f64) -> f64 {
    let mut known: Vec<(f64, f64)> = known.iter().map(|k| (k.at, k.below as f64)).collect();
    known.retain(|(_, count)| *count > 0.0);
    known.dedup_by_key(|(_, count)| *count);
    let above = known.iter().position(|(_, count)| *count > place).unwrap_or(known.len() - 1);
    let (at, count) = known[above];
    let other = if above > 0 { known.get(above - 1) } else { known.get(above + 1) };
    // By Weyl's law λ grows as the count to the power 1 on a membrane and 2 on a plate.
    let power = other.map_or(1.3, |other| (at / other.0).ln() / (count / other.1).ln());
    at * (place / count).powf(power.clamp(0.2, 4.0))
}
