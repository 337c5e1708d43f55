//! A long task that runs beside the session, and the messages on its progress to pages.

use super::quality::Quality;
use crate::notices::Notices;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use unripple::core::Cache;
use unripple_session::lock;
use unripple_tasks::{Progress, Report, TaskError, apart, calibrate, devices, doctor};

/// Number of lines that are shown, and longest length of each: as many as a panel shows.
const LINES: usize = 12;
const LONGEST: usize = 400;

/// The stage in which a task fills its library. Before it the folder may hold another task's library.
const FILLING: &str = "points";

/// Interval of the messages on progress: as fast as a bar's progress is seen.
const LOOKED: Duration = Duration::from_millis(400);

/// A task that a page has requested.
pub enum Work {
    /// The list of devices.
    Devices(devices::Ask),
    /// A check of each stage between a touch and what is felt.
    Doctor(Box<doctor::Ask>),
    /// A measurement of responses into a library.
    Calibrate(Box<calibrate::Ask>),
}

impl Work {
    fn name(&self) -> &'static str {
        match self {
            Self::Devices(_) => "devices",
            Self::Doctor(_) => "doctor",
            Self::Calibrate(_) => "calibrate",
        }
    }

    /// Path of the library that the task fills; `None` for a task without one.
    fn library(&self) -> Option<PathBuf> {
        match self {
            Self::Calibrate(ask) => Some(ask.output.clone()),
            Self::Devices(_) | Self::Doctor(_) => None,
        }
    }

    fn run(self, progress: &mut dyn Progress) -> Result<Value, TaskError> {
        match self {
            Self::Devices(ask) => apart(ask, devices::run, progress).map(told),
            Self::Doctor(ask) => apart(*ask, doctor::run, progress).map(told),
            Self::Calibrate(ask) => apart(*ask, calibrate::run, progress).map(told),
        }
    }
}

fn told(report: impl Report) -> Value {
    // A report is made of numbers and names: always JSON.
    serde_json::to_value(report).unwrap_or_default()
}

/// A task that is running.
pub struct Running {
    /// Number of the job.
    pub id: u64,
    kind: &'static str,
    command: String,
    stopped: AtomicBool,
    over: AtomicBool,
    now: Mutex<Now>,
}

/// Progress of a running task: the share that is done, and the newest lines of its output.
#[derive(Default)]
struct Now {
    share: Option<f64>,
    lines: VecDeque<String>,
    /// Whether the task has begun to fill its library.
    filling: bool,
}

/// The task's progress, as pages see it.
struct Heard(Arc<Running>);

impl Progress for Heard {
    fn stage(&mut self, what: &str) {
        let mut now = lock(&self.0.now);
        now.share = None;
        now.filling |= what == FILLING;
    }

    fn done(&mut self, share: f64) {
        lock(&self.0.now).share = Some(share);
    }

    fn tell(&mut self, line: &str) {
        self.0.say(line);
    }

    fn cache(&self) -> Option<Arc<dyn Cache>> {
        unripple_tasks::cache::disk()
    }

    fn cancelled(&self) -> bool {
        self.0.stopped.load(Ordering::Relaxed)
    }
}

impl Running {
    /// Starts a task. `id` is the job's number; `command` is the command line that does the same.
    ///
    /// # Errors
    /// Reason why the task cannot be started.
    pub fn start(id: u64, work: Work, command: String, notices: Arc<Notices>) -> Result<Arc<Self>, String> {
        let (stopped, over, now) = (AtomicBool::new(false), AtomicBool::new(false), Mutex::default());
        let running = Arc::new(Self { id, kind: work.name(), command, stopped, over, now });
        let mut quality = work.library().map(Quality::of);
        let own = running.clone();
        let watch = move || {
            let (done, result) = channel();
            let mut heard = Heard(own.clone());
            std::thread::scope(|scope| {
                scope.spawn(move || {
                    // Whoever listens waits until this comes.
                    let _ = done.send(work.run(&mut heard));
                });
                own.accompany(&result, &notices, quality.as_mut());
            });
        };
        std::thread::Builder::new().name("job".into()).spawn(watch).map_err(|error| error.to_string())?;
        Ok(running)
    }

    /// Sends pages the task's progress until it ends, and then its result.
    fn accompany(
        &self,
        result: &Receiver<Result<Value, TaskError>>,
        notices: &Notices,
        mut quality: Option<&mut Quality>,
    ) {
        let ended = loop {
            self.tell(notices, "running", Value::Null, quality.as_deref_mut());
            match result.recv_timeout(LOOKED) {
                Err(RecvTimeoutError::Timeout) => {}
                ended => break ended,
            }
        };
        let (state, found) = match ended {
            Ok(Ok(found)) => ("done", found),
            Ok(Err(TaskError::Cancelled)) => ("stopped", Value::Null),
            Ok(Err(error)) => {
                self.say(&format!("error: {error}"));
                ("failed", Value::Null)
            }
            // It panicked, and said so.
            Err(_) => ("failed", Value::Null),
        };
        self.over.store(true, Ordering::Relaxed);
        self.tell(notices, state, found, quality);
    }

    /// Cancels the task, which then ends by itself.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the task has ended.
    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::Relaxed)
    }

    fn say(&self, line: &str) {
        let mut now = lock(&self.now);
        if now.lines.len() == LINES {
            now.lines.pop_front();
        }
        now.lines.push_back(line.chars().take(LONGEST).collect());
    }

    fn tell(&self, notices: &Notices, state: &str, result: Value, quality: Option<&mut Quality>) {
        let filling = lock(&self.now).filling;
        let (share, quality) = quality.filter(|_| filling).map_or((None, Value::Null), Quality::look);
        let now = lock(&self.now);
        let message = json!({
            "is": "job",
            "id": self.id,
            "kind": self.kind,
            "command": self.command,
            "state": state,
            "progress": share.or(now.share),
            "lines": &now.lines,
            "result": result,
            "quality": quality,
        });
        notices.tell(&format!("job {}", self.kind), &message);
    }
}
