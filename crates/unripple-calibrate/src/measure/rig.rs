//! The rig of a measurement: a device, and somebody who moves the probe.

use crate::CalibrateError;
use unripple_core::{Device, Point};

/// The equipment of a measurement: a device, and somebody who moves the probe or taps the surface.
///
/// Before each recording the surface has to be at rest: [`Rig::ready`] waits until it is.
pub trait Rig {
    /// The device that plays and records.
    fn device(&mut self) -> &mut dyn Device;

    /// Brings the probe to a point and lets the surface come to rest. `number` is the index of the point in the plan;
    /// `attempt` counts the recordings there, from 0, so that a simulated rig can give the same random numbers again.
    ///
    /// # Errors
    /// [`CalibrateError::Rig`] if the point cannot be reached.
    fn ready(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError>;

    /// Makes sure that the surface is tapped at a point at some time during the recording that begins
    /// [`SILENCE`](super::SILENCE) blocks from now. It is called after [`Rig::ready`].
    ///
    /// # Errors
    /// [`CalibrateError::Rig`] if the surface cannot be tapped there.
    fn tap(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError>;

    /// Says why the last tap or blow at a point could not be used, before it is asked for again. Rigs without people need not listen.
    fn refused(&mut self, _number: usize, _why: &str) {}
}
