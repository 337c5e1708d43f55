//! Report of the task `verify`: measured beside predicted, where they part, and the likeliest causes.

use super::analysis::Analysis;
use super::bench::Recorded;
use super::parting::{InBand, InTime, in_bands, in_time};
use super::setting::{Setting, spot};
use serde::Serialize;
use unripple::act::{self, Note};
use unripple::core::{ActuatorKind, Point, Surface};
use unripple::dsp::rms;
use unripple_calibrate::causes::{Cause, Suspect, WireFault};

/// Largest deviation of the velocity at the focus from the prediction that counts as agreement, as a share: what the gains of
/// good amplifiers and probes are off by.
const SAME: f64 = 0.03;

/// Largest amplitude of what is left unexplained everywhere, as a share of the recordings, that counts as agreement: it moves
/// a contrast of 10 by less than a tenth.
const EXPLAINED: f64 = 0.1;

/// Whether the bench does what was predicted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// Nothing was played: a dry run.
    Planned,
    /// Velocity and shape are those predicted.
    Agrees,
    /// They are not.
    Differs,
}

/// The focus as velocities at the places tell it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FocusFigures {
    /// Velocity at the target at the focal instant, in m/s.
    pub velocity_m_s: f64,
    /// Its magnitude over the rms velocity of the places outside the focal disc at the same instant; `None` without such places.
    pub contrast: Option<f64>,
    /// Full width at half maximum, in m, by the places within the focal disc; `None` without any that tell it.
    pub spot_m: Option<f64>,
}

impl FocusFigures {
    fn of(setting: &Setting, traces: &[Vec<f64>]) -> Self {
        let at = |trace: &Vec<f64>| trace.get(setting.focal_sample()).copied().unwrap_or(0.0);
        let now: Vec<f64> = traces.iter().map(at).collect();
        let velocity_m_s = now[0];
        let outside = |place: &Point| place.distance(setting.places[0]) > setting.disc;
        let others: Vec<f64> =
            setting.places.iter().zip(&now).filter(|(place, _)| outside(place)).map(|(_, v)| *v).collect();
        let around = rms(&others);
        let contrast = (!others.is_empty() && around > 0.0).then(|| velocity_m_s.abs() / around);
        Self { velocity_m_s, contrast, spot_m: spot(&setting.places, &now, setting.disc) }
    }
}

/// One place: what is predicted there, and what was recorded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlaceFigures {
    /// The place, in m.
    pub at_m: [f64; 2],
    /// Whether it lies outside the focal disc.
    pub outside: bool,
    /// Largest predicted velocity, in m/s.
    pub predicted_peak_m_s: f64,
    /// Largest recorded velocity, in m/s; absent in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_peak_m_s: Option<f64>,
    /// Rms difference of the two over the rms predicted velocity; absent in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<f64>,
}

/// Gain of an actuator, relative to the prediction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActuatorGain {
    /// Name of the actuator.
    pub name: String,
    /// Least-squares factor on its part of the prediction.
    pub gain: f64,
}

/// A suspected cause of a difference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CauseFound {
    /// Name of the cause: `tension`, `wires`, `saturation`, `gains` or `noise`.
    pub cause: &'static str,
    /// The cause in words.
    pub text: String,
    /// Amplitude that stays unexplained if this is the cause, as a share of the recordings'.
    pub unexplained: f64,
    /// For `tension`: relative deviation from the tension that the prediction assumes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tension_change: Option<f64>,
    /// For `wires`: the actuators concerned.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actuators: Vec<String>,
    /// For `saturation`: magnitude at which the drive seems to be clipped, in the drive's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clip: Option<f64>,
}

impl CauseFound {
    fn of(suspect: &Suspect, surface: &Surface, unit: &str) -> Self {
        let name = |a: usize| surface.actuators.get(a).map_or_else(String::new, |a| a.name.clone());
        let plain = Self {
            cause: suspect.cause.name(),
            text: String::new(),
            unexplained: suspect.left,
            tension_change: None,
            actuators: Vec::new(),
            clip: None,
        };
        match &suspect.cause {
            Cause::Tension { ratio } => {
                let text = format!("the tension is {:+.2} % off", 100.0 * (ratio - 1.0));
                Self { text, tension_change: Some(ratio - 1.0), ..plain }
            }
            Cause::Wires(faults) => {
                let one = |fault: &WireFault| match *fault {
                    WireFault::Swapped(a, b) => format!("`{}` and `{}` are exchanged", name(a), name(b)),
                    WireFault::Reversed(a) => format!("`{}` is reversed", name(a)),
                    WireFault::Dead(a) => format!("`{}` is dead", name(a)),
                };
                let text = faults.iter().map(one).collect::<Vec<_>>().join(", ");
                let actuators = faults.iter().flat_map(|fault| fault.actuators()).map(name).collect();
                Self { text, actuators, ..plain }
            }
            Cause::Saturation { clip } => {
                let text = format!("an amplifier saturates, at about {clip:.3} {unit}");
                Self { text, clip: Some(*clip), ..plain }
            }
            Cause::Gains => Self { text: "gains of single actuators differ".into(), ..plain },
            Cause::Noise => Self { text: "noise of the probe".into(), ..plain },
        }
    }
}

/// What was measured, beside the prediction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// The focus as it was recorded.
    pub focus: FocusFigures,
    /// Recorded velocity at the focus over the predicted one; `None` where the scale is not known.
    pub velocity_ratio: Option<f64>,
    /// Recorded contrast over the predicted one.
    pub contrast_ratio: Option<f64>,
    /// Delay of the recordings, in s.
    pub latency_s: f64,
    /// Factor on the prediction that fits all recordings best.
    pub gain: f64,
    /// Amplitude that gain and delay leave unexplained, as a share of the recordings'.
    pub unexplained: f64,
    /// Amplitude of the noise as a share of the recordings'.
    pub noise: f64,
    /// Amplitude by which the recordings differ from those at a quarter of the level, scaled up, as a share of the recordings'.
    pub nonlinearity: Option<f64>,
    /// Least-squares gain of each actuator.
    pub gains: Vec<ActuatorGain>,
    /// Where the difference lies in time.
    pub times: Vec<InTime>,
    /// Where the difference lies in frequency.
    pub bands: Vec<InBand>,
    /// Suspected causes, the likeliest first.
    pub causes: Vec<CauseFound>,
}

/// A drive on the bench beside its prediction, in SI units.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    program: &'static str,
    version: &'static str,
    command: &'static str,
    surface: String,
    /// Whether the bench does what was predicted.
    pub state: State,
    /// Name of the device that played; absent in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// Level of the drive, as a share of what the file has.
    pub level: f64,
    /// Largest sample of the drive as it is played.
    pub drive_peak: f64,
    /// Unit of the drive.
    pub drive_unit: &'static str,
    /// Largest sample as a share of the surface's limit.
    pub limit_share: f64,
    /// Length of each recording besides the latency, in s.
    pub recording_s: f64,
    /// Focal instant, in s.
    pub instant_s: f64,
    /// Radius of the focal disc, in m.
    pub focal_radius_m: f64,
    /// The predicted focus, at the places that are probed.
    pub predicted: FocusFigures,
    /// What was measured; absent in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// The places, the target first.
    pub places: Vec<PlaceFigures>,
    /// Whether velocities are in m/s.
    pub scaled: bool,
    /// Notes on the prediction and the device.
    pub notes: Vec<Note>,
}

impl Report {
    /// What would be played.
    pub(super) fn planned(setting: &Setting, level: f64) -> Self {
        let surface = &setting.surface;
        let place = |(at, trace): (&Point, &Vec<f64>)| PlaceFigures {
            at_m: [at.x, at.y],
            outside: at.distance(setting.places[0]) > setting.disc,
            predicted_peak_m_s: peak(trace),
            measured_peak_m_s: None,
            difference: None,
        };
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "verify",
            surface: surface.name.clone(),
            state: State::Planned,
            device: None,
            level,
            drive_peak: setting.drive.peak(),
            drive_unit: act::unit(&surface.actuators.first().map_or(ActuatorKind::Force, |a| a.kind)),
            limit_share: setting.drive.peak() / surface.emission.limit,
            recording_s: setting.samples as f64 / setting.drive.rate(),
            instant_s: setting.instant,
            focal_radius_m: setting.disc,
            predicted: FocusFigures::of(setting, &setting.predicted),
            measured: None,
            places: setting.places.iter().zip(&setting.predicted).map(place).collect(),
            scaled: setting.scaled,
            notes: setting.notes.clone(),
        }
    }

    /// This report with what was recorded.
    pub(super) fn with(mut self, setting: &Setting, recorded: &Recorded, analysis: &Analysis) -> Self {
        let (found, measured) = (&analysis.findings, &analysis.measured);
        let focus = FocusFigures::of(setting, measured);
        let ratio = |found: f64, known: f64| (known != 0.0).then(|| found / known);
        let velocity_ratio =
            ratio(focus.velocity_m_s, self.predicted.velocity_m_s).filter(|_| recorded.scaled);
        let contrast_ratio = focus.contrast.zip(self.predicted.contrast).and_then(|(a, b)| ratio(a, b));
        let same = velocity_ratio.is_none_or(|ratio| (ratio - 1.0).abs() <= SAME);
        self.state = if same && found.left <= EXPLAINED { State::Agrees } else { State::Differs };
        let (surface, unit) = (&setting.surface, self.drive_unit);
        let gain = |(actuator, gain): (&unripple::core::Actuator, &f64)| ActuatorGain {
            name: actuator.name.clone(),
            gain: *gain,
        };
        for ((place, found), known) in self.places.iter_mut().zip(measured).zip(&setting.predicted) {
            place.measured_peak_m_s = Some(peak(found));
            let off: Vec<f64> = found.iter().zip(known).map(|(found, known)| found - known).collect();
            place.difference = ratio(rms(&off), rms(known));
        }
        self.measured = Some(Measured {
            focus,
            velocity_ratio,
            contrast_ratio,
            latency_s: found.delay / setting.drive.rate(),
            gain: found.gain,
            unexplained: found.left,
            noise: found.noise,
            nonlinearity: found.nonlinearity,
            gains: surface.actuators.iter().zip(&found.gains).map(gain).collect(),
            times: in_time(setting, measured),
            bands: in_bands(setting, measured),
            causes: found.suspects.iter().map(|suspect| CauseFound::of(suspect, surface, unit)).collect(),
        });
        self.device = Some(recorded.device.clone());
        self.scaled = recorded.scaled;
        if let Some(truth) = &recorded.truth {
            self.notes.push(Note { topic: "device", text: format!("the virtual surface has {truth}") });
        }
        self
    }
}

/// Largest magnitude of a signal.
pub(super) fn peak(trace: &[f64]) -> f64 {
    trace.iter().fold(0.0, |most, v| most.max(v.abs()))
}
