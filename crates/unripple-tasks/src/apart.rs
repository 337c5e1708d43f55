//! Runs a task on its own thread, so that a cancelled call returns at once, even while the task is in work that cannot be interrupted.

use crate::{Progress, TaskError};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Interval at which the caller checks for a cancellation: a tenth of the 0.2 s after which people take a program for stuck.
const LOOK: Duration = Duration::from_millis(20);

/// How many tasks that were given up still run: the next begins when none does, since each holds its memory and cores until its longest
/// call is over.
static GIVEN_UP: (Mutex<usize>, Condvar) = (Mutex::new(0), Condvar::new());

/// What a task on its own thread says.
enum Said<R> {
    Stage(String),
    Done(f64),
    Tell(String),
    Over(Result<R, TaskError>),
}

/// What the thread and its caller share.
#[derive(Default)]
struct Shared {
    cancelled: AtomicBool,
    /// Whether the task has begun to put its results in place: then a cancellation waits for its result. Locked meanwhile.
    placed: Mutex<bool>,
}

/// The caller's progress, as the thread sees it.
struct Relay<R> {
    to: Sender<Said<R>>,
    shared: Arc<Shared>,
}

impl<R> Progress for Relay<R> {
    // A caller that has gone gets no report, which is no fault of the task.
    fn stage(&mut self, what: &str) {
        let _ = self.to.send(Said::Stage(what.into()));
    }

    fn done(&mut self, share: f64) {
        let _ = self.to.send(Said::Done(share));
    }

    fn tell(&mut self, line: &str) {
        let _ = self.to.send(Said::Tell(line.into()));
    }

    fn cancelled(&self) -> bool {
        self.shared.cancelled.load(Ordering::Relaxed)
    }

    fn place(&mut self, put: &mut dyn FnMut() -> Result<(), TaskError>) -> Result<(), TaskError> {
        let mut placed = self.shared.placed.lock().unwrap_or_else(PoisonError::into_inner);
        if self.cancelled() {
            return Err(TaskError::Cancelled);
        }
        *placed = true;
        put()
    }
}

/// Runs a task on its own thread and returns its result, or [`TaskError::Cancelled`] within 0.2 s after `progress` reports a cancellation.
/// If the task has begun to put its results in place by then, its own result is awaited and returned. A cancelled task ends in the
/// background when it next checks its progress; the next call waits until then.
///
/// ```
/// use unripple_tasks::{Report, Silent, apart, design};
///
/// let report = apart(design::Ask::default(), design::run, &mut Silent)?;
/// assert!(report.text().contains("contrast"));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// Those of the task; [`TaskError::Cancelled`]; [`TaskError::Work`] if the task panicked or no thread can be had.
pub fn apart<A, R>(
    ask: A,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
    progress: &mut dyn Progress,
) -> Result<R, TaskError>
where
    A: Send + 'static,
    R: Send + 'static,
{
    wait_for_the_last(progress)?;
    let (to, from) = channel();
    let shared = Arc::new(Shared::default());
    let mut relay = Relay { to, shared: shared.clone() };
    let work = move || {
        let over = run(&ask, &mut relay);
        // Whoever cancelled it is not informed of how it ended.
        let _ = relay.to.send(Said::Over(over));
    };
    let thread = std::thread::Builder::new().name("task".into()).spawn(work).map_err(TaskError::work)?;
    match follow(&from, &shared, progress) {
        Some(result) => result,
        None => {
            give_up(thread);
            Err(TaskError::Cancelled)
        }
    }
}

/// Passes on what the task says until it is over; nothing if it is to be given up.
fn follow<R>(
    from: &Receiver<Said<R>>,
    shared: &Shared,
    progress: &mut dyn Progress,
) -> Option<Result<R, TaskError>> {
    loop {
        match from.recv_timeout(LOOK) {
            Ok(Said::Stage(what)) => progress.stage(&what),
            Ok(Said::Done(share)) => progress.done(share),
            Ok(Said::Tell(line)) => progress.tell(&line),
            Ok(Said::Over(result)) => return Some(result),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Some(Err(TaskError::Work(
                    "the task ended in a panic, which is an error in the program".into(),
                )));
            }
        }
        if progress.cancelled() {
            let placed = shared.placed.lock().unwrap_or_else(PoisonError::into_inner);
            shared.cancelled.store(true, Ordering::Relaxed);
            if !*placed {
                return None;
            }
        }
    }
}

/// Waits in the background for a task that nobody wants.
fn give_up(thread: std::thread::JoinHandle<()>) {
    count(|running| running + 1);
    let wait = move || {
        // A panic of what nobody waits for has said so already.
        let _ = thread.join();
        count(|running| running - 1);
    };
    if std::thread::Builder::new().name("given up".into()).spawn(wait).is_err() {
        count(|running| running - 1);
    }
}

fn count(change: impl Fn(usize) -> usize) {
    let mut running = GIVEN_UP.0.lock().unwrap_or_else(PoisonError::into_inner);
    *running = change(*running);
    drop(running);
    GIVEN_UP.1.notify_all();
}

/// Waits until the task that was given up last is over, or this one is cancelled too.
fn wait_for_the_last(progress: &dyn Progress) -> Result<(), TaskError> {
    let mut running = GIVEN_UP.0.lock().unwrap_or_else(PoisonError::into_inner);
    while *running > 0 {
        crate::go_on(progress)?;
        let woken = GIVEN_UP.1.wait_timeout(running, LOOK);
        running = woken.unwrap_or_else(PoisonError::into_inner).0;
    }
    Ok(())
}
