//! The report of a drive on a surface, in SI units.

mod played;
mod text;
mod unscaled;

pub use played::{Followed, Stroked};

use super::{Felt, Judged, Note, Strength};
use crate::core::{Actuator, ActuatorKind, CoilDrive, Drive, Surface};
use crate::field::{DriveFigures, SilenceFigures, TakenOn, TargetFigures};
use crate::focus::Focused;
use crate::physics::design::Linearity;
use serde::Serialize;

/// Everything said about one drive on one surface. Lengths in metres, times in seconds, drive in its own unit.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// The command that the report is of.
    pub command: &'static str,
    /// Name of the surface.
    pub surface: String,
    /// The model that figures were computed on, where it is not that surface with the modes of its band.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged_on: Option<String>,
    /// How the drive was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<&'static str>,
    /// The window T, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_s: Option<f64>,
    /// The period of a repeated drive, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// Samples per second of the drive.
    pub sample_rate_hz: f64,
    /// The channels of the drive.
    pub actuators: Vec<Channel>,
    /// Figures of every target.
    pub targets: Vec<TargetFigures>,
    /// Waveforms at targets, where they were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub waveforms: Vec<Followed>,
    /// Points that were to be silent meanwhile.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub silent: Vec<SilenceFigures>,
    /// A focus that was to move.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke: Option<Stroked>,
    /// Fingers that rest on the surface.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<Felt>,
    /// Slopes, strains and added tension of the field, which linear theory takes to be small.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linearity: Option<Linearity>,
    /// Figures of the drive that was sent.
    pub drive: DriveFigures,
    /// Strength of the drive beside its limits, and what decided it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level: Option<Strength>,
    /// Thickness of the sheet, in metres.
    #[serde(skip)]
    pub thickness: f64,
    /// Shortest wavelength of the band, in metres.
    pub lambda_min_m: f64,
    /// Radius around every target that does not count as outside, in metres.
    pub focal_radius_m: f64,
    /// Whether outside figures are taken on a regular grid or on a library's own points.
    pub taken_on: TakenOn,
    /// Number of points that lie outside every target's disc.
    pub outside_points: usize,
    /// The highest level felt outside the focal discs, in dB above the threshold of touch.
    pub felt_outside_db: Option<f64>,
    /// Notes that a reader of the figures must know.
    pub notes: Vec<Note>,
    /// Files written beside the report.
    pub files: Vec<String>,
}

/// One channel of a drive.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Channel {
    /// Name of the actuator.
    pub name: String,
    /// Place of the actuator, in metres.
    pub at_m: [f64; 2],
    /// Unit of what it is sent.
    pub unit: &'static str,
}

impl Report {
    /// A report of `command`.
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
            drive: measured.drive.clone(),
            level: None,
            thickness: surface.sheet.thickness,
            lambda_min_m: measured.lambda_min_m,
            focal_radius_m: measured.focal_radius_m,
            taken_on: measured.taken_on,
            outside_points: measured.outside_points,
            felt_outside_db: measured.felt_outside_db,
            notes: judged.notes.clone(),
            files: Vec::new(),
        }
    }

    /// A report of a focus made with a window of `window` seconds.
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

/// Unit of what an actuator is sent.
pub fn unit(kind: &ActuatorKind) -> &'static str {
    match kind {
        ActuatorKind::Force => "N",
        ActuatorKind::MovingMagnet { driven_by: CoilDrive::Current, .. } => "A",
        ActuatorKind::MovingMagnet { driven_by: CoilDrive::Voltage, .. } | ActuatorKind::Piezo { .. } => "V",
    }
}
