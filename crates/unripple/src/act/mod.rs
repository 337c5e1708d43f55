//! A complete focus, an *act*: computes a drive from a surface, targets and options, brings it to its level, evaluates
//! what it does to the surface, and reports.
//!
//! [`Act`] does what `unripple focus` does, without its files. Every program that shows metrics of a focus uses it, so
//! that they are the same everywhere. A drive looks better on the modes that it was computed from than on a sheet, which has
//! more: [`Judging`] says up to which frequency modes count where a drive is evaluated, and [`Act::run_from`] evaluates it
//! on other responses than those that it is computed from.

mod acted;
mod aimed;
mod aware;
mod beyond;
mod carries;
mod cost;
mod error;
mod fingers;
mod judge;
mod judging;
mod level;
mod loss;
mod model;
mod note;
mod power;
mod readouts;
mod report;
mod send;
mod sound;
mod strength;
mod window;

pub use acted::Acted;
pub use aware::Aware;
pub use carries::carries;
pub use cost::{judging_cost, model_cost, window_cost};
pub use error::{ActError, LevelKind};
pub use fingers::{Felt, felt};
pub use judge::{Judged, judge, known};
pub use judging::{JUDGED_BANDS, Judging, Missed, Reached, judged_hz, reached};
pub use level::Level;
pub use model::{accuracy, at_most, inexact, less_accurate, model, model_modes, model_on, response_error};
pub use note::{Note, nearby};
pub use power::power;
pub use readouts::{CELLS, Readouts};
pub use report::{Channel, CoilHeat, Followed, Report, Stroked, ratios_of, unit};
pub use send::Sent;
pub use sound::{Hearing, LISTEN_M, Sound};
pub use strength::{DecidedBy, Headroom, Strength};
pub use window::{chosen_among, chosen_window, lasting, recommended_window, windows};

use crate::core::{Responses, Surface};
use crate::focus::{Options, Target};

/// A focus to be computed, brought to its level and evaluated.
///
/// ```
/// use unripple::act::{Act, Level, model, recommended_window};
/// use unripple::core::Point;
/// use unripple::focus::{Options, Target};
///
/// let surface = unripple::physics::design::papers_surface();
/// let responses = model(&surface, None, &[])?;
/// let options = Options { window: recommended_window(&surface, &responses), ..Options::default() };
/// let targets = [Target::at(Point::from_mm(62.0, 90.0))];
/// let level = Level::Peak(40e-6);
/// let act = Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
/// let acted = act.run()?;
/// let target = &acted.judged.measured.targets[0];
/// assert!((target.contrast.unwrap_or(0.0) - 25.116).abs() < 0.001);
/// assert!((target.peak_displacement_m.abs() / 40e-6 - 1.0).abs() < 1e-6);
/// let report = acted.report(&surface, &options);
/// assert!(report.text().contains("contrast"));
/// # Ok::<(), unripple::act::ActError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Act<'a> {
    /// The surface that the drive is evaluated on.
    pub surface: &'a Surface,
    /// Responses of the surface, modal or sampled.
    pub responses: &'a Responses,
    /// Points and shapes to be in focus.
    pub targets: &'a [Target],
    /// Method of focusing and its options.
    pub options: &'a Options,
    /// Level that the drive is brought to.
    pub level: Level,
}
