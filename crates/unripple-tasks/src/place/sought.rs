//! The search for a layout: what it found from every beginning, how good that can be, and where one more actuator would help.

use super::Ask;
use super::placed::{Best, More};
use super::refused::refused;
use crate::{Progress, TaskError, go_on};
use std::collections::HashSet;
use unripple_placement::{Chosen, Found, Objective, PlacementError, Search};

/// Random layouts that those that were found are compared with.
pub(super) const RANDOM: usize = 20;

/// The difference between the seed of these random layouts and that of the restarts.
pub(super) const OTHERS: u64 = 0x5eed;

/// What a search found, on the targets that layouts are optimised for.
pub(super) struct Sought {
    /// The layouts of every number of actuators, each made from the one before.
    pub each: Vec<Found>,
    /// The best layout of the number that was asked for.
    pub best: Found,
    /// The objective that was reached from each beginning, the greedy one first.
    pub reached: Vec<f64>,
    /// What is known of how good a layout can be.
    pub certificate: Best,
    /// The layouts from all beginnings, and the best of all if it is known.
    found: Vec<Found>,
    /// The objective of the best layout with one more actuator, for each actuator of the forms.
    with_each: Vec<f64>,
}

impl Sought {
    /// Searches for the layout that a request asks for.
    ///
    /// # Errors
    /// [`TaskError::Ask`] if the places do not hold so many actuators; [`TaskError::Cancelled`].
    pub fn of(ask: &Ask, search: &Search<'_>, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let (each, mut starts) = searched(ask, search, progress)?;
        go_on(progress)?;
        progress.stage("all layouts, where they are few");
        let optimum = search.best_of_all(ask.count);
        let reached = starts.iter().map(|found| found.score).collect();
        let certificate = certificate(search, ask.count, &starts, optimum.as_ref());
        starts.extend(optimum);
        let best =
            starts.iter().fold(&starts[0], |best, found| if found.score > best.score { found } else { best });
        let best = best.clone();
        let with_each = Chosen::new(search.forms, best.actuators.clone()).with_each(search.objective);
        Ok(Self { each, best, reached, certificate, found: starts, with_each })
    }

    /// The best of the layouts from all beginnings, at most so many, the best one first and each once.
    pub fn leading(&self, most: usize) -> Vec<Vec<usize>> {
        let mut found: Vec<&Found> = self.found.iter().collect();
        found.sort_by(|a, b| b.score.total_cmp(&a.score));
        let mut seen = HashSet::new();
        let is_new = |found: &&Found| {
            let mut set = found.actuators.clone();
            set.sort_unstable();
            seen.insert(set)
        };
        found.into_iter().filter(is_new).take(most).map(|found| found.actuators.clone()).collect()
    }

    /// Takes another layout for the best one, as a search by another objective found it.
    pub fn choose(&mut self, search: &Search<'_>, actuators: Vec<usize>) {
        let chosen = Chosen::new(search.forms, actuators);
        self.with_each = chosen.with_each(search.objective);
        self.best = Found { score: chosen.score(search.objective), actuators: chosen.actuators().to_vec() };
    }

    /// Index of the free actuator of the forms that would be the best one more; `None` if none is free.
    pub fn next(&self, search: &Search<'_>) -> Option<usize> {
        let free = (search.kept..search.at.len()).filter(|b| search.is_free(&self.best.actuators, *b));
        free.reduce(|best, b| if self.with_each[b] > self.with_each[best] { b } else { best })
    }

    /// The best place for one more actuator.
    pub fn one_more(&self, search: &Search<'_>) -> Option<More> {
        let next = self.next(search)?;
        let at = search.at[next];
        Some(More { name: None, at_m: [at.x, at.y], objective: self.with_each[next] })
    }

    /// The objective with one more actuator at each place, not a number where the place is not free.
    pub fn free(&self, search: &Search<'_>) -> Vec<f64> {
        let free = |b: usize| match search.is_free(&self.best.actuators, b) {
            true => self.with_each[b],
            false => f64::NAN,
        };
        (search.kept..search.at.len()).map(free).collect()
    }
}

/// The layouts of every number of actuators, and those of the requested number from each beginning, the greedy one first.
fn searched(
    ask: &Ask,
    search: &Search<'_>,
    progress: &mut dyn Progress,
) -> Result<(Vec<Found>, Vec<Found>), TaskError> {
    go_on(progress)?;
    progress.stage("each number of actuators");
    let places = search.at.len() - search.kept;
    let up_to = ask.up_to.unwrap_or(2 * ask.count).max(ask.count).min(places);
    let each = match search.each_number(up_to) {
        // Distances may leave fewer places than there are points of the grid.
        Err(PlacementError::Few { found, .. }) if found >= ask.count => search.each_number(found),
        other => other,
    };
    let few = |error| match error {
        PlacementError::Few { found, .. } => PlacementError::Few { expected: ask.count, found },
        other => other,
    };
    let each = each.map_err(|error| refused(few(error)))?;
    go_on(progress)?;
    progress.stage("search");
    let mut starts = vec![each[ask.count - 1].clone()];
    // Where distances leave room for hardly any layout, random ones may not be found; the greedy one was.
    starts.extend(search.restarts(ask.count, ask.restarts, ask.seed).unwrap_or_default());
    Ok((each, starts))
}

/// The objective that is maximised, in words.
pub(super) fn objective_name(ask: &Ask) -> String {
    match ask.objective() {
        Objective::Mean => "mean contrast".into(),
        Objective::Worst => "least contrast".into(),
        Objective::Quantile(share) => {
            format!("contrast that is worse at {:.0} % of the targets", 100.0 * share)
        }
    }
}

/// What is known of how good a layout can be.
fn certificate(search: &Search<'_>, count: usize, starts: &[Found], best: Option<&Found>) -> Best {
    let layouts = search.layouts(count);
    let reached = starts.iter().map(|found| found.score).fold(0.0, f64::max);
    let certificate = match best {
        Some(best) if reached >= best.score * (1.0 - 1e-4) => {
            "the best of all layouts on these places: every one was compared".to_owned()
        }
        Some(best) => format!(
            "the best of all layouts on these places: every one was compared (the search alone reached {:.1} % of it)",
            100.0 * reached / best.score
        ),
        None => format!("none: {layouts:.1e} layouts are too many to compare, and no useful bound is known"),
    };
    Best { layouts, objective: best.map(|best| best.score), certificate }
}
