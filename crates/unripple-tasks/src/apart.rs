//! Runs a task on its own thread, so that a cancelled call returns at once, even while the task is in work that cannot be interrupted.

use crate::progress::part_of;
use crate::{Progress, TaskError, machine};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, LazyLock, Mutex, PoisonError};
use std::time::Duration;
use unripple::core::threads::{self, Started};
use unripple::core::{Cached, Observed, Observer};

/// Interval at which the caller checks for a cancellation: a tenth of the 0.2 s after which people take a program for stuck.
const LOOK: Duration = Duration::from_millis(20);

/// The lane of [`apart`]: a task begins when no cancelled one still runs, since each holds its memory and
/// cores until its longest uninterruptible call is over.
static TASKS: LazyLock<Lane> = LazyLock::new(|| Lane::new(0));

/// Runs tasks, each on its own thread; where there are no threads, in place, so that none is cancelled. A cancelled task runs on until it next checks for a cancellation; a
/// new task begins as soon as no more than `beside` cancelled ones still run.
#[derive(Clone, Debug)]
pub struct Lane {
    /// Number of cancelled tasks that still run.
    given_up: Arc<(Mutex<usize>, Condvar)>,
    beside: usize,
}

/// Message from a task on its own thread to its caller.
enum Said<R> {
    Stage(String),
    /// A part of the stage.
    Part(String),
    Done(f64),
    Ended,
    Tell(String),
    Over(Result<R, TaskError>),
}

/// State that the thread of a task and its caller share.
#[derive(Default)]
struct Shared {
    cancelled: AtomicBool,
    /// Whether the task has begun to put its results in place: then a cancellation waits for its result. Locked meanwhile.
    placed: Mutex<bool>,
}

/// Progress in the thread of a task, which forwards everything to the caller.
struct Relay<R> {
    to: Sender<Said<R>>,
    shared: Arc<Shared>,
}

/// Observer that forwards the progress of long computations to the caller.
struct Parts<R>(Sender<Said<R>>);

impl<R: Send> Observer for Parts<R> {
    // As of the task itself.
    fn part(&self, what: &str) {
        let _ = self.0.send(Said::Part(what.into()));
    }

    fn done(&self, share: f64) {
        let _ = self.0.send(Said::Done(share));
    }
}

impl<R: Send + 'static> Progress for Relay<R> {
    // A caller that has gone gets no report, which is no fault of the task.
    fn stage(&mut self, what: &str) {
        let _ = self.to.send(Said::Stage(what.into()));
    }

    fn done(&mut self, share: f64) {
        let _ = self.to.send(Said::Done(share));
    }

    fn over(&mut self) {
        let _ = self.to.send(Said::Ended);
    }

    fn tell(&mut self, line: &str) {
        let _ = self.to.send(Said::Tell(line.into()));
    }

    fn observer(&self) -> Option<Arc<dyn Observer>> {
        Some(Arc::new(Parts(self.to.clone())))
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

impl Lane {
    /// A lane in which a new task begins only while at most `beside` cancelled tasks still run.
    pub fn new(beside: usize) -> Self {
        Self { given_up: Arc::default(), beside }
    }

    /// Runs `work` on its own thread and returns its result, or [`TaskError::Cancelled`] within 0.2 s after `progress` reports a
    /// cancellation. If the work has begun to put its results in place by then, its own result is awaited and returned. The work may take
    /// its progress to another thread.
    ///
    /// ```
    /// use unripple_tasks::{Lane, Silent};
    ///
    /// assert_eq!(Lane::new(1).run(|_| Ok(2 + 2), &mut Silent)?, 4);
    /// # Ok::<(), unripple_tasks::TaskError>(())
    /// ```
    ///
    /// # Errors
    /// Those of the work; [`TaskError::Cancelled`]; [`TaskError::Work`] if the work panicked or no thread can be had.
    pub fn run<R: Send + 'static>(
        &self,
        work: impl FnOnce(&mut (dyn Progress + Send)) -> Result<R, TaskError> + Send + 'static,
        progress: &mut dyn Progress,
    ) -> Result<R, TaskError> {
        self.wait(progress)?;
        let (to, from) = channel();
        let shared = Arc::new(Shared::default());
        let mut relay = Relay { to, shared: shared.clone() };
        let (cached, memory) = (Cached::by(progress.cache()), machine::memory());
        let work = move || {
            let observed = Observed::by(relay.observer());
            let over = memory.during(|| observed.during(|| cached.during(|| work(&mut relay))));
            // Whoever cancelled it is not informed of how it ended.
            let _ = relay.to.send(Said::Over(over));
        };
        let thread = threads::start("task", work).map_err(TaskError::work)?;
        match follow(&from, &shared, progress) {
            Some(result) => result,
            None => {
                self.give_up(thread);
                Err(TaskError::Cancelled)
            }
        }
    }

    /// Waits in the background until a cancelled task has ended.
    fn give_up(&self, thread: Started) {
        self.count(|running| running + 1);
        let lane = self.clone();
        let wait = move || {
            // A panic of what nobody waits for has said so already.
            let _ = thread.join();
            lane.count(|running| running - 1);
        };
        if threads::start("given up", wait).is_err() {
            self.count(|running| running - 1);
        }
    }

    /// Waits at most `at_most` (a duration, in s) until no cancelled task still runs, and returns whether
    /// none does. Call it before the process ends, so that no task is cut off while it writes or removes
    /// files.
    ///
    /// ```
    /// use std::time::Duration;
    /// use unripple_tasks::Lane;
    ///
    /// assert!(Lane::new(0).quiet(Duration::ZERO));
    /// ```
    pub fn quiet(&self, at_most: Duration) -> bool {
        let running = self.given_up.0.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.given_up.1.wait_timeout_while(running, at_most, |running| *running > 0);
        *waited.unwrap_or_else(PoisonError::into_inner).0 == 0
    }

    fn count(&self, change: impl Fn(usize) -> usize) {
        let mut running = self.given_up.0.lock().unwrap_or_else(PoisonError::into_inner);
        *running = change(*running);
        drop(running);
        self.given_up.1.notify_all();
    }

    /// Waits until few enough cancelled tasks still run, or until this task is cancelled too.
    fn wait(&self, progress: &dyn Progress) -> Result<(), TaskError> {
        let mut running = self.given_up.0.lock().unwrap_or_else(PoisonError::into_inner);
        while *running > self.beside {
            crate::go_on(progress)?;
            let woken = self.given_up.1.wait_timeout(running, LOOK);
            running = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
        Ok(())
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
    TASKS.run(move |progress| run(&ask, progress), progress)
}

/// Forwards the messages of the task to `progress` until the task is over, and returns its result; `None`
/// if the task is cancelled.
fn follow<R>(
    from: &Receiver<Said<R>>,
    shared: &Shared,
    progress: &mut dyn Progress,
) -> Option<Result<R, TaskError>> {
    let mut stage = String::new();
    loop {
        match threads::receive(from, LOOK) {
            Ok(Said::Stage(what)) => {
                progress.stage(&what);
                stage = what;
            }
            Ok(Said::Part(what)) => match progress.observer() {
                Some(observer) => observer.part(&what),
                None => progress.stage(&part_of(&stage, &what)),
            },
            Ok(Said::Done(share)) => progress.done(share),
            Ok(Said::Ended) => progress.over(),
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
