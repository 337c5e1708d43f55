//! The field of a modal system, evaluated in blocks of points and samples.

use crate::motion::Motion;
use crate::readout::Kept;
use crate::source::{Quantity, Tally};
use rayon::prelude::*;
use std::sync::Arc;
use unripple_core::{Drive, Mixture, ModalResponses, Point, Shapes};
use unripple_linalg::{Accum, Mat, MatRef, Par, multiply, product};

/// Points of a block of the field: small enough to stay in cache, with [`SAMPLES`], while it is tallied.
/// With twice this value, blocks of 256 KiB may fall out of it.
const POINTS: usize = 256;
/// Samples of a block of the field; see [`POINTS`].
const SAMPLES: usize = 128;

/// Number of values of modal states (modes x samples) in memory at once, up to 32 MiB of them. Twice as many
/// take twice the memory.
pub(crate) const STATES: usize = 1 << 22;

/// Largest number of readout weights of a block, 128 MiB of them in each thread: with more than 65 536
/// modes, blocks have fewer points. With twice this value, twice the memory.
pub(crate) const READ: usize = 1 << 24;

/// Largest number of readout weights that are cached between surveys, half a GiB of them; if there are more,
/// they are computed again for each block of time. Twice as many take a GiB.
const KEPT: usize = 1 << 27;

/// The field of a modal system: states of all modes over time, read out in blocks and never stored as a whole.
#[derive(Debug)]
pub(crate) struct ModalField<'a> {
    /// Poles, input weights and shapes.
    pub(crate) responses: &'a ModalResponses,
    /// The drive of the actuators.
    pub(crate) drive: &'a Drive,
    pub(crate) kept: Arc<Kept>,
}

/// Displacement and velocity of every mode at one instant.
#[derive(Clone, Debug)]
pub(crate) struct State {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
}

impl State {
    /// Velocity or displacement, one value per mode.
    pub(crate) fn of(&self, quantity: Quantity) -> &[f64] {
        match quantity {
            Quantity::Velocity => &self.velocity,
            Quantity::Displacement => &self.displacement,
        }
    }
}

impl<'a> ModalField<'a> {
    /// The field of modal responses under a drive, at the points (m) of `kept`.
    pub fn new(responses: &'a ModalResponses, drive: &'a Drive, kept: Arc<Kept>) -> Self {
        Self { responses, drive, kept }
    }

    pub(crate) fn points(&self) -> &[Point] {
        &self.kept.points
    }

    /// Number of modes.
    pub(crate) fn modes(&self) -> usize {
        self.responses.poles.len()
    }

    /// The combinations of which the modes' shapes are, where their base is read out in their place: if it has fewer shapes, each sample costs
    /// less at every point, and with more points than combinations, combining the motion costs less than combining the shapes.
    pub(crate) fn mixture(&self) -> Option<Mixture<'_>> {
        let fewer = |mixture: &Mixture<'_>| {
            mixture.base.modes() < self.modes() && mixture.mixing.ncols() < self.points().len()
        };
        self.responses.shapes.mixture().filter(fewer)
    }

    /// The shapes that are read out at the points of the field.
    fn read(&self) -> &dyn Shapes {
        self.mixture().map_or(self.responses.shapes.as_ref(), |mixture| mixture.base)
    }

    /// Number of shapes that are read out.
    pub(crate) fn read_modes(&self) -> usize {
        self.read().modes()
    }

    /// The motion of the shapes that are read out, from that of the modes; both one row per mode and one column per sample.
    pub(crate) fn as_read(&self, motion: Mat<f64>) -> Mat<f64> {
        match self.mixture() {
            Some(mixture) => mixture.of_base(motion.as_ref()),
            None => motion,
        }
    }

    /// Number of samples whose modal states are in memory at once.
    pub(crate) fn samples_at_once(&self) -> usize {
        (STATES / self.modes().max(self.read_modes()).max(1)).max(SAMPLES)
    }

    /// Number of points whose readout weights are in memory at once.
    pub(crate) fn points_at_once(&self) -> usize {
        (READ / self.read_modes().max(1)).clamp(1, POINTS)
    }

    /// Readout weights (points x modes) of one chunk of points, in single precision.
    fn weights(&self, points: &[Point]) -> Mat<f32> {
        let exact = self.read().at_all(points);
        Mat::from_fn(exact.nrows(), exact.ncols(), |p, m| exact[(p, m)] as f32)
    }

    /// Applies `work` to the weights (points x shapes that are read out) of every chunk of points and the chunk's item of
    /// `owned`, in parallel.
    pub(crate) fn for_chunks<T: Send>(&self, owned: &mut [T], work: impl Fn(&Mat<f32>, &mut T) + Sync) {
        if self.points().len() * self.read_modes() > KEPT {
            let chunks = self.points().par_chunks(self.points_at_once());
            chunks.zip(owned.par_iter_mut()).for_each(|(points, own)| work(&self.weights(points), own));
        } else {
            let weights =
                || self.points().par_chunks(self.points_at_once()).map(|p| self.weights(p)).collect();
            let kept = self.kept.weights.get_or_init(weights);
            kept.par_iter().zip(owned.par_iter_mut()).for_each(|(weights, own)| work(weights, own));
        }
    }

    /// Modal states at these instants, in the same order.
    pub(crate) fn states(&self, instants: &[usize]) -> Vec<State> {
        let mut order: Vec<usize> = (0..instants.len()).collect();
        order.sort_by_key(|&i| instants[i]);
        let rest = State { displacement: vec![0.0; self.modes()], velocity: vec![0.0; self.modes()] };
        let mut states = vec![rest; instants.len()];
        let mut motion = Motion::new(self.responses, self.drive);
        for index in order {
            motion.skip_to(instants[index] + 1, self.samples_at_once());
            let (displacement, velocity) = motion.state();
            states[index] = State { displacement: displacement.to_vec(), velocity: velocity.to_vec() };
        }
        states
    }

    /// Velocity and displacement at every point, at some samples.
    pub(crate) fn snapshots(&self, instants: &[usize]) -> Vec<[Vec<f32>; 2]> {
        let states = self.states(instants);
        let both = self.as_read(Mat::from_fn(self.modes(), 2 * states.len(), |m, column| {
            let state = &states[column / 2];
            if column % 2 == 0 { state.velocity[m] } else { state.displacement[m] }
        }));
        let both = Mat::from_fn(both.nrows(), both.ncols(), |m, column| both[(m, column)] as f32);
        let mut read = vec![Mat::<f32>::zeros(0, 0); self.points().len().div_ceil(self.points_at_once())];
        self.for_chunks(&mut read, |weights, own| *own = product(weights.as_ref(), both.as_ref()));
        let column = |c: usize| read.iter().flat_map(|chunk| chunk.col_as_slice(c)).copied().collect();
        (0..states.len()).map(|i| [column(2 * i), column(2 * i + 1)]).collect()
    }
}

/// Adds the field weights · states, of readout weights (points x modes) and a block of states (modes x
/// samples), to a tally.
pub(crate) fn add_to(tally: &mut Tally, weights: MatRef<'_, f32>, states: MatRef<'_, f32>) {
    let mut field = Mat::<f32>::zeros(weights.nrows(), SAMPLES.min(states.ncols()));
    let mut squares = vec![0.0_f32; weights.nrows()];
    for first in (0..states.ncols()).step_by(SAMPLES) {
        let count = SAMPLES.min(states.ncols() - first);
        let mut block = field.as_mut().subcols_mut(0, count);
        multiply(block.as_mut(), Accum::Replace, weights, states.subcols(first, count), 1.0, Par::Seq);
        squares.fill(0.0);
        for column in 0..count {
            let values = field.col_as_slice(column);
            for ((value, square), peak) in values.iter().zip(&mut squares).zip(&mut tally.peak) {
                *square += value * value;
                *peak = if value.abs() > *peak { value.abs() } else { *peak };
            }
        }
        tally.squares.iter_mut().zip(&squares).for_each(|(sum, square)| *sum += f64::from(*square));
    }
}
