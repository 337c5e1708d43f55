//! Options of a player: sizes, limits of actuators, and bounds on the work in a block.

use crate::PlayerError;
use crate::error::{count, same};
use unripple_core::require;

/// Options of a player. All memory that they call for is allocated once, when the player is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Number of outputs, one per actuator.
    pub outputs: usize,
    /// Samples per block, per output.
    pub block: usize,
    /// Samples per second.
    pub rate: f64,
    /// Limits of the actuators: one per output, or a single one for all.
    pub limits: Vec<Limit>,
    /// Largest number of repeating voices (combs and loops) at once.
    pub voices: usize,
    /// Largest number of copies of drives sounding at once; a comb whose period is shorter than its drive has several.
    pub copies: usize,
    /// Length of the longest drive, in samples.
    pub longest: usize,
    /// Largest number of samples (over all outputs) of drives that are compared with the limits in one
    /// block: the bound on its work, at some 2 ns each. Starts beyond this bound wait for the next block and
    /// are reported as late, but one drive can always start in a block, however long it is.
    pub work: usize,
    /// Inputs for continuous waveforms; `None` for a player without them.
    pub waves: Option<WaveOptions>,
    /// Largest number of commands in the ring to the player, and of those that wait in the player for their sample.
    pub commands: usize,
}

impl Default for Options {
    /// Eight outputs in blocks of 64 at 48 kHz with a peak limit of 1, drives of up to a tenth of a second, no waveforms.
    fn default() -> Self {
        Self {
            outputs: 8,
            block: 64,
            rate: 48e3,
            limits: vec![Limit::default()],
            voices: 64,
            copies: 256,
            longest: 4800,
            work: 1 << 18,
            waves: None,
            commands: 1024,
        }
    }
}

/// The limits of an actuator, in its own unit: peak, short-term and thermal rms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Largest magnitude of a sample, in the actuator's unit.
    pub peak: f64,
    /// Limit on the running rms over a short time; `None` for no such limit.
    pub rms: Option<Running>,
    /// Limit on the running rms over a time as long as the actuator takes to heat up; `None` for no such limit.
    pub thermal: Option<Running>,
}

impl Default for Limit {
    /// A peak of 1.
    fn default() -> Self {
        Self { peak: 1.0, rms: None, thermal: None }
    }
}

/// A limit on the running rms √p of an output d, where the running power p follows p' = (d² − p) / τ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Running {
    /// Largest running rms √p, in the actuator's unit.
    pub level: f64,
    /// The time constant τ over which power is averaged, in seconds.
    pub seconds: f64,
}

/// Options of continuous waveforms, where each input is convolved into all outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveOptions {
    /// Number of inputs, which is the number of points at which waveforms can be played at once.
    pub inputs: usize,
    /// Length of the longest response, in samples at the full rate.
    pub taps: usize,
    /// Highest frequency of waveforms that is played, in Hz: the top of the band.
    pub band_top_hz: f64,
    /// Size of each input's ring buffer, in samples.
    pub feed: usize,
    /// Largest number of prepared waveforms playing at once, over all inputs.
    pub sounds: usize,
}

impl Default for WaveOptions {
    /// Ten inputs with responses of 30 ms at 48 kHz, up to 3 kHz.
    fn default() -> Self {
        Self { inputs: 10, taps: 1440, band_top_hz: 3000.0, feed: 4096, sounds: 64 }
    }
}

/// Most of anything that options may ask for: a bound on what is allocated. With twice this value, options of twice the
/// size are taken.
const MOST: usize = 1 << 20;

impl Options {
    /// The limits of the output of this index, in the actuator's unit.
    pub fn limit(&self, output: usize) -> Limit {
        let which = if self.limits.len() == 1 { 0 } else { output };
        self.limits.get(which).copied().unwrap_or_default()
    }

    /// Checks that a player can be made with these options.
    ///
    /// # Errors
    /// [`PlayerError::Range`] for the first number out of range, [`PlayerError::Size`] for a number of limits that is
    /// neither 1 nor that of the outputs.
    pub fn check(&self) -> Result<(), PlayerError> {
        count("outputs", self.outputs, 1, 4096)?;
        count("samples of a block", self.block, 8, 8192)?;
        require("sample rate", self.rate > 0.0, "a positive number", self.rate)?;
        count("voices", self.voices, 1, MOST)?;
        count("copies", self.copies, 1, MOST)?;
        count("samples of the longest drive", self.longest, 1, 1 << 24)?;
        count("work of a block", self.work, 1, usize::MAX)?;
        count("commands", self.commands, 1, MOST)?;
        if self.limits.len() != 1 {
            same("limits", self.limits.len(), self.outputs)?;
        }
        self.limits.iter().try_for_each(Limit::check)?;
        self.waves.map_or(Ok(()), |waves| waves.check(self.rate))
    }
}

impl Limit {
    fn check(&self) -> Result<(), PlayerError> {
        let peak = f64::from(self.peak as f32);
        require("peak limit", peak > 0.0 && peak <= 1e12, "above 0, at most 1e12", self.peak)?;
        for running in [self.rms, self.thermal].into_iter().flatten() {
            require("rms limit", running.level > 0.0, "a positive number", running.level)?;
            require("time of an rms limit", running.seconds > 0.0, "seconds above 0", running.seconds)?;
        }
        Ok(())
    }
}

impl WaveOptions {
    fn check(&self, rate: f64) -> Result<(), PlayerError> {
        count("inputs", self.inputs, 1, 4096)?;
        count("taps", self.taps, 1, 1 << 22)?;
        count("samples of an input's ring", self.feed, 1, 1 << 24)?;
        count("waveforms", self.sounds, 1, MOST)?;
        let legal = self.band_top_hz > 0.0 && self.band_top_hz <= rate / 2.0;
        Ok(require("top of the band", legal, "above 0, at most half the sample rate", self.band_top_hz)?)
    }
}
