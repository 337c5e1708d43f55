//! The real-time callback of an audio device: the buffers of one cycle, and the code called to fill them.

use crate::clock::Instant;
use std::any::Any;

/// The buffers of one callback cycle of a device with its own clock: outputs to be filled, and recorded inputs. All have
/// [`Cycle::frames`] samples, a number that may differ from cycle to cycle.
pub trait Cycle {
    /// Number of samples per channel in this cycle: the length of every [`Cycle::drive`] and [`Cycle::heard`] buffer.
    fn frames(&self) -> usize;

    /// The instant at which the first sample of the cycle passes the device's ports, by the device's own
    /// clock. The latency of converters and cables behind the ports comes on top.
    fn began(&self) -> Instant;

    /// The buffer to fill for an output (by its index), with samples scaled as in
    /// [`Device::exchange`](crate::Device::exchange). The slice is empty for an index beyond the last
    /// output.
    fn drive(&mut self, output: usize) -> &mut [f32];

    /// The samples that an input (by its index) recorded, as float32 with full scale 1, [`Cycle::frames`]
    /// of them. The slice is empty for an index beyond the last input.
    fn heard(&self, input: usize) -> &[f32];
}

/// A real-time callback that a device calls once per cycle. Samples that it writes leave in the same cycle, without a
/// block of buffering in between.
///
/// The callback runs on the device's own thread, in real time: it must not allocate, lock, wait or fail.
pub trait Work: Any + Send {
    /// Reads the inputs and fills the outputs of one cycle.
    fn cycle(&mut self, cycle: &mut dyn Cycle);
}
