//! The course of a search: all designs so far, and the best of them.

use super::front::Front;
use super::good::Step;
use super::told::{Told, turned};
use super::{End, Search};
use crate::sweep::Row;
use std::collections::HashMap;

/// All that is known of a search so far.
#[derive(Default)]
pub(super) struct Course {
    /// All designs, generation by generation.
    pub told: Vec<Told>,
    /// What each generation brought.
    pub steps: Vec<Step>,
    /// The designs that no other one is better than.
    pub front: Front,
    /// Optimisers that asked, as they call themselves, each once.
    pub optimisers: Vec<String>,
    /// The generation that has to be asked for next; `None` if the search is over.
    pub to_ask: Option<usize>,
    /// Why the search is over; `None` if it is not.
    pub ended: Option<End>,
    /// Rows by the hash of their design: what is asked for again is not computed again.
    pub known: HashMap<String, Row>,
}

impl Course {
    /// Takes the rows of another generation into account.
    pub fn take(&mut self, search: &Search, generation: usize, rows: Vec<Row>) {
        let (designs, mut failed) = (rows.len(), 0);
        for row in rows {
            let at = self.told.len();
            self.known.entry(row.hash.clone()).or_insert_with(|| row.clone());
            self.told.push(Told::of(search.file(), generation, at, row));
            failed += usize::from(self.told[at].losses.is_none());
            self.front.take(&self.told, at);
        }
        let best = match (search.file().objectives.as_slice(), self.front.places()) {
            ([only], [first, ..]) => {
                let loss = self.told[*first].feasible().and_then(|losses| losses.first().copied());
                loss.map(|loss| turned(only.want, loss))
            }
            _ => None,
        };
        self.steps.push(Step { generation, designs, failed, best, front: self.front.places().len() });
    }
}
