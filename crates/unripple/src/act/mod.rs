//! A complete focus, an *act*: computes a drive from a surface, targets and options, brings it to its level, evaluates
//! what it does to the surface, and reports.
//!
//! [`Act`] does what `unripple focus` does, without its files. Every program that shows metrics of a focus uses it, so
//! that they are the same everywhere.

mod aware;
mod carries;
mod error;
mod fingers;
mod judge;
mod level;
mod model;
mod note;
mod readouts;
mod report;
mod send;
mod strength;
mod window;

pub use aware::Aware;
pub use carries::carries;
pub use error::{ActError, LevelKind};
pub use fingers::{Felt, felt};
pub use judge::{CELLS, Judged, judge, known};
pub use level::Level;
pub use model::{accuracy, model};
pub use note::{Note, nearby};
pub use readouts::Readouts;
pub use report::{Channel, Followed, Report, Stroked, unit};
pub use send::Sent;
pub use strength::{DecidedBy, Headroom, Strength};
pub use window::{chosen_window, lasting, recommended_window};

use crate::core::{Drive, Responses, Surface};
use crate::focus::{Focused, Focuser, Options, Target};

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
/// assert!((target.contrast.unwrap_or(0.0) - 25.075).abs() < 0.001);
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

/// Result of an [`Act`]: the drive, its level and its evaluation.
#[derive(Clone, Debug)]
pub struct Acted {
    /// The focus as computed, before its drive is scaled to the level and rounded, with its timing.
    pub focused: Focused,
    /// The drive at the level asked for, as float32 samples.
    pub drive: Drive,
    /// Level of the drive relative to its limits, and what decided it.
    pub strength: Strength,
    /// Metrics, traces and maps of the field of the drive.
    pub judged: Judged,
}

impl<'a> Act<'a> {
    /// Grids on which the fields of the act's responses are evaluated, for [`Act::send`] and [`Act::judge`]; acts on
    /// the same responses can share them.
    pub fn readouts(&self) -> Readouts<'a> {
        Readouts::of(self.responses)
    }

    /// Computes the drive, brings it to its level and evaluates it.
    ///
    /// # Errors
    /// Those of [`carries`], [`Focuser`], [`Act::send`] and [`Act::judge`].
    pub fn run(&self) -> Result<Acted, ActError> {
        self.run_on(&self.readouts())
    }

    /// As [`Act::run`], with readouts that are shared with other acts on the same responses.
    ///
    /// # Errors
    /// Those of [`Act::run`].
    pub fn run_on(&self, on: &Readouts<'_>) -> Result<Acted, ActError> {
        carries(self.responses.conditions(), self.options.window)?;
        let focuser = Focuser::new(self.responses, self.options)?;
        let sent = self.send(&focuser, focuser.focus(self.targets)?, on)?;
        let judged = self.judge(&sent, on)?;
        Ok(Acted { focused: sent.focused, drive: sent.drive, strength: sent.strength, judged })
    }

    /// Evaluates the field of a drive on the act's own responses.
    ///
    /// # Errors
    /// Those of [`Readouts::fine`] and [`judge()`].
    pub fn judge(&self, sent: &Sent, on: &Readouts<'_>) -> Result<Judged, ActError> {
        let field = on.fine()?.field(&sent.drive)?;
        let mut judged = judge(self.surface, &field, &sent.aims, sent.period, sent.until)?;
        judged.notes.extend(sent.notes.iter().cloned());
        Ok(judged)
    }
}

impl Acted {
    /// The report of `unripple focus` on `surface` with these options, without names of files.
    pub fn report(&self, surface: &Surface, options: &Options) -> Report {
        let report = Report::of_focus(surface, &self.focused, options.window, &self.drive, &self.judged);
        Report { level: Some(self.strength.clone()), ..report }
    }
}
