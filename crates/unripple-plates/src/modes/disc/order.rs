//! The modes of one angular order.

use super::super::losses;
use super::super::ritz::{lowest, missing};
use super::energy::Energy;
use super::problem::Problem;
use super::radial::Radial;
use unripple_linalg::{Mat, Par};

/// Largest number of rounds, each with a quarter more functions. A first round is nearly always enough; more would only delay the failure.
const ROUNDS: usize = 8;

/// The modes of one angular order n: shapes Σ_j c_j f_j(r/a) cos nθ and, but for n = 0, sin nθ.
#[derive(Debug)]
pub(super) struct OrderModes {
    pub(super) radial: Radial,
    /// ω², ascending, in 1/s²; rigid-body modes first, at 0.
    pub(super) squares: Vec<f64>,
    pub(super) bending_shares: Vec<f64>,
    /// What a loss factor changes to second order, of each mode; see [`losses::second`].
    pub(super) second: Vec<f64>,
    /// Coefficients, functions x modes, with orthonormal columns.
    pub(super) coefficients: Mat<f64>,
    /// Largest relative error of a frequency for want of further functions, estimated.
    missing: f64,
    /// A bound of the relative error of a squared frequency by rounding.
    rounded: f64,
}

impl OrderModes {
    /// Solves with more and more functions until the estimated error is at most the requested one, or rounding errors are most of it; `None` if
    /// an eigenvalue iteration does not converge.
    pub(super) fn solve(problem: &Problem, order: usize) -> Option<Self> {
        let mut count = first_count(problem, order);
        let mut found = Self::with(problem, order, count)?;
        for _ in 1..ROUNDS {
            let error = found.error();
            if error <= problem.bounds.accuracy || 2.0 * found.rounded > error {
                break;
            }
            count += (count / 4).max(2);
            found = Self::with(problem, order, count)?;
        }
        Some(found)
    }

    /// Largest relative error of a frequency, estimated.
    pub(super) fn error(&self) -> f64 {
        self.missing + self.rounded
    }

    /// The modes in `count` functions; `None` if the eigenvalue iteration does not converge.
    fn with(problem: &Problem, order: usize, count: usize) -> Option<Self> {
        let top = problem.bounds.top_square();
        let rigid = problem.rigid(order);
        let radial = Radial::new(order, problem.zeros(), count + (count / 4).max(3));
        let energy = Energy::new(problem, &radial);
        let mut lifted = energy.matrix(rigid);
        let n = count - rigid;
        let (squares, vectors) = lowest(&lifted.as_ref().submatrix(0, 0, n, n).to_owned(), top, Par::Seq)?;
        let between = lifted.as_ref().submatrix(n, 0, lifted.nrows() - n, n).to_owned();
        (0..lifted.nrows()).for_each(|i| lifted[(i, i)] -= top);
        let missing = missing(lifted, between.as_ref(), (&squares, &vectors), top, Par::Seq);
        let inside = squares.partition_point(|square| *square <= top);
        let rounded = energy.rounded(rigid, (&squares[..inside], vectors.as_ref()));
        let mut coefficients = Mat::zeros(radial.count(), rigid + inside);
        (0..rigid).for_each(|m| coefficients[(m, m)] = 1.0);
        coefficients
            .as_mut()
            .submatrix_mut(rigid, rigid, n, inside)
            .copy_from(vectors.as_ref().subcols(0, inside));
        let squares: Vec<f64> =
            std::iter::repeat_n(0.0, rigid).chain(squares[..inside].iter().copied()).collect();
        let bent = energy.of_bending(coefficients.as_ref());
        let share = |(m, square): (usize, &f64)| {
            if *square > 0.0 { (bent[(m, m)] / square).clamp(0.0, 1.0) } else { 0.0 }
        };
        let bending_shares = squares.iter().enumerate().map(share).collect();
        let far = losses::far(&[problem.edge], true);
        let second = losses::second(&squares, bent.as_ref(), far, f64::INFINITY);
        Some(Self { radial, squares, bending_shares, second, coefficients, missing, rounded })
    }
}

/// Number of functions to begin with: their degree n + 2j reaches ka and as far beyond as the Bessel functions of such waves take to fall to the
/// accuracy, about exp(-(4√2/3) δ^1.5 / √(ka)) at the degree ka + δ (Debye's expansion; DLMF 10.19), and they resolve a boundary layer.
fn first_count(problem: &Problem, order: usize) -> usize {
    let reach = problem.bounds.k_top * problem.radius;
    let digits = -problem.bounds.accuracy.ln() + 2.0;
    let beyond = (0.53 * digits).powf(2.0 / 3.0) * reach.max(1.0).cbrt();
    let degrees = reach + beyond - order as f64 - f64::from(2 * problem.zeros());
    (0.5 * degrees).max(problem.in_layer()).ceil().max(0.0) as usize + 4
}
