//! Methods of focusing, and their options.

use crate::{FeltOptions, FocusError};
use unripple_core::require;

/// Method by which a drive is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// The responses reversed in time, without a taper (Hudin et al. 2012, eq. 1): the matched filter, the highest
    /// peak for a given drive energy.
    #[default]
    TimeReversal,
    /// The sign of the time-reversed drive times the limit: the highest peak for a given drive limit.
    /// Samples at which the time-reversed drive is exactly zero stay zero.
    OneBit,
    /// Spatio-temporal inverse filter: the velocity of the whole surface at the focal instant is minimised
    /// with the level at the targets fixed, regularised by the energy of the drive. The field is as near to
    /// a delta function as the band allows (Tanter, Thomas and Fink 2000).
    Inverse,
    /// Concentration: the velocity outside the targets' focal discs at the focal instant is minimised with
    /// the level at the targets fixed, regularised by the energy of the drive.
    Concentrate,
    /// Concentration as by [`Method::Concentrate`], with the limits of the actuators as constraints, so that
    /// a higher peak is reached.
    Limited,
    /// Concentration as by [`Method::Concentrate`], for several surfaces at once: with all natural
    /// frequencies lower by [`Options::spread`], nominal, and higher by it. This tolerates changes of
    /// tension.
    Robust,
    /// The displacement outside the targets, weighted by the threshold of touch and over all time, is
    /// minimised: see [`FeltPlan`](crate::FeltPlan).
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

    /// Name of the method on the command line.
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

    /// Default of [`Options::strength`], a number from 0 to 1; 0 for methods that do not use it.
    pub fn strength(self) -> f64 {
        match self {
            Self::TimeReversal | Self::OneBit | Self::Felt => 0.0,
            Self::Concentrate => 0.945,
            Self::Inverse | Self::Limited => 0.98,
            Self::Robust => 0.985,
        }
    }

    /// Whether the method plays responses backwards (time reversal, one-bit) rather than solving an optimisation.
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

/// Compensation of the losses that break the symmetry of time (Hudin et al. 2012, section 2.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LossCorrection {
    /// No compensation: the matched filter.
    #[default]
    None,
    /// The response at time t after the impulse is multiplied by e^{+t/τ}, with this amplitude decay time τ
    /// in seconds.
    Uniform(f64),
    /// Each mode's contribution to the response is multiplied by e^{+σt}, with σ the decay rate of that
    /// mode. Modes that do not oscillate (overdamped) are not compensated. Modal responses only.
    PerMode,
}

/// Options of [`focus`](crate::focus): method, window, limits and parameters of the methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The method by which the drive is computed.
    pub method: Method,
    /// Window T, in seconds: samples 0 … n of each response are used, n = round(T · rate).
    pub window: f64,
    /// Largest magnitude of a sample, in the drive's unit. The drive's peak is scaled to this, unless an rms limit
    /// keeps it lower.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole;
    /// [`Method::Limited`] takes it as a constraint.
    pub rms_limit: Option<f64>,
    /// Largest rms of all actuators together, √(Σ mean d²) in the drive's unit: the square root of the power that they
    /// may take. A drive above it is scaled down as a whole; [`Method::Limited`] takes it as a constraint.
    pub total_rms: Option<f64>,
    /// Weight of velocity against energy in the cost, dimensionless: from 0, which is time reversal, to 1,
    /// velocity alone; `None` for the default of the method, [`Method::strength`]. Not used by time
    /// reversal, one-bit and [`Method::Felt`].
    pub strength: Option<f64>,
    /// For [`Method::Limited`]: the level to be reached, between that of the unlimited drive scaled to the
    /// limit (0) and that of the one-bit drive (1).
    pub push: f64,
    /// For [`Method::Robust`]: shift s of all natural frequencies, as a share of them, below 0.5. The drive
    /// is optimised for surfaces with 1 − s, 1 and 1 + s times the nominal frequencies.
    pub spread: f64,
    /// For [`Method::Inverse`]: whether the displacements of the modes at the focal instant are minimised along with
    /// their velocities. Needs modal responses; not used for repeated targets.
    pub rest: bool,
    /// For [`Method::Felt`]: weight, 0 to 1, between the two terms that are minimised: the mean square (0)
    /// and the square of the largest value (1) of what is felt outside the targets.
    pub worst: f64,
    /// For [`Method::Felt`]: weight of the drive's energy, dimensionless and above 0; see [`FeltOptions::economy`].
    pub economy: f64,
    /// For [`Method::Felt`]: time from the focal instant to the end of the drive, in seconds.
    pub lead: f64,
    /// Compensation of losses, for time reversal and one-bit.
    pub loss: LossCorrection,
    /// Length of the drive, in seconds; `None` for as long as is needed: the window, or with repetition until the last
    /// full period is steady. A single pulse is followed by silence up to this length.
    pub duration: Option<f64>,
    /// Truncation error allowed in modal responses, as a share of the sum of the magnitudes of their modes. From 1e-6
    /// upwards (120 dB below that sum) single precision is enough and is used, which is quickest.
    pub accuracy: f64,
}

impl Default for Options {
    /// Time reversal over 30 ms at a limit of 1, without compensation of losses.
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

    /// Checks that all options are in their ranges, including those of the method.
    ///
    /// # Errors
    /// [`FocusError::Range`] that names the first option out of its range.
    pub fn check(&self) -> Result<(), FocusError> {
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
        if self.method == Method::Felt {
            self.felt().check()?;
        }
        Ok(())
    }
}
