//! The second search: layouts compared by what drives of a method reach from them, beginning with the best ones for the contrast of time
//! reversal.

use super::budget::{JUDGED, SEARCHED, most};
use super::drives::{Drives, method};
use super::setting::Setting;
use super::{Ask, ByAsk};
use crate::window::conditions;
use crate::{Progress, TaskError};
use serde::Serialize;
use unripple::core::Point;
use unripple_placement::{Aim, Objective, Refining, Search};

/// Distance between places that are tried first for an actuator, over the shortest wavelength: nearer ones drive the modes alike.
const SPACING: f64 = 0.5;

/// Values of an objective for two layouts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Number of targets, each with a drive of its own.
    pub targets: usize,
    /// The objective for the best layout for time reversal; infinite where a drive has no such figure.
    pub time_reversal: f64,
    /// The objective for the layout that was found.
    pub found: f64,
}

/// A search by what drives of a method reach.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Second {
    /// Name of the method.
    pub method: &'static str,
    /// The figure by which layouts are compared: its key in the results by method.
    pub by: &'static str,
    /// The objective, in words.
    pub objective: String,
    /// Number of layouts whose drives were computed and evaluated.
    pub layouts: usize,
    /// The number of layouts that was allowed.
    pub most_layouts: usize,
    /// Whether all moves of one actuator from the best layout on the places were evaluated, and none was better.
    pub settled: bool,
    /// What is known of how good the layout can be, in words.
    pub certificate: &'static str,
    /// The objective on the targets of the search, with fields read at a fourth of the points.
    pub searched: Compared,
    /// The objective on evaluation targets, with fields read at all points.
    pub evaluated: Compared,
}

/// What a second search comes to.
pub(super) struct Found {
    /// The places of the layout.
    pub places: Vec<Point>,
    /// Its actuators in the forms, if it is on the places that the search chose from; `None` for the layout for time reversal.
    pub chosen: Option<Vec<usize>>,
    /// What is reported of the search.
    pub second: Second,
}

/// Searches for a layout by what drives reach, from the layouts `starts` of the search for time reversal and the final layout of that
/// search, `proposed`.
///
/// # Errors
/// Those of computing and evaluating drives; [`TaskError::Cancelled`].
pub(super) fn searched(
    ask: &Ask,
    by: ByAsk,
    setting: &Setting,
    (search, starts): (&Search<'_>, &[Vec<usize>]),
    proposed: &[Point],
    progress: &mut dyn Progress,
) -> Result<Found, TaskError> {
    let (most, method) = (most(ask), method(ask).name());
    let aims = leading(setting, &setting.trained, SEARCHED);
    progress.stage(&format!(
        "search by the {} of {method}: at most {most} layouts, {} drives each",
        by.words(),
        aims.len()
    ));
    let drives = Drives::of(ask, by, &setting.built(proposed), setting.window)?;
    let before = drives.score(&setting.built(proposed), &aims, true, &*progress)?;
    let at = |layout: &[usize]| layout[search.kept..].iter().map(|a| search.at[*a]).collect::<Vec<_>>();
    let spacing = SPACING * conditions(&setting.surface).lambda_min;
    let refining = Refining { evaluations: most - 1, spacing, seed: ask.seed };
    let mut layouts: usize = 1;
    let found = search.refined(starts, &refining, |layout| {
        progress.done(layouts as f64 / most as f64);
        layouts += 1;
        drives.score(&setting.built(&at(layout)), &aims, true, &*progress)
    })?;
    let settled = found.as_ref().is_some_and(|found| found.settled);
    let (places, chosen, after) = match found {
        Some(found) if found.score >= before => (at(&found.actuators), Some(found.actuators), found.score),
        _ => (proposed.to_vec(), None, before),
    };
    let evaluated = evaluated(setting, &drives, [proposed, places.as_slice()], progress)?;
    let second = Second {
        method,
        by: by.key(),
        objective: objective_name(ask.objective(), by),
        layouts,
        most_layouts: most,
        settled,
        certificate: certificate(settled, ask.count),
        searched: Compared::of(by, aims.len(), [before, after]),
        evaluated: Compared::of(by, evaluated.0, evaluated.1),
    };
    Ok(Found { places, chosen, second })
}

/// Number of evaluation targets, and the scores on them of the layout for time reversal and of the one that was found.
fn evaluated(
    setting: &Setting,
    drives: &Drives,
    [proposed, found]: [&[Point]; 2],
    progress: &mut dyn Progress,
) -> Result<(usize, [f64; 2]), TaskError> {
    progress.stage("evaluation of both layouts");
    let aims = leading(setting, &setting.tested, JUDGED);
    let score = |places: &[Point]| drives.score(&setting.built(places), &aims, false, &*progress);
    let before = score(proposed)?;
    let after = if found == proposed { before } else { score(found)? };
    Ok((aims.len(), [before, after]))
}

impl Compared {
    /// Scores as values of the objective.
    fn of(by: ByAsk, targets: usize, [before, after]: [f64; 2]) -> Self {
        Self { targets, time_reversal: by.turned(before), found: by.turned(after) }
    }
}

/// The first of some targets, which are spread evenly; of those that are named, the ones that weigh most.
pub(super) fn leading(setting: &Setting, aims: &[Aim], most: usize) -> Vec<Aim> {
    let mut aims = aims.to_vec();
    if !setting.held_out {
        aims.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    }
    aims.truncate(most);
    aims
}

/// The objective for a figure, in words.
fn objective_name(objective: Objective, by: ByAsk) -> String {
    let figure = by.words();
    match objective {
        Objective::Mean => format!("mean {figure}"),
        Objective::Worst => format!("worst {figure}"),
        Objective::Quantile(share) => {
            format!("{figure} that is worse at {:.0} % of the targets", 100.0 * share)
        }
    }
}

/// What is known of how good the layout can be, in words, by whether the search settled and the number of actuators that are placed.
fn certificate(settled: bool, count: usize) -> &'static str {
    match settled {
        // Its moves are all the places.
        true if count == 1 => "every place was evaluated: the best on these places",
        true => {
            "no move of one actuator from the best layout on the places is better, but another layout may be: the search is local"
        }
        false => "their number ended the search, which is local: more may find a better layout",
    }
}
