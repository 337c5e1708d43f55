//! The search for the best places: greedy start, exchange to a local optimum, restarts.

use crate::apart::{are_apart, random};
use crate::{Chosen, Forms, Objective, PlacementError};
use rayon::prelude::*;
use unripple_core::Point;

/// Least relative gain for which an actuator is moved. With much less, rounding errors of single precision would move actuators for ever.
const GAIN: f64 = 1e-5;

/// A search for the best layout: quadratic forms, places, kept actuators, least distance and objective.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    /// Quadratic forms of all actuators: the kept ones first, then one at each place.
    pub forms: &'a Forms,
    /// Place of each actuator of the forms, in metres.
    pub at: &'a [Point],
    /// Number of kept actuators, which are in every layout.
    pub kept: usize,
    /// Least distance between any two actuators, in metres.
    pub apart: f64,
    /// The objective that is maximised.
    pub objective: Objective,
}

/// A layout that cannot be improved by moving any one of its actuators, and the value of the objective for
/// it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Indices of its actuators in the forms; the kept ones come first.
    pub actuators: Vec<usize>,
    /// The value of the objective, a contrast (ratio).
    pub score: f64,
}

impl Search<'_> {
    /// Layouts of every number of actuators from 1 to `most` (in addition to the kept ones): each starts from the layout before with
    /// the actuator added that gains most, and is improved by exchange.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if the places do not hold so many.
    pub fn each_number(&self, most: usize) -> Result<Vec<Found>, PlacementError> {
        let mut layouts: Vec<Found> = Vec::new();
        for number in 1..=most {
            let before =
                layouts.last().map_or_else(|| (0..self.kept).collect(), |found| found.actuators.clone());
            let more = self.best_of(&Chosen::new(self.forms, before.clone()), |_| true);
            let (more, _) = more.ok_or(PlacementError::Few { expected: most, found: number - 1 })?;
            let mut actuators = before;
            actuators.push(more);
            layouts.push(self.exchanged(actuators));
        }
        Ok(layouts)
    }

    /// Layouts of `count` actuators in addition to the kept ones, each improved by exchange from one of `restarts` random
    /// layouts, in the order of these whatever the number of threads.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if no random layout of so many actuators was found.
    pub fn restarts(&self, count: usize, restarts: usize, seed: u64) -> Result<Vec<Found>, PlacementError> {
        let from = self.random(count, restarts, seed)?;
        Ok(from.into_par_iter().map(|actuators| self.exchanged(actuators)).collect())
    }

    /// Random layouts of `count` actuators in addition to the kept ones, as indices of the forms.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if none was found that keeps the least distance.
    pub fn random(&self, count: usize, layouts: usize, seed: u64) -> Result<Vec<Vec<usize>>, PlacementError> {
        random(self.kept..self.at.len(), count, layouts, seed, |chosen, b| self.is_free(chosen, b))
    }

    /// The value of the objective for a layout, a contrast (ratio).
    pub fn score(&self, actuators: Vec<usize>) -> f64 {
        Chosen::new(self.forms, actuators).score(self.objective)
    }

    /// A layout in which no single actuator can be moved to a better place: each in turn is moved to the best one, until none gains.
    pub fn exchanged(&self, actuators: Vec<usize>) -> Found {
        self.exchanged_among(actuators, |_, _| true)
    }

    /// The same where only some moves are allowed: `may` says whether the actuator at a position of the layout may be one of the forms.
    pub(crate) fn exchanged_among(&self, actuators: Vec<usize>, may: impl Fn(usize, usize) -> bool) -> Found {
        let mut now = Chosen::new(self.forms, actuators);
        let mut score = now.score(self.objective);
        let (mut position, mut settled) = (self.kept, 0);
        let movable = now.actuators().len() - self.kept;
        while settled < movable {
            let rest = now.without(position);
            let best = self.best_of(&rest, |b| may(position, b));
            match best.filter(|(_, reached)| *reached > score * (1.0 + GAIN)) {
                Some((best, reached)) => {
                    (now, score, settled) = (rest.with(position, best), reached, 0);
                }
                None => settled += 1,
            }
            position += 1;
            if position == self.kept + movable {
                position = self.kept;
                // Sums that change by differences gather rounding errors.
                now = Chosen::new(self.forms, now.actuators().to_vec());
            }
        }
        Found { score: now.score(self.objective), actuators: now.actuators().to_vec() }
    }

    /// The actuator whose addition to a set gives the objective its largest value, and that value; `None` if
    /// no place is free.
    fn best_of(&self, set: &Chosen<'_>, may: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let scores = set.with_each(self.objective);
        let mut best: Option<(usize, f64)> = None;
        for (b, score) in scores.iter().enumerate().skip(self.kept) {
            if best.is_none_or(|(_, most)| *score > most) && may(b) && self.is_free(set.actuators(), b) {
                best = Some((b, *score));
            }
        }
        best
    }

    /// Whether an actuator is at least [`Search::apart`] away from all those of a set, and is none of them.
    pub fn is_free(&self, set: &[usize], b: usize) -> bool {
        let far = |a: usize| are_apart(self.at[a], self.at[b], self.apart);
        set.iter().all(|a| *a != b && far(*a))
    }
}
