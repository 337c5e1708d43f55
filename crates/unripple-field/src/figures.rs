//! Metrics of a drive, as numbers with units.

use crate::{Grid, Similarity, Snapshot};
use serde::Serialize;
use unripple_core::Point;

/// All metrics of a drive, as [`measure()`](crate::measure()) returns them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Metrics of each target, in the order of the aims.
    pub targets: Vec<TargetFigures>,
    /// Metrics of the drive itself.
    pub drive: DriveFigures,
    /// Shortest wavelength of the band, in metres.
    pub lambda_min_m: f64,
    /// Radius of the focal disc around every target point, (4/3) λ_min, in metres; only points beyond all
    /// discs count as outside.
    pub focal_radius_m: f64,
    /// Whether the points outside the focal discs are those of a regular grid or those of a library of responses.
    pub taken_on: TakenOn,
    /// Number of evaluated points that lie outside every target's focal disc.
    pub outside_points: usize,
    /// Share, from 0 to 1, of the evaluated points that lie outside every focal disc; on a grid, the share
    /// of the surface over which ratios are taken.
    pub outside_share: f64,
    /// The highest felt level at any point outside the focal discs over all time spans evaluated, in dB
    /// above the threshold of touch; `None` without such points, or if none of them moves.
    pub felt_outside_db: Option<f64>,
    /// How alike the images of the vibration and of the targets are; `None` for sampled responses, which are on no grid, without targets,
    /// and where nothing moves.
    pub ssim: Option<Similarity>,
    /// Maps and snapshots of the field; not part of the report.
    #[serde(skip)]
    pub maps: Maps,
}

/// The points at which the motion outside the focal discs is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TakenOn {
    /// A regular grid over the surface.
    Grid,
    /// The points of a library of responses.
    Library,
}

/// Metrics of the focus at one target.
///
/// For a set of points all of these are of the mean motion over the points, except the ranges at the end; the metrics
/// of the spot are left out. A point is *outside* if it is farther than the focal radius (4/3) λ_min from every point
/// of every target. The *span* is the time evaluated: [0, 2T], or the last full period of a repeated drive. Ratios are
/// of magnitudes; they are `None` without outside points, or where none of them moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetFigures {
    /// The point requested, or the centroid of the set of points requested, in metres.
    pub at_m: [f64; 2],
    /// Number of points of the target.
    pub points: usize,
    /// Mean distance from the points requested to those at which the motion was evaluated, in metres; 0
    /// unless the responses are sampled.
    pub misplaced_m: f64,
    /// Focal instant T, in seconds.
    pub instant_s: f64,
    /// First and last instant of the time span evaluated, in seconds.
    pub span_s: [f64; 2],
    /// Whether the field is known over the whole time span evaluated: sampled responses may end earlier.
    pub span_complete: bool,
    /// Velocity at the target at the focal instant T, in m/s; contrasts and worst spot in velocity are
    /// ratios of its magnitude.
    pub peak_velocity_m_s: f64,
    /// Instant at which the magnitude of the velocity at the target is largest during the time span
    /// evaluated, in seconds.
    pub peak_time_s: f64,
    /// Contrast: `peak_velocity_m_s` over the rms velocity of the points outside the focal discs, at the
    /// focal instant T.
    pub contrast: Option<f64>,
    /// `peak_velocity_m_s` over the rms velocity of the points outside the focal discs during the time span
    /// evaluated.
    pub background_contrast: Option<f64>,
    /// `peak_velocity_m_s` over the largest velocity of any point outside the focal discs during the time
    /// span evaluated.
    pub worst_spot: Option<f64>,
    /// Point at which the largest velocity outside the focal discs occurs, in metres.
    pub worst_spot_at_m: Option<[f64; 2]>,
    /// Instant at which the largest velocity outside the focal discs occurs, in seconds.
    pub worst_spot_time_s: Option<f64>,
    /// Share of the energy of the velocity at the target during the time span evaluated that lies above 1
    /// kHz ([`Threshold::MEASURED_TO_HZ`](crate::Threshold::MEASURED_TO_HZ)), from 0 to 1; 0 without motion.
    pub share_above_1khz: f64,
    /// Share of the energy of the velocity above 1 kHz, from 0 to 1, at the point of the largest velocity
    /// outside the focal discs.
    pub worst_spot_share_above_1khz: Option<f64>,
    /// Full width at half maximum of the velocity around the target at the focal instant T, in metres.
    pub spot_diameter_m: Option<f64>,
    /// Area around the target in which the velocity at the focal instant T is above half that at the target,
    /// in square metres; for sampled responses, the area of a circle with the diameter `spot_diameter_m`.
    pub spot_area_m2: Option<f64>,
    /// Focus localisation error: distance from the target to the nearest maximum of the magnitude of the
    /// velocity at the focal instant T, in metres; `None` for sampled responses.
    pub focus_offset_m: Option<f64>,
    /// Full width at half maximum, in time, of the velocity at the target around the focal instant T, in
    /// seconds.
    pub pulse_duration_s: Option<f64>,
    /// Displacement at the target when its magnitude is largest within the time span evaluated, in metres.
    pub peak_displacement_m: f64,
    /// Instant of `peak_displacement_m`, in seconds, at which the ratios and widths in displacement are
    /// evaluated.
    pub displacement_peak_time_s: f64,
    /// `peak_displacement_m` over the rms displacement of the points outside the focal discs, at
    /// `displacement_peak_time_s`.
    pub displacement_contrast: Option<f64>,
    /// `peak_displacement_m` over the rms displacement of the points outside the focal discs during the time
    /// span evaluated.
    pub displacement_background_contrast: Option<f64>,
    /// `peak_displacement_m` over the largest displacement of any point outside the focal discs during the
    /// time span evaluated.
    pub displacement_worst_spot: Option<f64>,
    /// Full width at half maximum of the displacement around the target at `displacement_peak_time_s`, in
    /// metres.
    pub displacement_spot_diameter_m: Option<f64>,
    /// Area around the target in which the displacement at `displacement_peak_time_s` is above half that at
    /// the target, in square metres.
    pub displacement_spot_area_m2: Option<f64>,
    /// Full width at half maximum, in time, of the displacement at the target around
    /// `displacement_peak_time_s`, in seconds.
    pub displacement_pulse_duration_s: Option<f64>,
    /// Felt level: the largest magnitude of the threshold-weighted displacement at the target within the
    /// time span evaluated, in dB above the threshold of touch; `None` without motion. The
    /// threshold-weighted displacement is the displacement filtered by 1/threshold(f) with zero phase, in
    /// units of the threshold. The ratios below are those of this magnitude to what is felt outside, in dB;
    /// higher is better.
    pub felt_level_db: Option<f64>,
    /// Instant at which the level `felt_level_db` is reached, in seconds.
    pub felt_peak_time_s: f64,
    /// Duration of the felt motion, in seconds: around `felt_peak_time_s`, from the first to the last
    /// instant at which the threshold-weighted displacement has at least half of its largest magnitude,
    /// without pauses longer than [`Threshold::INTEGRATION_S`](crate::Threshold::INTEGRATION_S). `None`
    /// without motion, and if the motion is repeated without such a pause.
    pub felt_duration_s: Option<f64>,
    /// Threshold-weighted displacement at the target over the rms of that of the points outside the focal
    /// discs, both at `felt_peak_time_s`, in dB.
    pub felt_contrast_db: Option<f64>,
    /// Largest threshold-weighted displacement at the target over the rms of that of the points outside the
    /// focal discs during the time span evaluated, in dB.
    pub felt_background_db: Option<f64>,
    /// Largest threshold-weighted displacement at the target over the largest one at any point outside the
    /// focal discs during the time span evaluated, in dB.
    pub felt_worst_spot_db: Option<f64>,
    /// Least and greatest velocity over the target's points at the focal instant T, in m/s; `None` for a
    /// single point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_range_m_s: Option<[f64; 2]>,
    /// Least and greatest displacement over the target's points at `displacement_peak_time_s`, in metres;
    /// `None` for a single point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacement_range_m: Option<[f64; 2]>,
}

/// Metrics of the drive signals: of the whole drive, or of its last full period if it is repeated.
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
    /// Length of the drive, or of its period if it is repeated, in seconds.
    pub duration_s: f64,
}

/// Maps and snapshots of the field: one value per point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Maps {
    /// The points to which the values belong, in metres.
    pub points: Vec<Point>,
    /// The grid of the points; `None` for the points of a library.
    pub grid: Option<Grid>,
    /// Whether each point lies outside every target's focal disc.
    pub outside: Vec<bool>,
    /// Largest magnitude of the velocity at each point over all time spans, in m/s.
    pub peak_velocity: Vec<f32>,
    /// Largest magnitude of the displacement at each point over all time spans, in metres.
    pub peak_displacement: Vec<f32>,
    /// Largest magnitude of the threshold-weighted displacement at each point over all time spans, in units
    /// of the threshold: 1 is just felt.
    pub felt_peak: Vec<f32>,
    /// The field at the focal instant T of each target.
    pub at_peak: Vec<Snapshot>,
    /// The field at the instant of each target's largest displacement.
    pub at_displacement_peak: Vec<Snapshot>,
}
