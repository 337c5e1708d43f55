//! Brings a drive to the requested level.

use super::aimed::Aimed;
use super::level::Step;
use super::strength::{DecidedBy, Strength};
use super::{Act, ActError, Level, Note, Readouts, loss, note};
use crate::core::Drive;
use crate::field::Aim;
use crate::focus::{FocusError, Focused, Focuser, Method};

/// Relative error below which a level that is solved for counts as met; the remaining error is removed by
/// scaling.
const MET: f64 = 1e-6;

/// Largest number of steps towards a level that is solved for: each step leaves less than a fifth of the
/// error before it.
const STEPS: usize = 12;

/// A drive at the requested level, and where and when it is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Sent {
    /// The focus as computed, before its drive is scaled to the level and rounded, with its timing.
    pub focused: Focused,
    /// The drive at the requested level, as float32 samples.
    pub drive: Drive,
    /// Every target with its focal instant.
    pub aims: Vec<Aim>,
    /// The period of a repeated drive, in seconds.
    pub period: Option<f64>,
    /// End of the time that is evaluated, in seconds: twice the last focal instant, or the end of a repeated drive.
    pub until: f64,
    /// End of the traces, in seconds: as `until`, but at least half a window past the last focus of a repeated drive.
    pub traced: f64,
    /// Level of the drive relative to its limits, and what decided it.
    pub strength: Strength,
    /// Notes on how the requested level affects the method.
    pub notes: Vec<Note>,
}

/// A drive after it was brought to a level, and how.
struct Levelled {
    focused: Focused,
    drive: Drive,
    by: DecidedBy,
    /// Factor by which the drive at its limit would have to be multiplied to reach its level; `None` where nothing sets a level.
    factor: Option<f64>,
    /// Whether a drive that is shaped by limits could only be scaled.
    scaled: bool,
}

impl Act<'_> {
    /// Scales a drive that was computed for its limit to the level of this act, as evaluated on
    /// [`Act::responses`]. For [`Method::Limited`], whose waveforms depend on the level, the drive is
    /// computed anew for that level.
    ///
    /// # Errors
    /// [`ActError::Level`] for levels that are not legal numbers or are above what the drive limit gives, and for a
    /// target that does not move; those of [`Focuser::focus_at`] and of the field.
    pub fn send(&self, focuser: &Focuser<'_>, focused: Focused, on: &Readouts<'_>) -> Result<Sent, ActError> {
        let aimed = Aimed::of(self.targets, &focused, self.options.window);
        let full = focused.drive.clone().as_emitted();
        let step = self.step(on, &full, &aimed)?;
        step.map_or(Ok(()), |step| self.level.within(step))?;
        self.brought((focuser, on), focused, full, step, aimed)
    }

    /// As [`send`](Self::send), but if the requested level is above that of the drive at its limit, the
    /// drive is at its limit and a note says which level it reaches. Used to show several drives side by
    /// side.
    ///
    /// # Errors
    /// As [`send`](Self::send), except for levels above what the drive limit gives.
    pub fn send_at_most(
        &self,
        focuser: &Focuser<'_>,
        focused: Focused,
        on: &Readouts<'_>,
    ) -> Result<Sent, ActError> {
        let aimed = Aimed::of(self.targets, &focused, self.options.window);
        let full = focused.drive.clone().as_emitted();
        let step = self.step(on, &full, &aimed)?;
        let Some(beyond) = step.and_then(|step| self.level.beyond(step)) else {
            return self.brought((focuser, on), focused, full, step, aimed);
        };
        let at_limit = Act { level: Level::Limit, ..*self };
        let mut sent = at_limit.brought((focuser, on), focused, full, None, aimed)?;
        sent.notes.push(note::beyond(&beyond));
        Ok(sent)
    }

    /// Brings a drive to its level by the factor `step`; `full` is the drive at its limit as it is emitted.
    fn brought(
        &self,
        (focuser, on): (&Focuser<'_>, &Readouts<'_>),
        focused: Focused,
        full: Drive,
        step: Option<Step>,
        aimed: Aimed,
    ) -> Result<Sent, ActError> {
        let levelled = self.level((focuser, on), focused, full, step, &aimed)?;
        let strength = Strength::of(&levelled.drive, self.options, levelled.by).allowing(
            levelled.factor.filter(|_| levelled.by == DecidedBy::Limit && self.level == Level::Linear),
        );
        let mut notes = Vec::new();
        if self.level == Level::Linear && levelled.factor.is_none() {
            notes.extend(note::unknown(self.surface, &levelled.drive));
        }
        if levelled.factor.is_some_and(|factor| factor < 1.0) {
            notes.extend(loss::idle(
                self,
                (focuser, on),
                &levelled.focused,
                &levelled.drive,
                &aimed.aims,
                levelled.scaled,
            )?);
        }
        let period = aimed.seconds();
        let Levelled { focused, drive, .. } = levelled;
        let Aimed { aims, until, traced, .. } = aimed;
        Ok(Sent { focused, drive, aims, period, until, traced, strength, notes })
    }

    fn level(
        &self,
        (focuser, on): (&Focuser<'_>, &Readouts<'_>),
        focused: Focused,
        full: Drive,
        step: Option<Step>,
        aimed: &Aimed,
    ) -> Result<Levelled, ActError> {
        let at_limit =
            |focused, factor| Levelled { focused, drive: full, by: DecidedBy::Limit, factor, scaled: false };
        let Some(step) = step else { return Ok(at_limit(focused, None)) };
        if step.factor >= 1.0 && self.level == Level::Linear {
            return Ok(at_limit(focused, Some(step.factor)));
        }
        let (by, factor) = (step.by, Some(step.factor));
        if focused.method == Method::Limited
            && let Some((focused, drive)) = self.solve((focuser, on), step, aimed)?
        {
            return Ok(Levelled { focused, drive, by, factor, scaled: false });
        }
        let drive = focused.drive.clone().scaled(step.factor).as_emitted();
        let scaled = focused.method == Method::Limited;
        Ok(Levelled { focused, drive, by, factor, scaled })
    }

    /// Solves for the drive of [`Method::Limited`] that has the requested level by itself; `None` if none
    /// is found.
    fn solve(
        &self,
        (focuser, on): (&Focuser<'_>, &Readouts<'_>),
        mut step: Step,
        aimed: &Aimed,
    ) -> Result<Option<(Focused, Drive)>, ActError> {
        let mut share = 1.0;
        for _ in 0..STEPS {
            share *= step.factor;
            let focused = match focuser.focus_at(self.targets, share) {
                Err(FocusError::Gap { .. }) => return Ok(None),
                found => found?,
            };
            let emitted = focused.drive.clone().as_emitted();
            let Some(next) = self.step(on, &emitted, aimed)? else { return Ok(None) };
            step = next;
            if (step.factor - 1.0).abs() < MET {
                let room = Strength::of(&emitted, self.options, step.by).below_limit;
                let drive = focused.drive.clone().scaled(step.factor.min(room.max(1.0))).as_emitted();
                return Ok(Some((focused, drive)));
            }
        }
        Ok(None)
    }

    fn step(&self, on: &Readouts<'_>, drive: &Drive, aimed: &Aimed) -> Result<Option<Step>, ActError> {
        self.level.step(self.surface, on, drive, aimed)
    }
}
