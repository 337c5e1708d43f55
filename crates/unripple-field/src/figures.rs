//! The figures of a drive, as numbers with units.

use crate::{Grid, Snapshot};
use serde::Serialize;
use unripple_core::Point;

/// All figures of a drive.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Figures of each target, in the order of the aims.
    pub targets: Vec<TargetFigures>,
    /// Figures of the drive that was sent.
    pub drive: DriveFigures,
    /// Shortest wavelength of the band, in metres.
    pub lambda_min_m: f64,
    /// Radius around every target that does not count as outside, (4/3) λ_min, in metres.
    pub focal_radius_m: f64,
    /// Whether outside figures are taken on a regular grid or on the library's own points.
    pub taken_on: TakenOn,
    /// How many points lie outside every target's disc.
    pub outside_points: usize,
    /// The highest level felt at any outside point over all spans, in dB above the threshold; `None` where nothing is
    /// outside, and in silence.
    pub felt_outside_db: Option<f64>,
    /// Pictures of the field; not part of the report.
    #[serde(skip)]
    pub maps: Maps,
}

/// What outside figures are taken on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TakenOn {
    /// A regular grid over the surface.
    Grid,
    /// The points of a library of responses.
    Library,
}

/// How good the focus at one target is.
///
/// A set of points is measured by the mean over its points: `peak_velocity_m_s` and all that is compared with it are of the
/// mean. Its spot diameters are left out. Ratios are of magnitudes, `None` where nothing moves outside or nothing is
/// outside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetFigures {
    /// The point asked for, or the centroid of the set, in metres.
    pub at_m: [f64; 2],
    /// How many points it has.
    pub points: usize,
    /// Mean distance from the points asked for to the points measured at, in metres; 0 unless on a library.
    pub misplaced_m: f64,
    /// Focal instant T, in seconds.
    pub instant_s: f64,
    /// First and last instant of the span measured, in seconds.
    pub span_s: [f64; 2],
    /// Whether the field is known over the whole span of the definitions: responses of a library may end before.
    pub span_complete: bool,
    /// Velocity at the target at T, in m/s.
    pub peak_velocity_m_s: f64,
    /// When the magnitude of the velocity at the target is largest, in seconds.
    pub peak_time_s: f64,
    /// Peak over the rms of the outside points at T.
    pub contrast: Option<f64>,
    /// Peak over the rms of the outside points and the span.
    pub background_contrast: Option<f64>,
    /// Peak over the largest magnitude of the outside points and the span.
    pub worst_spot: Option<f64>,
    /// Full width at half maximum around the target at T, in metres.
    pub spot_diameter_m: Option<f64>,
    /// Full width at half maximum in time around T, in seconds.
    pub pulse_duration_s: Option<f64>,
    /// Displacement at the target at its own extreme within the span, in metres.
    pub peak_displacement_m: f64,
    /// When that is, in seconds. The figures below are those above in displacement, at this instant.
    pub displacement_peak_time_s: f64,
    /// The same as `contrast`, in displacement at that instant.
    pub displacement_contrast: Option<f64>,
    /// The same as `background_contrast`, in displacement.
    pub displacement_background_contrast: Option<f64>,
    /// The same as `worst_spot`, in displacement.
    pub displacement_worst_spot: Option<f64>,
    /// The same as `spot_diameter_m`, in displacement.
    pub displacement_spot_diameter_m: Option<f64>,
    /// The same as `pulse_duration_s`, in displacement.
    pub displacement_pulse_duration_s: Option<f64>,
    /// Largest magnitude of the weighed displacement at the target within the span, in dB above the threshold; `None` in
    /// silence. Weighed is displacement filtered by 1/threshold(f) without delay, in units of the threshold; the figures
    /// below are ratios of this level, in dB, higher being better.
    pub felt_level_db: Option<f64>,
    /// When that is, in seconds.
    pub felt_peak_time_s: f64,
    /// The level over the rms of the weighed displacement of the outside points at that instant.
    pub felt_contrast_db: Option<f64>,
    /// The level over the rms of the weighed displacement of the outside points and the span.
    pub felt_background_db: Option<f64>,
    /// The level over the largest magnitude of the weighed displacement of the outside points and the span.
    pub felt_worst_spot_db: Option<f64>,
    /// Least and greatest velocity over a set of points at T, in m/s; `None` for one point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_range_m_s: Option<[f64; 2]>,
    /// Least and greatest displacement over a set of points at `displacement_peak_time_s`, in metres; `None` for one point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement_range_m: Option<[f64; 2]>,
}

/// What was sent: the whole drive, or its last full period if it is repeated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DriveFigures {
    /// Largest magnitude over all channels, in the drive's unit.
    pub peak: f64,
    /// Root mean square over all channels and samples, in the drive's unit.
    pub rms: f64,
    /// Energy Σ∫d²dt, in the drive's unit squared times seconds.
    pub energy: f64,
    /// Share of the energy above the band of the responses, from 0 to 1.
    pub share_above_band: f64,
    /// Length, in seconds.
    pub duration_s: f64,
}

/// Pictures of the field: one value per point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Maps {
    /// Places of the values, in metres.
    pub points: Vec<Point>,
    /// The grid the points are on; `None` on a library.
    pub grid: Option<Grid>,
    /// Which points count as outside.
    pub outside: Vec<bool>,
    /// Largest magnitude of the velocity over all spans, in m/s.
    pub peak_velocity: Vec<f32>,
    /// Largest magnitude of the displacement over all spans, in metres.
    pub peak_displacement: Vec<f32>,
    /// Largest magnitude of the weighed displacement over all spans, in units of the threshold: 1 is just felt.
    pub felt_peak: Vec<f32>,
    /// The field at each target's T.
    pub at_peak: Vec<Snapshot>,
    /// The field at each target's extreme of displacement.
    pub at_displacement_peak: Vec<Snapshot>,
}
