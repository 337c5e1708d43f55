//! Searches that Python takes from one generation to the next, and asks for itself.

use crate::commands::{Done, asked};
use crate::error::raised;
use crate::progress::{brief, work};
use pyo3::prelude::*;
use std::ffi::{OsStr, OsString};
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use unripple_tasks::optimise::{Ask, Crew, Missing, Stepped};
use unripple_tasks::sweep::{Piece, THREADS};
use unripple_tasks::{Progress, TaskError};

/// A search: go() computes generations that have been asked for, up to the first that has not, and its caller asks for that one. `ask` is that
/// of the task optimise, as JSON. A call that an exception ended, as Ctrl+C does, leaves nothing to go on with but the folder.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Search {
    /// Not there while a call works on it, nor once one was given up.
    stepped: Mutex<Option<Stepped>>,
}

#[pymethods]
impl Search {
    #[new]
    fn new(py: Python<'_>, ask: &str) -> PyResult<Self> {
        let stepped = brief(py, || Stepped::open(&asked::<Ask>(ask)?))?;
        Ok(Self { stepped: Mutex::new(Some(stepped)) })
    }

    /// Computes generations that have been asked for: here, or with `jobs` above 1 by so many processes of the interpreter `python`. Returns
    /// the number of the generation that has to be asked for next; None if the search is over.
    #[pyo3(signature = (jobs, python, progress=None, threads=None))]
    fn go(
        &self,
        py: Python<'_>,
        jobs: usize,
        python: OsString,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Option<usize>> {
        self.working(py, progress, threads, move |stepped, progress| {
            let command =
                |plan: &Path, place: &Path, piece: Piece| process(&python, threads, plan, place, &piece);
            let crew = Crew { jobs, command: &command };
            stepped.go((jobs > 1).then_some(&crew), progress)
        })
    }

    /// Plan, folder and shards of the sweep that the next generation is, if it has been asked for and not all is there; otherwise None.
    fn missing(&self, py: Python<'_>) -> PyResult<Option<(OsString, OsString, Vec<usize>)>> {
        let missing = self.with(py, |stepped| stepped.missing())?;
        let told = |missing: Missing| (missing.plan.into(), missing.place.into(), missing.shards);
        Ok(missing.map(told))
    }

    /// What an optimiser has to know for the next generation, as JSON, with what came of all before but the first `since`.
    fn question(&self, py: Python<'_>, since: usize) -> PyResult<String> {
        self.with(py, |stepped| stepped.question().json(since))
    }

    /// Writes the question into the folder, for whoever asks.
    fn put_question(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |stepped| stepped.question().put())
    }

    /// Ends the search: its optimiser has nothing more to ask for.
    fn over(&self, py: Python<'_>, why: String) -> PyResult<()> {
        self.with(py, |stepped| {
            stepped.over(why);
            Ok(())
        })
    }

    /// Writes the table of a search that could not go on.
    fn keep(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |stepped| stepped.keep())
    }

    /// Writes table, report and figures, and returns the report.
    #[pyo3(signature = (progress=None))]
    fn finish(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<Done> {
        self.working(py, progress, None, |stepped, progress| {
            let report = stepped.finish(progress)?;
            Done::of(&report, Some(stepped.record()))
        })
    }
}

impl Search {
    /// Does brief work on the search.
    fn with<R: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Stepped) -> Result<R, TaskError> + Send,
    ) -> PyResult<R> {
        brief(py, || {
            let mut held = self.stepped.lock().unwrap_or_else(PoisonError::into_inner);
            work(held.as_mut().ok_or_else(gone)?)
        })
    }

    /// Does long work on the search, which is lost where the work is given up.
    fn working<R: Send + 'static>(
        &self,
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
        own: impl FnOnce(&mut Stepped, &mut dyn Progress) -> Result<R, TaskError> + Send + 'static,
    ) -> PyResult<R> {
        let taken = self.stepped.lock().unwrap_or_else(PoisonError::into_inner).take();
        let mut stepped = taken.ok_or_else(|| raised(py, gone()))?;
        let (stepped, result) = work(py, progress, threads, move |progress| {
            let result = own(&mut stepped, progress);
            Ok((stepped, result))
        })?;
        *self.stepped.lock().unwrap_or_else(PoisonError::into_inner) = Some(stepped);
        result.map_err(|error| raised(py, error))
    }
}

/// What a call says that comes beside another, or after one that was given up.
fn gone() -> TaskError {
    TaskError::work(
        "expected a search that goes on, found one that another call works on, or that was given up",
    )
}

/// The command of a process that computes a piece of a sweep.
fn process(python: &OsStr, threads: Option<usize>, plan: &Path, place: &Path, piece: &Piece) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "unripple"]).args(piece.arguments(plan, place));
    if let Some(threads) = threads {
        command.env(THREADS, threads.to_string());
    }
    command
}
