//! Work with the GIL released: its progress, told to an object of Python, and how signals and exceptions cancel it.

use crate::error::{caught, raised};
use crate::threads;
use pyo3::prelude::*;
use std::cell::{Cell, RefCell};
use std::sync::LazyLock;
use std::time::{Duration, Instant};
use unripple_tasks::{Lane, Progress, TaskError, observed};

/// How often the interpreter is asked for signals: far within the 0.2 s in which a call is to end, and rarely enough that other threads of
/// Python do not notice.
const LOOK: Duration = Duration::from_millis(50);

/// The lane of all calls: work begins when none that was given up still runs, since each holds its memory and cores until its longest call
/// is over.
static WORK: LazyLock<Lane> = LazyLock::new(|| Lane::new(0));

/// Waits, `at_most` so long, until no work that was given up still runs.
pub(crate) fn settled(at_most: Duration) {
    WORK.quiet(at_most);
}

/// Does long work on a thread of its own, with the GIL released, on so many threads of rayon (`None`: one for each core, shared by all
/// calls). What it tells is passed to `progress`, which has the methods `stage(what)`, `done(share)` and `tell(line)`. A signal whose handler
/// raises, and an exception of these methods, end the call within 0.2 s: the work is given up, and the exception is raised.
///
/// # Errors
/// The exception that cancelled it; otherwise the work's error, as [`raised`] makes it; `WorkError` for a panic.
pub(crate) fn work<R: Send + 'static>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    threads: Option<usize>,
    work: impl FnOnce(&mut dyn Progress) -> Result<R, TaskError> + Send + 'static,
) -> PyResult<R> {
    let pool = threads::pool(threads).map_err(|error| raised(py, error))?;
    let (result, exception) = followed(py, progress, move |reported| {
        WORK.run(
            move |progress| match pool {
                // What is computed on a thread of the pool is observed from there.
                Some(pool) => pool.install(|| observed(progress, |progress| work(progress))),
                None => work(progress),
            },
            reported,
        )
    });
    match exception {
        Some(exception) => Err(exception),
        None => result.map_err(|error| raised(py, error)),
    }
}

/// Does work that ends by itself within 0.2 s after a cancellation, and still has a result then, such as playing: as [`work`], but on this
/// thread, and the result is awaited. It comes with the exception that cancelled the work, if one did.
///
/// # Errors
/// As those of [`work`], where there is no result.
pub(crate) fn work_to_its_end<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&mut dyn Progress) -> Result<R, TaskError> + Send,
) -> PyResult<(R, Option<PyErr>)> {
    match followed(py, progress, move |reported| caught(|| work(reported))) {
        (Ok(result), exception) => Ok((result, exception)),
        (Err(_), Some(exception)) => Err(exception),
        (Err(error), None) => Err(raised(py, error)),
    }
}

/// Does work on this thread with the GIL released, without progress and cancellation.
///
/// # Errors
/// The work's error, as [`raised`] makes it; `WorkError` for a panic.
pub(crate) fn brief<R: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<R, TaskError> + Send,
) -> PyResult<R> {
    py.detach(|| caught(work)).map_err(|error| raised(py, error))
}

/// Does `work` with the GIL released and a progress that reports to an object of Python. Gives what came of it, and what that object or the
/// handler of a signal raised.
fn followed<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&mut Reported<'_>) -> Result<R, TaskError> + Send,
) -> (Result<R, TaskError>, Option<PyErr>) {
    let to = progress.as_ref();
    py.detach(move || {
        let mut reported = Reported { to, exception: RefCell::new(None), looked: Cell::new(Instant::now()) };
        let result = work(&mut reported);
        (result, reported.exception.into_inner())
    })
}

/// Progress that is told to an object of Python, on the thread that called.
struct Reported<'p> {
    to: Option<&'p Py<PyAny>>,
    /// The first exception of a method or of a signal's handler, which cancels the work.
    exception: RefCell<Option<PyErr>>,
    /// When the interpreter was last asked for signals.
    looked: Cell<Instant>,
}

impl Reported<'_> {
    /// Attaches to the interpreter and calls it, unless it has already raised an exception, and keeps the exception that it raises.
    fn attached(&self, call: impl FnOnce(Python<'_>) -> PyResult<()>) {
        if self.exception.borrow().is_some() {
            return;
        }
        // An interpreter that is shutting down hears of nothing more.
        if let Some(Err(exception)) = Python::try_attach(call) {
            *self.exception.borrow_mut() = Some(exception);
        }
    }
}

impl Progress for Reported<'_> {
    fn stage(&mut self, what: &str) {
        if let Some(to) = self.to {
            self.attached(|py| to.call_method1(py, "stage", (what,)).map(drop));
        }
    }

    fn done(&mut self, share: f64) {
        if let Some(to) = self.to {
            self.attached(|py| to.call_method1(py, "done", (share,)).map(drop));
        }
    }

    fn tell(&mut self, line: &str) {
        if let Some(to) = self.to {
            self.attached(|py| to.call_method1(py, "tell", (line,)).map(drop));
        }
    }

    fn cancelled(&self) -> bool {
        if self.looked.get().elapsed() >= LOOK {
            self.looked.set(Instant::now());
            self.attached(|py| py.check_signals());
        }
        self.exception.borrow().is_some()
    }
}
