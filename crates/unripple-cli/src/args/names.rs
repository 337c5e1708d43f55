//! Names on the command line of devices, methods and interpolations.

use clap::ValueEnum;

/// Where drives are sent and recordings come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum DeviceName {
    /// The simulated surface, with a probe.
    #[default]
    Virtual,
    /// A JACK server, or PipeWire.
    Jack,
    /// A sound card without a sound server, in a build with the feature `cards`.
    Card,
    /// WAV files: the program writes a file to play, and reads recordings of it that were made elsewhere.
    Tape,
}

impl DeviceName {
    /// The kind of device that the name stands for.
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

/// Objectives of a search for places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ObjectiveName {
    /// The mean of the contrasts.
    #[default]
    Mean,
    /// The least contrast.
    Worst,
    /// The contrast that a share of the targets stays below.
    Quantile,
}

impl ObjectiveName {
    /// The objective that the name stands for.
    pub fn objective(self) -> unripple_tasks::place::ObjectiveAsk {
        use unripple_tasks::place::ObjectiveAsk;
        match self {
            Self::Mean => ObjectiveAsk::Mean,
            Self::Worst => ObjectiveAsk::Worst,
            Self::Quantile => ObjectiveAsk::Quantile,
        }
    }
}

/// How a point is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum WayName {
    /// With a vibrometer, accelerometer or microphone at the point, while actuators drive.
    #[default]
    Probe,
    /// With taps at the point, while actuators sense.
    Tap,
}

/// Focusing methods by their names on the command line and in reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// The response from every actuator to the target, played backwards.
    TimeReversal,
    /// The sign of the time-reversed response, so that every sample is at the limit.
    OneBit,
    /// The sharpest peak that the band allows, by regularised least squares: more contrast for more energy.
    Inverse,
    /// The least velocity away from the targets at the focal instant: several times the contrast of time reversal.
    Concentrate,
    /// As `concentrate`, with every sample within the drive limit, for higher peaks.
    Limited,
    /// As `concentrate`, for lower, nominal and higher natural frequencies at once: for a sheet whose tension drifts.
    Robust,
    /// The lowest level felt away from the targets over the whole time, weighted by the fingertip's threshold.
    Felt,
}

impl MethodName {
    /// The focusing method that the name stands for.
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

/// How responses are interpolated between the points of a library.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum BetweenName {
    /// The response at the nearest point of the library.
    Nearest,
    /// Linear interpolation between the surrounding points of the library.
    Linear,
    /// Gaussian-process regression (kriging) for a diffuse wave field.
    #[default]
    Kernel,
}

impl BetweenName {
    /// The interpolation that the name stands for.
    pub fn interpolation(self) -> unripple_calibrate::Interpolation {
        use unripple_calibrate::Interpolation;
        match self {
            Self::Nearest => Interpolation::Nearest,
            Self::Linear => Interpolation::Linear,
            Self::Kernel => Interpolation::Kernel,
        }
    }
}

/// How the decay of waves is compensated in the drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LossName {
    /// No compensation: the paper's time reversal.
    None,
    /// Multiply the response by e^{+t/τ}, with the decay time τ of the surface, if it is the same for all modes.
    Uniform,
    /// Multiply the response of each mode by e^{+t/τ}, with the mode's own decay time τ.
    PerMode,
}
