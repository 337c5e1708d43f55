//! Processes that compute a sweep together, each its own shards.

use super::Piece;
use crate::{Progress, TaskError, go_on};
use std::env;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::{available_parallelism, sleep};
use std::time::{Duration, Instant};

/// How often it is looked whether a process has ended: a fraction of the time that the shortest shards take.
const LOOK: Duration = Duration::from_millis(10);

/// How often the shards that are done are counted.
const COUNT: Duration = Duration::from_millis(500);

/// Time that a process has to end by itself once its standard input has ended, in looks; then it is killed.
const PATIENCE: usize = 200;

/// Time in which a signal that was sent to a whole group of processes ends this one too, in looks: half a second.
const GRACE: usize = 50;

/// Signals by which somebody wants a process to end: hang-up, interrupt and termination.
const WISHES: [i32; 3] = [1, 2, 15];

/// The variable that says on how many threads a process computes.
pub const THREADS: &str = "RAYON_NUM_THREADS";

/// How a sweep starts processes.
pub struct Workers<'w> {
    /// Number of processes at a time, at least 1.
    pub jobs: usize,
    /// The command of a process that calls [`compute`](super::compute) with the piece that it is given, and ends when its standard input does,
    /// so that it does not outlive whoever started it. It ends with status 0, or with 1 or 2 after an error of its own.
    pub command: &'w dyn Fn(Piece) -> Command,
}

/// Processes that are ended when this is dropped.
struct Group(Vec<Child>);

impl Drop for Group {
    fn drop(&mut self) {
        self.0.iter_mut().for_each(|child| drop(child.stdin.take()));
        for child in &mut self.0 {
            let ended = |child: &mut Child| matches!(child.try_wait(), Ok(Some(_)));
            let in_time = (0..PATIENCE).any(|_| {
                ended(child) || {
                    sleep(LOOK);
                    false
                }
            });
            if !in_time {
                // One that has ended meanwhile cannot be killed.
                let _ = child.kill().and_then(|()| child.wait());
            }
        }
    }
}

impl Workers<'_> {
    /// Runs a process for each piece until all have ended, and calls `count` now and then; returns how each died, if it did. A process
    /// that somebody wanted to end has died as any other, unless this one is to end as well.
    ///
    /// # Errors
    /// Those of `count`; [`TaskError::Cancelled`]; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
    pub(super) fn wait(
        &self,
        pieces: &[Piece],
        progress: &mut dyn Progress,
        count: &mut dyn FnMut(&mut dyn Progress) -> Result<(), TaskError>,
    ) -> Result<Vec<Option<String>>, TaskError> {
        let mut group = Group(Vec::new());
        for piece in pieces {
            group.0.push(self.start(piece.clone(), pieces.len())?);
        }
        let mut counted = Instant::now();
        let mut statuses: Vec<Option<ExitStatus>> = vec![None; pieces.len()];
        loop {
            for (child, status) in
                group.0.iter_mut().zip(&mut statuses).filter(|(_, status)| status.is_none())
            {
                *status = child.try_wait().map_err(TaskError::work)?;
                if status.and_then(signal).is_some_and(|signal| WISHES.contains(&signal)) {
                    (0..GRACE).try_for_each(|_| {
                        sleep(LOOK);
                        go_on(progress)
                    })?;
                }
            }
            if statuses.iter().all(Option::is_some) {
                return statuses.into_iter().flatten().map(death).collect();
            }
            go_on(progress)?;
            if counted.elapsed() >= COUNT {
                count(progress)?;
                counted = Instant::now();
            }
            sleep(LOOK);
        }
    }

    /// Starts the process of a piece, one of so many, which share the processors.
    fn start(&self, piece: Piece, processes: usize) -> Result<Child, TaskError> {
        let mut command = (self.command)(piece);
        let is_told = command.get_envs().any(|(name, _)| name == THREADS);
        if !is_told && env::var_os(THREADS).is_none() {
            let threads = available_parallelism().map_or(1, usize::from).div_ceil(processes);
            command.env(THREADS, threads.to_string());
        }
        command.stdin(Stdio::piped()).stdout(Stdio::null());
        let shown = command.get_program().to_string_lossy().into_owned();
        command.spawn().map_err(|error| TaskError::Work(format!("cannot start {shown}: {error}")))
    }
}

/// How a process died; `None` if it did its work.
///
/// # Errors
/// [`TaskError::Work`] if it ended with an error of its own.
fn death(status: ExitStatus) -> Result<Option<String>, TaskError> {
    match (status.code(), signal(status)) {
        (Some(0), _) => Ok(None),
        (Some(code @ (1 | 2)), _) => {
            Err(TaskError::Work(format!("a process of the sweep ended with exit status {code}; it said why")))
        }
        // As a system does that ends programs before memory runs out.
        (_, Some(signal)) if WISHES.contains(&signal) => {
            Ok(Some(format!("signal {signal}, by which somebody wants a program to end")))
        }
        (_, Some(6)) => Ok(Some("signal 6, with which a program ends that runs out of memory".into())),
        (_, Some(9)) => {
            Ok(Some("signal 9, with which the system ends a program that takes too much memory".into()))
        }
        (_, Some(signal)) => Ok(Some(format!("signal {signal}"))),
        (code, None) => Ok(Some(format!("exit status {}", code.unwrap_or_default()))),
    }
}

/// The signal that ended a process, if one did.
#[cfg(unix)]
fn signal(status: ExitStatus) -> Option<i32> {
    std::os::unix::process::ExitStatusExt::signal(&status)
}

/// The signal that ended a process: other systems have none.
#[cfg(not(unix))]
fn signal(_status: ExitStatus) -> Option<i32> {
    None
}
