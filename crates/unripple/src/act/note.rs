//! Notes that go with the results of a focus.

use super::beyond::Beyond;
use crate::core::{Drive, Surface};
use crate::field::Measured;
use crate::focus::{Focused, Target};
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
