//! Outputs that lead nowhere, for tests in which nobody listens.

use unripple_core::{Device, DeviceError, Layout, Status};

/// A device that drops what it plays, and hears nothing.
pub struct Nowhere(pub Layout);

impl Device for Nowhere {
    fn layout(&self) -> &Layout {
        &self.0
    }

    fn status(&self) -> Status {
        Status::default()
    }

    fn exchange(&mut self, _: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        heard.fill(0.0);
        Ok(())
    }
}
