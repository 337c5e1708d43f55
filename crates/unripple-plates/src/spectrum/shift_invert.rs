//! Shift-and-invert Lanczos at one shift.

use super::SpectrumError;
use super::block::EigenBlock;
use super::factor::Factor;
use super::lanczos::{Lanczos, Ritz};
use super::panel::{LANES, NONE, Panel, project, subtract};
use super::pencil::Pencil;
use super::solve::solve;
use unripple_core::Steps;

/// Relative residual, as estimated by the iteration, below which an eigenpair counts as found: the error of
/// its eigenvalue is about the square of the residual, below rounding errors. Ten times more saves one or
/// two steps.
const FOUND: f64 = 1e-9;
/// Largest accepted relative residual when it is computed from the vector itself: ten times the estimate,
/// since rounding errors add to it.
const CHECKED: f64 = 1e-8;
/// Approximate number of steps until the first eigenpairs near a shift are found: with fewer, the small eigenvalue problem is
/// solved too early; with more, steps are wasted.
const START: usize = 17;
/// Approximate number of further steps for each panel of eigenpairs. With twice this value, more steps are taken than needed; halved, the
/// small eigenvalue problem is solved too early.
const PACE: f64 = 1.5;
/// Approximate number of decades by which a small residual falls with each step. With twice this value, the next
/// check comes too early; halved, too late.
const DECADES: f64 = 0.7;
/// Largest number of steps, as a multiple of the expected number: eigenpairs not found by then belong to an
/// eigenvalue of higher multiplicity than the block, and are found by another search. With twice this
/// value, that is noticed later.
const PATIENCE: usize = 3;

/// Share of the work at a shift that is reported as progress while its basis grows. Nearer to 1, less is
/// left for vectors and residuals.
const ITERATING: f64 = 0.9;

/// Numbers of eigenpairs requested on either side of a shift.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wanted {
    /// Number of eigenpairs below the shift.
    pub(super) left: usize,
    /// Number of eigenpairs above the shift.
    pub(super) right: usize,
}

/// The requested numbers of eigenpairs nearest to a shift on either side, or fewer if not all are found.
/// `known` are eigenvectors to leave out, `seed` starts the random numbers of the first vectors, and the
/// whole search counts as one of the `steps` of progress.
///
/// # Errors
/// [`SpectrumError::Matrices`] if M is not positive definite.
pub(super) fn nearest(
    pencil: &Pencil,
    factor: &Factor,
    wanted: Wanted,
    known: &[Panel],
    (seed, steps): (u64, Option<&Steps>),
) -> Result<EigenBlock, SpectrumError> {
    let mut lanczos = Lanczos::new(pencil, factor, known.to_vec(), seed)?;
    let all = wanted.left + wanted.right;
    let expected = START + (all as f64 * PACE / LANES as f64).ceil() as usize;
    let mut until = expected;
    let mut found = None;
    // The remaining share is reported at the end: vectors, residuals, and panels beyond the expected number.
    let (mut taken, share) = (0.0, ITERATING / expected as f64);
    while found.is_none() {
        let full = lanczos.taken() + LANES > pencil.len() || lanczos.len() >= PATIENCE * expected * LANES;
        if !full && lanczos.len() < until * LANES {
            lanczos.step()?;
            if taken + share <= ITERATING {
                taken += share;
                steps.iter().for_each(|steps| steps.take(share));
            }
            continue;
        }
        let Some(ritz) = lanczos.ritz() else { break };
        let have = ritz.found();
        if full || have.left >= wanted.left && have.right >= wanted.right {
            found = Some((ritz, have));
        } else {
            until += ritz.steps_to(wanted);
        }
    }
    let rest = || steps.iter().for_each(|steps| steps.take(1.0 - taken));
    let Some((ritz, have)) = found else {
        rest();
        return Ok(EigenBlock::default());
    };
    let (left, right) = (have.left.min(wanted.left), have.right.min(wanted.right));
    let count = ritz.inverses.len();
    let numbers: Vec<usize> = (0..left).rev().chain((count - right..count).rev()).collect();
    let values = numbers.iter().map(|i| factor.shift + 1.0 / ritz.inverses[*i]).collect();
    let panels = lanczos.vectors(&ritz, &numbers);
    let inverses: Vec<f64> = numbers.iter().map(|i| ritz.inverses[*i]).collect();
    let residuals = residuals(pencil, factor, &inverses, &panels);
    let from = left - residuals[..left].iter().rev().take_while(|r| **r < CHECKED).count();
    let to = left + residuals[left..].iter().take_while(|r| **r < CHECKED).count();
    let mut piece = EigenBlock::new(values, residuals, panels, left);
    piece.keep(from..to);
    rest();
    Ok(piece)
}

/// Residuals computed from the vectors themselves: norms in M of (K - σM)⁻¹Mx - x/(λ-σ), times abs(λ-σ).
fn residuals(pencil: &Pencil, factor: &Factor, inverses: &[f64], panels: &[Panel]) -> Vec<f64> {
    let mut rows = Vec::new();
    let (mut weighed, mut rest) = (vec![NONE; pencil.len()], vec![NONE; pencil.len()]);
    let mut out = Vec::new();
    for (inverses, panel) in inverses.chunks(LANES).zip(panels) {
        pencil.weigh(panel, &mut rest);
        solve(pencil.arch, factor, &mut rest, &mut rows);
        let mut diagonal = [NONE; LANES];
        inverses.iter().enumerate().for_each(|(i, inverse)| diagonal[i][i] = *inverse);
        subtract(pencil.arch, std::slice::from_ref(panel), &[diagonal], &mut rest);
        pencil.weigh(&rest, &mut weighed);
        let gram = project(pencil.arch, [&rest], &weighed)[0];
        out.extend(
            inverses.iter().enumerate().map(|(i, inverse)| gram[i][i].max(0.0).sqrt() / inverse.abs()),
        );
    }
    out
}

impl Ritz {
    /// Approximate number of further steps until the requested eigenpairs are found.
    fn steps_to(&self, wanted: Wanted) -> usize {
        let count = self.residuals.len();
        let sides = self.residuals[..wanted.left.min(count)]
            .iter()
            .chain(&self.residuals[count.saturating_sub(wanted.right)..]);
        let worst = sides.fold(FOUND, |a, b| a.max(*b)).min(1.0);
        ((worst / FOUND).log10() / DECADES).ceil().max(1.0) as usize
    }

    /// The numbers of converged eigenpairs on either side, counted from the shift outwards up to the first
    /// that has not converged.
    fn found(&self) -> Wanted {
        let good =
            |(inverse, residual): &(&f64, &f64), side: f64| **inverse * side > 0.0 && **residual < FOUND;
        let pairs = self.inverses.iter().zip(&self.residuals);
        Wanted {
            left: pairs.clone().take_while(|pair| good(pair, -1.0)).count(),
            right: pairs.rev().take_while(|pair| good(pair, 1.0)).count(),
        }
    }
}
