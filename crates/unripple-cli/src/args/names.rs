//! Names of devices, methods and interpolations as they are typed.

use clap::ValueEnum;

/// Where drives go and what is heard comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum DeviceName {
    /// The surface computed in time, microphone included.
    #[default]
    Virtual,
    /// A JACK server, or PipeWire.
    Jack,
    /// A sound card without a sound server, in a build with the feature `cards`.
    Card,
    /// WAV files: what is to be played is written, what was recorded of it elsewhere is brought back.
    Tape,
}

impl DeviceName {
    /// What it stands for.
    pub fn kind(self) -> unripple_tasks::DeviceKind {
        use unripple_tasks::DeviceKind;
        match self {
            Self::Virtual => DeviceKind::Virtual,
            Self::Jack => DeviceKind::Jack,
            Self::Card => DeviceKind::Card,
            Self::Tape => DeviceKind::Tape,
        }
    }
}

/// How a place is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum WayName {
    /// A vibrometer, accelerometer or microphone at the place, actuators driving.
    #[default]
    Probe,
    /// Taps at the place, actuators listening.
    Tap,
}

/// Methods by the names the command line and reports use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// The response from every actuator to the target, played backwards.
    TimeReversal,
    /// The sign of time reversal, at the limit throughout.
    OneBit,
    /// The least-energy drive of a delta: more contrast for more energy.
    Inverse,
    /// The least velocity elsewhere at the focal instant: several times the contrast of time reversal.
    Concentrate,
    /// The same within each actuator's limit, pushed towards the highest peak.
    Limited,
    /// The same over a spread of frequencies: for a sheet that warms.
    Robust,
    /// The least that a fingertip feels elsewhere, over all time.
    Felt,
}

impl MethodName {
    /// What it stands for.
    pub fn method(self) -> unripple::focus::Method {
        use unripple::focus::Method;
        match self {
            Self::TimeReversal => Method::TimeReversal,
            Self::OneBit => Method::OneBit,
            Self::Inverse => Method::Inverse,
            Self::Concentrate => Method::Concentrate,
            Self::Limited => Method::Limited,
            Self::Robust => Method::Robust,
            Self::Felt => Method::Felt,
        }
    }
}

/// What stands for a place between the points of a library.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum BetweenName {
    /// The nearest point.
    Nearest,
    /// A line between the points around it.
    Linear,
    /// The most likely field of waves.
    #[default]
    Kernel,
}

impl BetweenName {
    /// What it stands for.
    pub fn interpolation(self) -> unripple_calibrate::Interpolation {
        use unripple_calibrate::Interpolation;
        match self {
            Self::Nearest => Interpolation::Nearest,
            Self::Linear => Interpolation::Linear,
            Self::Kernel => Interpolation::Kernel,
        }
    }
}

/// How the decay of what is played back is made up for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LossName {
    /// Not at all: the paper's time reversal.
    None,
    /// By e^{+t/τ} with the surface's one decay time.
    Uniform,
    /// Mode by mode, by e^{+t/τ} with each mode's own decay time.
    PerMode,
}
