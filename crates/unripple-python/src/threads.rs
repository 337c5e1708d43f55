//! `threads=`: on how many threads a call computes.

use rayon::{ThreadPool, ThreadPoolBuilder};
use unripple_tasks::TaskError;

/// Most threads of a call, above the number of cores of any machine that this is meant for: threads beyond that are most likely a mistake,
/// and cost memory each.
const MOST: usize = 1024;

/// A pool of so many threads; `None` for the pool that all calls share, which has one for each core. Results do not depend on the number.
///
/// # Errors
/// [`TaskError::Ask`] of a number that is not accepted; [`TaskError::Work`] if the system has no such number of threads left.
pub(crate) fn pool(threads: Option<usize>) -> Result<Option<ThreadPool>, TaskError> {
    let Some(threads) = threads else { return Ok(None) };
    if !(1..=MOST).contains(&threads) {
        return Err(TaskError::ask("threads", format!("1 to {MOST}"), threads));
    }
    ThreadPoolBuilder::new().num_threads(threads).build().map(Some).map_err(TaskError::work)
}
