//! Rigs of a calibration: the virtual surface, or people at a real one.

use super::hands::Hands;
use unripple::core::{Device, FORCE, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Rig, SILENCE};
use unripple_devices::{Handle, Tap, Virtual};

/// The virtual surface, brought to rest before every recording. Its noise and taps depend only on the seed,
/// the point and the number of the attempt.
pub struct VirtualRig {
    device: Virtual,
    handle: Handle,
    seed: u64,
    /// Whether taps are blows of a hammer.
    hammer: bool,
}

impl VirtualRig {
    /// A virtual surface whose noise and taps are determined by `seed`, the point and the number of the
    /// attempt.
    pub fn new(device: Virtual, seed: u64) -> Self {
        let hammer = device.layout().inputs.iter().any(|input| input == FORCE);
        Self { handle: device.handle(), device, seed, hammer }
    }

    fn seed(&self, number: usize, attempt: u64) -> u64 {
        (self.seed ^ (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_add(attempt)
    }
}

impl Rig for VirtualRig {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.device
    }

    fn ready(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        self.handle.rest(self.seed(number, attempt));
        self.handle.move_probe(at).map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }

    fn tap(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        let seed = self.seed(number, attempt);
        let layout = self.device.layout();
        let tap = if self.hammer { Tap::hammer(seed, layout.rate) } else { Tap::random(seed, layout.rate) };
        let silence = (SILENCE * layout.block) as f64 / layout.rate;
        let after = silence + 0.01 + 0.04 * (seed % 1024) as f64 / 1024.0;
        self.handle
            .tap(&tap, at, after)
            .map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }
}

/// The people at a real surface, and whether they move a probe.
pub struct People {
    /// The callback that asks the people to move the probe or to tap.
    pub hands: Hands,
    /// Whether there is a probe to be moved; measurements by taps need none.
    pub probe: bool,
    /// Whether they have a hammer with a force sensor, which takes the input of the probe.
    pub hammer: bool,
}

/// A real device, and people at the surface who move the probe and tap.
pub struct HandRig<D> {
    device: D,
    people: People,
    place: Option<usize>,
    /// Why the last tap or blow could not be used.
    refused: Option<String>,
}

impl<D: Device> HandRig<D> {
    /// A real device, with `people` who move the probe or tap the surface when they are asked to.
    pub fn new(device: D, people: People) -> Self {
        Self { device, people, place: None, refused: None }
    }

    fn ask(&mut self, number: usize, text: &str) -> Result<(), CalibrateError> {
        (self.people.hands)(text).map_err(|why| CalibrateError::Rig { number, why })
    }
}

impl<D: Device> Rig for HandRig<D> {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.device
    }

    fn ready(&mut self, number: usize, at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        if self.people.probe && self.place != Some(number) {
            self.ask(number, &format!("point {}: put the probe at {at}", number + 1))?;
            self.place = Some(number);
        }
        Ok(())
    }

    fn tap(&mut self, number: usize, at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        let strike = if self.people.hammer { "strike once with the hammer" } else { "tap" };
        let before = self.refused.take().map_or_else(String::new, |why| format!("not used ({why}); "));
        self.ask(
            number,
            &format!(
                "{before}point {}: get ready to {strike} at {at} right after pressing Enter",
                number + 1
            ),
        )
    }

    fn refused(&mut self, _number: usize, why: &str) {
        self.refused = Some(why.to_owned());
    }
}
