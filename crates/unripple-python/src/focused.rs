//! Drives that focus, follow waveforms or move a focus along a path, with their reports and figures.

use crate::commands::Done;
use crate::drive::Drive;
use crate::progress::work;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBytes, PyDict};
use std::sync::Arc;
use unripple_tasks::TaskError;

/// Draws the figures of what was made, as SVG text by their names.
pub(crate) type Draw = Arc<dyn Fn() -> Result<Vec<(String, String)>, TaskError> + Send + Sync>;

/// What a focusing task made, before Python has it.
pub(crate) struct Outcome {
    /// The report, with its record if there is one.
    pub done: Done,
    /// The drive, as it is emitted.
    pub drive: unripple::core::Drive,
    /// The figures that the task writes in its folder.
    pub draw: Draw,
}

/// What a focusing task made: a drive, its report and its figures.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Focused {
    done: Done,
    drive: Py<Drive>,
    draw: Draw,
}

impl Focused {
    /// What a task made, for Python.
    pub(crate) fn of(py: Python<'_>, made: Outcome) -> PyResult<Self> {
        Ok(Self { done: made.done, drive: Py::new(py, Drive::of(made.drive))?, draw: made.draw })
    }
}

#[pymethods]
impl Focused {
    /// The report. Its JSON has a record, the key "run", if a request makes the same again: for the responses of a surface in its own band, and
    /// those of a library.
    #[getter]
    fn done(&self) -> Done {
        self.done.clone()
    }

    /// The drive, float32 values in the actuators' units.
    #[getter]
    fn drive(&self, py: Python<'_>) -> Py<Drive> {
        self.drive.clone_ref(py)
    }

    /// The figures that the task writes in its folder: SVG text by name. They are drawn each time; none if the request wants none.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        drawn(py, &self.draw)
    }
}

/// A figure as a picture: the bytes of a PNG of an SVG text, on white, at a resolution in dots to an inch from 20 to 2400.
///
/// Raises WorkError of what cannot be drawn.
#[pyfunction]
pub(crate) fn png<'py>(py: Python<'py>, svg: String, dpi: f64) -> PyResult<Bound<'py, PyBytes>> {
    let picture = work(py, None, None, move |_| Ok(unripple::plot::png(&svg, dpi)?))?;
    Ok(PyBytes::new(py, &picture))
}

/// Figures as SVG text by their names, drawn with the GIL released.
pub(crate) fn drawn<'py>(py: Python<'py>, draw: &Draw) -> PyResult<Bound<'py, PyDict>> {
    let draw = draw.clone();
    work(py, None, None, move |_| draw())?.into_py_dict(py)
}
