//! What tasks cost: time and memory, estimated before anything is meshed or solved.

use crate::{Progress, TaskError, machine};
use serde::Serialize;
use unripple::act::{judging_cost, model_cost, window_cost};
use unripple::core::{Contact, Cost, Surface};

/// Time by the clock above which a task says what it will take, in s: people wait for less without asking.
const LONG: f64 = 10.0;

/// The estimated cost of a task on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Time by the clock, in s.
    pub seconds: f64,
    /// Processor time, in s.
    pub processor_s: f64,
    /// Largest amount of memory in use at a time, in bytes.
    pub bytes: f64,
}

impl Estimate {
    /// An estimate for this machine.
    pub fn of(cost: Cost) -> Self {
        let bytes = PROGRAM + cost.bytes;
        Self { seconds: machine::clock(cost), processor_s: machine::processor(cost), bytes }
    }

    /// The estimate in words, such as "about 50 s and 0.9 GB of memory".
    pub fn text(&self) -> String {
        let time = match self.seconds {
            seconds if seconds < 1.0 => "less than a second".to_owned(),
            seconds if seconds < 100.0 => format!("about {seconds:.0} s"),
            seconds if seconds < 6000.0 => format!("about {:.0} minutes", seconds / 60.0),
            seconds => format!("about {:.1} hours", seconds / 3600.0),
        };
        format!("{time} and {:.1} GB of memory", self.bytes * 1e-9)
    }
}

/// Memory of the program itself, in bytes.
const PROGRAM: f64 = 2e7;

/// The cost of computing a drive on a surface, and of evaluating it on the surface `judged`, the same or another: of `drives` drives on the same
/// responses. A window in s where one was asked for.
///
/// # Errors
/// Those of the model that are known before solving, such as one that does not fit in memory.
pub fn of_drives(
    surface: &Surface,
    judged: &Surface,
    window: Option<f64>,
    judge_hz: Option<f64>,
    contacts: &[Contact],
    drives: usize,
) -> Result<Cost, TaskError> {
    let chosen = if window.is_none() { window_cost(surface) } else { Cost::default() };
    Ok(model_cost(surface, None, &[])? + chosen + judging_cost(judged, judge_hz, contacts, window, drives)?)
}

/// Tells of the cost of a task if it takes longer than people wait without asking; `less` says what would take less.
pub(crate) fn announce(cost: Cost, less: &str, progress: &mut dyn Progress) {
    // The speed of the machine is asked for only where it matters.
    if cost.seconds < machine::SLOWEST * LONG {
        return;
    }
    let estimate = Estimate::of(cost);
    if estimate.seconds > LONG {
        progress.tell(&format!("this takes {}; {less} would take less", estimate.text()));
    }
}
