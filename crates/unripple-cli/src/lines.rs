//! Progress of tasks as lines on standard error.

use std::io::{IsTerminal, stderr};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Amount of progress output while a task runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Talk {
    /// Only warnings are printed.
    Quiet,
    /// A bar on a terminal; elsewhere lines on stages that take long.
    #[default]
    Usual,
    /// Each stage is printed as a line, with the time since the beginning.
    Verbose,
}

/// Set once for the whole program, since progress is reported from everywhere.
static TALK: OnceLock<Talk> = OnceLock::new();

/// Sets the amount of progress output; to be called once, before any task runs.
pub fn settle(talk: Talk) {
    // It is called once.
    let _ = TALK.set(talk);
}

/// Amount of progress output that was set.
pub fn talk() -> Talk {
    TALK.get().copied().unwrap_or_default()
}

/// Time after which a task's stages are told where there is no terminal: shorter ones are over before they are read.
const LONG: Duration = Duration::from_secs(2);

/// Time between lines that tell how much of a stage is done. A log of an hour has some hundred of them.
const BETWEEN: Duration = Duration::from_secs(20);

/// What is told as lines.
#[derive(Debug)]
pub struct Lines {
    began: Instant,
    told: Instant,
    stage: String,
    /// Whether stages are told from the beginning, with their times.
    all: bool,
}

impl Lines {
    /// Lines where they are wanted: without a terminal, or where everything is to be told.
    pub fn wanted() -> Option<Self> {
        let all = talk() == Talk::Verbose;
        let wanted = all || talk() == Talk::Usual && !stderr().is_terminal();
        let now = Instant::now();
        wanted.then(|| Self { began: now, told: now, stage: String::new(), all })
    }

    /// A stage begins.
    pub fn stage(&mut self, what: &str) {
        what.clone_into(&mut self.stage);
        self.told = Instant::now();
        if self.all {
            eprintln!("{:8.1} s  {what}", self.began.elapsed().as_secs_f64());
        } else if self.began.elapsed() >= LONG {
            eprintln!("{what} …");
        }
    }

    /// A share of the stage is done, from 0 to 1.
    pub fn done(&mut self, share: f64) {
        if self.told.elapsed() >= BETWEEN {
            self.told = Instant::now();
            eprintln!("{}: {:.0} %", self.stage, 100.0 * share);
        }
    }
}
