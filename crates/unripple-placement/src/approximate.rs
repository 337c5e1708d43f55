//! D-optimal approximate designs: shares of all measurements at each place, with a certificate that none is better.

use crate::informations::{Solved, packed, unpacked, within};
use crate::{Informations, PlacementError, newton};
use unripple_linalg::{Mat, exact_symmetric};

/// Largest excess of the sensitivity over the number of unknowns, relative to it, at which a design is certified.
const TOLERANCE: f64 = 1e-6;

/// Largest number of steps. A few dozen are enough; with this many a design that has not settled is returned as it is.
const STEPS: usize = 500;

/// Share of the mean of all measurements that the first places are chosen beside, so that no direction counts as known before.
const BESIDE: f64 = 1e-6;

/// Halvings of the interval in which the length of a step is sought: all digits that doubles have.
const HALVINGS: usize = 50;

/// Shares of some number of measurements at each place that make the determinant of their information largest.
///
/// With M the information of all of them, and A the information of a design with all of them at one place, both with what is known before,
/// the *sensitivity* of the place is tr(M⁻¹A). A design is the best of all if and only if no sensitivity is above the number of unknowns p
/// (J. Kiefer, J. Wolfowitz, *Canad. J. Math.* 12, 363, 1960). If one is, no design's ln det is more than the excess above that of M, since
/// ln det is concave.
#[derive(Clone, Debug, PartialEq)]
pub struct Approximate {
    /// Share of the measurements at each place; their sum is 1.
    pub weights: Vec<f64>,
    /// Sensitivity of each place, a pure number.
    pub sensitivity: Vec<f64>,
    /// Logarithm of the determinant of the information of as many measurements in these shares.
    pub log_det: f64,
    /// Number of unknowns that the measurements tell of, what is known before discounted: p - tr(M⁻¹B), B what is known before. It is p
    /// where nothing is.
    pub told: f64,
    /// Excess of the largest sensitivity over p, relative to p.
    pub excess: f64,
}

impl Approximate {
    /// Whether the equivalence theorem holds to a millionth.
    pub fn is_certified(&self) -> bool {
        self.excess <= TOLERANCE
    }

    /// The number that ln det of no design of as many measurements exceeds, be they at different places or some at the same.
    pub fn bound(&self, informations: &Informations) -> f64 {
        self.log_det + self.excess.max(0.0) * informations.unknowns() as f64
    }

    /// Least D-efficiency of a design of as many measurements whose information has this ln det, 0 to 1: relative to all designs,
    /// repeated places included. It is the p-th root of a ratio of determinants, p the number of unknowns, what is known before counted
    /// in both: no design leaves variances, along the principal axes, of which the geometric mean is less than so many times that of
    /// this one.
    pub fn efficiency(&self, informations: &Informations, log_det: f64) -> f64 {
        ((log_det - self.bound(informations)) / informations.unknowns() as f64).exp().min(1.0)
    }

    /// Least share, 0 to 1, of what any design of as many measurements adds to the ln det of what is known before, for a design whose
    /// information has this ln det; for a Gaussian prior that is twice the information in nats (D. V. Lindley, *Ann. Math. Statist.* 27,
    /// 986, 1956). Where much is known before, it tells designs apart, and the efficiency does not.
    pub fn added(&self, informations: &Informations, log_det: f64) -> f64 {
        let before = informations.log_det(&[]);
        // Where nothing is known before, any design adds without bound.
        if before.is_finite() {
            ((log_det - before) / (self.bound(informations) - before)).clamp(0.0, 1.0)
        } else {
            1.0
        }
    }
}

/// A design, and what it tells.
struct Here {
    solved: Solved,
    sensitivity: Vec<f64>,
    /// tr(M⁻¹B).
    before: f64,
}

impl Informations {
    /// The D-optimal shares of `count` measurements, by vertex directions (V. V. Fedorov, *Theory of Optimal Experiments*, 1972; H. P.
    /// Wynn, *Ann. Math. Statist.* 41, 1655, 1970): each step moves some of all measurements to the place with the largest sensitivity,
    /// and then shares them anew among the places in use, by Newton's method. It begins with the shares `from`, those of a similar number of
    /// measurements, where they are given.
    ///
    /// # Errors
    /// [`PlacementError::Untold`] if the information of all places is singular to within rounding.
    ///
    /// ```
    /// use unripple_linalg::Mat;
    /// use unripple_placement::Informations;
    ///
    /// // A parabola through measurements at points of -1 to 1: a third of them at either end, a third in the middle.
    /// let at: Vec<f64> = (-10..=10).map(|i| f64::from(i) / 10.0).collect();
    /// let powers = |x: &f64| Mat::from_fn(3, 3, |i, j| x.powi((i + j) as i32));
    /// let all = Informations::new(&Mat::zeros(3, 3), &at.iter().map(powers).collect::<Vec<_>>())?;
    /// let best = all.approximate(1, None)?;
    /// assert!(best.is_certified());
    /// for (x, weight) in at.iter().zip(&best.weights) {
    ///     let exact = if [-1.0, 0.0, 1.0].contains(x) { 1.0 / 3.0 } else { 0.0 };
    ///     assert!((weight - exact).abs() < 1e-3, "{x}: {weight}");
    /// }
    /// # Ok::<(), unripple_placement::PlacementError>(())
    /// ```
    pub fn approximate(&self, count: usize, from: Option<&[f64]>) -> Result<Approximate, PlacementError> {
        let mut weights = match from {
            Some(from) if from.len() == self.places() => from.to_vec(),
            _ => self.begun(count),
        };
        let untold = || PlacementError::Untold { places: self.places(), unknowns: self.unknowns() };
        let unknowns = self.unknowns() as f64;
        let mut steps = 0;
        loop {
            let here = self.here(&weights, count).ok_or_else(untold)?;
            let most = largest(&here.sensitivity);
            let excess = here.sensitivity[most] / unknowns - 1.0;
            if excess <= TOLERANCE || steps == STEPS {
                return Ok(Approximate {
                    weights,
                    log_det: here.solved.log_det + self.offset(),
                    told: unknowns - here.before,
                    excess,
                    sensitivity: here.sensitivity,
                });
            }
            steps += 1;
            self.step(&mut weights, most, &here.solved, count);
            newton::shared(self, &mut weights, count, excess);
        }
    }

    /// The information of a design with all measurements at one place, packed.
    pub(crate) fn all_at(&self, place: usize, count: usize) -> Vec<f64> {
        self.sum(std::iter::once((place, count as f64)))
    }

    /// The information of a design by its shares, packed.
    pub(crate) fn by_shares(&self, weights: &[f64], count: usize) -> Vec<f64> {
        let used = weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
        self.sum(used.map(|(place, weight)| (place, weight * count as f64)))
    }

    fn here(&self, weights: &[f64], count: usize) -> Option<Here> {
        let solved = Solved::of(&self.by_shares(weights, count), self.unknowns())?;
        let before: f64 = self.base().iter().zip(&solved.inverse).map(|(x, y)| x * y).sum();
        let traces = self.traces(&solved.inverse);
        let sensitivity = traces.into_iter().map(|trace| before + count as f64 * trace).collect();
        Some(Here { solved, sensitivity, before })
    }

    /// Equal shares of a few places, each chosen as that which tells most beside those before; of all places if these do not tell of
    /// everything.
    fn begun(&self, count: usize) -> Vec<f64> {
        let (places, unknowns) = (self.places(), self.unknowns());
        let all = (0..places).map(|place| (place, BESIDE / places as f64));
        let mut sum = self.sum(all);
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < (unknowns + 1).min(places) {
            let Some(solved) = Solved::of(&sum, unknowns) else { break };
            let mut traces = self.traces(&solved.inverse);
            chosen.iter().for_each(|place| traces[*place] = f64::NEG_INFINITY);
            let most = largest(&traces);
            // As little as is to be had from a place where these are all that are needed.
            let enough = 2.0 * unknowns as f64 / chosen.len().max(1) as f64;
            if chosen.len() > 1 && count as f64 * traces[most] < enough {
                break;
            }
            sum.iter_mut().zip(self.one(most)).for_each(|(sum, x)| *sum += count as f64 * x);
            chosen.push(most);
        }
        let mut weights = vec![0.0; places];
        chosen.iter().for_each(|place| weights[*place] = 1.0 / chosen.len() as f64);
        match Solved::of(&self.by_shares(&weights, count), unknowns) {
            Some(_) => weights,
            None => vec![1.0 / places as f64; places],
        }
    }

    /// Moves as much of all measurements to a place as makes the determinant largest.
    fn step(&self, weights: &mut [f64], place: usize, solved: &Solved, count: usize) {
        let unknowns = self.unknowns();
        let there = within(&solved.lower, &unpacked(&self.all_at(place, count), unknowns));
        // With λ the eigenvalues there, ln det grows by Σ ln(1 + α(λ - 1)) when a share α is moved.
        let Some((values, _)) = exact_symmetric(there.as_ref()) else { return };
        let slope = |share: f64| values.iter().map(|x| (x - 1.0) / (1.0 + share * (x - 1.0))).sum::<f64>();
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 { low = middle } else { high = middle }
        }
        weights.iter_mut().for_each(|weight| *weight *= 1.0 - low);
        weights[place] += low;
    }

    /// L⁻¹ A L⁻ᵀ, packed, with A the information of a design with all measurements at one place.
    pub(crate) fn all_within(&self, lower: &Mat<f64>, place: usize, count: usize) -> Vec<f64> {
        packed(&within(lower, &unpacked(&self.all_at(place, count), self.unknowns())))
    }
}

/// Index of the largest value, the first of equals.
fn largest(values: &[f64]) -> usize {
    (0..values.len()).reduce(|most, i| if values[i] > values[most] { i } else { most }).unwrap_or(0)
}
