//! Spectrum slicing: eigenpairs found at several shifts are joined, without duplicates or omissions.

use super::SpectrumError;
use super::block::EigenBlock;
use super::panel::{NONE, Panel, project, subtract};
use super::pencil::Pencil;
use super::plan::{Plan, Shift, factor_near};
use super::shift_invert::{Wanted, nearest};
use super::small::transposed;
use rayon::prelude::*;
use unripple_core::{Observed, Steps};

/// Number of eigenpairs requested from a shift in addition to its part of the spectrum, so that clusters
/// need not be divided. With twice this value, each shift computes two more that are not needed.
const MARGIN: usize = 2;
/// Least distance, relative to the interval, between the eigenvalues taken from one shift and those from
/// the next: nearer ones may be the same eigenvalue, and the interval then gets another shift. With twice
/// this value, that happens more often.
const CLEAR: f64 = 1e-6;
/// Largest number of searches for eigenvectors of one eigenvalue; each search finds up to a panel of them,
/// 320 in all. More are an error.
const ROUNDS: usize = 40;
/// Number of panels on either side of a boundary between parts of the spectrum that are made orthogonal to
/// each other: those of the nearest eigenvalues, whose vectors are mixed by rounding errors. With twice
/// this value, vectors that are orthogonal already are compared as well.
const NEIGHBOURS: usize = 3;

/// An interval of the spectrum between two shifts, or between a shift and an end.
#[derive(Clone, Copy, Debug)]
struct Gap {
    from: f64,
    to: f64,
    /// Numbers of eigenvalues below the two ends of the interval.
    below: [usize; 2],
}

impl Gap {
    fn count(&self) -> usize {
        self.below[1] - self.below[0]
    }

    fn holds(&self, value: f64) -> bool {
        let beyond = 1e-9 * self.to.abs();
        value > self.from && value < self.to + beyond
    }
}

/// All eigenpairs below the bound of a plan, as a list of blocks in ascending order.
///
/// # Errors
/// [`SpectrumError::Missed`] if their number is not that given by inertia.
pub(super) fn all(
    pencil: &Pencil,
    mut plan: Plan,
    observed: &Observed,
) -> Result<Vec<EigenBlock>, SpectrumError> {
    let gaps = gaps(&plan);
    observed.part(|| format!("{} modes from {} shifts", plan.below, plan.shifts.len()));
    let steps = observed.steps(plan.shifts.len());
    let wanted: Vec<Wanted> =
        gaps.windows(2).enumerate().map(|(i, pair)| wanted(pair, i, gaps.len())).collect();
    let pieces: Vec<EigenBlock> = std::mem::take(&mut plan.shifts)
        .into_par_iter()
        .zip(&wanted)
        .enumerate()
        .map(|(i, (shift, wanted))| shift_invert(pencil, shift, *wanted, i as u64, &steps))
        .collect::<Result<_, _>>()?;
    let parted: Vec<Option<usize>> = gaps.iter().enumerate().map(|(i, gap)| part(gap, i, &pieces)).collect();
    let mut out: Vec<EigenBlock> = Vec::new();
    let mut pieces = pieces.into_iter();
    for (i, (gap, here)) in gaps.iter().zip(&parted).enumerate() {
        if here.is_none() {
            out.push(resolve(pencil, gap)?);
        }
        if let Some(mut piece) = pieces.next() {
            let from = here.map_or(piece.left, |right| piece.left + right - gap.count());
            piece.keep(from..piece.left + parted[i + 1].unwrap_or(0));
            out.push(piece);
        }
    }
    out.retain(|piece| !piece.values.is_empty());
    for i in 1..out.len() {
        let (before, after) = out.split_at_mut(i);
        let (before, after) = (&mut before[i - 1].panels, &mut after[0].panels);
        let (from, to) = (before.len().saturating_sub(NEIGHBOURS), after.len().min(NEIGHBOURS));
        separate(pencil, &mut before[from..], &mut after[..to]);
    }
    let found = out.iter().map(|piece| piece.values.len()).sum();
    if found != plan.below {
        return Err(SpectrumError::Missed { top: plan.top, expected: plan.below, found });
    }
    Ok(out)
}

/// The intervals between the shifts, the first unbounded below, the last ending at the bound.
fn gaps(plan: &Plan) -> Vec<Gap> {
    let ends = plan.shifts.iter().map(|s| (s.at, s.below)).chain([(plan.top, plan.below)]);
    let mut start = (f64::NEG_INFINITY, 0);
    ends.map(|end| {
        let gap = Gap { from: start.0, to: end.0, below: [start.1, end.1] };
        start = end;
        gap
    })
    .collect()
}

/// The numbers of eigenpairs requested from the shift between interval `i` and the next.
fn wanted(pair: &[Gap], i: usize, count: usize) -> Wanted {
    let (left, right) = (pair[0].count(), pair[1].count());
    Wanted {
        left: if i == 0 { left } else { left.min(left.div_ceil(2) + MARGIN) },
        right: if i + 2 == count { right } else { right.min(right.div_ceil(2) + MARGIN) },
    }
}

/// The eigenpairs nearest to one shift; factors that were not stored are computed again.
fn shift_invert(
    pencil: &Pencil,
    shift: Shift,
    wanted: Wanted,
    seed: u64,
    steps: &Steps,
) -> Result<EigenBlock, SpectrumError> {
    if wanted == Wanted::default() {
        steps.take(1.0);
        return Ok(EigenBlock::default());
    }
    let factor = match shift.factor {
        Some(factor) => factor,
        None => factor_near(pencil, shift.at, 0.0)?,
    };
    nearest(pencil, &factor, wanted, &[], (seed, Some(steps)))
}

/// How many of an interval's eigenpairs to take from the shift at its start; the others are taken from the
/// shift at its end. `None` if both shifts together do not have all eigenpairs of the interval, clearly
/// separated.
fn part(gap: &Gap, i: usize, pieces: &[EigenBlock]) -> Option<usize> {
    let count = gap.count();
    let right: &[f64] = if i == 0 { &[] } else { pieces[i - 1].right() };
    let left: &[f64] = pieces.get(i).map_or(&[], |piece| &piece.values[..piece.left]);
    let clear = |p: usize| {
        let last = right[..p].last().copied();
        let first = left[left.len() - (count - p)..].first().copied();
        match (last, first) {
            (Some(last), Some(first)) => (first - last) / (gap.to - gap.from),
            (last, first) => {
                let inside = last.or(first).is_none_or(|value| gap.holds(value));
                if inside { 2.0 * CLEAR } else { f64::NEG_INFINITY }
            }
        }
    };
    let possible = count.saturating_sub(left.len())..=count.min(right.len());
    let (clearance, p) = possible.map(|p| (clear(p), p)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    (clearance > CLEAR).then_some(p)
}

/// All eigenpairs within an interval, found from an additional shift inside it. The search is repeated
/// orthogonally to those already found until none is missing, so that a multiple eigenvalue is found with
/// all its vectors.
fn resolve(pencil: &Pencil, gap: &Gap) -> Result<EigenBlock, SpectrumError> {
    let low = gap.from.max(0.0);
    let factor = factor_near(pencil, low + 0.47 * (gap.to - low), 0.01 * (gap.to - low))?;
    let mut whole = EigenBlock::default();
    for round in 0..ROUNDS {
        let done = whole.values.iter().filter(|value| **value < factor.shift).count();
        let wanted = Wanted {
            left: factor.below.saturating_sub(gap.below[0] + done),
            right: gap.below[1].saturating_sub(factor.below.max(gap.below[0]) + whole.values.len() - done),
        };
        if wanted == Wanted::default() {
            break;
        }
        let mut piece = nearest(pencil, &factor, wanted, &whole.panels, (round as u64, None))?;
        let from = piece.values.partition_point(|value| *value <= gap.from);
        piece.keep(from..piece.values.partition_point(|value| gap.holds(*value)).max(from));
        if piece.values.is_empty() {
            break;
        }
        whole.append(piece);
    }
    Ok(whole)
}

/// Makes the vectors of two blocks, each M-orthonormal, orthogonal to each other by changing both equally.
fn separate(pencil: &Pencil, before: &mut [Panel], after: &mut [Panel]) {
    let old = after.to_vec();
    let mut factors = vec![Vec::new(); before.len()];
    let mut weighed = vec![NONE; pencil.len()];
    for panel in after.iter_mut() {
        pencil.weigh(panel, &mut weighed);
        let mut halves = project(pencil.arch, before.iter(), &weighed);
        halves.iter_mut().flatten().flatten().for_each(|v| *v *= 0.5);
        subtract(pencil.arch, before, &halves, panel);
        for (factors, half) in factors.iter_mut().zip(&halves) {
            factors.push(transposed(half));
        }
    }
    for (panel, factors) in before.iter_mut().zip(&factors) {
        subtract(pencil.arch, &old, factors, panel);
    }
}
