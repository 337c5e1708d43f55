//! The conditions that a drive is made for: fingers on the surface, and other states that it has to be robust against.

use super::{ActError, Note, model};
use crate::core::{Contact, Drive, Responses, Surface};
use crate::field::Field;
use crate::focus::{Focused, Focuser, Options, Target, focus};
use unripple_core::OutOfRange;

/// The conditions that a drive is made for: the surface under fingers, and other states that it may get into.
#[derive(Clone, Debug, Default)]
pub struct Aware {
    /// Responses of the surface under the fingers, if the drive is made for that.
    pub under: Option<Responses>,
    /// Other plants that [`Method::Robust`](crate::focus::Method::Robust) is to be robust against.
    pub others: Vec<Responses>,
}

impl Aware {
    /// Conditions with fingers that the drive is made for, if any; of the tension changed by `tension`, a share,
    /// either way; and of each of
    /// `more` fingers in turn.
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

    /// The focuser for these conditions, from the responses of the bare surface.
    ///
    /// # Errors
    /// Those of [`Focuser::beside`].
    pub fn focuser<'a>(&'a self, bare: &'a Responses, options: &Options) -> Result<Focuser<'a>, ActError> {
        let known = self.under.as_ref().unwrap_or(bare);
        Ok(Focuser::beside(known, &self.others, options)?)
    }

    /// A note on what making the drive for the fingers gained, at the first target and the drive limit.
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
                "the drive was made for the surface under the fingers: at the limit the first target is {:.1} dB below that of \
                 the bare surface, where a drive computed without them gives {:.1} dB less",
                below(restored),
                below(lost)
            ),
        }))
    }
}
