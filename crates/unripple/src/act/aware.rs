//! The conditions that a drive is computed for: fingers on the surface, and other states that it has to be robust
//! against.

use super::{ActError, Note, model};
use crate::core::{Contact, Drive, Responses, Surface};
use crate::field::Field;
use crate::focus::{Focused, Focuser, Options, Target, focus};
use unripple_core::OutOfRange;

/// The conditions that a drive is computed for: the surface under fingers, and other states that it may get into.
#[derive(Clone, Debug, Default)]
pub struct Aware {
    /// Responses of the surface with fingers on it, if the drive is computed for that.
    pub under: Option<Responses>,
    /// Responses of the surface in other states, that [`Method::Robust`](crate::focus::Method::Robust) optimises for as
    /// well.
    pub others: Vec<Responses>,
}

impl Aware {
    /// Computes the responses of the surface with the fingers `known`, if there are any, and in the other states: with
    /// its tension reduced and raised by the fraction `tension`, and with each of the fingers `more` added in turn.
    ///
    /// # Errors
    /// Those of [`model`]; [`ActError::Range`] for a share not between 0 and 0.5.
    pub fn of(
        surface: &Surface,
        known: &[Contact],
        tension: Option<f64>,
        more: &[Contact],
    ) -> Result<Self, ActError> {
        let under = if known.is_empty() { None } else { Some(model(surface, None, known)?) };
        let mut others = Vec::new();
        if let Some(share) = tension {
            if !(share > 0.0 && share < 0.5) {
                let (what, expected) = ("change of tension, as a share", "a number above 0 and below 0.5");
                return Err(ActError::Range(OutOfRange::new(what, expected, share)));
            }
            for factor in [1.0 - share, 1.0 + share] {
                let mut other = surface.clone();
                other.sheet.tension *= factor;
                others.push(model(&other, None, known)?);
            }
        }
        for contact in more {
            let mut all = known.to_vec();
            all.push(*contact);
            others.push(model(surface, None, &all)?);
        }
        Ok(Self { under, others })
    }

    /// A focuser for these conditions; `bare` are the responses of the surface without fingers.
    ///
    /// # Errors
    /// Those of [`Focuser::beside`].
    pub fn focuser<'a>(&'a self, bare: &'a Responses, options: &Options) -> Result<Focuser<'a>, ActError> {
        let known = self.under.as_ref().unwrap_or(bare);
        Ok(Focuser::beside(known, &self.others, options)?)
    }

    /// A note on the gain in level, at the first target and the drive limit, of computing the drive for the surface
    /// under the fingers; `None` without fingers.
    ///
    /// # Errors
    /// Those of [`focus`] and [`Field::traces`].
    pub fn note(
        &self,
        bare: &Responses,
        targets: &[Target],
        options: &Options,
        aware: &Focused,
    ) -> Result<Option<Note>, ActError> {
        let Some(under) = &self.under else { return Ok(None) };
        let unaware = focus(bare, targets, options)?;
        let peak = |responses: &Responses, drive: &Drive, focused: &Focused| -> Result<f64, ActError> {
            let field = Field::new(responses, drive, 1.0)?;
            let points = targets.first().map_or(&[][..], |target| &target.points);
            let traces = field.traces(points, focused.instant())?;
            let sum: f64 = traces.iter().filter_map(|trace| trace.velocity.last()).sum();
            Ok((sum / traces.len().max(1) as f64).abs())
        };
        let free = peak(bare, &unaware.drive, &unaware)?;
        let lost = peak(under, &unaware.drive, &unaware)?;
        let restored = peak(under, &aware.drive, aware)?;
        let below = |peak: f64| 20.0 * (free / peak).log10();
        Ok(Some(Note {
            topic: "fingers",
            text: format!(
                "the drive was computed for the surface under the fingers: at the drive limit the peak velocity at the first \
                 target is {:.1} dB below that without fingers; a drive computed for the bare surface would be {:.1} dB below it",
                below(restored),
                below(lost)
            ),
        }))
    }
}
