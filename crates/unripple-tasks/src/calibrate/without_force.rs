//! A device without the input of a hammer's force, for tests of what moves when actuators drive.

use unripple::core::{Device, DeviceError, FORCE, Layout, Status};

/// A device with all inputs but that of a hammer's force, which no actuator moves.
pub struct WithoutForce<'a> {
    device: &'a mut dyn Device,
    layout: Layout,
    /// Indices of the inputs that are left.
    inputs: Vec<usize>,
    heard: Vec<f32>,
}

impl<'a> WithoutForce<'a> {
    /// The device without its input of a force, if it has one.
    pub fn new(device: &'a mut dyn Device) -> Self {
        let whole = device.layout().clone();
        let inputs: Vec<usize> =
            (0..whole.inputs.len()).filter(|input| whole.inputs[*input] != FORCE).collect();
        let heard = vec![0.0; whole.inputs.len() * whole.block];
        let names = inputs.iter().map(|input| whole.inputs[*input].clone()).collect();
        Self { device, layout: Layout { inputs: names, ..whole }, inputs, heard }
    }
}

impl Device for WithoutForce<'_> {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        self.device.status()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        self.device.exchange(drive, &mut self.heard)?;
        let block = self.layout.block;
        for (plane, input) in heard.chunks_exact_mut(block).zip(&self.inputs) {
            plane.copy_from_slice(&self.heard[input * block..][..block]);
        }
        Ok(())
    }
}
