//! Uniformly partitioned convolution of every input into every output, at a rate just high enough for the band.
//!
//! Inputs are decimated to the lower rate, cut into blocks and transformed, once per input and block. Responses are cut
//! into partitions of a block. Products of the spectra of the last blocks with those of the partitions are summed per
//! output, transformed back once, overlapped and added (overlap-add), and interpolated to the full rate. Every block
//! takes the same work.
//!
//! Each block of an input keeps the filters that it entered under until it has passed the last partition: filters are
//! exchanged without cutting off the responses to earlier samples, and at no more cost than the blocks of the fade,
//! which are convolved twice.

mod filters;
mod history;
mod input;
mod product;
mod resample;

pub use filters::{FilterPlan, PreparedFilters};

use crate::PlayerError;
use crate::error::count;
use crate::kernels::Wide;
use crate::shelf::Garbage;
use filters::{LANES, OUTPUTS};
use history::History;
use input::Input;
use product::Product;
use pulp::Arch;
use resample::{Decimator, Interpolator, LowPass};
use std::sync::Arc;
use unripple_dsp::{Complex, ComplexToReal, inverse_single};

/// Convolves every input with its impulse responses to every output, block by block.
///
/// ```
/// use std::sync::Arc;
/// use unripple_player::{Convolver, PlayerError};
///
/// let mut convolver = Convolver::new([1, 2], 64, 48e3, 100, 3e3)?;
/// let filters = convolver.plan().prepare(&[vec![0.5], vec![0.0, -1.0]])?;
/// convolver.turn(0, Arc::new(filters), 1);
/// let (input, mut output) = ([0.0; 64], [0.0; 128]);
/// convolver.process(&input, &mut output);
/// assert_eq!((convolver.factor(), convolver.delay()), (4, 84));
/// # Ok::<(), PlayerError>(())
/// ```
pub struct Convolver {
    plan: FilterPlan,
    block: usize,
    inputs: Vec<Input>,
    outputs: Vec<Output>,
    backward: Arc<dyn ComplexToReal<f32>>,
    arch: Arch,
    /// Sums of products: output x group of lanes x (real, imaginary) x lane.
    sums: Vec<f32>,
    low: Vec<f32>,
    spectrum: Vec<Complex<f32>>,
    signal: Vec<f32>,
    scratch: Vec<Complex<f32>>,
}

struct Output {
    interpolator: Interpolator,
    /// Part of the last block's result that overlaps into this one.
    tail: Vec<f32>,
}

impl std::fmt::Debug for Convolver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Convolver").field("plan", &self.plan).field("inputs", &self.inputs.len()).finish()
    }
}

impl Convolver {
    /// A convolver of `[inputs, outputs]` in blocks of `block` samples at `rate` samples per second, for
    /// responses of up to `taps` samples. Frequencies of an input up to `band_top_hz` pass with a relative
    /// error below 1e-4. Those from there to the lower rate minus `band_top_hz` may be attenuated and
    /// aliased, and those above are removed.
    ///
    /// # Errors
    /// [`PlayerError::Range`] for a size out of range.
    pub fn new(
        [inputs, outputs]: [usize; 2],
        block: usize,
        rate: f64,
        taps: usize,
        band_top_hz: f64,
    ) -> Result<Self, PlayerError> {
        count("inputs", inputs, 1, 4096)?;
        count("outputs", outputs, 1, 4096)?;
        count("samples of a block", block, 1, 8192)?;
        count("taps", taps, 1, 1 << 22)?;
        let factor = resample::factor(block, rate, band_top_hz);
        let filter = LowPass::new(factor, band_top_hz / rate);
        let plan = FilterPlan::new(outputs, taps, block, filter);
        let (low, groups) = (plan.low, plan.groups());
        let backward = inverse_single(2 * low);
        let scratch = plan.forward.get_scratch_len().max(backward.get_scratch_len());
        let input = || Input {
            decimator: Decimator::new(&plan.filter, block),
            history: History::new(plan.partitions, groups),
        };
        let output = || Output { interpolator: Interpolator::new(&plan.filter, low), tail: vec![0.0; low] };
        Ok(Self {
            inputs: (0..inputs).map(|_| input()).collect(),
            outputs: (0..outputs).map(|_| output()).collect(),
            sums: vec![0.0; outputs.next_multiple_of(OUTPUTS) * groups * 2 * LANES],
            low: vec![0.0; low],
            spectrum: vec![Complex::default(); low + 1],
            signal: vec![0.0; 2 * low],
            scratch: vec![Complex::default(); scratch],
            arch: Arch::new(),
            backward,
            block,
            plan,
        })
    }

    /// The plan with which responses are prepared.
    pub fn plan(&self) -> &FilterPlan {
        &self.plan
    }

    /// Ratio of the sample rate of inputs and outputs to the lower rate at which the convolution is
    /// computed.
    pub fn factor(&self) -> usize {
        self.plan.filter.factor
    }

    /// Delay in samples from an input to an output if the response is a unit impulse at sample 0: three
    /// times half the length of the low-pass filter, which acts on the decimated input, on the response, and
    /// on the interpolated output.
    pub fn delay(&self) -> usize {
        3 * self.plan.filter.half
    }

    /// Number of samples for which a sample that has entered still influences the decimator's output.
    pub(crate) fn lag(&self) -> usize {
        2 * self.plan.filter.half + 1
    }

    /// Removes the filters of an input, by its index, from the next block on. Samples that entered before
    /// are still convolved with the filters present when they entered.
    pub(crate) fn clear(&mut self, input: usize, leave: impl FnMut(Garbage)) {
        if let Some(input) = self.inputs.get_mut(input) {
            input.history.clear(leave);
        }
    }

    /// Number of blocks after which a sample that has entered no longer influences the state or the output.
    pub(crate) fn memory(&self) -> usize {
        // Besides the partitions: the block at hand, what the last overlaps into, and the filters down and up.
        self.plan.partitions + 2 + (4 * self.plan.filter.half + 2).div_ceil(self.block)
    }

    /// Whether a cross-fade of any input is under way or waiting.
    pub(crate) fn is_turning(&self) -> bool {
        self.inputs.iter().any(|input| input.history.is_turning())
    }

    /// Largest number of filters that may be held at once.
    pub(crate) fn places(&self) -> usize {
        self.inputs.len() * (History::places(self.plan.partitions) + 1)
    }

    /// Cross-fades an input, by its index, to other filters over a number of blocks, from the next block on,
    /// or after the cross-fade that is under way. Returns filters that are not used: filters of another
    /// plan, those for an input that does not exist, or those that were waiting and are replaced.
    pub fn turn(
        &mut self,
        input: usize,
        filters: Arc<PreparedFilters>,
        blocks: u32,
    ) -> Option<Arc<PreparedFilters>> {
        match self.inputs.get_mut(input) {
            Some(input) if filters.shape == self.plan.shape() => input.history.turn(filters, blocks),
            _ => Some(filters),
        }
    }

    /// Convolves a block: planar inputs in, planar outputs out (channels x samples). If a slice has a wrong size the
    /// output is silent. Filters that are no longer used are dropped.
    pub fn process(&mut self, input: &[f32], output: &mut [f32]) {
        self.process_leaving(input, output, drop);
    }

    /// As [`Convolver::process`], planar samples in and out, but filters that are no longer used are handed to `leave`.
    pub(crate) fn process_leaving(
        &mut self,
        input: &[f32],
        output: &mut [f32],
        mut leave: impl FnMut(Garbage),
    ) {
        if input.len() != self.inputs.len() * self.block || output.len() != self.outputs.len() * self.block {
            return output.fill(0.0);
        }
        let arch = self.arch;
        for (at, input) in input.chunks_exact(self.block).enumerate() {
            let (low, decimator) = (&mut self.low, &mut self.inputs[at].decimator);
            arch.dispatch(Wide(
                #[inline(always)]
                || decimator.process(input, low),
            ));
            let shares = self.inputs[at].history.advance(&mut leave);
            self.transform(at, 0, [1.0 - shares.new[0], 1.0 - shares.new[1]]);
            if shares.turning {
                self.transform(at, 1, shares.new);
            }
        }
        let histories = &self.inputs;
        let (sums, shape) = (&mut self.sums, self.plan.shape());
        arch.dispatch(Product { histories, sums, shape });
        for (at, output) in output.chunks_exact_mut(self.block).enumerate() {
            self.transform_back(at);
            let (signal, held) = (&self.signal, &mut self.outputs[at]);
            let low = &mut self.low;
            arch.dispatch(Wide(
                #[inline(always)]
                || {
                    let (now, next) = signal.split_at(signal.len() / 2);
                    low.iter_mut().zip(now).zip(&held.tail).for_each(|((to, now), tail)| *to = now + tail);
                    held.tail.copy_from_slice(next);
                    held.interpolator.process(low, output);
                },
            ));
        }
    }

    /// Transforms a share of the block at hand, with weights that run linearly from the end of the last block to the end of this.
    fn transform(&mut self, input: usize, share: usize, [from, to]: [f32; 2]) {
        let low = self.low.len();
        self.signal.fill(0.0);
        for (i, (signal, x)) in self.signal.iter_mut().zip(&self.low).enumerate() {
            *signal = x * (from + (to - from) * (i + 1) as f32 / low as f32);
        }
        let forward = &self.plan.forward;
        // The sizes are the plan's own.
        let done = forward.process_with_scratch(&mut self.signal, &mut self.spectrum, &mut self.scratch);
        debug_assert!(done.is_ok());
        self.inputs[input].history.put(share, &self.spectrum);
    }

    /// Transforms an output's sum back.
    fn transform_back(&mut self, output: usize) {
        let (low, groups) = (self.low.len(), self.plan.groups());
        let sums = &self.sums[output * groups * 2 * LANES..];
        for (bin, value) in self.spectrum.iter_mut().take(low).enumerate() {
            let at = bin / LANES * 2 * LANES + bin % LANES;
            *value = Complex::new(sums[at], sums[at + LANES]);
        }
        self.spectrum[low] = Complex::new(self.spectrum[0].im, 0.0);
        self.spectrum[0].im = 0.0;
        let done =
            self.backward.process_with_scratch(&mut self.spectrum, &mut self.signal, &mut self.scratch);
        debug_assert!(done.is_ok());
    }
}
