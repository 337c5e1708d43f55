//! Notes that go with the results of a focus.

use super::level::Beyond;
use super::{Act, ActError, Readouts};
use crate::core::{Drive, Surface};
use crate::field::{Aim, Measured};
use crate::focus::{Focused, Focuser, Method, Options, Target, focus};
use crate::physics::design::Linearity;
use serde::Serialize;

/// A remark or warning that goes with the results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Note {
    /// Topic of the note, in a word or two.
    pub topic: &'static str,
    /// The note, a sentence or two.
    pub text: String,
}

/// Notes on targets for which the nearest stored points of a library are used.
pub fn nearby(focused: &Focused, targets: &[Target]) -> Vec<Note> {
    let places = targets.iter().zip(&focused.points).filter_map(|(target, used)| {
        let (asked, stored) = (*target.points.first()?, *used.first()?);
        let apart = asked.distance(stored);
        (apart > 1e-9).then(|| Note {
            topic: "library",
            text: format!(
                "{stored} is used for {asked}, {:.2} mm away: it is the nearest finished point",
                apart * 1e3
            ),
        })
    });
    places.collect()
}

/// Warnings that go with measured figures.
pub(super) fn all(surface: &Surface, measured: &Measured, largest: f64, found: &Linearity) -> Vec<Note> {
    let mut notes = linear_theory(surface, largest, found);
    if measured.targets.iter().any(|target| !target.span_complete) {
        notes.push(Note {
            topic: "span",
            text: "the responses end before twice the focal instant: background contrast and worst spot are those of the known \
                part".into(),
        });
    }
    notes
}

/// Notes on what linear theory cannot say of a field with a displacement of `largest` metres.
fn linear_theory(surface: &Surface, largest: f64, found: &Linearity) -> Vec<Note> {
    let um = |metres: f64| metres * 1e6;
    let mut notes = Vec::new();
    let mut note = |text| notes.push(Note { topic: "linear theory", text });
    if surface.sheet.thickness > 0.0 && found.displacement_over_thickness > 1.0 {
        note(format!(
            "the largest displacement, {:.0} µm, is above the sheet's thickness of {:.0} µm: the sheet would stretch as \
             much as it bends, and linear theory does not hold",
            um(largest),
            um(surface.sheet.thickness)
        ));
    }
    if let Some(change) = found.tension_change.filter(|change| *change > 0.1) {
        note(format!(
            "slopes of up to {:.3} add {:.1} N/m to the tension, {:.0} % of it: above 10 %, the wave speed depends on the \
             amplitude, and linear theory does not hold",
            found.slope,
            found.tension_added_n_per_m,
            100.0 * change
        ));
    }
    if let Some(share) = found.share_of_yield.filter(|share| *share > 1.0) {
        note(format!(
            "bending strains the faces by {:.2e} and stretching the middle by {:.2e}: with the tension, {share:.1} times the \
             strain at which the sheet yields",
            found.bending_strain, found.stretching_strain
        ));
    }
    notes
}

/// A note that the level is that of the limit, because neither thickness nor tension and strength of the sheet are
/// known.
pub(super) fn unknown(surface: &Surface, drive: &Drive) -> Option<Note> {
    let known = surface.sheet.thickness > 0.0;
    (!known && drive.peak() > 0.0).then(|| Note {
        topic: "level",
        text: "how far linear theory holds is not known, since the sheet has no thickness: the drive is at its limit, and \
               displacements may be beyond linear theory"
            .into(),
    })
}

/// A note that a drive is at its limit, because the level asked for is above it.
pub(super) fn beyond(beyond: &Beyond) -> Note {
    let Beyond { most, wanted, unit, .. } = beyond;
    Note {
        topic: "level",
        text: format!("reaches {most} at the drive limit, not the {wanted} {unit} asked for"),
    }
}

/// A note on what a method loses below the limit of the drive.
pub(super) fn idle(
    act: &Act<'_>,
    (focuser, on): (&Focuser<'_>, &Readouts<'_>),
    focused: &Focused,
    drive: &Drive,
    aims: &[Aim],
    scaled: bool,
) -> Result<Option<Note>, ActError> {
    let text = match focused.method {
        Method::Limited if scaled => {
            "no drive was found for this level: the drive is the one for the limit, scaled down".into()
        }
        Method::Limited if !focused.shaped => format!(
            "the limit is not reached at this level: the drive is that of concentrate with a strength of {}, and push has no \
             effect",
            act.options.strength.unwrap_or(focused.method.strength())
        ),
        Method::OneBit => one_bit(act, (focuser, on), drive, aims)?,
        _ => return Ok(None),
    };
    Ok(Some(Note { topic: "method", text }))
}

/// One-bit below the limit, beside time reversal at the same peak.
fn one_bit(
    act: &Act<'_>,
    (focuser, on): (&Focuser<'_>, &Readouts<'_>),
    drive: &Drive,
    aims: &[Aim],
) -> Result<String, ActError> {
    let options = Options { method: Method::TimeReversal, ..act.options.clone() };
    let reversed = focus(focuser.responses(), act.targets, &options)?.drive;
    let peak = |drive: &Drive| -> Result<f64, ActError> {
        let Some(aim) = aims.first() else { return Ok(0.0) };
        let traces = on.fine()?.field(drive)?.traces(&aim.points, aim.instant)?;
        let sum: f64 = traces.iter().filter_map(|trace| trace.velocity.last()).sum();
        Ok((sum / traces.len().max(1) as f64).abs())
    };
    let share = peak(drive)? / peak(&reversed)?;
    let said = "one-bit gives the highest peak for a drive at the limit, but this level needs less";
    if share.is_nan() || share > 1.0 {
        return Ok(format!(
            "{said}: its drive is scaled down as a whole, but time reversal would exceed the limit for the same peak"
        ));
    }
    let energy = share * share * reversed.energy() / drive.energy();
    Ok(format!(
        "{said}: its drive is scaled down as a whole, and time reversal gives the same peak velocity for {energy:.2} times the energy"
    ))
}
