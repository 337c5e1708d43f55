//! Devices as typed, for whoever opens one.

use crate::args::DeviceOptions;
use unripple::core::Surface;
use unripple_devices::{DevicesError, JackOptions, Unknowns, Virtual, VirtualOptions};
use unripple_tasks::device;
pub use unripple_tasks::device::names;

pub fn virtual_surface(
    options: &DeviceOptions,
    surface: &Surface,
    plain: &VirtualOptions,
) -> Result<(Virtual, Option<Unknowns>), DevicesError> {
    device::virtual_surface(&options.ask(), surface, plain)
}

pub fn jack(options: &DeviceOptions, surface: &Surface, inputs: Vec<String>) -> JackOptions {
    device::jack(&options.ask(), surface, inputs)
}

#[cfg(feature = "cards")]
pub fn card(
    options: &DeviceOptions,
    surface: &Surface,
    inputs: Vec<String>,
) -> unripple_devices::cards::CardOptions {
    device::card(&options.ask(), surface, inputs)
}
