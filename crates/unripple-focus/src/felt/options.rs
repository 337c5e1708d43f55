//! Weights of the method that keeps down what is felt elsewhere.

use crate::FocusError;
use unripple_core::require;
use unripple_dsp::Threshold;

/// What a drive that is felt at the targets only should weigh against what.
#[derive(Clone, Debug, PartialEq)]
pub struct FeltOptions {
    /// Window T, in seconds: the drive has samples 0 … n, n = round(T · rate).
    pub window: f64,
    /// How long before the end of the drive the focus is, in seconds: afterwards the drive goes on to cancel what it left
    /// behind. At least 0, less than the window.
    pub lead: f64,
    /// Largest drive per actuator, in the drive's unit. The drive's peak is exactly this, unless `rms_limit` is lower.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Balance between the mean of what is felt elsewhere (0) and its worst spot (1). The square of the worst
    /// spot is much larger than the mean square, so that little is enough.
    pub worst: f64,
    /// Weight of the drive's energy, above 0. At 1 a drive of white noise costs as much by its energy as by what is felt
    /// of it; what is felt of a good drive is much less than that.
    pub economy: f64,
    /// The least vibration that is felt.
    pub threshold: Threshold,
}

impl Default for FeltOptions {
    /// Over 30 ms, in focus 4 ms before the end, at a limit of 1, for the published threshold: well below time reversal in
    /// background, worst spot and drive.
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
    /// Refuses options out of their range.
    pub(crate) fn check(&self) -> Result<(), FocusError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        require("window (s)", positive(self.window), "a positive number", self.window)?;
        let lead = (0.0..self.window).contains(&self.lead);
        require("lead (s)", lead, format!("0 to less than the window, {}", self.window), self.lead)?;
        require("limit", positive(self.limit), "a positive number", self.limit)?;
        if let Some(rms) = self.rms_limit {
            require("rms limit", positive(rms), "a positive number", rms)?;
        }
        require("weight of the worst spot", (0.0..=1.0).contains(&self.worst), "0 to 1", self.worst)?;
        let economy = (1e-6..=1e6).contains(&self.economy);
        Ok(require("economy", economy, "1e-6 to 1e6", self.economy)?)
    }
}
