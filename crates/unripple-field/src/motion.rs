//! Modal coordinates under a drive, advanced exactly from sample to sample.

use std::ops::Range;
use unripple_core::{Drive, ModalResponses};
use unripple_linalg::{Accum, Mat, Par, multiply};

/// Displacement and velocity of every mode under a drive, stepped exactly from sample to sample.
///
/// The state of mode m is its displacement u and velocity v. At sample i it receives the impulse
/// `q[m] = Σ_a input[a, m] · d[a][i] / rate`, times what a unit impulse does to its pole, so that
/// `v[i] = Σ_j h[i−j] d[j] / rate` with `h[0]` whole, and then it vibrates freely until the next sample. Displacement
/// follows from the same state.
#[derive(Debug)]
pub(crate) struct Motion<'a> {
    drive: &'a Drive,
    /// Input weights divided by the rate, modes x actuators.
    input: Mat<f64>,
    /// Rows of the propagator over one sample, one column per mode.
    step: [Vec<f64>; 4],
    /// Displacement and velocity that a unit impulse gives each mode.
    kick: [Vec<f64>; 2],
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    next: usize,
}

impl<'a> Motion<'a> {
    /// The motion of all modes, at rest before sample 0.
    pub fn new(responses: &ModalResponses, drive: &'a Drive) -> Self {
        Self::of(responses, drive, 0..responses.poles.len())
    }

    /// The motion of some of the modes only, by their indices, at rest before sample 0.
    pub fn of(responses: &ModalResponses, drive: &'a Drive, modes: Range<usize>) -> Self {
        let rate = drive.rate();
        let poles = &responses.poles[modes.clone()];
        let input = |m: usize, a: usize| responses.input[(a, modes.start + m)] / rate;
        let steps: Vec<_> = poles.iter().map(|pole| pole.step(1.0 / rate)).collect();
        let entry = |i: usize, j: usize| steps.iter().map(|step| step[i][j]).collect();
        let kicks: Vec<_> = poles.iter().map(|pole| pole.kick()).collect();
        Self {
            drive,
            input: Mat::from_fn(poles.len(), drive.channels().len(), input),
            step: [entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)],
            kick: [0, 1].map(|i| kicks.iter().map(|kick| kick[i]).collect()),
            displacement: vec![0.0; poles.len()],
            velocity: vec![0.0; poles.len()],
            next: 0,
        }
    }

    /// Index of the next sample to be computed.
    pub fn next(&self) -> usize {
        self.next
    }

    /// Displacement (m·√kg) and velocity (√J) of every mode at the last sample computed.
    pub fn state(&self) -> (&[f64], &[f64]) {
        (&self.displacement, &self.velocity)
    }

    /// Steps through the next `count` samples, and passes displacement (m·√kg) and velocity (√J) of every mode to
    /// `show` at each.
    pub fn advance(&mut self, count: usize, mut show: impl FnMut(&[f64], &[f64])) {
        let momenta = self.momenta(self.next..self.next + count);
        for offset in 0..count {
            if self.next > 0 {
                self.ring();
            }
            if offset < momenta.ncols() {
                let column = momenta.col_as_slice(offset);
                let [moved, struck] = &self.kick;
                self.displacement.iter_mut().zip(column).zip(moved).for_each(|((u, q), k)| *u += q * k);
                self.velocity.iter_mut().zip(column).zip(struck).for_each(|((v, q), k)| *v += q * k);
            }
            self.next += 1;
            show(&self.displacement, &self.velocity);
        }
    }

    /// Velocity (√J) and displacement (m·√kg) of every mode over the next `count` samples, modes x samples each.
    pub fn states(&mut self, count: usize) -> [Mat<f64>; 2] {
        let zeros = || Mat::zeros(self.velocity.len(), count);
        let [mut velocities, mut displacements] = [zeros(), zeros()];
        let mut column = 0;
        self.advance(count, |displacement, velocity| {
            velocities.col_as_slice_mut(column).copy_from_slice(velocity);
            displacements.col_as_slice_mut(column).copy_from_slice(displacement);
            column += 1;
        });
        [velocities, displacements]
    }

    /// Velocity (√J) of every mode over the next `count` samples, modes x samples.
    pub fn velocities(&mut self, count: usize) -> Mat<f64> {
        let mut velocities = Mat::zeros(self.velocity.len(), count);
        let mut column = 0;
        self.advance(count, |_, velocity| {
            velocities.col_as_slice_mut(column).copy_from_slice(velocity);
            column += 1;
        });
        velocities
    }

    /// Steps until `sample` is the next to be computed, at most `stride` samples at a time.
    pub fn skip_to(&mut self, sample: usize, stride: usize) {
        while self.next < sample {
            self.advance((sample - self.next).min(stride), |_, _| ());
        }
    }

    /// Momentum per mode (modes x samples) for those of the samples that lie within the drive.
    fn momenta(&self, samples: Range<usize>) -> Mat<f64> {
        let channels = self.drive.channels();
        let end = samples.end.min(self.drive.samples());
        let count = end.saturating_sub(samples.start);
        let sent = Mat::from_fn(channels.len(), count, |a, i| channels[a][samples.start + i]);
        let mut momenta = Mat::zeros(self.velocity.len(), count);
        multiply(momenta.as_mut(), Accum::Replace, self.input.as_ref(), sent.as_ref(), 1.0, Par::Seq);
        momenta
    }

    /// Advances the free vibration of all modes by one sample.
    fn ring(&mut self) {
        let [a, b, c, d] = &self.step;
        let modes = self.velocity.iter_mut().zip(&mut self.displacement);
        let steps = a.iter().zip(b).zip(c.iter().zip(d));
        for ((v, u), ((a, b), (c, d))) in modes.zip(steps) {
            (*u, *v) = (a * *u + b * *v, c * *u + d * *v);
        }
    }
}
