//! Responses for time reversal, synthesised from modes.

use crate::magnitude::energy;
use crate::{FocusError, LossCorrection, Options};
use unripple_core::{ModalResponses, Onset, Point, Pole};
use unripple_dsp::ModalSynth;
use unripple_linalg::{Mat, MatRef, Number, product};

/// Values of responses that are held at once while their energies are summed, 32 MiB of them. With twice this value, twice
/// the memory; sums differ by rounding.
const VALUES_AT_ONCE: usize = 1 << 22;

/// A shape weight below this share of those elsewhere on the surface is rounding error, not motion. Larger,
/// targets close to a held edge would be refused.
pub(crate) const REST: f64 = 1e-9;

/// Accuracy for which single precision is enough: its rounding error is about as large. Larger, single
/// precision would be used less.
const SINGLE: f64 = 1e-6;

/// Modes times samples of the largest synthesis that is planned ahead rather than summed block by block:
/// tables of up to three quarters of a GiB. With twice this value, plans may take twice the memory.
const PLANNED: usize = 1 << 26;

/// Synthesises responses from modes.
#[derive(Debug)]
pub(crate) struct ModalRecorder<'r> {
    responses: &'r ModalResponses,
    length: usize,
    /// The synthesis prepared in advance; `None` if responses are summed directly.
    synth: Option<ModalSynth>,
    /// Whether the decay of each mode is compensated by its own rate.
    lossless: bool,
    accuracy: f64,
    /// Largest mode-shape weight on the surface, to which small weights are compared.
    usual: f64,
}

impl<'r> ModalRecorder<'r> {
    /// Prepares the synthesis of responses of `length` samples.
    pub fn plan(responses: &'r ModalResponses, length: usize, options: &Options) -> Self {
        let usual = usual(responses);
        let (lossless, accuracy) = (options.loss == LossCorrection::PerMode, options.accuracy);
        let planned = !lossless && responses.poles.len().saturating_mul(length) <= PLANNED;
        let rate = responses.conditions.rate;
        let synth = planned.then(|| ModalSynth::new(&responses.poles, rate, length, accuracy));
        Self { responses, length, synth, lossless, accuracy, usual }
    }

    /// The sum of the responses at all points, `[actuator][sample]`, and the sum of their energies; an empty
    /// vector and zero if no mode moves the points.
    pub fn record(&self, points: &[Point]) -> Result<(Vec<f64>, f64), FocusError> {
        let readout = self.readout(points);
        if largest(readout.as_ref()) <= REST * self.usual {
            return Ok((Vec::new(), 0.0));
        }
        let sum =
            Mat::from_fn(1, readout.ncols(), |_, m| (0..points.len()).map(|p| readout[(p, m)]).sum::<f64>());
        let together = self.respond(sum.as_ref())?;
        if points.len() == 1 {
            let own = energy(&together);
            return Ok((together, own));
        }
        let mut energies = 0.0;
        let each = self.length * self.responses.ports.len();
        let at_once = (VALUES_AT_ONCE / each.max(1)).max(1);
        for first in (0..points.len()).step_by(at_once) {
            let count = at_once.min(points.len() - first);
            energies += energy(&self.respond(readout.as_ref().subrows(first, count))?);
        }
        Ok((together, energies))
    }

    /// Shape weights, points x modes.
    fn readout(&self, points: &[Point]) -> Mat<f64> {
        let &[point] = points else { return self.responses.shapes.at_all(points) };
        let mut row = vec![0.0; self.responses.shapes.modes()];
        self.responses.shapes.at(point, &mut row);
        Mat::from_fn(1, row.len(), |_, m| row[m])
    }

    /// Responses at points with these shape weights (points x modes), `[point][actuator][sample]`.
    fn respond(&self, readout: MatRef<'_, f64>) -> Result<Vec<f64>, FocusError> {
        let ports = self.responses.ports.len();
        let mut rows = vec![0.0; readout.nrows() * ports * self.length];
        match &self.synth {
            Some(synth) if self.accuracy >= SINGLE => {
                let mut single = vec![0.0_f32; rows.len()];
                synth.respond_f32(self.weights(readout, |w| w as f32).as_ref(), &mut single)?;
                rows.iter_mut().zip(single).for_each(|(to, h)| *to = f64::from(h));
            }
            Some(synth) => synth.respond(self.weights(readout, |w| w).as_ref(), &mut rows)?,
            None => self.sum(self.weights(readout, |w| w).as_ref(), &mut rows),
        }
        Ok(rows)
    }

    /// Weights of the modes in every response, (points · actuators) x modes.
    fn weights<T: Number>(&self, readout: MatRef<'_, f64>, convert: impl Fn(f64) -> T) -> Mat<T> {
        let input = &self.responses.input;
        let mut weights = Mat::zeros(readout.nrows() * input.nrows(), input.ncols());
        for m in 0..input.ncols() {
            let column = weights.col_as_slice_mut(m).chunks_exact_mut(input.nrows().max(1));
            for (point, to) in column.enumerate() {
                to.iter_mut()
                    .zip(input.col_as_slice(m))
                    .for_each(|(w, a)| *w = convert(a * readout[(point, m)]));
            }
        }
        weights
    }

    /// The sum that defines modal responses, in blocks of samples: `Σ_m weights[row, m] · velocity_m(i / rate)`.
    fn sum(&self, weights: MatRef<'_, f64>, rows: &mut [f64]) {
        // So few samples at once that the modes' velocities stay in the cache while all rows are summed.
        const BLOCK: usize = 512;
        let (poles, rate) = (&self.responses.poles, self.responses.conditions.rate);
        for first in (0..self.length).step_by(BLOCK) {
            let count = BLOCK.min(self.length - first);
            let ringing = Mat::from_fn(poles.len(), count, |m, i| {
                let t = (first + i) as f64 / rate;
                if self.lossless { undamped(poles[m], t) } else { poles[m].velocity(t) }
            });
            let block = product(weights, ringing.as_ref());
            for (row, samples) in rows.chunks_exact_mut(self.length).enumerate() {
                samples[first..first + count]
                    .iter_mut()
                    .enumerate()
                    .for_each(|(i, to)| *to = block[(row, i)]);
            }
        }
    }
}

/// Largest mode-shape weight over a lattice of points on the surface.
pub(crate) fn usual(responses: &ModalResponses) -> f64 {
    let (width, height) = responses.conditions.outline.extent();
    let lattice = (0..25).map(|i| {
        // Off the middle, where odd modes are at rest.
        let at = |cell: usize| (cell as f64 + 0.4) / 5.0;
        Point::new(width * at(i % 5), height * at(i / 5))
    });
    let inside: Vec<Point> = lattice.filter(|p| responses.conditions.outline.contains(*p)).collect();
    largest(responses.shapes.at_all(&inside).as_ref())
}

/// The largest magnitude of some weights, points x modes.
pub(crate) fn largest(weights: MatRef<'_, f64>) -> f64 {
    (0..weights.ncols())
        .flat_map(|m| (0..weights.nrows()).map(move |p| weights[(p, m)].abs()))
        .fold(0.0, f64::max)
}

/// Velocity of a mode times e^{+σt}, if it oscillates.
fn undamped(pole: Pole, t: f64) -> f64 {
    let square = (pole.omega - pole.sigma) * (pole.omega + pole.sigma);
    if square <= 0.0 {
        return pole.velocity(t);
    }
    let lossless = Pole::new(square.sqrt(), 0.0);
    match pole.onset {
        Onset::Velocity => lossless.velocity(t) - pole.sigma * lossless.displacement(t),
        Onset::Displacement => -pole.omega * lossless.displacement(t),
    }
}
