use crate::core::Surface;
use crate::field::Measured;
use crate::focus::{Focused, Target};
use crate::physics::design::Linearity;
use serde::Serialize;

/// Something a reader of the figures must know.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Note {
    /// What it is about, in a word or two.
    pub topic: &'static str,
    /// The note.
    pub text: String,
}

/// Where stored points stand for the places asked for.
pub fn nearby(focused: &Focused, targets: &[Target]) -> Vec<Note> {
    let places = targets.iter().zip(&focused.points).filter_map(|(target, used)| {
        let (asked, stored) = (*target.points.first()?, *used.first()?);
        let apart = asked.distance(stored);
        (apart > 1e-9).then(|| Note {
            topic: "library",
            text: format!(
                "{stored} stands for {asked}, {:.2} mm away: the nearest finished point",
                apart * 1e3
            ),
        })
    });
    places.collect()
}

/// The largest displacement anywhere, in metres.
pub(super) fn largest(measured: &Measured) -> f64 {
    let peak = measured.maps.peak_displacement.iter().fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
    measured.targets.iter().map(|t| t.peak_displacement_m.abs()).fold(peak, f64::max)
}

/// Warnings that go with measured figures.
pub(super) fn all(surface: &Surface, measured: &Measured, linearity: Option<&Linearity>) -> Vec<Note> {
    let mut notes = linearity.map_or_else(Vec::new, |found| linear_theory(surface, largest(measured), found));
    if measured.targets.iter().any(|target| !target.span_complete) {
        notes.push(Note {
            topic: "span",
            text: "the responses end before twice the focal instant: background figures are those of the part known".into(),
        });
    }
    notes
}

/// What a field with a displacement of `largest` metres puts in doubt.
fn linear_theory(surface: &Surface, largest: f64, found: &Linearity) -> Vec<Note> {
    let um = |metres: f64| metres * 1e6;
    let mut notes = Vec::new();
    let mut note = |text| notes.push(Note { topic: "linear theory", text });
    if found.displacement_over_thickness > 1.0 {
        note(format!(
            "the largest displacement, {:.0} µm, is above the sheet's thickness of {:.0} µm: the sheet would stretch as \
             much as it bends, and linear theory does not hold",
            um(largest),
            um(surface.sheet.thickness)
        ));
    }
    if let Some(change) = found.tension_change.filter(|change| *change > 0.1) {
        note(format!(
            "slopes of up to {:.3} add {:.1} N/m to the tension, {:.0} % of it: above 10 %, waves run faster where they are \
             high, and linear theory does not hold",
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
