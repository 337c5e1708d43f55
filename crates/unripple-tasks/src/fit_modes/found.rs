//! What a fit to frequencies found, as it stands in the report.

use serde::Serialize;
use unripple_calibrate::frequencies as fit;
use unripple_store::to_toml;

/// A fitted quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// Name of the quantity, as `free` names it.
    pub quantity: String,
    /// Unit of its values.
    pub unit: &'static str,
    /// The value found.
    pub value: f64,
    /// Ends of the 95 % interval, given which mode each frequency is.
    pub interval: [f64; 2],
    /// The value of the surface file.
    pub nominal: f64,
}

impl Value {
    pub(super) fn of(found: &fit::FittedValue) -> Self {
        let fit::FittedValue { quantity, unit, value, interval, nominal } = *found;
        Self { quantity: quantity.name(), unit, value, interval, nominal }
    }
}

/// A measured frequency and the mode that it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mode {
    /// Number of the mode from 1, without motions as a rigid body.
    pub mode: usize,
    /// Measured frequency, in Hz.
    pub measured_hz: f64,
    /// Frequency of the fitted surface, in Hz.
    pub computed_hz: f64,
    /// Measured over computed frequency, less 1.
    pub residual: f64,
    /// The same for a fit to all other frequencies, linearised; `None` where the others tell nothing of it.
    pub left_out: Option<f64>,
}

impl Mode {
    pub(super) fn of(found: &fit::MatchedMode) -> Self {
        Self {
            mode: found.mode + 1,
            measured_hz: found.measured_hz,
            computed_hz: found.computed_hz,
            residual: found.residual.exp_m1(),
            left_out: found.left_out.map(f64::exp_m1),
        }
    }
}

/// What frequencies do not tell.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Untold {
    /// Name of the quantity that keeps the value of the file.
    pub held: String,
    /// The product of powers of quantities that is not told, in words.
    pub product: String,
    /// Factor either way within which it may lie with a probability of 95 %; `None` if frequencies tell nothing of it.
    pub factor: Option<f64>,
}

impl Untold {
    pub(super) fn of(found: &fit::Untold) -> Self {
        let power = |(quantity, exponent): &(fit::Quantity, f64)| match *exponent == 1.0 {
            true => quantity.name(),
            false => format!("{}^{exponent:.2}", quantity.name()),
        };
        let product = found.direction.iter().map(power).collect::<Vec<_>>().join(" · ");
        // More than a million either way is nothing.
        let factor = found.deviation.map(|deviation| (1.96 * deviation).exp()).filter(|factor| *factor < 1e6);
        Self { held: found.held.name(), product, factor }
    }
}

/// Damping by the decay times.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Losses {
    /// Loss factor, where the surface file has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss_factor: Option<f64>,
    /// Ends of its 95 % interval, where there are several decay times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
    /// Pairs of frequency in Hz and decay time in s, where the surface file has decay times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_times: Option<Vec<[f64; 2]>>,
}

impl Losses {
    pub(super) fn of(found: &fit::FittedLosses) -> Self {
        match found {
            fit::FittedLosses::LossFactor { value, interval } => {
                Self { loss_factor: Some(*value), interval: *interval, decay_times: None }
            }
            fit::FittedLosses::DecayTimes(rows) => Self {
                loss_factor: None,
                interval: None,
                decay_times: Some(rows.iter().map(|(hz, time)| [*hz, *time]).collect()),
            },
        }
    }
}

/// Another surface that explains the frequencies.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Other {
    /// How its sides are held.
    pub sides: String,
    /// Whether it is a mirror image, which no frequency tells from the first.
    pub mirrored: bool,
    /// Its fitted quantities.
    pub quantities: Vec<Value>,
    /// Cost of its fit, as that of the first.
    pub cost: f64,
    /// What would tell it from the first; `None` if neither a frequency nor the motion at a place does.
    pub telling: Option<Telling>,
    /// The text of its surface file.
    pub surface_toml: String,
}

impl Other {
    pub(super) fn of(found: &fit::Other) -> Self {
        Self {
            sides: found.explained.sides.clone(),
            mirrored: found.mirrored,
            quantities: found.explained.values.iter().map(Value::of).collect(),
            cost: found.explained.cost,
            telling: found.telling.as_ref().map(Telling::of),
            surface_toml: to_toml(&found.explained.surface),
        }
    }
}

/// The measurement that would tell two surfaces apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Telling {
    /// The measurement in words.
    pub text: String,
    /// Frequencies of the mode that tells, in Hz: of the first surface and of the other, or the nearest that it has.
    pub frequencies_hz: [f64; 2],
    /// Place to listen at, in m, if it is a place that tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 2]>,
    /// How far each moves there, over the largest amplitude of the mode.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<[f64; 2]>,
}

impl Telling {
    fn of(found: &fit::Telling) -> Self {
        match *found {
            fit::Telling::Frequency { hz, of_first, nearest_hz } => {
                let (which, other) =
                    if of_first { ("this surface", "the other") } else { ("the other", "this surface") };
                let text = format!(
                    "listen for a mode near {hz:.1} Hz: {which} has it, and the nearest of {other} is at {nearest_hz:.1} Hz"
                );
                let frequencies_hz = if of_first { [hz, nearest_hz] } else { [nearest_hz, hz] };
                Self { text, frequencies_hz, at_m: None, motion: None }
            }
            fit::Telling::Place { at, hz, motion } => {
                let text = format!(
                    "tap, or hold a finger, at {at}: in the mode near {:.1} Hz this surface moves there by {:.0} % of its largest amplitude, \
                     the other by {:.0} %",
                    hz[0],
                    100.0 * motion[0],
                    100.0 * motion[1]
                );
                Self { text, frequencies_hz: hz, at_m: Some([at.x, at.y]), motion: Some(motion) }
            }
        }
    }
}
