//! Writing of a fitted model's responses as a library.

use super::probed::Probed;
use crate::{Progress, Record, TaskError, filling, record};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use unripple::core::{Decay, Point, SampledResponses, Surface};
use unripple_calibrate::{Fitted, Verdict};
use unripple_store::{Doubt, Library, LibraryPlan};

/// Keys of the log entries that are copied from the measured library to the fitted one: its scale, and its
/// dead actuators.
const KEPT: [&str; 2] = ["scale", "dead"];

/// Key in the provenance of a library's plan: the library that the model was fitted to.
pub const FITTED_TO: &str = "fitted to";

/// Writes a library of the fitted model's responses at `points`. They have the length of the probed
/// responses, and are corrected by the probed responses nearby; those of dead actuators are zero. Doubts are
/// written first, so that a library filled in part carries them too.
pub fn fill(
    (record, folder): (&Record, &Path),
    source: &Library,
    surface: &Surface,
    fitted: &Fitted,
    probed: &Probed,
    points: &[Point],
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    let plan = plan(source, surface, fitted, &probed.good, points);
    let mut library = Library::create(folder, &plan)?;
    record.log(&mut library)?;
    for key in KEPT {
        library.log(key, source.logged(key).cloned().unwrap_or(Value::Null))?;
    }
    let doubtful = match &fitted.verdict {
        Verdict::Doubtful { why, .. } => {
            Some(Doubt::of("fit", format!("the fitted model is doubtful: {why}")))
        }
        Verdict::Good => None,
    };
    // What is doubted of single points was left out; what is doubted of the whole measurement is doubted of what is fitted to it.
    let of_all = source.doubts().iter().filter(|doubt| doubt.points.is_empty()).cloned();
    let found = probed.doubts.iter().map(|what| Doubt::of("fit", what)).chain(doubtful);
    let mut doubts: BTreeMap<String, Vec<Doubt>> = BTreeMap::new();
    of_all.chain(found).for_each(|doubt| doubts.entry(doubt.check.clone()).or_default().push(doubt));
    for (check, found) in doubts {
        library.set_doubts(&check, found)?;
    }
    filling::fill(&mut library, &source.dead(), progress, &mut |places| {
        Ok(fitted.blend(&probed.good, places)?)
    })
}

fn plan(
    source: &Library,
    surface: &Surface,
    fitted: &Fitted,
    probed: &SampledResponses,
    points: &[Point],
) -> LibraryPlan {
    let verdict = match &fitted.verdict {
        Verdict::Good => "good".to_owned(),
        Verdict::Doubtful { why, .. } => format!("doubtful: {why}"),
    };
    let about = [
        ("device", "fitted model".to_owned()),
        (FITTED_TO, source.path().display().to_string()),
        ("corrected by measured points", probed.points.len().to_string()),
        ("verdict", verdict),
        ("modes", fitted.modal().poles.len().to_string()),
        ("software", format!("unripple {}", env!("CARGO_PKG_VERSION"))),
        ("created", record::now()),
    ];
    let own = about.into_iter().map(|(key, text)| (key.to_owned(), text));
    let theirs = source.plan().provenance.iter().map(|(key, text)| (format!("measured {key}"), text.clone()));
    let provenance: BTreeMap<String, String> = theirs.chain(own).collect();
    let modal = fitted.modal();
    LibraryPlan {
        drive_units: source.plan().drive_units.clone(),
        surface: Some(as_fitted(surface, fitted)),
        provenance,
        ..LibraryPlan::new(modal.ports.clone(), points.to_vec(), modal.conditions.clone(), probed.samples())
    }
}

/// The surface with the fitted values of its sheet and of its actuators' places.
fn as_fitted(nominal: &Surface, fitted: &Fitted) -> Surface {
    let mut surface = nominal.clone();
    let stiffness = unripple::physics::Medium::of(&nominal.sheet).bending_stiffness;
    surface.sheet.tension = fitted.tension.value;
    if stiffness > 0.0 {
        surface.sheet.young *= fitted.bending_stiffness.value / stiffness;
    }
    surface.sheet.decay = Decay::Table(fitted.decay.iter().map(|(hz, time)| (*hz, time.value)).collect());
    for (actuator, found) in surface.actuators.iter_mut().zip(&fitted.actuators) {
        let at = Point::new(found.at[0].value, found.at[1].value);
        if surface.outline.contains(at) {
            actuator.at = at;
        }
    }
    surface
}
