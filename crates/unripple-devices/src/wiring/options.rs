//! Options of the wiring test.

use crate::DevicesError;
use unripple_core::{Surface, require};

/// Pause between bursts in decay times, (`LOW`) the frequency at which the decay time is taken, as a share
/// of the burst's, and (`LONGEST`) the longest pause, in s. After five decay times an amplitude is at 0.7 %;
/// half as many leave 8 % of one burst in the next.
const PAUSE: f64 = 5.0;
const LOW: f64 = 0.3;
const LONGEST: f64 = 10.0;

/// Options of the wiring test: bursts, pauses, limits.
///
/// ```
/// let options = unripple_devices::WiringOptions::for_band([0.0, 3e3]);
/// assert_eq!(options.frequency, 600.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WiringOptions {
    /// Centre frequency of the bursts, in Hz: low in the band, where a slightly wrong model is still
    /// accurate.
    pub frequency: f64,
    /// Length of a burst, in periods.
    pub cycles: f64,
    /// Peak of a burst, as a share of full scale.
    pub level: f64,
    /// Duration of the recording, from the burst's start on, that is compared with the model, in s.
    pub listen: f64,
    /// Longest latency that is searched, in s.
    pub max_latency: f64,
    /// Silence before each burst, in s.
    pub pause: f64,
    /// Smallest mean correlation (0 to 1) of a channel's recordings with the model that is enough for a verdict.
    pub least_likeness: f64,
}

impl Default for WiringOptions {
    fn default() -> Self {
        Self {
            frequency: 600.0,
            cycles: 2.0,
            level: 0.5,
            listen: 0.02,
            max_latency: 0.1,
            pause: 0.2,
            least_likeness: 0.5,
        }
    }
}

impl WiringOptions {
    /// Options for a band (its lower and upper limit, in Hz): the frequency of bursts lies a fifth of the way from the lower to the upper.
    pub fn for_band(band: [f64; 2]) -> Self {
        Self { frequency: band[0] + 0.2 * (band[1] - band[0]), ..Self::default() }
    }

    /// Options for a surface: bursts at a fifth of its band, each played when the one before has decayed to
    /// less than a hundredth.
    pub fn for_surface(surface: &Surface) -> Self {
        let usual = Self::for_band(surface.emission.band);
        let decay = crate::perturbation::nominal_decay(surface, LOW * usual.frequency);
        Self { pause: (PAUSE * decay).min(LONGEST).max(usual.pause), ..usual }
    }

    /// Checks that all values are in their ranges for a device of this sample rate, in Hz.
    pub(super) fn check(&self, rate: f64) -> Result<(), DevicesError> {
        let in_band = self.frequency > 0.0 && self.frequency < rate / 2.0;
        require("frequency of a burst in Hz", in_band, "positive, below half the rate", self.frequency)?;
        require("periods of a burst", (0.5..=100.0).contains(&self.cycles), "0.5 to 100", self.cycles)?;
        require("level of a burst", self.level > 0.0 && self.level <= 1.0, "above 0, at most 1", self.level)?;
        for (what, time) in [
            ("time to listen in s", self.listen),
            ("longest latency in s", self.max_latency),
            ("pause in s", self.pause),
        ] {
            require(what, (0.0..=10.0).contains(&time), "0 to 10", time)?;
        }
        require("time to listen in samples", self.listen * rate >= 2.0, "2 or more", self.listen * rate)?;
        let least = self.least_likeness;
        Ok(require("least likeness", (0.0..=1.0).contains(&least), "0 to 1", least)?)
    }
}
