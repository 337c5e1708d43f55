//! A surface as Python holds it: read once, without faults, and immutable.

use crate::arrays::coordinates;
use crate::commands::asked;
use crate::drive::Drive;
use crate::error::{input, of_surface, raised};
use crate::progress::brief;
use numpy::PyArray2;
use pyo3::prelude::*;
use std::sync::Arc;
use unripple::act::unit;
use unripple_store::{BUILTINS, Library, to_toml};
use unripple_tasks::record::Request;
use unripple_tasks::{SurfaceAsk, TaskError, commands, field, focus, stroke, waveform};

/// The tasks whose asks a surface refuses before there are modes.
const CHECKED: [&str; 4] =
    [focus::Ask::COMMAND, waveform::Ask::COMMAND, stroke::Ask::COMMAND, field::Ask::COMMAND];

/// Pieces of a full turn of a round boundary, enough to look round on a screen.
const TURN: usize = 256;

/// A surface: sheet, outline, actuators, frequency band and finger. Immutable. Places are in metres.
///
/// Surface(ask) reads one. `ask` is JSON: the name of a built-in surface, or the path of a file, as a string; {"name": …, "set": {key: value}}
/// for one with keys set to other values; {"toml": …, "name": …} for the text of a surface file. Raises SurfaceError with all faults.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Surface {
    ask: SurfaceAsk,
    inner: Arc<unripple::core::Surface>,
}

impl Surface {
    /// A surface that was made elsewhere, such as that of a library.
    pub(crate) fn of(surface: unripple::core::Surface) -> Self {
        let ask = SurfaceAsk::Text { toml: to_toml(&surface), name: Some(surface.name.clone()) };
        Self { ask, inner: Arc::new(surface) }
    }

    /// The surface itself.
    pub(crate) fn inner(&self) -> &Arc<unripple::core::Surface> {
        &self.inner
    }

    /// The surface as asks name it: a built-in surface by its name, any other by its text, so that no file is read again.
    pub(crate) fn ask(&self) -> &SurfaceAsk {
        &self.ask
    }
}

#[pymethods]
impl Surface {
    #[new]
    fn new(py: Python<'_>, ask: &str) -> PyResult<Self> {
        let ask = serde_json::from_str::<SurfaceAsk>(ask)
            .map_err(|error| input(py, format!("ask: expected JSON that names a surface, found {error}")))?;
        let read = brief(py, || Ok(read(&ask)))?;
        let inner = read.map_err(|error| of_surface(py, &ask.to_string(), error))?;
        Ok(Self { ask: kept(ask, &inner), inner: Arc::new(inner) })
    }

    /// The name of the surface.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// The text of a surface file that describes this surface completely, without other files.
    #[getter]
    fn toml(&self) -> String {
        to_toml(&self.inner)
    }

    /// JSON that names this surface in the request of a task: a built-in surface by its name, any other by its text.
    #[getter(ask)]
    fn ask_json(&self, py: Python<'_>) -> PyResult<String> {
        serde_json::to_string(&self.ask).map_err(|error| raised(py, TaskError::work(error)))
    }

    /// The names of the actuators, in channel order.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.inner.actuators.iter().map(|actuator| actuator.name.as_str()).collect()
    }

    /// The unit of each actuator's drive: N, A or V.
    #[getter]
    fn units(&self) -> Vec<&'static str> {
        self.inner.actuators.iter().map(|actuator| unit(&actuator.kind)).collect()
    }

    /// The places of the actuators, in metres: float64 [actuator, 2].
    #[getter]
    fn actuators_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        coordinates(py, self.inner.actuators.iter().map(|actuator| actuator.at))
    }

    /// Lowest and highest frequency of the drive, in Hz.
    #[getter]
    fn band_hz(&self) -> (f64, f64) {
        let [low, high] = self.inner.emission.band;
        (low, high)
    }

    /// Samples per second of the drive, in Hz.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.inner.emission.rate
    }

    /// Largest magnitude of each actuator's drive, in its unit.
    #[getter]
    fn limit(&self) -> f64 {
        self.inner.emission.limit
    }

    /// Width and height of the outline's bounding box, in metres.
    #[getter]
    fn extent_m(&self) -> (f64, f64) {
        self.inner.outline.extent()
    }

    /// The outer boundary, then the holes, as closed polygons for drawing, in metres: a list of float64 [n, 2].
    #[getter]
    fn outline_m<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let outline = &self.inner.outline;
        let rims = std::iter::once(outline.rim(TURN)).chain(outline.hole_rims(TURN));
        rims.map(|rim| coordinates(py, rim)).collect()
    }

    /// Refuses a request, JSON, that makes no sense on this surface, by what can be told before there are modes: of the task `focus`, `waveform` or
    /// `stroke`, or of `field` with the drive that is to be evaluated.
    ///
    /// Raises what the task raises, and AskError for another task, or `field` without a drive.
    #[pyo3(signature = (command, ask, drive=None))]
    fn refuse(
        &self,
        py: Python<'_>,
        command: &str,
        ask: &str,
        drive: Option<&Bound<'_, Drive>>,
    ) -> PyResult<()> {
        let (surface, drive) = (&*self.inner, drive.map(|drive| drive.get().inner()));
        brief(py, || match (command, drive) {
            (focus::Ask::COMMAND, _) => focus::check(&asked(ask)?, surface),
            (waveform::Ask::COMMAND, _) => waveform::check(&asked(ask)?, surface),
            (stroke::Ask::COMMAND, _) => stroke::check(&asked(ask)?, surface),
            (field::Ask::COMMAND, Some(drive)) => field::check(&asked(ask)?, surface, drive),
            (field::Ask::COMMAND, None) => Err(TaskError::ask("drive", "a drive", "none")),
            (other, _) => Err(commands::unknown(other, &CHECKED)),
        })
    }
}

/// Reads a surface, but no library, which tasks alone take in the place of one.
fn read(ask: &SurfaceAsk) -> Result<unripple::core::Surface, TaskError> {
    match ask {
        SurfaceAsk::Name(name) if Library::is_at(name) => {
            Err(TaskError::Input(format!("{name}: expected a surface file, found a library of responses")))
        }
        _ => ask.load(),
    }
}

/// The ask of a surface that has been read, from which the same one is read again whatever becomes of its file.
fn kept(ask: SurfaceAsk, surface: &unripple::core::Surface) -> SurfaceAsk {
    let name = match ask {
        SurfaceAsk::Name(name) if BUILTINS.iter().any(|builtin| builtin.name == name) => {
            return SurfaceAsk::Name(name);
        }
        SurfaceAsk::Name(name) | SurfaceAsk::Set { name, .. } => Some(name),
        SurfaceAsk::Text { name, .. } => name,
    };
    SurfaceAsk::Text { toml: to_toml(surface), name }
}
