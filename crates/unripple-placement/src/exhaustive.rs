//! The best of all layouts, found by comparing every one: proof of an optimum where there are few.

use crate::{Chosen, Found, Objective, Search};
use rayon::prelude::*;

/// Largest number of contrasts that are computed to compare all layouts: it takes some seconds. With ten times as many, a search would
/// mostly wait for it.
const MOST: f64 = 2e9;

/// Ratio of the time to find a quantile to that to find a mean.
const SORTED: f64 = 16.0;

impl Search<'_> {
    /// Number of layouts of `count` actuators, if any distance between two of them is allowed.
    pub fn layouts(&self, count: usize) -> f64 {
        let places = (self.at.len() - self.kept) as f64;
        let layouts: f64 = (0..count).map(|i| (places - i as f64).max(0.0) / (i as f64 + 1.0)).product();
        layouts.min(f64::MAX)
    }

    /// The best of all layouts of `count` actuators in addition to the kept ones; `None` if there are too many layouts to
    /// compare, or none.
    pub fn best_of_all(&self, count: usize) -> Option<Found> {
        // Quantiles are found by sorting.
        let most = if matches!(self.objective, Objective::Quantile(_)) { MOST / SORTED } else { MOST };
        if count == 0 || self.layouts(count) * self.forms.cases() as f64 > most {
            return None;
        }
        // After a later one there are not enough places left.
        let first = self.kept..(self.at.len() + 1).saturating_sub(count);
        let best = first.into_par_iter().map(|a| {
            let mut set: Vec<usize> = (0..self.kept).collect();
            if !self.is_free(&set, a) {
                return None;
            }
            set.push(a);
            self.among(set, count - 1)
        });
        let better = |one: Option<Found>, other: Option<Found>| match (one, other) {
            (Some(one), Some(other)) => Some(if other.score > one.score { other } else { one }),
            (one, other) => one.or(other),
        };
        // In the order of the places, whatever the number of threads.
        best.collect::<Vec<_>>().into_iter().fold(None, better)
    }

    /// The best of all layouts that have `more` actuators beside those of a set, all of them later than its last.
    fn among(&self, set: Vec<usize>, more: usize) -> Option<Found> {
        let now = Chosen::new(self.forms, set);
        if more == 0 {
            return Some(Found { score: now.score(self.objective), actuators: now.actuators().to_vec() });
        }
        let after = now.actuators().last().map_or(self.kept, |last| last + 1);
        let rest =
            (after..(self.at.len() + 1).saturating_sub(more)).filter(|b| self.is_free(now.actuators(), *b));
        let with = |b: usize| now.actuators().iter().copied().chain([b]).collect::<Vec<_>>();
        if more == 1 {
            let scores = now.with_each(self.objective);
            let best = rest.reduce(|best, b| if scores[b] > scores[best] { b } else { best })?;
            return Some(Found { score: scores[best], actuators: with(best) });
        }
        let found = rest.filter_map(|b| self.among(with(b), more - 1));
        found.reduce(|best, found| if found.score > best.score { found } else { best })
    }
}
