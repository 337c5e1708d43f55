//! The trait of whatever plays drives and records what comes back: sound cards, sound servers, virtual
//! surfaces, files.

use crate::Work;
use std::fmt;
use std::time::Duration;

/// Where drives meet the world: blocks of drive go out, blocks of what is heard come back. Virtual surfaces, sound
/// servers and files all are devices; so calibration and play know one kind of thing.
///
/// A device is open from when it is made until it is dropped. Samples are float32 between -1 and 1 of full scale, or in the
/// actuator's own unit where the device knows it: [`Layout::full_scale`] says how much drive one is.
pub trait Device: Send {
    /// Its channels, rate and block.
    fn layout(&self) -> &Layout;

    /// How it fares: whether blocks pass, how many did, how many were late.
    fn status(&self) -> Status;

    /// Plays one block and hears one, taking as long as the device's own clock takes. `drive` holds [`Layout::block`]
    /// samples for each output, one output after another, and `heard` as many for each input. What is heard in a block
    /// answers drive of the same and earlier blocks, later by the round trip's latency.
    ///
    /// # Errors
    /// [`DeviceError::Size`] for slices of another length; [`DeviceError::Lost`] once the device is gone;
    /// [`DeviceError::Stalled`] when no block passed within the device's patience.
    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError>;

    /// Hands over what the device is to call in each of its cycles from now on, instead of being asked to
    /// [exchange](Device::exchange) blocks; [`Device::dismiss`] has it back.
    ///
    /// # Errors
    /// The work itself, for a device that calls nobody: most have no clock of their own.
    fn employ(&mut self, work: Box<dyn Work>) -> Result<(), Box<dyn Work>> {
        Err(work)
    }

    /// Calls no longer, and gives back what was called: after the cycle under way, if there is one. Nothing comes back from a device that
    /// stands still and cannot be left.
    fn dismiss(&mut self) -> Option<Box<dyn Work>> {
        None
    }

    /// Looks after a device that calls, and returns the time (a [`Duration`]) until it wants to be looked
    /// after again.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] once the device is gone for good.
    fn tend(&mut self) -> Result<Duration, DeviceError> {
        match self.status().state {
            State::Lost(why) => Err(DeviceError::Lost { device: self.layout().device.clone(), why }),
            _ => Ok(TEND),
        }
    }
}

/// How often a device that calls is looked after, and so how late its loss is noticed at most. Doubled, it is
/// noticed twice as late; the drive itself does not wait for it.
pub const TEND: Duration = Duration::from_millis(100);

/// Name of the input that hears a probe on the surface.
pub const PROBE: &str = "probe";

/// What a device has: name, sample rate, block length, channels and scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// What it is called: `virtual`, `jack`, a file's name.
    pub device: String,
    /// Samples per second.
    pub rate: f64,
    /// Samples per block.
    pub block: usize,
    /// Names of the outputs, in the order of the drive.
    pub outputs: Vec<String>,
    /// Names of the inputs, in the order of what is heard.
    pub inputs: Vec<String>,
    /// Drive, in the actuators' unit, of a sample of 1.
    pub full_scale: f64,
}

/// How a device fares: its state, and blocks passed and lost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Whether blocks pass, and if not, why.
    pub state: State,
    /// Blocks exchanged so far.
    pub blocks: u64,
    /// Blocks that came late or were lost so far.
    pub lost: u64,
    /// Samples that drive given by [`Device::exchange`] waits until it leaves the device, as far as that is known.
    pub waiting: u64,
    /// What the server behind it says, where there is one.
    pub server: Option<Server>,
}

/// What a sound server says of itself and of how it fares.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Server {
    /// Samples of a cycle as it is now; a server may change it at any time.
    pub period: usize,
    /// Real-time priority (1 to 99) of the thread on which it calls its clients; `None` where that has none. Whoever works for
    /// a client stays below it.
    pub priority: Option<u8>,
    /// Samples from our ports to the air, as the server knows it: the largest over all ports.
    pub playback: u64,
    /// Samples from the air to our ports, likewise.
    pub capture: u64,
    /// Cycles that it says came late, whoever's fault that was: all its clients are told of each.
    pub late: u64,
    /// Cycles whose time was over before our own part of them was done. The time until we were called counts,
    /// the work of other clients does not.
    pub own_late: u64,
    /// Samples that it left out between cycles: silence, and a jump in what sounds.
    pub skipped: u64,
}

/// Whether blocks pass, and if not, why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// Blocks pass as they should.
    #[default]
    Running,
    /// No block has passed for a while, for this reason; some may pass again.
    Stalled(String),
    /// No block will pass any more, for this reason.
    Lost(String),
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Running => f.write_str("running"),
            Self::Stalled(why) => write!(f, "stalled: {why}"),
            Self::Lost(why) => write!(f, "lost: {why}"),
        }
    }
}

/// Why a device did not exchange a block.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// A block of another size than the device's.
    #[error("device `{device}`: expected {expected} samples of {what}, found {found}")]
    Size {
        /// Name of the device, as [`Layout::device`] says it.
        device: String,
        /// `drive` or `heard`.
        what: &'static str,
        /// Samples there should be.
        expected: usize,
        /// Samples there are.
        found: usize,
    },
    /// The device is gone for good, for the reason given.
    #[error("device `{device}` is lost: {why}")]
    Lost {
        /// Name of the device, as [`Layout::device`] says it.
        device: String,
        /// What happened, in words for people.
        why: String,
    },
    /// No block passed within the device's patience.
    #[error("device `{device}` stalled: {why}")]
    Stalled {
        /// Name of the device, as [`Layout::device`] says it.
        device: String,
        /// What happened, in words for people.
        why: String,
    },
}

impl Layout {
    /// Compares the lengths of a block's two buffers, in samples over all channels, with the layout's.
    ///
    /// # Errors
    /// [`DeviceError::Size`] with what was expected and found.
    pub fn fits(&self, drive: usize, heard: usize) -> Result<(), DeviceError> {
        let wanted = [("drive", self.outputs.len(), drive), ("heard", self.inputs.len(), heard)];
        for (what, channels, found) in wanted {
            let expected = channels * self.block;
            if found != expected {
                return Err(DeviceError::Size { device: self.device.clone(), what, expected, found });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_another_size_are_refused() {
        let names = |n: usize| (0..n).map(|i| format!("c{i}")).collect::<Vec<_>>();
        let layout = Layout {
            device: "virtual".into(),
            rate: 48e3,
            block: 64,
            outputs: names(2),
            inputs: names(3),
            full_scale: 1.0,
        };
        assert!(layout.fits(128, 192).is_ok());
        let error = layout.fits(128, 128).unwrap_err();
        assert_eq!(error.to_string(), "device `virtual`: expected 192 samples of heard, found 128");
    }
}
