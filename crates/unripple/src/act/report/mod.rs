//! The report of a drive on a surface, in SI units.

mod heat;
mod played;
mod text;
mod unscaled;

pub use heat::CoilHeat;
pub use played::{Followed, Stroked};
pub use unscaled::ratios_of;

use super::{Felt, Judged, Note, Sound, Strength};
use crate::core::{Actuator, ActuatorKind, CoilDrive, Drive, Surface};
use crate::field::{DriveFigures, SilenceFigures, Similarity, TakenOn, TargetFigures};
use crate::focus::Focused;
use crate::physics::design::Linearity;
use serde::Serialize;

/// The report of one drive on one surface. Lengths are in metres, times in seconds, drives in the
/// actuators' unit.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// The command that made the report.
    pub command: &'static str,
    /// Name of the surface.
    pub surface: String,
    /// The model on which metrics were computed, if it is not `surface` with the modes of its band.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged_on: Option<String>,
    /// Method by which the drive was computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<&'static str>,
    /// The window T, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_s: Option<f64>,
    /// The period of a repeated drive, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// Sample rate of the drive, in Hz.
    pub sample_rate_hz: f64,
    /// The channels of the drive, one per actuator.
    pub actuators: Vec<Channel>,
    /// Metrics of every target.
    pub targets: Vec<TargetFigures>,
    /// Metrics of targets that were to follow a waveform.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub waveforms: Vec<Followed>,
    /// Residual motion at points of silence.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub silent: Vec<SilenceFigures>,
    /// Metrics of a focus that moves along a path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke: Option<Stroked>,
    /// Motion of the fingers that rest on the surface.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<Felt>,
    /// Slopes, strains and added tension of the field, which linear theory assumes to be small.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linearity: Option<Linearity>,
    /// Metrics of the drive itself.
    pub drive: DriveFigures,
    /// Mean mechanical power that the actuators give to the sheet, in W, over the whole drive or its last
    /// period; absent where [`power()`](crate::act::power()) cannot determine it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_mechanical_power_w: Option<f64>,
    /// Structural similarity of the vibration, as an image, and of the targets; absent on a library, for waveforms and strokes, and where
    /// nothing moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ssim: Option<Similarity>,
    /// Sound pressure level above the surface; absent for waveforms and strokes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sound: Option<Sound>,
    /// Mean heat in the coils; absent if the surface has no coils.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coil_heat: Option<CoilHeat>,
    /// Level of the drive relative to its limits, and what decided it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level: Option<Strength>,
    /// An upper bound of the relative error (root mean square over the window) of the responses that a focus was evaluated on; absent where
    /// it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub response_error: Option<f64>,
    /// Thickness of the sheet, in metres.
    #[serde(skip)]
    pub thickness: f64,
    /// Shortest wavelength of the band, in metres.
    pub lambda_min_m: f64,
    /// Radius of the focal disc around every target, in metres; only points beyond it count as outside.
    pub focal_radius_m: f64,
    /// Whether the points outside the focal discs are those of a regular grid or those of a library of responses.
    pub taken_on: TakenOn,
    /// Number of points that lie outside every target's disc.
    pub outside_points: usize,
    /// Share of all points that lie outside every target's disc, from 0 to 1.
    pub outside_share: f64,
    /// The highest level felt outside the focal discs, in dB above the threshold of touch.
    pub felt_outside_db: Option<f64>,
    /// Remarks and warnings that go with the results.
    pub notes: Vec<Note>,
    /// Files written beside the report.
    pub files: Vec<String>,
}

/// One channel of a drive.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Channel {
    /// Name of the actuator.
    pub name: String,
    /// Position of the actuator, in metres.
    pub at_m: [f64; 2],
    /// Unit of the samples of the channel.
    pub unit: &'static str,
}

impl Report {
    /// The report of `command` on a drive of a surface, from the drive's evaluation.
    pub fn new(command: &'static str, surface: &Surface, drive: &Drive, judged: &Judged) -> Self {
        let measured = &judged.measured;
        let channel =
            |a: &Actuator| Channel { name: a.name.clone(), at_m: [a.at.x, a.at.y], unit: unit(&a.kind) };
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command,
            surface: surface.name.clone(),
            judged_on: None,
            method: None,
            window_s: None,
            period_s: None,
            sample_rate_hz: drive.rate(),
            actuators: surface.actuators.iter().map(channel).collect(),
            targets: measured.targets.clone(),
            waveforms: Vec::new(),
            silent: Vec::new(),
            stroke: None,
            fingers: Vec::new(),
            linearity: judged.linearity,
            mean_mechanical_power_w: judged.power,
            ssim: measured.ssim,
            sound: judged.sound.clone(),
            coil_heat: CoilHeat::of(surface, drive, measured.drive.duration_s),
            drive: measured.drive.clone(),
            level: None,
            response_error: None,
            thickness: surface.sheet.thickness,
            lambda_min_m: measured.lambda_min_m,
            focal_radius_m: measured.focal_radius_m,
            taken_on: measured.taken_on,
            outside_points: measured.outside_points,
            outside_share: measured.outside_share,
            felt_outside_db: measured.felt_outside_db,
            notes: judged.notes.clone(),
            files: Vec::new(),
        }
    }

    /// The report of a focus that was computed with a window of `window` seconds.
    pub fn of_focus(
        surface: &Surface,
        focused: &Focused,
        window: f64,
        drive: &Drive,
        judged: &Judged,
    ) -> Self {
        Self {
            method: Some(focused.method.name()),
            window_s: Some(window),
            period_s: focused.period.map(|samples| samples as f64 / drive.rate()),
            ..Self::new("focus", surface, drive, judged)
        }
    }
}

/// Unit of the drive of an actuator of this kind.
pub fn unit(kind: &ActuatorKind) -> &'static str {
    match (kind, kind.coil().map(|coil| coil.driven_by)) {
        (ActuatorKind::Force, _) => "N",
        (_, Some(CoilDrive::Current)) => "A",
        (_, Some(CoilDrive::Voltage) | None) => "V",
    }
}
