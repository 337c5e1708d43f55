//! The result of an act: the steps that compute it, and its report.

use super::{Act, ActError, Judged, Note, Readouts, Report, Sent, Strength, carries, judge, loss};
use crate::core::{Drive, Responses, Surface};
use crate::field::Measured;
use crate::focus::{Focused, Focuser, Options};

/// Result of an [`Act`]: the drive, its level and its evaluation.
#[derive(Clone, Debug)]
pub struct Acted {
    /// The focus as computed, before its drive is scaled to the level and rounded, with its timing.
    pub focused: Focused,
    /// The drive at the requested level, as float32 samples.
    pub drive: Drive,
    /// Level of the drive relative to its limits, and what decided it.
    pub strength: Strength,
    /// Metrics, traces and maps of the field of the drive.
    pub judged: Judged,
}

impl<'a> Act<'a> {
    /// Grids on which fields are evaluated, for [`Act::send`] and [`Act::judge`]; acts with the same responses can
    /// share them.
    pub fn readouts(&self) -> Readouts<'a> {
        Readouts::of(self.responses)
    }

    /// Computes the drive, brings it to the requested level and evaluates it.
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
        self.run_from(self.responses, on)
    }

    /// As [`Act::run_on`], but the drive is computed from `known`, other responses of the surface; it is
    /// brought to its level and evaluated on [`Act::responses`].
    ///
    /// # Errors
    /// Those of [`Act::run`].
    pub fn run_from(&self, known: &Responses, on: &Readouts<'_>) -> Result<Acted, ActError> {
        carries(known.conditions(), self.options.window)?;
        let focuser = Focuser::new(known, self.options)?;
        let sent = self.send(&focuser, focuser.focus(self.targets)?, on)?;
        let judged = self.judge(&sent, on)?;
        Ok(Acted { focused: sent.focused, drive: sent.drive, strength: sent.strength, judged })
    }

    /// Notes on how level and limits affect the method: those of [`Act::send`], and one where limits could not shape the drive.
    pub fn notes(&self, sent: &Sent) -> Vec<Note> {
        let gave_up = loss::gave_up(self, &sent.focused, &sent.strength);
        sent.notes.iter().cloned().chain(gave_up).collect()
    }

    /// Evaluates the metrics of the field of a drive on [`Act::responses`] alone: for searches that compare many drives.
    ///
    /// # Errors
    /// Those of [`Readouts::fine`] and [`Field::measure`](crate::field::Field::measure).
    pub fn measure(&self, sent: &Sent, on: &Readouts<'_>) -> Result<Measured, ActError> {
        Ok(on.fine()?.field(&sent.drive)?.measure(&sent.aims, sent.period)?)
    }

    /// Evaluates the field of a drive on [`Act::responses`], and its sound.
    ///
    /// # Errors
    /// Those of [`Readouts::fine`], [`Readouts::hearing`], [`judge()`] and [`Hearing::sound`](super::Hearing::sound).
    pub fn judge(&self, sent: &Sent, on: &Readouts<'_>) -> Result<Judged, ActError> {
        let field = on.fine()?.field(&sent.drive)?;
        let mut judged = judge(self.surface, &field, &sent.aims, sent.period, sent.traced)?;
        judged.notes.extend(self.notes(sent));
        judged.sound = Some(on.hearing(self.surface)?.sound(&sent.drive, sent.period)?);
        Ok(judged)
    }
}

impl Acted {
    /// The report of `unripple focus` on `surface` with these options, without names of files; [`Judging::tell`] adds the modes
    /// on which the drive was evaluated.
    ///
    /// [`Judging::tell`]: super::Judging::tell
    pub fn report(&self, surface: &Surface, options: &Options) -> Report {
        let report = Report::of_focus(surface, &self.focused, options.window, &self.drive, &self.judged);
        Report { level: Some(self.strength.clone()), ..report }
    }
}
