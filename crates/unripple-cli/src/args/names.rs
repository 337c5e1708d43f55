//! Names on the command line of devices, methods, interpolations and the like.

use clap::ValueEnum;
use unripple::focus::Method;
use unripple_calibrate::Interpolation;
use unripple_tasks::DeviceKind;
use unripple_tasks::calibrate::By;
use unripple_tasks::export::Format;
use unripple_tasks::focus::Losses;
use unripple_tasks::import::{Kind, Per, Quantity};
use unripple_tasks::place::{ByAsk, ObjectiveAsk};

/// Defines names, each with its help, and their conversion to the values of the same names of another type.
macro_rules! names {
    ($($(#[$($about:tt)*])* $name:ident => $meaning:ty { $($(#[$($help:tt)*])* $value:ident,)+ })+) => {$(
        $(#[$($about)*])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub enum $name {
            $($(#[$($help)*])* $value,)+
        }

        impl From<$name> for $meaning {
            fn from(name: $name) -> Self {
                match name {
                    $($name::$value => Self::$value,)+
                }
            }
        }
    )+};
}

names! {
    /// Where drives are sent and recordings come from.
    #[derive(Default)]
    DeviceName => DeviceKind {
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

    /// Objectives of a search for places.
    #[derive(Default)]
    ObjectiveName => ObjectiveAsk {
        /// The mean of the contrasts.
        #[default]
        Mean,
        /// The least contrast.
        Worst,
        /// The contrast that a share of the targets stays below.
        Quantile,
    }

    /// Figures of drives by which layouts are compared.
    FigureName => ByAsk {
        /// Contrast at the focal instant.
        Contrast,
        /// Felt contrast.
        FeltContrast,
        /// Felt level at the target with the drive at its limit.
        FeltLevel,
        /// Least energy of the drive for a peak velocity.
        EnergyForPeak,
    }

    /// How a point is measured.
    #[derive(Default)]
    WayName => By {
        /// With a vibrometer, accelerometer or microphone at the point, while actuators drive.
        #[default]
        Probe,
        /// With taps at the point, while actuators sense.
        Tap,
        /// With blows of a hammer at the point, whose force is recorded, while actuators sense.
        Hammer,
    }

    /// Focusing methods by their names on the command line and in reports.
    MethodName => Method {
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

    /// How responses are interpolated between the points of a library.
    #[derive(Default)]
    BetweenName => Interpolation {
        /// The response at the nearest point of the library.
        Nearest,
        /// Linear interpolation between the surrounding points of the library.
        Linear,
        /// Gaussian-process regression (kriging) for a diffuse wave field.
        #[default]
        Kernel,
    }

    /// How the decay of waves is compensated in the drive.
    LossName => Losses {
        /// No compensation: the paper's time reversal.
        None,
        /// Multiply the response by e^{+t/τ}, with the decay time τ of the surface, if it is the same for all modes.
        Uniform,
        /// Multiply the response of each mode by e^{+t/τ}, with the mode's own decay time τ.
        PerMode,
    }

    /// What imported responses are.
    KindName => Kind {
        /// Ratios of the spectra of response and reference.
        FrequencyResponses,
        /// Responses to an impulse of one unit of the reference times one second.
        ImpulseResponses,
        /// Coefficients with which samples of the reference are convolved: impulse responses divided by the sample rate.
        Filters,
    }

    /// What was measured at the points of imported responses.
    QuantityName => Quantity {
        /// Velocity normal to the sheet.
        Velocity,
        /// Displacement normal to the sheet.
        Displacement,
        /// Acceleration normal to the sheet.
        Acceleration,
    }

    /// Unit of the reference of imported responses.
    PerName => Per {
        /// A force in newtons.
        Newton,
        /// A voltage in volts.
        Volt,
        /// A current in amperes.
        Ampere,
    }

    /// Formats that libraries are exported to.
    FormatName => Format {
        /// A folder with a float32 WAV file for each point, one channel per actuator, and library.json.
        Wav,
        /// One SOFA file: AES69, convention GeneralFIR-E, with points as measurements and actuators as emitters.
        Sofa,
        /// One universal file: nodes, units and frequency responses.
        Uff,
        /// One universal file with the modes of the surface that the library describes.
        UffModes,
        /// One MATLAB file of version 5.
        Mat,
    }
}
