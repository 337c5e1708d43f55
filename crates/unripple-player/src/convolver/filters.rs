//! Impulse responses partitioned and transformed for the convolver.

use super::resample::LowPass;
use crate::PlayerError;
use crate::error::{playable, same};
use std::sync::Arc;
use unripple_dsp::{Complex, RealToComplex, forward_single};

/// Lanes that spectra are grouped in: the float32 numbers of a 512-bit register. With twice this value, more empty lanes
/// are worked on.
pub(crate) const LANES: usize = 16;

/// Outputs that are summed up together, so that an input's spectrum is read once for all of them. With twice this value,
/// sums no longer fit the registers.
pub(crate) const OUTPUTS: usize = 4;

/// Prepares impulse responses for a [`Convolver`](crate::Convolver): partitions and transforms them. This
/// takes long, but can be done on any thread.
#[derive(Clone)]
pub struct FilterPlan {
    /// Number of outputs.
    pub(crate) outputs: usize,
    /// Samples of the longest response, at the full rate.
    pub(crate) taps: usize,
    /// Samples of a block at the lower rate.
    pub(crate) low: usize,
    /// Number of partitions, each of a block at the lower rate.
    pub(crate) partitions: usize,
    /// Low-pass filter with which responses are brought to the lower rate.
    pub(crate) filter: LowPass,
    /// The Fourier transform of two blocks.
    pub(crate) forward: Arc<dyn RealToComplex<f32>>,
}

impl std::fmt::Debug for FilterPlan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { outputs, taps, low, partitions, .. } = self;
        write!(f, "FilterPlan {{ outputs: {outputs}, taps: {taps}, low: {low}, partitions: {partitions} }}")
    }
}

/// Responses of one input to all outputs, as spectra of partitions, ready for a [`Convolver`](crate::Convolver).
#[derive(Clone, Debug)]
pub struct PreparedFilters {
    /// Group of outputs x group of lanes x partition x output in the group x (real, imaginary) x lane.
    pub(crate) spectra: Vec<f32>,
    /// Groups of outputs, groups of lanes, partitions.
    pub(crate) shape: [usize; 3],
}

impl FilterPlan {
    /// A plan for responses of up to `taps` samples in blocks of `block` samples, both at the full rate.
    pub(crate) fn new(outputs: usize, taps: usize, block: usize, filter: LowPass) -> Self {
        let low = block / filter.factor;
        // The low-pass filter that takes responses to the lower rate reaches its half length to either side.
        let low_taps = (taps + 2 * filter.half).div_ceil(filter.factor);
        let forward = forward_single(2 * low);
        Self { outputs, taps, low, partitions: low_taps.div_ceil(low), filter, forward }
    }

    /// Number of groups of lanes that a spectrum takes.
    pub(crate) fn groups(&self) -> usize {
        self.low.div_ceil(LANES)
    }

    /// The shape of spectra: numbers of groups of outputs, groups of lanes and partitions.
    pub(crate) fn shape(&self) -> [usize; 3] {
        [self.outputs.div_ceil(OUTPUTS), self.groups(), self.partitions]
    }

    /// Prepares the responses of one input: one response per output, each of at most the planned number of
    /// samples, at the full sample rate.
    ///
    /// # Errors
    /// [`PlayerError::Size`] for another number of responses or one that is too long, [`PlayerError::Sample`] at the
    /// first sample that is not finite or too large.
    pub fn prepare(&self, responses: &[Vec<f32>]) -> Result<PreparedFilters, PlayerError> {
        same("responses of an input", responses.len(), self.outputs)?;
        for response in responses {
            if response.len() > self.taps {
                let (expected, found) = (self.taps, response.len());
                return Err(PlayerError::Size { what: "taps of a response, at most", expected, found });
            }
            playable("response", response, response.len())?;
        }
        let shape = self.shape();
        let mut spectra = vec![0.0; shape.iter().product::<usize>() * OUTPUTS * 2 * LANES];
        for (output, response) in responses.iter().enumerate() {
            let low = self.lowered(response);
            for (partition, part) in low.chunks(self.low).enumerate().take(self.partitions) {
                self.put(&mut spectra, [output, partition], &self.spectrum(part)?);
            }
        }
        Ok(PreparedFilters { spectra, shape })
    }

    /// The response at the lower rate, delayed by half the length of the low-pass filter.
    fn lowered(&self, response: &[f32]) -> Vec<f32> {
        let (factor, half) = (self.filter.factor as i64, self.filter.half as i64);
        let sample = |n: i64| {
            let middle = n * factor - half;
            let reach = (middle - half).max(0)..(middle + half + 1).min(response.len() as i64);
            let sum: f64 =
                reach.map(|k| f64::from(response[k as usize]) * self.filter.about(middle - k)).sum();
            (sum * factor as f64) as f32
        };
        (0..(self.partitions * self.low) as i64).map(sample).collect()
    }

    /// The spectrum of a partition, with the inverse transform's factor.
    fn spectrum(&self, part: &[f32]) -> Result<Vec<Complex<f32>>, PlayerError> {
        let mut input = self.forward.make_input_vec();
        input.iter_mut().zip(part).for_each(|(to, from)| *to = from / (2 * self.low) as f32);
        let mut output = self.forward.make_output_vec();
        let fault =
            |_| PlayerError::Size { what: "samples of a partition", expected: self.low, found: part.len() };
        self.forward.process(&mut input, &mut output).map_err(fault)?;
        Ok(output)
    }

    /// Stores a spectrum in its place; the real value of the highest frequency is stored as the imaginary part of lane
    /// 0.
    fn put(&self, spectra: &mut [f32], [output, partition]: [usize; 2], spectrum: &[Complex<f32>]) {
        let [_, groups, partitions] = self.shape();
        for (bin, value) in spectrum.iter().take(self.low).enumerate() {
            let group = (output / OUTPUTS * groups + bin / LANES) * partitions + partition;
            let at = (group * OUTPUTS + output % OUTPUTS) * 2 * LANES + bin % LANES;
            spectra[at] = value.re;
            spectra[at + LANES] = if bin == 0 { spectrum[self.low].re } else { value.im };
        }
    }
}
