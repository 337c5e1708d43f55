//! The interface of audio devices, which play drives and record signals: sound cards, sound servers, virtual
//! surfaces, files.

use crate::Work;
use std::fmt;
use std::time::Duration;

/// An audio device: it plays blocks of drive samples and returns blocks of recorded samples. Sound cards, sound servers, virtual
/// surfaces and files all have this interface, so that calibration and playback work with any of them.
///
/// A device is open from its construction until it is dropped. Samples are float32 between -1 and 1 of full scale, or in the
/// actuator's own unit where the device knows it: [`Layout::full_scale`] is the drive that a sample of 1 stands for.
pub trait Device: Send {
    /// The device's channels, sample rate and block length.
    fn layout(&self) -> &Layout;

    /// The state of the device: whether blocks are being exchanged, how many have been, and how many were
    /// late or lost.
    fn status(&self) -> Status;

    /// Plays one block and records one; calls return at the pace of the device's clock. `drive` holds
    /// [`Layout::block`] samples for each output, one output after another; `heard` receives the same
    /// number of recorded samples for each input. The recorded signal is the response to the drive of this
    /// and earlier blocks, delayed by the round-trip latency.
    ///
    /// # Errors
    /// [`DeviceError::Size`] for slices of another length; [`DeviceError::Lost`] once the device is gone;
    /// [`DeviceError::Stalled`] if no block passed within the device's time limit.
    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError>;

    /// Installs a callback that the device calls in each of its cycles from now on, instead of
    /// [exchanging](Device::exchange) blocks. [`Device::remove_work`] returns it.
    ///
    /// # Errors
    /// Returns the callback itself if the device cannot call it: most devices have no clock of their own.
    fn install_work(&mut self, work: Box<dyn Work>) -> Result<(), Box<dyn Work>> {
        Err(work)
    }

    /// Removes the callback that [`Device::install_work`] installed and returns it, once the current cycle is
    /// over. `None` if no callback was installed, or if the device has stopped calling it and does not
    /// release it.
    fn remove_work(&mut self) -> Option<Box<dyn Work>> {
        None
    }

    /// Checks a device that calls a callback and updates its [`Status`]; to be called at intervals. Returns the time (a
    /// [`Duration`]) until the next check.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] once the device is gone for good.
    fn check(&mut self) -> Result<Duration, DeviceError> {
        match self.status().state {
            State::Lost(why) => Err(DeviceError::Lost { device: self.layout().device.clone(), why }),
            _ => Ok(CHECK_INTERVAL),
        }
    }
}

/// Default interval between checks of a device that calls a callback ([`Device::check`]): the longest time
/// until the loss of the device is noticed. Twice this interval doubles that time; playback does not wait
/// for the checks.
pub const CHECK_INTERVAL: Duration = Duration::from_millis(100);

/// Name of the input that records a velocity probe on the surface, in [`Layout::inputs`].
pub const PROBE: &str = "probe";

/// Name of the input that records the force of a hammer, in N.
pub const FORCE: &str = "force";

/// The configuration of a device: name, sample rate, block length, channels and full scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Name of the device: `virtual`, `jack`, a file's name.
    pub device: String,
    /// Samples per second.
    pub rate: f64,
    /// Samples per channel in a block.
    pub block: usize,
    /// Names of the outputs, in the order of the drive's channels.
    pub outputs: Vec<String>,
    /// Names of the inputs, in the order of the recorded channels.
    pub inputs: Vec<String>,
    /// The drive that a sample of 1 stands for, in the actuators' unit.
    pub full_scale: f64,
}

/// The status of a device: its state, and the numbers of blocks exchanged and lost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Whether blocks are being exchanged, and if not, the reason.
    pub state: State,
    /// Blocks exchanged so far.
    pub blocks: u64,
    /// Number of blocks so far that came late or were lost.
    pub lost: u64,
    /// Delay in samples, as far as it is known, from the call of [`Device::exchange`] with a block until
    /// that block leaves the device.
    pub waiting: u64,
    /// What the sound server behind the device reports; `None` without a server.
    pub server: Option<Server>,
}

/// What a sound server reports: its period, latencies, and counts of late cycles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Server {
    /// Number of samples per cycle at present; a server may change it at any time.
    pub period: usize,
    /// Real-time priority (1 to 99) of the thread on which the server calls this client; `None` without real-time scheduling.
    /// Other threads of the client should have a lower one.
    pub priority: Option<u8>,
    /// Playback latency from our output ports to the converter's output, in samples, as the server reports it: the largest over
    /// all ports.
    pub playback: u64,
    /// Capture latency from the converter's input to our input ports, in samples: the largest over all ports.
    pub capture: u64,
    /// Number of cycles that the server reported as late (xruns), whichever client caused them.
    pub late: u64,
    /// Number of cycles that ended before our own callback was done. A callback that began late counts; time taken by other
    /// clients afterwards does not.
    pub own_late: u64,
    /// Number of samples that the server skipped between cycles: a gap in the output, and a jump in the signals.
    pub skipped: u64,
}

/// Whether a device is exchanging blocks, and if not, the reason.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// Blocks are being exchanged at the device's rate.
    #[default]
    Running,
    /// No block has been exchanged for a while, for the reason in the string; the device may recover.
    Stalled(String),
    /// No block will be exchanged any more, for the reason in the string.
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
    /// The length of a buffer is not that of a block of the device.
    #[error("device `{device}`: expected {expected} samples of {what}, found {found}")]
    Size {
        /// Name of the device, as in [`Layout::device`].
        device: String,
        /// Which buffer has the wrong length: `drive` or `heard`.
        what: &'static str,
        /// Required length of the buffer, in samples.
        expected: usize,
        /// Actual length of the buffer, in samples.
        found: usize,
    },
    /// The device is gone for good.
    #[error("device `{device}` is lost: {why}")]
    Lost {
        /// Name of the device, as in [`Layout::device`].
        device: String,
        /// The reason, in words for people.
        why: String,
    },
    /// No block was exchanged within the device's time limit.
    #[error("device `{device}` stalled: {why}")]
    Stalled {
        /// Name of the device, as in [`Layout::device`].
        device: String,
        /// The reason, in words for people.
        why: String,
    },
}

impl Layout {
    /// Checks the lengths of a block's two buffers, in samples over all channels, against this layout.
    ///
    /// # Errors
    /// [`DeviceError::Size`] for the first buffer whose length differs.
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
