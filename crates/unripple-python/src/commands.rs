//! The tasks by name, the command line, and what the program brings: built-in surfaces, effects, its version.

use crate::error::raised;
use crate::progress::{brief, work, work_to_its_end};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use serde_json::Value;
use std::ffi::OsString;
use std::sync::{Arc, OnceLock};
use unripple_store::{BUILTINS, builtin_effects};
use unripple_tasks::record::Request;
use unripple_tasks::{Progress, Record, Report, TaskError, play, rerun};

/// What a task has done: its report, as JSON and as text.
#[pyclass(frozen, module = "unripple._unripple")]
#[derive(Clone)]
pub struct Done {
    /// The report. Its JSON is without the record where that is `late`.
    done: unripple_tasks::commands::Done,
    late: Option<Arc<Late>>,
}

/// The JSON of a report with a record that takes long to write, such as one that holds a drive: written when it is first asked for.
struct Late {
    write: Box<dyn Fn() -> Result<String, TaskError> + Send + Sync>,
    json: OnceLock<String>,
}

impl Late {
    fn json(&self) -> Result<&str, TaskError> {
        if let Some(json) = self.json.get() {
            return Ok(json);
        }
        // Two threads that ask at once write the same.
        let json = (self.write)()?;
        Ok(self.json.get_or_init(|| json))
    }
}

impl Done {
    /// A report, with the record of how it was made; without one, the JSON has no key "run".
    pub(crate) fn of(report: &impl Report, record: Option<&Record>) -> Result<Self, TaskError> {
        unripple_tasks::commands::Done::of(report, record).map(Self::from)
    }

    /// A report whose JSON with its record is written when it is first asked for.
    pub(crate) fn late(
        report: &impl Report,
        write: impl Fn() -> Result<String, TaskError> + Send + Sync + 'static,
    ) -> Result<Self, TaskError> {
        let late = Late { write: Box::new(write), json: OnceLock::new() };
        Ok(Self { late: Some(Arc::new(late)), ..Self::of(report, None)? })
    }
}

impl From<unripple_tasks::commands::Done> for Done {
    fn from(done: unripple_tasks::commands::Done) -> Self {
        Self { done, late: None }
    }
}

#[pymethods]
impl Done {
    /// The report with its record, as the JSON text that `--json` prints. Quantities are in SI units.
    #[getter]
    fn json(&self, py: Python<'_>) -> PyResult<&str> {
        match &self.late {
            Some(late) => brief(py, || late.json()),
            None => Ok(&self.done.json),
        }
    }

    /// The report's JSON without its record, where that is written when `json` is first asked for; None where it is there already.
    #[getter]
    fn unrecorded(&self) -> Option<&str> {
        self.late.as_ref().map(|_| self.done.json.as_str())
    }

    /// The report for people, as lines of text.
    #[getter]
    fn text(&self) -> &str {
        &self.done.text
    }

    /// Reason for which the task counts as failed although it has a report; None if it succeeded.
    #[getter]
    fn failure(&self) -> Option<&str> {
        self.done.failure.as_deref()
    }
}

/// The ask that a JSON text says. Absent fields have their defaults.
///
/// # Errors
/// [`TaskError::Input`] of text that is no JSON, of a field that there is not, and of a value of the wrong type.
pub(crate) fn asked<A: Request>(ask: &str) -> Result<A, TaskError> {
    unripple_tasks::commands::asked(json(ask)?)
}

/// The value that a JSON text of a request says.
fn json(ask: &str) -> Result<Value, TaskError> {
    serde_json::from_str(ask).map_err(|error| TaskError::Input(format!("ask: expected JSON, found {error}")))
}

/// The names of all tasks.
#[pyfunction]
#[pyo3(name = "commands")]
pub(crate) fn names() -> Vec<&'static str> {
    unripple_paper::commands::COMMANDS.to_vec()
}

/// The default ask of a task, as a JSON object that has every field of it, in SI units.
///
/// Raises AskError for a name that no task has.
#[pyfunction]
pub(crate) fn default_ask(py: Python<'_>, command: &str) -> PyResult<String> {
    let ask = unripple_paper::commands::default_ask(command).map_err(|error| raised(py, error))?;
    Ok(ask.to_string())
}

/// Does a task by its name. `ask` is JSON, in SI units; fields that it leaves out have their defaults.
///
/// `progress` has the methods stage(what), done(share) and tell(line), or is None. `threads` is the number of threads that the task computes
/// on; None: one for each core. The task `play`, also where `rerun` does it again, chooses its threads itself, and ends at a signal with all
/// its files written: the KeyboardInterrupt that is raised then has what was played as its attribute `done`.
#[pyfunction]
#[pyo3(signature = (command, ask, progress=None, threads=None))]
pub(crate) fn run(
    py: Python<'_>,
    command: String,
    ask: &str,
    progress: Option<Py<PyAny>>,
    threads: Option<usize>,
) -> PyResult<Done> {
    let ask = json(ask).map_err(|error| raised(py, error))?;
    if !plays(&command, &ask) {
        return work(py, progress, threads, named(command, ask)).map(Done::from);
    }
    let (played, exception) = work_to_its_end(py, progress, named(command, ask))?;
    let Some(exception) = exception else { return Ok(Done::from(played)) };
    // Other exceptions are somebody's own, to whose attributes nothing is added.
    if exception.is_instance_of::<PyKeyboardInterrupt>(py) {
        exception.value(py).setattr("done", Done::from(played))?;
    }
    Err(exception)
}

/// Whether a task plays, and so ends at a signal with a report.
fn plays(command: &str, ask: &Value) -> bool {
    // What cannot be read is refused by the task itself.
    let again =
        || unripple_tasks::commands::asked::<rerun::Ask>(ask.clone()).and_then(|ask| rerun::record(&ask));
    command == play::Ask::COMMAND
        || command == rerun::Ask::COMMAND && again().is_ok_and(|record| record.command == play::Ask::COMMAND)
}

/// The task of that name with a request, as work to do.
fn named(
    command: String,
    ask: Value,
) -> impl FnOnce(&mut dyn Progress) -> Result<unripple_tasks::commands::Done, TaskError> + Send + 'static {
    move |progress| unripple_paper::commands::run(&command, ask, progress)
}

/// Runs the command line with the arguments that follow the program's name, prints what it prints, and returns its exit code, 0 to 2.
///
/// Once in a process: it handles SIGINT, SIGTERM and SIGHUP from then on.
#[pyfunction]
pub(crate) fn command_line(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    let typed = std::iter::once(OsString::from("unripple")).chain(arguments);
    brief(py, move || Ok(unripple_cli::command_line(typed)))
}

/// The version of the program.
#[pyfunction]
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// The names of the built-in surfaces.
#[pyfunction]
pub(crate) fn builtin() -> Vec<&'static str> {
    BUILTINS.iter().map(|builtin| builtin.name).collect()
}

/// The names of the built-in effects.
#[pyfunction]
pub(crate) fn effects() -> Vec<&'static str> {
    builtin_effects().iter().map(|builtin| builtin.name).collect()
}
