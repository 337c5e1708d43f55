//! The front of a search: the designs that no other design is better than.

use super::told::Told;

/// Designs that keep all constraints and that no other one dominates, by their places in a list that grows; of equal designs the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Front(Vec<usize>);

impl Front {
    /// Takes another design of the list into account.
    pub fn take(&mut self, told: &[Told], at: usize) {
        let Some(new) = told[at].feasible() else { return };
        let losses = |at: usize| told[at].feasible().unwrap_or_default();
        let equal = |other: usize| told[other].row.hash == told[at].row.hash;
        if self.0.iter().any(|other| equal(*other) || dominates(losses(*other), new)) {
            return;
        }
        self.0.retain(|other| !dominates(new, losses(*other)));
        self.0.push(at);
    }

    /// The places of the designs, in order.
    pub fn places(&self) -> &[usize] {
        &self.0
    }
}

/// Whether losses are nowhere greater than others, and somewhere smaller.
fn dominates(one: &[f64], other: &[f64]) -> bool {
    one.iter().zip(other).all(|(one, other)| one <= other)
        && one.iter().zip(other).any(|(one, other)| one < other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Row;

    fn told(index: usize, losses: Option<Vec<f64>>, violation: f64) -> Told {
        let row = Row { hash: index.to_string(), ..Row::default() };
        Told { generation: 0, index, row, losses, violation, error: None }
    }

    #[test]
    fn the_front_has_all_that_nothing_is_better_than_and_nothing_else() {
        let mut random = unripple::core::Random::seeded(7);
        let step = |random: &mut unripple::core::Random| random.between(0.0, 20.0).floor();
        let mut all: Vec<Told> = (0..200)
            .map(|index| {
                let losses: Vec<f64> = (0..3).map(|_| step(&mut random)).collect();
                told(index, Some(losses).filter(|_| index % 7 != 0), if index % 5 == 0 { 0.1 } else { 0.0 })
            })
            .collect();
        all[9].row.hash = all[8].row.hash.clone();
        all[9].losses = all[8].losses.clone();
        let mut front = Front::default();
        (0..all.len()).for_each(|at| front.take(&all, at));
        let better =
            |other: &Told, losses: &[f64]| other.feasible().is_some_and(|own| dominates(own, losses));
        let alone = |told: &&Told| {
            let losses = told.feasible();
            losses.is_some_and(|losses| !all.iter().any(|other| better(other, losses))) && told.index != 9
        };
        let expected: Vec<usize> = all.iter().filter(alone).map(|told| told.index).collect();
        assert_eq!(front.places(), expected);
        assert!(expected.len() > 3, "{expected:?}");
    }
}
