//! Drives as Python holds them: from arrays and WAV files, and into them.

use crate::arrays::{doubles, moved};
use crate::error::input;
use crate::progress::brief;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::path::PathBuf;
use std::sync::Arc;
use unripple_store::write_wav;
use unripple_tasks::TaskError;

/// A drive: what every actuator of a surface is sent, in its own unit (N, A or V). Immutable.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Drive {
    inner: Arc<unripple::core::Drive>,
    /// The samples in one piece, made when they are first asked for.
    samples: PyOnceLock<Py<PyArray2<f64>>>,
}

impl Drive {
    /// A drive that was made elsewhere.
    pub(crate) fn of(drive: unripple::core::Drive) -> Self {
        Self { inner: Arc::new(drive), samples: PyOnceLock::new() }
    }

    /// The drive itself.
    pub(crate) fn inner(&self) -> &Arc<unripple::core::Drive> {
        &self.inner
    }
}

#[pymethods]
impl Drive {
    /// A drive from samples, float32 or float64 [actuator, sample], in the actuators' units, at `rate_hz` samples per second, for actuators
    /// of these names.
    ///
    /// The samples are copied. Raises InputError of no samples, of values that are not finite, of a rate that is not above 0, and of another
    /// number of names.
    #[new]
    fn new(samples: &Bound<'_, PyAny>, rate_hz: f64, names: Vec<String>) -> PyResult<Self> {
        let py = samples.py();
        let (values, [actuators, length]) = doubles::<2>(samples, "samples")?;
        if values.is_empty() {
            let found = format!("{actuators} x {length}");
            let expected = "at least one actuator and one sample";
            return Err(input(py, format!("samples: expected {expected}, found {found}")));
        }
        let made = brief(py, move || {
            let channels = values.chunks_exact(length).map(<[f64]>::to_vec).collect();
            unripple::core::Drive::new(rate_hz, names, channels).map_err(TaskError::input)
        });
        made.map(Self::of)
    }

    /// The samples, in the actuators' units: float64 [actuator, sample]. Read-only; each time another view of the same memory, since whoever
    /// has an array can change its shape.
    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let made = self.samples.get_or_try_init(py, || -> PyResult<Py<PyArray2<f64>>> {
            let channels = self.inner.channels();
            Ok(moved(py, channels.concat(), [channels.len(), self.inner.samples()])?.unbind())
        })?;
        Ok(made.bind(py).call_method0("view")?.cast_into()?)
    }

    /// Samples per second, in Hz.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.inner.rate()
    }

    /// The names of the actuators, in channel order.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.inner.names().iter().map(String::as_str).collect()
    }

    /// Largest magnitude of all samples, in the drive's unit.
    #[getter]
    fn peak(&self) -> f64 {
        self.inner.peak()
    }

    /// Root mean square of all samples, in the drive's unit.
    #[getter]
    fn rms(&self) -> f64 {
        self.inner.rms()
    }

    /// Energy, the integral of the square summed over actuators, in the drive's unit squared times seconds.
    #[getter]
    fn energy(&self) -> f64 {
        self.inner.energy()
    }

    /// Writes the drive as a WAV file of float32 samples in the actuators' units, one channel for each actuator.
    ///
    /// Raises InputError of a drive that the format cannot hold, such as one whose rate is no whole number of Hz, and WorkError of a file that
    /// cannot be written.
    fn to_wav(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        brief(py, || Ok(write_wav(&path, &self.inner)?))
    }
}

/// Reads a drive from a WAV file: float samples in the actuators' units, whole numbers with full scale as 1.
///
/// `names` are those of the actuators, one for each channel; None calls them a1, a2 and so on. Raises InputError of a file that cannot be
/// read, and of another number of names.
#[pyfunction]
#[pyo3(signature = (path, names=None))]
pub(crate) fn read_wav(py: Python<'_>, path: PathBuf, names: Option<Vec<String>>) -> PyResult<Drive> {
    let read = brief(py, move || {
        let wav = unripple_store::read_wav(&path)?;
        let count = wav.channels.len();
        let names = names.unwrap_or_else(|| (1..=count).map(|channel| format!("a{channel}")).collect());
        Ok(wav.into_drive(&names, &path.display().to_string())?)
    });
    read.map(Drive::of)
}
