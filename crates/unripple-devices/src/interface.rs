//! Converters and amplifiers between computer and surface: rate, delay, gains.

use crate::DevicesError;
use crate::delay::{Delay, HALF};
use crate::error::same;
use unripple_core::{Layout, Random, require};

/// The chain between a computer and a surface: converters, amplifiers and wires. The default has no faults.
///
/// Faults of the surface itself, of its sensors and of whole channels are
/// [`InjectedFaults`](unripple_physics::stepper::InjectedFaults); those of an interface act on all outputs and
/// inputs, the probe included.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Gain of each output, a factor on its drive, negative for a reversed wire; an empty list means 1 for
    /// all outputs.
    pub drive_gains: Vec<f64>,
    /// Gain of each input, a factor on its signal; an empty list means 1 for all inputs.
    pub heard_gains: Vec<f64>,
    /// Root mean square of white noise on each input, in the input's unit; an empty list means no noise.
    pub noise: Vec<f64>,
    /// Latency of all inputs, in samples: a whole number, or a fractional number of at least 24, for which
    /// the interpolator is made.
    pub latency: f64,
    /// Number of blocks after which the device fails with
    /// [`DeviceError::Lost`](unripple_core::DeviceError::Lost); `None` for never.
    pub vanish_after: Option<u64>,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Interface {
    fn default() -> Self {
        Self {
            drive_gains: Vec::new(),
            heard_gains: Vec::new(),
            noise: Vec::new(),
            latency: 0.0,
            vanish_after: None,
            seed: 1,
        }
    }
}

/// An interface in use, with its delay line and its noise.
#[derive(Clone, Debug)]
pub(crate) struct Converter {
    interface: Interface,
    delay: Delay,
    random: Random,
}

impl Converter {
    pub(crate) fn new(interface: &Interface, layout: &Layout) -> Result<Self, DevicesError> {
        let mut interface = interface.clone();
        let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
        let lists = [
            ("gains of the drive", &mut interface.drive_gains, outputs, 1.0),
            ("gains of the inputs", &mut interface.heard_gains, inputs, 1.0),
            ("levels of noise", &mut interface.noise, inputs, 0.0),
        ];
        for (what, list, count, default) in lists {
            if list.is_empty() {
                list.resize(count, default);
            }
            same(what, list.len(), count)?;
            list.iter().try_for_each(|value| require(what, true, "finite numbers", *value))?;
        }
        let late = interface.latency;
        let whole = late.fract() == 0.0;
        let expected = format!("a whole number of samples up to 1e7, or at least {HALF}");
        let legal = (0.0..=1e7).contains(&late) && (whole || late >= HALF as f64);
        require("latency of an interface in samples", legal, expected, late)?;
        let random = Random::seeded(interface.seed);
        Ok(Self { delay: Delay::new(inputs, late), random, interface })
    }

    /// Restarts the noise with another seed.
    pub(crate) fn reseed(&mut self, seed: u64) {
        self.random = Random::seeded(self.interface.seed ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    }

    /// Whether the device is lost after `blocks` blocks.
    pub(crate) fn vanished(&self, blocks: u64) -> bool {
        self.interface.vanish_after.is_some_and(|most| blocks >= most)
    }

    /// Converts a block of drive to the actuators' unit, with each output's gain.
    pub(crate) fn send(&self, layout: &Layout, drive: &[f32], sent: &mut [f64]) {
        let planes = sent.chunks_exact_mut(layout.block).zip(drive.chunks_exact(layout.block));
        for ((sent, drive), gain) in planes.zip(&self.interface.drive_gains) {
            let gain = gain * layout.full_scale;
            sent.iter_mut().zip(drive).for_each(|(to, from)| *to = gain * f64::from(*from));
        }
    }

    /// Applies gains, noise and latency to a block of input signals, in place.
    pub(crate) fn hear(&mut self, frames: usize, planes: &mut [f64]) {
        self.delay.process(planes, frames);
        let levels = self.interface.heard_gains.iter().zip(&self.interface.noise);
        for (plane, (gain, noise)) in planes.chunks_exact_mut(frames).zip(levels) {
            plane.iter_mut().for_each(|x| *x *= gain);
            if *noise != 0.0 {
                plane.iter_mut().for_each(|x| *x += noise * self.random.normal());
            }
        }
    }
}
