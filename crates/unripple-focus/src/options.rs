//! Methods of focusing, and their options.

use crate::{FeltOptions, FocusError};
use unripple_core::require;

/// How the drive is made from the reversed responses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// The responses reversed in time, without a taper (Hudin et al. 2012, eq. 1): the matched filter, the highest
    /// peak for a given drive energy.
    #[default]
    TimeReversal,
    /// The sign of time reversal at the limit: the highest peak for a given drive limit. Where time reversal is
    /// exactly zero, so is this.
    OneBit,
    /// The least-energy drive of a band-limited delta at the focal instant: the spatio-temporal inverse
    /// filter.
    Inverse,
    /// The least velocity outside the targets' discs at the focal instant, for the energy it takes.
    Concentrate,
    /// As [`Method::Concentrate`], under the limits of each actuator, pushed towards the highest peak.
    Limited,
    /// As [`Method::Concentrate`], over a spread of frequencies at a fixed window.
    Robust,
    /// The least that is felt elsewhere over all time, as [`FeltPlan`](crate::FeltPlan) says.
    Felt,
}

impl Method {
    /// Every method, the default first.
    pub const ALL: [Self; 7] = [
        Self::TimeReversal,
        Self::OneBit,
        Self::Inverse,
        Self::Concentrate,
        Self::Limited,
        Self::Robust,
        Self::Felt,
    ];

    /// The name the command line uses.
    pub fn name(self) -> &'static str {
        match self {
            Self::TimeReversal => "time-reversal",
            Self::OneBit => "one-bit",
            Self::Inverse => "inverse",
            Self::Concentrate => "concentrate",
            Self::Limited => "limited",
            Self::Robust => "robust",
            Self::Felt => "felt",
        }
    }

    /// The strength that is used unless another is asked for, a number from 0 to 1; 0 where strength means
    /// nothing.
    pub fn strength(self) -> f64 {
        match self {
            Self::TimeReversal | Self::OneBit | Self::Felt => 0.0,
            Self::Concentrate => 0.945,
            Self::Inverse | Self::Limited => 0.98,
            Self::Robust => 0.985,
        }
    }

    /// Whether responses are played back as they are, rather than a state sought.
    pub fn reverses(self) -> bool {
        matches!(self, Self::TimeReversal | Self::OneBit)
    }
}

impl std::str::FromStr for Method {
    type Err = FocusError;

    fn from_str(name: &str) -> Result<Self, FocusError> {
        Self::ALL.into_iter().find(|method| method.name() == name).ok_or_else(|| FocusError::Method {
            found: name.to_owned(),
            expected: Self::ALL.map(|method| format!("`{}`", method.name())).join(", "),
        })
    }
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// What is done about the losses that break the symmetry of time (Hudin et al. 2012, section 2.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LossCorrection {
    /// Nothing: the matched filter.
    #[default]
    None,
    /// The response at age t is raised by e^{+t/τ}, with this amplitude decay time τ in seconds.
    Uniform(f64),
    /// Each mode's share of the response is raised by e^{+σt} with the σ of that mode. Modes that do not oscillate
    /// (overdamped) are left as they are. Modal responses only.
    PerMode,
}

/// How to focus: method, window, limits and their details.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The method by which the drive is made.
    pub method: Method,
    /// Window T, in seconds: samples 0 … n of each response are used, n = round(T · rate).
    pub window: f64,
    /// Largest drive per actuator, in the drive's unit. The drive's peak is exactly this, unless `rms_limit` is lower.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// Largest rms of all actuators together, √(Σ mean d²) in the drive's unit: the square root of the power that they may take.
    /// A drive above it is scaled down as a whole.
    pub total_rms: Option<f64>,
    /// How far from time reversal (0) to the method's own limit (1); `None` for [`Method::strength`]. Nothing to time
    /// reversal and one-bit.
    pub strength: Option<f64>,
    /// Of [`Method::Limited`]: from the level that the unlimited drive has at the limit (0) to that of one-bit (1).
    pub push: f64,
    /// Of [`Method::Robust`]: the largest stretch of frequencies that is borne, up and down, as a share.
    pub spread: f64,
    /// Of [`Method::Inverse`]: whether the displacement of every mode is brought to zero as well.
    pub rest: bool,
    /// Of [`Method::Felt`]: the balance between the mean of what is felt elsewhere (0) and its worst spot
    /// (1).
    pub worst: f64,
    /// Of [`Method::Felt`]: weight of the drive's energy, above 0.
    pub economy: f64,
    /// Of [`Method::Felt`]: how long before the end of the drive the focus is, in seconds.
    pub lead: f64,
    /// What is done about losses; of time reversal and one-bit.
    pub loss: LossCorrection,
    /// Length of the drive, in seconds; `None` for as long as is needed: the window, or with repetition until the last
    /// full period is steady. A single pulse is followed by silence up to this length.
    pub duration: Option<f64>,
    /// Accuracy of modal responses, as a share of the sum of the magnitudes of their modes. Single precision is enough
    /// down to 1e-6, which is 120 dB below that sum; the quickest.
    pub accuracy: f64,
}

impl Default for Options {
    /// Time reversal over 30 ms at a limit of 1, without correction of losses.
    fn default() -> Self {
        Self {
            method: Method::TimeReversal,
            window: 30e-3,
            limit: 1.0,
            rms_limit: None,
            total_rms: None,
            strength: None,
            push: 0.5,
            spread: 0.005,
            rest: false,
            worst: FeltOptions::default().worst,
            economy: FeltOptions::default().economy,
            lead: FeltOptions::default().lead,
            loss: LossCorrection::None,
            duration: None,
            accuracy: 1e-6,
        }
    }
}

impl Options {
    /// The options of [`Method::Felt`].
    pub(crate) fn felt(&self) -> FeltOptions {
        FeltOptions {
            window: self.window,
            lead: self.lead,
            limit: self.limit,
            rms_limit: self.rms_limit,
            worst: self.worst,
            economy: self.economy,
            ..FeltOptions::default()
        }
    }

    /// Refuses options out of their range.
    pub(crate) fn check(&self) -> Result<(), FocusError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        require("window (s)", positive(self.window), "a positive number", self.window)?;
        require("limit", positive(self.limit), "a positive number", self.limit)?;
        require("accuracy", positive(self.accuracy), "a positive number", self.accuracy)?;
        for (what, rms) in [("rms limit", self.rms_limit), ("total rms limit", self.total_rms)] {
            let rms = rms.unwrap_or(1.0);
            require(what, positive(rms), "a positive number", rms)?;
        }
        if let Some(duration) = self.duration {
            require("duration (s)", positive(duration), "a positive number", duration)?;
        }
        let share = |x: f64| (0.0..=1.0).contains(&x);
        if let Some(strength) = self.strength {
            require("strength", share(strength), "0 to 1", strength)?;
        }
        require("push", share(self.push), "0 to 1", self.push)?;
        require("spread of frequencies", (0.0..0.5).contains(&self.spread), "0 to 0.5", self.spread)?;
        if let LossCorrection::Uniform(tau) = self.loss {
            require("decay time of the loss correction (s)", positive(tau), "a positive number", tau)?;
        }
        Ok(())
    }
}
