//! When a search ends before its last generation: once what it has found has not improved for some generations.

use super::front::Front;
use super::told::Told;
use super::volume::volumes;
use super::{Ask, End, EndedBy};
use crate::TaskError;
use crate::sweep::short;
use std::collections::VecDeque;

/// Ends a search that does not improve any more.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    /// Number of generations within which there has to be an improvement.
    after: usize,
    /// The least improvement that counts, as a share of what was found before.
    share: f64,
    /// Places of the front before these generations and after each of them, as far as there were so many.
    fronts: VecDeque<Vec<usize>>,
}

impl Stop {
    /// As a request says; `None` if it does not.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of numbers that make no sense.
    pub fn of(ask: &Ask) -> Result<Option<Self>, TaskError> {
        let Some(after) = ask.stop_after else { return Ok(None) };
        if after == 0 {
            return Err(TaskError::ask("stop_after", "at least 1 generation", after));
        }
        if !(0.0..1.0).contains(&ask.stop_share) {
            let found = format!("{} %", short(100.0 * ask.stop_share));
            return Err(TaskError::ask("stop_share", "a share from 0 to below 100 %", found));
        }
        Ok(Some(Self { after, share: ask.stop_share, fronts: VecDeque::new() }))
    }

    /// Takes the front after another generation into account.
    pub fn take(&mut self, front: &Front) {
        self.fronts.push_back(front.places().to_vec());
        if self.fronts.len() > self.after + 1 {
            self.fronts.pop_front();
        }
    }

    /// Why the search is over; `None` if it is not. As long as no design keeps all constraints, it is not.
    pub fn end(&self, told: &[Told]) -> Option<End> {
        let (old, new) = (self.fronts.front()?, self.fronts.back()?);
        if self.fronts.len() <= self.after || old.is_empty() || self.improved(told, old, new) {
            return None;
        }
        let what = match told[old[0]].feasible() {
            Some([_]) => "the best design is",
            _ if old.len() == 1 && new.len() == 1 => "the one design of the front is",
            _ => "the hypervolume of the front is",
        };
        let (percent, after) = (short(100.0 * self.share), self.after);
        let generations =
            if after == 1 { "one generation".to_owned() } else { format!("{after} generations") };
        let why = format!("{what} better by no more than {percent} % than {generations} before");
        Some(End { by: EndedBy::NoImprovement, why })
    }

    /// Whether one front is better than another before by enough.
    fn improved(&self, told: &[Told], old: &[usize], new: &[usize]) -> bool {
        let losses = |places: &[usize]| -> Vec<&[f64]> {
            places.iter().filter_map(|place| told[*place].feasible()).collect()
        };
        let (old, new) = (losses(old), losses(new));
        match (old.as_slice(), new.as_slice()) {
            ([[old], ..], [[new], ..]) => old - new > self.share * old.abs(),
            // A box about two designs is as large as their difference, however small that is.
            ([old], [new]) => old.iter().zip(*new).any(|(old, new)| old - new > self.share * old.abs()),
            _ => {
                let [before, after] = volumes([&old, &new]);
                after - before > self.share * before
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Row;

    fn told(index: usize, losses: &[f64]) -> Told {
        let row = Row { hash: index.to_string(), ..Row::default() };
        Told { generation: index, index, row, losses: Some(losses.to_vec()), violation: 0.0, error: None }
    }

    /// The generation, one design each, after which a search is over.
    fn over(ask: &Ask, losses: &[&[f64]]) -> Option<usize> {
        let (mut stop, mut front, mut all) = (Stop::of(ask).unwrap().unwrap(), Front::default(), Vec::new());
        losses.iter().enumerate().position(|(index, losses)| {
            all.push(told(index, losses));
            front.take(&all, index);
            stop.take(&front);
            stop.end(&all).is_some()
        })
    }

    #[test]
    fn a_search_is_over_once_nothing_has_improved_for_so_long() {
        let ask = |stop_after, stop_share| Ask { stop_after: Some(stop_after), stop_share, ..Ask::default() };
        let one: [&[f64]; 6] = [&[8.0], &[4.0], &[3.99], &[5.0], &[3.98], &[1.0]];
        assert_eq!(over(&ask(2, 0.01), &one), Some(3));
        assert_eq!(over(&ask(2, 0.0), &one), None);
        assert_eq!(over(&ask(3, 0.01), &one), Some(4));
        // Below zero, where the greater number is the better one of what is wanted most.
        let most: [&[f64]; 4] = [&[-1.0], &[-2.0], &[-2.1], &[-2.1]];
        assert_eq!(over(&ask(1, 0.1), &most), Some(2));
        assert_eq!(over(&ask(1, 0.0), &[&[0.0], &[0.0]]), Some(1));
        let two: [&[f64]; 5] = [&[0.0, 4.0], &[4.0, 0.0], &[1.0, 1.0], &[2.0, 2.0], &[1.0, 1.0]];
        assert_eq!(over(&ask(1, 0.01), &two), Some(3));
        assert_eq!(over(&ask(4, 0.01), &two), None);
    }

    #[test]
    fn a_front_of_one_design_is_judged_by_its_objectives() {
        let ask = |stop_share| Ask { stop_after: Some(1), stop_share, ..Ask::default() };
        let slow: [&[f64]; 2] = [&[8.0, 1.0], &[7.99, 1.0]];
        assert_eq!(over(&ask(0.01), &slow), Some(1));
        assert_eq!(over(&ask(0.001), &slow), None);
        let once: [&[f64]; 3] = [&[8.0, -1.0], &[7.99, -1.5], &[7.98, -1.5]];
        assert_eq!(over(&ask(0.01), &once), Some(2));
    }

    #[test]
    fn numbers_that_make_no_sense_are_refused() {
        let refused = |ask: Ask| Stop::of(&ask).unwrap_err().to_string();
        let none = refused(Ask { stop_after: Some(0), ..Ask::default() });
        assert!(none.starts_with("stop_after: expected at least 1"), "{none}");
        let all = refused(Ask { stop_after: Some(5), stop_share: f64::NAN, ..Ask::default() });
        assert_eq!(all, "stop_share: expected a share from 0 to below 100 %, found NaN %");
        let whole = refused(Ask { stop_after: Some(5), stop_share: 1.0, ..Ask::default() });
        assert!(whole.ends_with("below 100 %, found 100 %"), "{whole}");
        assert!(Stop::of(&Ask::default()).unwrap().is_none());
    }
}
