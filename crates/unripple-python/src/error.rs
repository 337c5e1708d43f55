//! Errors as Python raises them: the classes of `unripple._errors`.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};
use unripple_store::{Fault, FileFaults};
use unripple_tasks::TaskError;

/// The module that defines the classes, in Python.
const CLASSES: &str = "unripple._errors";

/// The exception that a task's error is raised as.
pub(crate) fn raised(py: Python<'_>, error: TaskError) -> PyErr {
    let made = match error {
        TaskError::Ask { field, expected, found } => of_ask(py, field, &expected, &found),
        TaskError::Faults(faults) => of_faults(py, &faults),
        TaskError::Input(message) | TaskError::Memory(message) => of_message(py, "InputError", &message),
        TaskError::Work(message) => of_message(py, "WorkError", &message),
        TaskError::Cancelled => of_message(py, "Cancelled", &TaskError::Cancelled.to_string()),
    };
    // What keeps it from being made, such as a package that was only half installed, is raised instead.
    made.map_or_else(|failed| failed, PyErr::from_value)
}

/// `InputError` with the message of any error: of a file or an argument that cannot be used.
pub(crate) fn input(py: Python<'_>, error: impl Display) -> PyErr {
    raised(py, TaskError::input(error))
}

/// `AskError` of an argument, from its name, what was expected and what was found.
pub(crate) fn ask(
    py: Python<'_>,
    field: &'static str,
    expected: impl Into<String>,
    found: impl Display,
) -> PyErr {
    raised(py, TaskError::ask(field, expected, found))
}

/// The exception for a surface that cannot be read: `SurfaceError`, also where no line of a file is at fault. `path` is what the surface was
/// called.
pub(crate) fn of_surface(py: Python<'_>, path: &str, error: TaskError) -> PyErr {
    match error {
        error @ (TaskError::Ask { .. } | TaskError::Input(_)) => {
            let made = surface_error(py, &error.to_string(), path, &[]);
            made.map_or_else(|failed| failed, PyErr::from_value)
        }
        error => raised(py, error),
    }
}

/// Does `work`; a panic, which is an error in the program, becomes [`TaskError::Work`], as in tasks on a thread of their own.
pub(crate) fn caught<R>(work: impl FnOnce() -> Result<R, TaskError>) -> Result<R, TaskError> {
    // Nothing of what it worked on is looked at again.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Err(TaskError::Work("the work ended in a panic, which is an error in the program".into()))
    })
}

fn of_message<'py>(py: Python<'py>, class: &str, message: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import(CLASSES)?.getattr(class)?.call1((message,))
}

fn of_ask<'py>(py: Python<'py>, field: &str, expected: &str, found: &str) -> PyResult<Bound<'py, PyAny>> {
    let words = PyDict::new(py);
    words.set_item("field", field)?;
    words.set_item("expected", expected)?;
    words.set_item("found", found)?;
    py.import(CLASSES)?.getattr("AskError")?.call((), Some(&words))
}

fn of_faults<'py>(py: Python<'py>, faults: &FileFaults) -> PyResult<Bound<'py, PyAny>> {
    surface_error(py, &format!("{faults:#}"), faults.file(), faults.faults())
}

fn surface_error<'py>(
    py: Python<'py>,
    message: &str,
    path: &str,
    faults: &[Fault],
) -> PyResult<Bound<'py, PyAny>> {
    let faults = faults.iter().map(|fault| described(py, fault)).collect::<PyResult<Vec<_>>>()?;
    let words = PyDict::new(py);
    words.set_item("message", message)?;
    words.set_item("path", path)?;
    words.set_item("faults", faults)?;
    py.import(CLASSES)?.getattr("SurfaceError")?.call((), Some(&words))
}

/// A fault as the keyword arguments of the class `Fault`.
fn described<'py>(py: Python<'py>, fault: &Fault) -> PyResult<Bound<'py, PyDict>> {
    let words = PyDict::new(py);
    words.set_item("key", &fault.key)?;
    words.set_item("line", fault.line)?;
    words.set_item("column", fault.column)?;
    words.set_item("message", format!("expected {}, found {}", fault.expected, fault.found))?;
    words.set_item("found", &fault.found)?;
    words.set_item("expected", &fault.expected)?;
    words.set_item("nearest", fault.nearest.as_deref())?;
    Ok(words)
}
