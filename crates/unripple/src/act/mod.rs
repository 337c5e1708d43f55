//! An act of focusing, whole: from a surface, targets and options to a drive, what it was found to do, and a report.
//!
//! [`Act`] does what `unripple focus` does, without its files: whoever shows figures of a focus takes them from here, so
//! that they are the same everywhere.

mod aware;
mod error;
mod fingers;
mod judge;
mod level;
mod model;
mod note;
mod report;
mod window;

pub use aware::Aware;
pub use error::{ActError, LevelKind};
pub use fingers::{Felt, felt};
pub use judge::{CELLS, Judged, judge, known};
pub use level::Level;
pub use model::{accuracy, model};
pub use note::{Note, nearby};
pub use report::{Channel, Followed, Report, Stroked, unit};
pub use window::recommended_window;

use crate::core::{Drive, Responses, Surface};
use crate::field::{Aim, Field};
use crate::focus::{Focused, Options, Target, focus};

/// One act of focusing.
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
/// assert!((target.contrast.unwrap_or(0.0) - 26.385).abs() < 0.001);
/// assert!((target.peak_displacement_m.abs() / 40e-6 - 1.0).abs() < 1e-6);
/// let report = acted.report(&surface, &options);
/// assert!(report.text().contains("contrast"));
/// # Ok::<(), unripple::act::ActError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Act<'a> {
    /// The surface that is judged on.
    pub surface: &'a Surface,
    /// Its responses.
    pub responses: &'a Responses,
    /// What is to be in focus.
    pub targets: &'a [Target],
    /// How to focus.
    pub options: &'a Options,
    /// How loud.
    pub level: Level,
}

/// What came of an act.
#[derive(Clone, Debug)]
pub struct Acted {
    /// The drive at its limit, and its timing.
    pub focused: Focused,
    /// The drive at the level asked for, as float32 samples.
    pub drive: Drive,
    /// What that drive was found to do.
    pub judged: Judged,
}

/// A drive at the level asked for, and where and when it is to be judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Sent {
    /// The drive, as float32 samples.
    pub drive: Drive,
    /// Every target with its focal instant.
    pub aims: Vec<Aim>,
    /// The period of a repeated drive, in seconds.
    pub period: Option<f64>,
    /// How far targets are traced, in seconds: twice the last focal instant, or the end of a repeated drive.
    pub until: f64,
}

impl Act<'_> {
    /// Makes the drive, brings it to its level and judges it.
    ///
    /// # Errors
    /// Those of [`focus`], [`Act::send`] and [`Act::judge`].
    pub fn run(&self) -> Result<Acted, ActError> {
        let focused = focus(self.responses, self.targets, self.options)?;
        let sent = self.send(&focused)?;
        let judged = self.judge(&sent)?;
        Ok(Acted { focused, drive: sent.drive, judged })
    }

    /// Brings a drive, however it was made, to the level asked for.
    ///
    /// # Errors
    /// Those of [`Level::gain`].
    pub fn send(&self, focused: &Focused) -> Result<Sent, ActError> {
        let rate = focused.drive.rate();
        let seconds = |samples: usize| samples as f64 / rate;
        let timed = self.targets.iter().zip(&focused.timing);
        let aims: Vec<Aim> = timed
            .map(|(target, timing)| Aim { points: target.points.clone(), instant: seconds(timing.instant) })
            .collect();
        let last = focused.timing.iter().map(|timing| timing.instant).max().unwrap_or(0);
        let until = match focused.period {
            Some(_) => seconds(focused.drive.samples().saturating_sub(1)),
            None => 2.0 * seconds(last),
        };
        let full = focused.drive.clone().as_emitted();
        let gain = self.level.gain(self.responses, &full, &aims, focused.period, until)?;
        let drive = gain.map_or(full, |gain| focused.drive.clone().scaled(gain).as_emitted());
        Ok(Sent { drive, aims, period: focused.period.map(seconds), until })
    }

    /// Judges a drive on the act's own responses.
    ///
    /// # Errors
    /// Those of [`Field::new`] and [`judge()`].
    pub fn judge(&self, sent: &Sent) -> Result<Judged, ActError> {
        let field = Field::new(self.responses, &sent.drive, CELLS)?;
        judge(self.surface, &field, &sent.aims, sent.period, sent.until)
    }
}

impl Acted {
    /// The report of `unripple focus` on `surface` with these options, no files named.
    pub fn report(&self, surface: &Surface, options: &Options) -> Report {
        Report::of_focus(surface, &self.focused, options.window, &self.drive, &self.judged)
    }
}
