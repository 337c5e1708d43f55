//! The search by an objective that has to be evaluated layout by layout and takes long: exchange from several layouts, within a number of
//! evaluations.

use crate::{Chosen, Search};
use std::collections::HashMap;
use unripple_core::Random;

/// Least gain for which an actuator is moved, relative to the score. With much less, rounding errors would count as gains.
const GAIN: f64 = 1e-9;

/// How a search evaluates layouts one by one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refining {
    /// Largest number of layouts that are evaluated.
    pub evaluations: usize,
    /// Least distance in metres between the places that are tried first for an actuator; those between them are tried later.
    pub spacing: f64,
    /// Seed of the places that are tried in random order.
    pub seed: u64,
}

/// A layout found by evaluating layouts one by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// Indices of its actuators in the forms; the kept ones come first.
    pub actuators: Vec<usize>,
    /// Its score, in the unit of the scores.
    pub score: f64,
    /// Number of layouts that were evaluated.
    pub evaluations: usize,
    /// Whether all layouts that differ from it in one actuator were evaluated, and none was better.
    pub settled: bool,
}

/// Scores of layouts, each computed once.
struct Scores<F> {
    score: F,
    known: HashMap<Vec<usize>, f64>,
    most: usize,
}

impl<F> Scores<F> {
    /// The score of a layout; `None` if it is not known and no more layouts are to be evaluated.
    fn of<E>(&mut self, layout: &[usize]) -> Result<Option<f64>, E>
    where
        F: FnMut(&[usize]) -> Result<f64, E>,
    {
        // Where the actuators are is the same in any order.
        let mut set = layout.to_vec();
        set.sort_unstable();
        if let Some(known) = self.known.get(&set) {
            return Ok(Some(*known));
        }
        if self.known.len() >= self.most {
            return Ok(None);
        }
        let score = (self.score)(layout)?;
        self.known.insert(set, score);
        Ok(Some(score))
    }
}

impl Search<'_> {
    /// The layout with the largest `score`, a number in any unit, of those that are found by exchange from the best of the layouts `starts`,
    /// then from the others, as long as evaluations are left; `None` without starts or evaluations. Layouts are evaluated one after the
    /// other, each once.
    ///
    /// To move an actuator, places are tried in turn by the objective of the search and at random: that objective may tell little of the
    /// scores.
    ///
    /// # Errors
    /// Those of `score`, which end the search.
    pub fn refined<E>(
        &self,
        starts: &[Vec<usize>],
        refining: &Refining,
        score: impl FnMut(&[usize]) -> Result<f64, E>,
    ) -> Result<Option<Refined>, E> {
        let mut scores = Scores { score, known: HashMap::new(), most: refining.evaluations };
        let mut begun: Vec<(&[usize], f64)> = Vec::new();
        for start in starts {
            begun.extend(scores.of::<E>(start)?.map(|score| (start.as_slice(), score)));
        }
        begun.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut random = Random::seeded(refining.seed);
        let mut best: Option<Refined> = None;
        for (start, score) in begun {
            let found = self.climbed::<E, _>((start, score), refining, &mut random, &mut scores)?;
            best = Some(match best {
                Some(best) if best.score >= found.score => best,
                _ => found,
            });
        }
        Ok(best.map(|best| Refined { evaluations: scores.known.len(), ..best }))
    }

    /// The layout that moves of single actuators lead to from another one, each to the first place that is found to be better.
    fn climbed<E, F>(
        &self,
        (start, mut score): (&[usize], f64),
        refining: &Refining,
        random: &mut Random,
        scores: &mut Scores<F>,
    ) -> Result<Refined, E>
    where
        F: FnMut(&[usize]) -> Result<f64, E>,
    {
        let mut now = start.to_vec();
        let at = |actuators, score, settled| Refined { actuators, score, evaluations: 0, settled };
        'moved: loop {
            for (position, b) in self.moves(&now, refining.spacing, random) {
                let mut next = now.clone();
                next[position] = b;
                let Some(reached) = scores.of::<E>(&next)? else { return Ok(at(now, score, false)) };
                // Without a score, which is minus infinity, a layout is worse than any other.
                if reached - score > GAIN * reached.abs() {
                    (now, score) = (next, reached);
                    continue 'moved;
                }
            }
            return Ok(at(now, score, true));
        }
    }

    /// All moves of one actuator of a layout to another place, in the order in which they are tried: each actuator's first, then each one's
    /// second. A move is the actuator's number in the layout, and the actuator of the forms that it becomes.
    fn moves(&self, layout: &[usize], spacing: f64, random: &mut Random) -> Vec<(usize, usize)> {
        let now = Chosen::new(self.forms, layout.to_vec());
        let positions = self.kept..layout.len();
        let tried: Vec<Vec<usize>> =
            positions.clone().map(|position| self.tried(&now, position, spacing, random)).collect();
        let most = tried.iter().map(Vec::len).max().unwrap_or(0);
        let turn = |rank: usize| {
            let each = tried.iter().zip(positions.clone());
            each.filter_map(move |(places, position)| Some((position, *places.get(rank)?)))
        };
        (0..most).flat_map(turn).collect()
    }

    /// The places to which an actuator of a layout may move, in the order in which they are tried.
    fn tried(&self, now: &Chosen<'_>, position: usize, spacing: f64, random: &mut Random) -> Vec<usize> {
        let (own, rest) = (now.actuators()[position], now.without(position));
        let expected = rest.with_each(self.objective);
        let free = (self.kept..self.at.len()).filter(|b| *b != own && self.is_free(rest.actuators(), *b));
        let mut ranked: Vec<usize> = free.collect();
        let mut drawn = ranked.clone();
        ranked.sort_by(|a, b| expected[*b].total_cmp(&expected[*a]));
        for i in (1..drawn.len()).rev() {
            drawn.swap(i, ((random.uniform() * (i + 1) as f64) as usize).min(i));
        }
        let ranked = self.apart_first(ranked, spacing);
        let mut taken = vec![false; self.at.len()];
        let both = ranked.into_iter().zip(drawn).flat_map(|(one, other)| [one, other]);
        both.filter(|b| !std::mem::replace(&mut taken[*b], true)).collect()
    }

    /// Places in the same order, but those that are near to an earlier one after all others.
    fn apart_first(&self, ranked: Vec<usize>, spacing: f64) -> Vec<usize> {
        let (mut first, mut later): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
        for b in ranked {
            let far = first.iter().all(|a| self.at[*a].distance(self.at[b]) >= spacing);
            if far { first.push(b) } else { later.push(b) }
        }
        first.append(&mut later);
        first
    }
}
