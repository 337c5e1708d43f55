//! Time reversal from any set of actuators to any target, as quadratic forms of the choice.

use crate::basis::Basis;
use crate::mounting::Mounting;
use crate::{PlacementError, Plant};
use rayon::prelude::*;
use std::sync::OnceLock;
use unripple_core::{Memory, Point, require, window_samples};
use unripple_linalg::{Accum, Mat, Par, multiply};

/// Largest number of samples of a window: past it a window is taken for a mistake of unit, being minutes long at any usual rate.
const MOST_SAMPLES: f64 = 2e7;

/// A target and its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// The target, in metres.
    pub at: Point,
    /// Its weight among all targets; only ratios matter.
    pub weight: f64,
}

/// Time reversal from every one of many actuators to every target: what any set of them achieves is a sum over the set.
///
/// Time reversal from actuator a to the target x leaves the modes at the focal instant with the velocities s_a = b_a ∘ S(b_a ∘ φ(x)), with
/// the actuator's input weights b_a, the shape weights φ(x), and the sums S over the window of the products of two modes' impulse
/// responses ([`Correlations`](unripple_dsp::Correlations)). Fields of several actuators add up, so that for a set with the indicator z
/// (ones and zeros)
///
/// peak = pᵀz with p_a = φ(x)ᵀs_a,   mean square outside the focal disc = zᵀQz with Q_ab = s_aᵀ W s_b,
///
/// W the mean of the products of two shapes over the points of the grid outside the disc. A row of Q is computed when it is first needed.
/// Of sampled responses ([`Forms::sampled`]), p and Q are sums over their samples and points.
#[derive(Debug)]
pub struct Forms {
    cases: Vec<Case>,
    weights: Vec<f64>,
    actuators: usize,
    rate: f64,
    /// Rows of Q of [`TOGETHER`] actuators, as actuator x case x all actuators.
    rows: Vec<OnceLock<Vec<f32>>>,
}

/// Rows of Q that are computed at once when one of them is needed: then processors compute, where a single row would have them wait for
/// memory. With twice as many, a search computes more rows that it never needs.
const TOGETHER: usize = 32;

/// One target on one model of the surface, or of sampled responses.
#[derive(Debug)]
pub(crate) struct Case {
    /// Peak velocity p_a of each actuator, per square of its input weights.
    peaks: Vec<f32>,
    /// Mean square outside the disc, Q_aa, of each actuator.
    own: Vec<f32>,
    /// Velocities of the modes at the focal instant, s_a, modes x actuators; Q itself where it is known, actuators x actuators.
    states: Mat<f32>,
    /// W s_a, modes x actuators; the unit matrix where Q is known.
    outside: Mat<f32>,
    /// Factor that converts peaks to m²/s² per squared unit of drive, summed over samples.
    unit: f64,
}

impl Forms {
    /// The forms of the kept actuators and of one more at each of `places` (m), for all targets on all models of the surface. With
    /// `mounting` above 0, each place has an error of up to `mounting` (m) along each axis, and the forms are expected values over
    /// these errors.
    ///
    /// # Errors
    /// [`PlacementError::Range`] for a window (s) of no sample or too many, or weights that are not positive;
    /// [`PlacementError::Empty`] for a band without modes; [`PlacementError::Target`] for a target that nothing moves, or whose focal disc is
    /// the whole surface; [`PlacementError::TooLarge`]; those of [`Plant::responses`].
    pub fn new(
        plants: &[Plant],
        places: &[Point],
        aims: &[Aim],
        window: f64,
        mounting: f64,
    ) -> Result<Self, PlacementError> {
        let mut forms =
            Self { cases: Vec::new(), weights: Vec::new(), actuators: 0, rate: 0.0, rows: Vec::new() };
        for plant in plants {
            let rate = plant.surface().emission.rate;
            let legal = window > 0.0 && window * rate <= MOST_SAMPLES && window_samples(window, rate) > 0;
            require("window (s)", legal, "a positive number, of a moderate size", window)?;
            let mounting = Mounting::of(mounting);
            forms.actuators = plant.kept() + places.len();
            forms.fit(plant.modes(), plants.len() * aims.len(), mounting.nodes())?;
            let inputs = mounting.inputs(plant, places)?;
            if inputs.modes() == 0 {
                return Err(PlacementError::Empty);
            }
            let basis = Basis::new(&inputs, window)?;
            let nodes = inputs.scaled();
            let found = aims.par_iter().map(|aim| case(&basis, &nodes, aim.at));
            forms.cases.extend(found.collect::<Result<Vec<_>, _>>()?);
            for aim in aims {
                require("weight of a target", aim.weight > 0.0, "a positive number", aim.weight)?;
                forms.weights.push(plant.weight * aim.weight);
            }
            forms.rate = rate;
        }
        Ok(forms.weighed())
    }

    /// The forms of `actuators` actuators from cases with weights, of which only ratios matter, and the sample rate (Hz).
    pub(crate) fn of_cases(cases: Vec<Case>, weights: Vec<f64>, actuators: usize, rate: f64) -> Self {
        Self { cases, weights, actuators, rate, rows: Vec::new() }.weighed()
    }

    /// These forms with weights whose sum is 1, and without any row yet.
    fn weighed(mut self) -> Self {
        let total: f64 = self.weights.iter().sum();
        self.weights.iter_mut().for_each(|weight| *weight /= total);
        self.rows = (0..self.actuators.div_ceil(TOGETHER)).map(|_| OnceLock::new()).collect();
        self
    }

    /// Number of actuators: the kept ones, and one for each place.
    pub fn actuators(&self) -> usize {
        self.actuators
    }

    /// Number of cases: targets, each counted once per model of the surface.
    pub fn cases(&self) -> usize {
        self.cases.len()
    }

    /// The weight of each case; their sum is 1.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Peaks p_a of all actuators for a case.
    pub(crate) fn peaks(&self, case: usize) -> &[f32] {
        &self.cases[case].peaks
    }

    /// Mean squares outside the disc Q_aa of all actuators for a case.
    pub(crate) fn own(&self, case: usize) -> &[f32] {
        &self.cases[case].own
    }

    /// The row Q_ab of actuator a, for all actuators b, of every case in turn.
    pub(crate) fn row(&self, a: usize) -> &[f32] {
        let length = self.cases.len() * self.actuators;
        let rows = self.rows[a / TOGETHER].get_or_init(|| self.rows_from(a / TOGETHER * TOGETHER));
        &rows[a % TOGETHER * length..][..length]
    }

    /// The rows of actuator `first` and those that are computed with it.
    fn rows_from(&self, first: usize) -> Vec<f32> {
        let count = TOGETHER.min(self.actuators - first);
        let length = self.cases.len() * self.actuators;
        let mut rows = vec![0.0f32; count * length];
        let mut products = Mat::<f32>::zeros(self.actuators, count);
        for (i, case) in self.cases.iter().enumerate() {
            let outside = case.outside.subcols(first, count);
            multiply(products.as_mut(), Accum::Replace, case.states.transpose(), outside, 1.0, Par::Seq);
            for a in 0..count {
                let row = &mut rows[a * length + i * self.actuators..][..self.actuators];
                row.copy_from_slice(products.col_as_slice(a));
                row[first + a] = case.own[first + a];
            }
        }
        rows
    }

    /// Peaks and contrasts of every case for a set of actuators, computed without rows of Q.
    pub(crate) fn of_set(&self, set: &[usize]) -> (Vec<f64>, Vec<f64>) {
        let of = |case: &Case| {
            let peak: f64 = set.iter().map(|a| f64::from(case.peaks[*a])).sum();
            let sum =
                |columns: &Mat<f32>, m: usize| set.iter().map(|a| f64::from(columns[(m, *a)])).sum::<f64>();
            let modes = case.states.nrows();
            let common: f64 = (0..modes).map(|m| sum(&case.states, m) * sum(&case.outside, m)).sum();
            // Where places are uncertain, the mean square of each is more than that of its mean.
            let more = |a: &usize| {
                let mean = dot(case.states.col_as_slice(*a), case.outside.col_as_slice(*a));
                f64::from(case.own[*a] - mean)
            };
            let square = common + set.iter().map(more).sum::<f64>();
            (peak, peak.abs() / square.max(f64::MIN_POSITIVE).sqrt())
        };
        self.cases.iter().map(of).unzip()
    }

    /// The energy of the drive of time reversal to each case's target from a set of actuators, for a peak velocity of 1 m/s, in squared
    /// units of drive times seconds.
    pub(crate) fn energies<'a>(&'a self, peaks: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        // The drive is g·h reversed: its peak is g·Σh²/rate, its energy g²·Σh²/rate.
        self.cases.iter().zip(peaks).map(|(case, peak)| self.rate / (peak * case.unit))
    }

    /// Returns an error if the forms need more memory than is allowed.
    fn fit(&self, modes: usize, cases: usize, nodes: usize) -> Result<(), PlacementError> {
        // States and what they are outside, and rows, all of which a search may need.
        let forms = 4.0 * (cases * self.actuators) as f64 * (2 * modes + self.actuators) as f64;
        // Input weights at all nodes, in double precision and once more while they are scaled.
        let inputs = 8.0 * (modes * self.actuators * (nodes + 1)) as f64;
        held(forms + inputs, self.actuators, cases)
    }
}

/// Returns an error if the forms of so many actuators and cases, which take so many bytes, need more memory than is allowed.
pub(crate) fn held(bytes: f64, places: usize, cases: usize) -> Result<(), PlacementError> {
    let memory = Memory::here();
    if memory.holds(bytes) {
        return Ok(());
    }
    let [needed_gib, limit_gib] = [bytes, memory.bytes()].map(|bytes| bytes / Memory::GIB);
    Err(PlacementError::TooLarge { places, cases, needed_gib, limit_gib })
}

impl Case {
    /// A target whose mean squares outside the disc are known for all pairs of actuators: `squares`, Q, actuators x actuators. `unit`
    /// converts peaks to m²/s² per squared unit of drive, summed over samples.
    pub(crate) fn of_squares(peaks: Vec<f32>, squares: Mat<f32>, unit: f64) -> Self {
        let count = peaks.len();
        let outside = Mat::from_fn(count, count, |a, b| if a == b { 1.0 } else { 0.0 });
        Self { own: (0..count).map(|a| squares[(a, a)]).collect(), peaks, states: squares, outside, unit }
    }

    /// This case, if any actuator moves its target `at` (m): where none does, time reversal has no drive.
    ///
    /// # Errors
    /// [`PlacementError::Target`].
    pub(crate) fn moved(self, at: Point) -> Result<Self, PlacementError> {
        match self.peaks.iter().any(|peak| *peak > 0.0) {
            true => Ok(self),
            false => Err(PlacementError::Target { at, expected: "an actuator that moves it" }),
        }
    }
}

/// The forms of a target for all actuators: means over the nodes of the errors of mounting.
fn case(basis: &Basis, nodes: &[Mat<f32>], at: Point) -> Result<Case, PlacementError> {
    let aimed = basis.aimed(at)?;
    let (modes, actuators) = (nodes[0].nrows(), nodes[0].ncols());
    let share = 1.0 / nodes.len() as f32;
    let mut found = Case {
        peaks: vec![0.0; actuators],
        own: vec![0.0; actuators],
        states: Mat::zeros(modes, actuators),
        outside: Mat::zeros(modes, actuators),
        unit: aimed.unit,
    };
    let mut moved = Mat::<f32>::zeros(modes, actuators);
    for input in nodes {
        let aimed_at = Mat::from_fn(modes, actuators, |m, a| input[(m, a)] * aimed.shape[m]);
        multiply(moved.as_mut(), Accum::Replace, basis.sums(), aimed_at.as_ref(), 1.0, Par::Seq);
        for a in 0..actuators {
            found.peaks[a] += share * dot(moved.col_as_slice(a), aimed_at.col_as_slice(a));
            let input = input.col_as_slice(a);
            moved.col_as_slice_mut(a).iter_mut().zip(input).for_each(|(state, input)| *state *= input);
        }
        let mut outside = Mat::<f32>::zeros(modes, actuators);
        multiply(outside.as_mut(), Accum::Replace, aimed.outside.as_ref(), moved.as_ref(), 1.0, Par::Seq);
        for a in 0..actuators {
            found.own[a] += share * dot(moved.col_as_slice(a), outside.col_as_slice(a));
            add(found.states.col_as_slice_mut(a), share, moved.col_as_slice(a));
            add(found.outside.col_as_slice_mut(a), share, outside.col_as_slice(a));
        }
    }
    found.moved(at)
}

/// A product of two vectors, in eight sums that run side by side.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0f32; 8];
    let (heads, tails) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = heads.remainder().iter().zip(tails.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in heads.zip(tails) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.iter().sum::<f32>() + rest
}

fn add(to: &mut [f32], share: f32, from: &[f32]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += share * from);
}
