//! How many layouts and drives are computed and evaluated.

use super::Ask;

/// Number of targets to which drives are computed from each layout. With twice as many, the search takes twice the time.
pub(super) const SEARCHED: usize = 4;

/// Number of targets on which drives from layouts are evaluated at the end. With twice as many, this takes twice the time, which is most of
/// the task's without a second search.
pub(super) const JUDGED: usize = 6;

/// Largest number of layouts for time reversal with which the search begins.
pub(super) const STARTS: usize = 6;

/// Layouts that are evaluated by default, for each actuator that is placed.
const MOVES: usize = 8;

/// Largest number of layouts that are evaluated by default: more have to be asked for.
const MOST: usize = 200;

/// The number of layouts whose drives may be evaluated.
pub(super) fn most(ask: &Ask) -> usize {
    ask.evaluations.unwrap_or((STARTS + MOVES * ask.count).min(MOST))
}
