//! What a player is made for: sizes that are allocated once.

use crate::PlayerError;
use crate::error::{count, same};
use unripple_core::require;

/// What a player is made for; all of it is allocated once.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Number of actuators.
    pub outputs: usize,
    /// Samples per block, per output.
    pub block: usize,
    /// Samples per second.
    pub rate: f64,
    /// Limits of the actuators: one per output, or a single one for all.
    pub limits: Vec<Limit>,
    /// Most repeating voices at once.
    pub voices: usize,
    /// Most drives sounding at once; a comb whose period is shorter than its drive sounds several times.
    pub copies: usize,
    /// Samples of the longest drive.
    pub longest: usize,
    /// Most samples (over all outputs) of drives that are judged in one block: the bound on its work, at some 2 ns each. Starts
    /// beyond it wait for the next block, and are reported late; one drive a block is judged however long.
    pub work: usize,
    /// Continuous waveforms, if there are any.
    pub waves: Option<WaveOptions>,
    /// Commands that may wait on their way to the player, and as many that wait there for their sample.
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
    /// Largest magnitude of a sample.
    pub peak: f64,
    /// Largest running rms over a short time.
    pub rms: Option<Running>,
    /// Largest running rms over a time as long as the actuator takes to heat up.
    pub thermal: Option<Running>,
}

impl Default for Limit {
    /// A peak of 1.
    fn default() -> Self {
        Self { peak: 1.0, rms: None, thermal: None }
    }
}

/// A bound on the root of the running power p, which follows p' = (d² − p) / τ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Running {
    /// Largest √p, in the actuator's unit.
    pub level: f64,
    /// The time constant τ.
    pub seconds: f64,
}

/// Continuous waveforms: each input is convolved into all outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveOptions {
    /// Inputs: waveforms at as many places at once.
    pub inputs: usize,
    /// Samples of the longest response, at the full rate.
    pub taps: usize,
    /// Highest frequency that is kept whole, in Hz.
    pub band_top_hz: f64,
    /// Samples that may wait in each input's ring.
    pub feed: usize,
    /// Most prepared waveforms sounding at once, over all inputs.
    pub sounds: usize,
}

impl Default for WaveOptions {
    /// Ten inputs with responses of 30 ms at 48 kHz, up to 3 kHz.
    fn default() -> Self {
        Self { inputs: 10, taps: 1440, band_top_hz: 3000.0, feed: 4096, sounds: 64 }
    }
}

/// Most of anything that options may ask for: a bound on what is allocated. Doubled, options of twice the
/// size are taken.
const MOST: usize = 1 << 20;

impl Options {
    /// The limit of an output, by its index, in its unit.
    pub fn limit(&self, output: usize) -> Limit {
        let which = if self.limits.len() == 1 { 0 } else { output };
        self.limits.get(which).copied().unwrap_or_default()
    }

    /// Whether a player can be made of these.
    ///
    /// # Errors
    /// [`PlayerError::Range`] or [`PlayerError::Size`] at the first fault.
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
