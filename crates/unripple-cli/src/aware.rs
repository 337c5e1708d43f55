//! Drives made for a surface under fingers, and for others that it may turn into.

use crate::args::FocusOptions;
use crate::error::CliError;
use crate::fingers;
use crate::judge::{self, Note};
use unripple::core::{Drive, Responses, Surface};
use unripple::field::Field;
use unripple::focus::{Focused, Focuser, Options, Target, focus};

/// What a drive is made for.
pub struct Aware {
    /// The surface under the fingers, if the drive is to know of them.
    under: Option<Responses>,
    /// Other plants that `robust` is to bear.
    others: Vec<Responses>,
}

impl Aware {
    /// As the options say.
    pub fn of(options: &FocusOptions, surface: &Surface) -> Result<Self, CliError> {
        if options.finger_aware && options.finger.is_empty() {
            return Err(CliError::Input("--finger-aware: expected --finger X,Y with it, found none".into()));
        }
        let resting = fingers::contacts(&options.finger, surface)?;
        let known = if options.finger_aware { resting.as_slice() } else { &[] };
        let under = options.finger_aware.then(|| judge::model(surface, None, known)).transpose()?;
        let mut others = Vec::new();
        if let Some(percent) = options.bear_tension_percent {
            let share = percent / 100.0;
            if !(share > 0.0 && share < 0.5) {
                let text = format!(
                    "--bear-tension-percent: expected a number above 0 and below 50, found {percent}"
                );
                return Err(CliError::Input(text));
            }
            for factor in [1.0 - share, 1.0 + share] {
                let mut other = surface.clone();
                other.sheet.tension *= factor;
                others.push(judge::model(&other, None, known)?);
            }
        }
        for contact in fingers::contacts(&options.bear_finger, surface)? {
            let mut all = known.to_vec();
            all.push(contact);
            others.push(judge::model(surface, None, &all)?);
        }
        Ok(Self { under, others })
    }

    /// The drive, from these responses of the bare surface.
    pub fn focus(
        &self,
        bare: &Responses,
        targets: &[Target],
        options: &Options,
    ) -> Result<Focused, CliError> {
        let known = self.under.as_ref().unwrap_or(bare);
        let plan = Focuser::beside(known, &self.others, options).map_err(CliError::input)?;
        plan.focus(targets).map_err(CliError::input)
    }

    /// What knowing of the fingers gave back, at the first target and the drive limit.
    pub fn note(
        &self,
        bare: &Responses,
        targets: &[Target],
        options: &Options,
        aware: &Focused,
    ) -> Result<Option<Note>, CliError> {
        let Some(under) = &self.under else { return Ok(None) };
        let unaware = focus(bare, targets, options).map_err(CliError::input)?;
        let peak = |responses: &Responses, drive: &Drive, focused: &Focused| -> Result<f64, CliError> {
            let field = Field::new(responses, drive, 1.0).map_err(CliError::input)?;
            let points = targets.first().map_or(&[][..], |target| &target.points);
            let instant = focused.timing.first().map_or(0.0, |t| t.instant as f64 / drive.rate());
            let traces = field.traces(points, instant).map_err(CliError::input)?;
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
                "the drive was made for the surface under the fingers: at the limit the first target is {:.1} dB below that of the bare \
                 surface, where a drive that does not know of them leaves it {:.1} dB below",
                below(restored),
                below(lost)
            ),
        }))
    }
}
