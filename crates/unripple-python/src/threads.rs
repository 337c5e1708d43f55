//! `threads=`: on how many threads a call computes.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::OnceLock;
use unripple_tasks::TaskError;

/// Largest number of threads of a call, above the number of cores of any machine that this is meant for: threads beyond that are most
/// likely a mistake, and cost memory each.
const MOST: usize = 1024;

/// Number of the process that first used the shared pool. One that is forked from it has the pool and none of its threads.
static SHARED_BY: OnceLock<u32> = OnceLock::new();

/// What a process is told that was forked from one whose threads it would wait for.
const FORKED: &str = "expected a process that was started by `spawn`, found one forked from a process that has computed before: the threads \
                      that compute are not copied by a fork (or give `threads`)";

/// A pool of so many threads; `None` for the pool that all calls share, which has one for each core. Results do not depend on the number.
///
/// # Errors
/// [`TaskError::Ask`] of a number that is not accepted; [`TaskError::Work`] if the system has no such number of threads left, and for the shared pool
/// in a process that was forked from one that has used it.
pub(crate) fn pool(threads: Option<usize>) -> Result<Option<ThreadPool>, TaskError> {
    let Some(threads) = threads else {
        return match *SHARED_BY.get_or_init(std::process::id) == std::process::id() {
            true => Ok(None),
            false => Err(TaskError::work(FORKED)),
        };
    };
    if !(1..=MOST).contains(&threads) {
        return Err(TaskError::ask("threads", format!("1 to {MOST}"), threads));
    }
    ThreadPoolBuilder::new().num_threads(threads).build().map(Some).map_err(TaskError::work)
}
