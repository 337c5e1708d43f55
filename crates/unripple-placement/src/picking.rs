//! D-optimal choices of single places: greedy start, exchange to a local optimum, restarts.

use crate::apart::{are_apart, random};
use crate::informations::{Solved, log_det_of};
use crate::{Informations, PlacementError};
use rayon::prelude::*;
use unripple_core::Point;

/// Least gain of ln det for which a place is exchanged. With much less, rounding errors would exchange places for ever.
const GAIN: f64 = 1e-9;

/// What is added to the information while places are sought, in the units of [`Informations`]: with few places it is singular.
const RIDGE: f64 = 1e-9;

/// Choices of different places for measurements.
#[derive(Clone, Copy, Debug)]
pub struct Picking<'a> {
    /// What a measurement at each place tells.
    pub informations: &'a Informations,
    /// The places, in metres.
    pub at: &'a [Point],
    /// Places (m) of what is measured already, and is part of what is known before.
    pub kept: &'a [Point],
    /// Least distance between any two places, in metres.
    pub apart: f64,
}

/// A choice of places, and the determinant of its information.
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    /// Indices of the places.
    pub places: Vec<usize>,
    /// Logarithm of the determinant, as of [`Informations::log_det`].
    pub log_det: f64,
}

impl Picking<'_> {
    /// The best choices of every number of places from 1 to `most`: each begins with the one before and the place that gains most, and is
    /// improved by exchange.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if there are not so many places.
    pub fn each_number(&self, most: usize) -> Result<Vec<Picked>, PlacementError> {
        let mut found: Vec<Picked> = Vec::new();
        for number in 1..=most {
            let mut places = found.last().map_or_else(Vec::new, |before| before.places.clone());
            let more = self.best_beside(&places);
            places.push(more.ok_or(PlacementError::Few { expected: most, found: number - 1 })?);
            found.push(self.exchanged(places));
        }
        Ok(found)
    }

    /// Choices of `count` places, each improved by exchange from a random beginning, in their order whatever the number of threads.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if no random choice of so many places was found.
    pub fn restarts(&self, count: usize, restarts: usize, seed: u64) -> Result<Vec<Picked>, PlacementError> {
        let from = self.random(count, restarts, seed)?;
        Ok(from.into_par_iter().map(|places| self.exchanged(places)).collect())
    }

    /// Random choices of `count` places.
    ///
    /// # Errors
    /// [`PlacementError::Few`] if none was found that keeps the least distance.
    pub fn random(&self, count: usize, choices: usize, seed: u64) -> Result<Vec<Vec<usize>>, PlacementError> {
        random(0..self.at.len(), count, choices, seed, |chosen, b| self.is_free(chosen, b))
    }

    /// A choice in which no single place can be exchanged for a better one: each in turn is exchanged for the best, until none gains.
    pub fn exchanged(&self, mut places: Vec<usize>) -> Picked {
        let (mut position, mut settled) = (0, 0);
        while settled < places.len() {
            match self.better(&places, position) {
                Some(place) => (places[position], settled) = (place, 0),
                None => settled += 1,
            }
            position = (position + 1) % places.len();
        }
        Picked { log_det: self.informations.log_det(&places), places }
    }

    /// Whether a place keeps its distance from those of a choice, and is none of them.
    pub fn is_free(&self, places: &[usize], b: usize) -> bool {
        let far = |at: &Point| are_apart(*at, self.at[b], self.apart);
        places.iter().all(|a| *a != b && far(&self.at[*a])) && self.kept.iter().all(far)
    }

    /// The place that gains most beside those of a choice; `None` if none is free.
    fn best_beside(&self, places: &[usize]) -> Option<usize> {
        let sum = self.searched(places);
        let free: Vec<usize> = (0..self.at.len()).filter(|b| self.is_free(places, *b)).collect();
        let reached: Vec<f64> = free.par_iter().map(|b| self.with(&sum, *b)).collect();
        let best = (0..free.len()).reduce(|best, i| if reached[i] > reached[best] { i } else { best })?;
        Some(free[best])
    }

    /// The place that gains most in place of one of a choice; `None` if none gains.
    ///
    /// ln det is concave, so that an exchange gains at most the difference of both places' tr(M⁻¹ M_i): where this is not more than
    /// the best exchange found, the rest need not be looked at.
    fn better(&self, places: &[usize], position: usize) -> Option<usize> {
        let solved = Solved::of(&self.searched(places), self.informations.unknowns())?;
        let traces = self.informations.traces(&solved.inverse);
        let own = traces[places[position]];
        let mut rest = places.to_vec();
        rest.remove(position);
        let promising = |b: &usize| traces[*b] - own > GAIN && self.is_free(&rest, *b);
        let mut others: Vec<usize> = (0..self.at.len()).filter(promising).collect();
        others.sort_by(|a, b| traces[*b].total_cmp(&traces[*a]));
        let sum = self.searched(&rest);
        let (mut best, mut most) = (None, GAIN);
        for b in others {
            if traces[b] - own <= most {
                break;
            }
            let gain = self.with(&sum, b) - solved.log_det;
            if gain > most {
                (best, most) = (Some(b), gain);
            }
        }
        best
    }

    /// The information of a choice, packed, never singular.
    fn searched(&self, places: &[usize]) -> Vec<f64> {
        let mut sum = self.informations.sum(places.iter().map(|place| (*place, 1.0)));
        let (mut at, unknowns) = (0, self.informations.unknowns());
        for column in 0..unknowns {
            sum[at] += RIDGE;
            at += unknowns - column;
        }
        sum
    }

    /// ln det with one more place.
    fn with(&self, sum: &[f64], place: usize) -> f64 {
        let more: Vec<f64> = sum.iter().zip(self.informations.one(place)).map(|(x, y)| x + y).collect();
        log_det_of(&more, self.informations.unknowns())
    }
}
