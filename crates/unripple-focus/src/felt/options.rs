//! Options of the method that minimises what is felt outside the targets.

use crate::FocusError;
use unripple_core::require;
use unripple_dsp::Threshold;

/// Options of [`FeltPlan`](crate::FeltPlan): window, limits, and weights of what is felt outside the targets.
#[derive(Clone, Debug, PartialEq)]
pub struct FeltOptions {
    /// Window T, in seconds: the drive has samples 0 … n, n = round(T · rate).
    pub window: f64,
    /// Time from the focal instant to the end of the drive, in seconds: after the focus the drive goes on and cancels
    /// the waves that remain. At least 0, less than the window.
    pub lead: f64,
    /// Largest magnitude of a sample, in the drive's unit. The drive's peak is scaled to this, unless `rms_limit` is
    /// lower.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Weight, 0 to 1, between the two terms that are minimised: the mean square (0) and the square of the
    /// largest value (1) of what is felt outside the targets. The latter is much larger, so that a small
    /// weight is enough.
    pub worst: f64,
    /// Weight of the drive's energy, dimensionless, 1e-6 to 1e6. At 1, for a drive of random samples, the term of
    /// energy is about as large as that of the mean square felt; for an optimised drive the latter is much smaller.
    pub economy: f64,
    /// Threshold of vibrotactile detection: the least displacement that is felt, at each frequency.
    pub threshold: Threshold,
}

impl Default for FeltOptions {
    /// A window of 30 ms with the focus 4 ms before its end, a limit of 1 and the published threshold. With these
    /// weights, background, worst spot and drive are well below those of time reversal.
    fn default() -> Self {
        Self {
            window: 30e-3,
            lead: 4e-3,
            limit: 1.0,
            rms_limit: None,
            worst: 0.04,
            economy: 0.06,
            threshold: Threshold::default(),
        }
    }
}

impl FeltOptions {
    /// Checks that all options are in their ranges.
    pub(crate) fn check(&self) -> Result<(), FocusError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        require("window (s)", positive(self.window), "a positive number", self.window)?;
        require(
            "time from the focus to the end of the window (s)",
            self.lead >= 0.0,
            "0 or more",
            self.lead,
        )?;
        let room = format!("more than {}, the time from the focus to its end", self.lead);
        require("window (s)", self.window > self.lead, room, self.window)?;
        require("limit", positive(self.limit), "a positive number", self.limit)?;
        if let Some(rms) = self.rms_limit {
            require("rms limit", positive(rms), "a positive number", rms)?;
        }
        require("weight of the worst spot", (0.0..=1.0).contains(&self.worst), "0 to 1", self.worst)?;
        let economy = (1e-6..=1e6).contains(&self.economy);
        Ok(require("economy", economy, "1e-6 to 1e6", self.economy)?)
    }
}
