//! The library that recordings are evaluated into: a new one, the existing one, or the existing one with
//! more points.

use super::planned::SAME;
use crate::TaskError;
use crate::calibrate::campaign::{Campaign, PROBED};
use serde_json::Value;
use std::collections::BTreeMap;
use unripple::core::Point;
use unripple_store::{Library, LibraryPlan, PointState};

/// Creates or opens the library of a calibration, and adds points that its plan has gained.
pub fn library_of(campaign: &Campaign<'_>) -> Result<Library, TaskError> {
    let (folder, plan) = (&campaign.ask.output, campaign.plan());
    if Library::is_at(folder) {
        let there = Library::open(folder)?;
        if let Some(known) = grown(campaign, &plan, there.plan()) {
            drop(there);
            return Ok(Library::grow(folder, &plan, &known)?);
        }
    }
    Ok(Library::create(folder, &plan)?)
}

/// The points of `made` that were computed, but from other data than it says.
pub fn outdated(library: &Library, made: &BTreeMap<usize, Value>) -> Vec<usize> {
    let computed = |point: &usize| library.state(*point) != Some(PointState::Missing);
    let other =
        |point: &usize| library.logged_point(*point).and_then(|said| said.get("made")) != made.get(point);
    made.keys().copied().filter(computed).filter(other).collect()
}

/// The number of each point in the existing plan `there`, if the new plan differs from it only by added
/// points.
fn grown(campaign: &Campaign<'_>, plan: &LibraryPlan, there: &LibraryPlan) -> Option<Vec<Option<usize>>> {
    let old: usize = there.provenance.get(PROBED)?.parse().ok()?;
    let new = campaign.places.probed;
    if new <= old || there.points.len() < old {
        return None;
    }
    let provenance: BTreeMap<String, String> = plan.provenance.clone();
    let as_if = LibraryPlan { points: plan.points.clone(), provenance, ..there.clone() };
    let only = BTreeMap::from([(PROBED.to_owned(), old.to_string())]);
    let others = |map: &BTreeMap<String, String>| -> BTreeMap<String, String> {
        map.iter().filter(|(key, _)| !only.contains_key(*key)).map(|(k, v)| (k.clone(), v.clone())).collect()
    };
    let same = plan.difference(&as_if).is_none()
        && LibraryPlan { provenance: others(&plan.provenance), ..as_if.clone() }
            .difference(&LibraryPlan { provenance: others(&there.provenance), ..as_if })
            .is_none();
    let place = |points: &[Point], at: &Point| points.iter().position(|other| other.distance(*at) < SAME);
    let mut known: Vec<Option<usize>> =
        plan.points[..new].iter().map(|at| place(&there.points[..old], at)).collect();
    known.extend((0..plan.points.len() - new).map(|own| Some(old + own).filter(|n| *n < there.points.len())));
    let kept = known.iter().flatten().count() == there.points.len();
    (same && kept).then_some(known)
}
