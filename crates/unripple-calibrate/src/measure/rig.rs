//! The rig that a measurement needs: a device, and somebody who moves the probe.

use crate::CalibrateError;
use unripple_core::{Device, Point};

/// All that a measurement needs of the world: a device, and somebody who moves the probe or taps the surface.
///
/// Before each recording the surface is at rest: [`Rig::ready`] waits for that, or sees to it.
pub trait Rig {
    /// The device that plays and records.
    fn device(&mut self) -> &mut dyn Device;

    /// Brings the probe to a point and lets the surface come to rest. `number` counts the points of the plan, from 0;
    /// `attempt` the recordings there, so that a seeded rig can be the same each time it comes back.
    ///
    /// # Errors
    /// [`CalibrateError::Rig`] if the point cannot be reached.
    fn ready(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError>;

    /// Has the surface tapped at a point, at some time in the recording that follows, [`SILENCE`](super::SILENCE) blocks from
    /// now. Comes after [`Rig::ready`].
    ///
    /// # Errors
    /// [`CalibrateError::Rig`] if nobody can.
    fn tap(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError>;
}
