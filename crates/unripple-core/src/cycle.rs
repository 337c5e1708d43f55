//! A cycle of a device that calls whoever plays, and the work that is done in it.

use std::any::Any;
use std::time::Instant;

/// One cycle of a device with a clock of its own: the buffers that it wants filled and those that it filled. All have
/// [`Cycle::frames`] samples, which may differ from cycle to cycle.
pub trait Cycle {
    /// Samples of each channel in this cycle: the length of every [`Cycle::drive`] and [`Cycle::heard`].
    fn frames(&self) -> usize;

    /// When the first sample leaves at the device's ports, by the device's own clock; what lies behind them comes later still.
    fn began(&self) -> Instant;

    /// What is to be played by an output; samples as [`Device::exchange`](crate::Device::exchange) has them. Empty beyond the last.
    fn drive(&mut self, output: usize) -> &mut [f32];

    /// What an input hears in this cycle, as float32 of full scale, [`Cycle::frames`] samples. Empty for an
    /// input beyond the last.
    fn heard(&self, input: usize) -> &[f32];
}

/// What is done in each cycle of a device that calls: what is computed there leaves in the same cycle, with no block waiting
/// between.
///
/// It is called on the device's own thread, in real time: it must not allocate, lock, wait or fail.
pub trait Work: Any + Send {
    /// Fills the drive of one cycle.
    fn cycle(&mut self, cycle: &mut dyn Cycle);
}
