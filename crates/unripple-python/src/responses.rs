//! Responses as Python holds them: of a surface, of a library, of an array, computed or read once for many tasks.

mod array;
mod held;

use crate::arrays::{moved, places, points, shared, singles};
use crate::commands::Done;
use crate::drive::Drive;
use crate::error::raised;
use crate::field::Field;
use crate::focused::Focused;
use crate::progress::{brief, work};
use crate::surface::Surface;
use array::Given;
use held::Held;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::sync::Arc;
use unripple::core::{Pole, SampledResponses};
use unripple_tasks::record::Request;
use unripple_tasks::{Progress, TaskError, field, focus, stroke, waveform};

/// Impulse responses from the actuators of a surface to its points: as the modes of a model, or as samples. Immutable.
///
/// A response is the normal velocity at the point, in m/s, per unit impulse of the actuator's drive. Sample 0 is the full value just after the
/// impulse.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Responses {
    held: Arc<Held>,
    surface: Py<Surface>,
}

/// Sampled responses of which Python sees an array.
#[pyclass(frozen, module = "unripple._unripple")]
struct Samples(SampledResponses);

impl Responses {
    fn of(py: Python<'_>, held: Held) -> PyResult<Self> {
        let surface = Py::new(py, Surface::of(held.surface().clone()))?;
        Ok(Self { held: Arc::new(held), surface })
    }

    /// Does a task on these responses; its request is JSON.
    fn task<A: Request + Send + 'static, R: Send + 'static>(
        &self,
        py: Python<'_>,
        ask: &str,
        (progress, threads): (Option<Py<PyAny>>, Option<usize>),
        run: impl FnOnce(&Held, A, &mut dyn Progress) -> Result<R, TaskError> + Send + 'static,
    ) -> PyResult<R> {
        let ask = crate::commands::asked::<A>(ask).map_err(|error| raised(py, error))?;
        let held = self.held.clone();
        work(py, progress, threads, move |progress| run(&held, ask, progress))
    }

    /// One number of each mode; nothing of sampled responses.
    fn of_modes<'py>(
        &self,
        py: Python<'py>,
        number: impl Fn(&Pole) -> f64,
    ) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        let Some(modal) = self.held.modal() else { return Ok(None) };
        let numbers: Vec<f64> = modal.poles.iter().map(number).collect();
        moved(py, numbers, modal.poles.len()).map(Some)
    }
}

#[pymethods]
impl Responses {
    /// Computes the responses of a surface from its modes.
    ///
    /// `max_hz` is the highest frequency of the modes in Hz, at least the top of the band; None: that top. `fingers_m` are places, in metres, of
    /// fingers that rest on the surface. A drive is computed from these responses, and evaluated on the surface under these fingers unless the
    /// ask names others. `progress` has the methods stage(what), done(share) and tell(line), or is None; `threads` is the number of threads.
    ///
    /// Raises AskError of a finger beyond the rim, InputError of a frequency below the top of the band, and of modes that do not fit into the
    /// memory.
    #[staticmethod]
    #[pyo3(signature = (surface, max_hz=None, fingers_m=Vec::new(), progress=None, threads=None))]
    fn of_surface(
        py: Python<'_>,
        surface: &Bound<'_, Surface>,
        max_hz: Option<f64>,
        fingers_m: Vec<(f64, f64)>,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let (inner, named) = (surface.get().inner().clone(), surface.get().ask().clone());
        let fingers = fingers_m.into_iter().map(|(x, y)| [x, y]).collect();
        let made = work(py, progress, threads, move |progress| {
            Held::of_surface(&inner, named, (max_hz, fingers), progress)
        });
        Ok(Self { held: Arc::new(made?), surface: surface.clone().unbind() })
    }

    /// Opens a library of responses by its folder, and reads the responses of its finished points.
    ///
    /// What is wrong with the library is told to `progress` as warnings. Raises InputError of a folder that is no library, that does not
    /// describe its surface, or has no finished point.
    #[staticmethod]
    #[pyo3(signature = (path, progress=None))]
    fn open(py: Python<'_>, path: PathBuf, progress: Option<Py<PyAny>>) -> PyResult<Self> {
        let held = work(py, progress, None, move |progress| Held::open(&path, progress))?;
        Self::of(py, held)
    }

    /// Responses from samples, float32 or float64 [point, actuator, sample], in m/s per unit impulse, at `rate_hz` samples per second.
    ///
    /// `points_m` are the points, [point, 2], and `actuators_m` the places of the actuators, [actuator, 2], in metres from the lower-left corner
    /// of the surface; `names` are those of the actuators. `band_hz` is the band, in Hz, by default that of the surface, or from 0 to 0.45 of the
    /// rate. `lambda_min_m` is the shortest wavelength of the band in metres; it follows from the surface, and must be given without one.
    ///
    /// Without a surface, one is made up: a rectangle around points and actuators, which are ideal forces with a limit of 1. Of the sheet
    /// nothing is known: levels are those of the limit unless asked for, windows are by default half as long as the responses, and a place between
    /// the points takes the interpolation `nearest` or `linear`.
    ///
    /// `scaled` says that the samples are in m/s per unit impulse of the actuators' drives; otherwise they are known but for a factor, and
    /// figures are ratios.
    ///
    /// The samples are copied once. Raises InputError of arrays that do not fit together and of values that are not finite, AskError of numbers
    /// out of range, and SurfaceError of names, places or a rate that no surface has.
    #[staticmethod]
    #[pyo3(signature = (h, rate_hz, points_m, names, actuators_m, band_hz=None, lambda_min_m=None, surface=None, scaled=false))]
    #[allow(clippy::too_many_arguments)] // They are keywords in Python.
    fn from_array(
        py: Python<'_>,
        h: &Bound<'_, PyAny>,
        rate_hz: f64,
        points_m: &Bound<'_, PyAny>,
        names: Vec<String>,
        actuators_m: &Bound<'_, PyAny>,
        band_hz: Option<(f64, f64)>,
        lambda_min_m: Option<f64>,
        surface: Option<&Bound<'_, Surface>>,
        scaled: bool,
    ) -> PyResult<Self> {
        // The one copy: the program's responses own their samples, and NumPy may change its own at any time.
        let (samples, shape) = singles::<3>(h, "h")?;
        let given = Given {
            samples,
            shape,
            rate: rate_hz,
            points: points(points_m, "points_m")?,
            names,
            places: points(actuators_m, "actuators_m")?,
            band: band_hz.map(|(low, high)| [low, high]),
            lambda_min: lambda_min_m,
            surface: surface.map(|surface| surface.get().inner().clone()),
            scaled,
        };
        Self::of(py, brief(py, move || Held::of_array(given))?)
    }

    /// "modal" for the modes of a model, "sampled" for samples.
    #[getter]
    fn kind(&self) -> &'static str {
        if self.held.modal().is_some() { "modal" } else { "sampled" }
    }

    /// Where the responses come from, for people: the surface's name, the library's path, or "array".
    #[getter]
    fn source(&self) -> &str {
        self.held.told()
    }

    /// The surface: that of the model, that which a library was made for, or one that was given with an array or made up for it.
    #[getter]
    fn surface(&self, py: Python<'_>) -> Py<Surface> {
        self.surface.clone_ref(py)
    }

    /// The names of the actuators, in channel order.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.held.responses().ports().iter().map(|port| port.name.as_str()).collect()
    }

    /// The places of the actuators, in metres: float64 [actuator, 2].
    #[getter]
    fn actuators_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        places(py, self.held.responses().ports().iter().map(|port| port.at))
    }

    /// Samples per second, in Hz.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.held.responses().conditions().rate
    }

    /// Lowest and highest frequency for which the responses are valid, in Hz.
    #[getter]
    fn band_hz(&self) -> (f64, f64) {
        let [low, high] = self.held.responses().conditions().band;
        (low, high)
    }

    /// Shortest wavelength of the band, in metres.
    #[getter]
    fn lambda_min_m(&self) -> f64 {
        self.held.responses().conditions().lambda_min
    }

    /// The points of sampled responses, in metres: float64 [point, 2]; None of modal ones.
    #[getter]
    fn points_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        self.held.stored().map(|stored| places(py, stored.points.iter().copied())).transpose()
    }

    /// Number of samples in each response; None of modal ones.
    #[getter]
    fn samples(&self) -> Option<usize> {
        self.held.stored().map(SampledResponses::samples)
    }

    /// The samples, in m/s per unit impulse: float32 [point, actuator, sample]; None of modal responses. Read-only; shares memory.
    #[getter]
    fn array<'py>(slf: &Bound<'py, Self>) -> PyResult<Option<Bound<'py, PyArray3<f32>>>> {
        let Some(stored) = slf.get().held.stored() else { return Ok(None) };
        let shape = shape(stored);
        shared(slf, |this| this.held.stored().map_or(&[][..], SampledResponses::data), shape).map(Some)
    }

    /// Natural frequencies of the modes without their damping, ω/2π, in Hz, ascending: float64 [mode]; None of sampled responses.
    #[getter]
    fn frequencies_hz<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        self.of_modes(py, |pole| pole.omega / TAU)
    }

    /// Decay times of the modes' amplitudes, 1/σ, in s: float64 [mode]; None of sampled responses.
    #[getter]
    fn decay_times_s<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        self.of_modes(py, |pole| 1.0 / pole.sigma)
    }

    /// How strongly each actuator drives each mode, in modal force per unit of drive (of a force in N: 1/√kg): float64 [actuator, mode]; None of
    /// sampled responses.
    #[getter]
    fn input<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let Some(modal) = self.held.modal() else { return Ok(None) };
        let (actuators, modes) = (modal.input.nrows(), modal.input.ncols());
        let row = |actuator: usize| (0..modes).map(move |mode| modal.input[(actuator, mode)]);
        let values: Vec<f64> = (0..actuators).flat_map(row).collect();
        moved(py, values, [actuators, modes]).map(Some)
    }

    /// Responses of `length_s` seconds at points, float32 or float64 [point, 2] in metres: float32 [point, actuator, sample] in m/s per unit
    /// impulse, round(length_s * rate_hz) + 1 samples each. Read-only.
    ///
    /// Modal responses are summed over their modes, in single precision. Sampled ones are interpolated between their points as the tasks do by
    /// default (`kernel`); those of an array without a surface are known at its points only. Raises AskError of points beyond the rim, and of a
    /// length that is not above 0, longer than sampled responses, or of more than 2**29 values in all.
    fn impulse<'py>(
        &self,
        py: Python<'py>,
        points_m: &Bound<'py, PyAny>,
        length_s: f64,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let (places, held) = (points(points_m, "points_m")?, self.held.clone());
        let made = work(py, None, None, move |_| held.impulse(&places, length_s))?;
        let shape = shape(&made);
        shared(&Bound::new(py, Samples(made))?, |samples| samples.0.data(), shape)
    }

    /// Computes a drive that focuses, and evaluates it. `ask` is that of the task `focus`, as JSON in SI units; its surface is these responses,
    /// and nothing is written.
    ///
    /// Raises what the task raises, and AskError of an output.
    #[pyo3(signature = (ask, progress=None, threads=None))]
    fn focus(
        &self,
        py: Python<'_>,
        ask: &str,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Focused> {
        Focused::of(py, self.task(py, ask, (progress, threads), Held::focus)?)
    }

    /// Computes a drive by which targets follow waveforms, and evaluates it. `ask` is that of the task `waveform`, as JSON in SI units; its
    /// surface is that of these responses, and nothing is written. The task plans on modes above the band, which it computes.
    ///
    /// Raises what the task raises, and AskError of sampled responses, of those under fingers, and of an output.
    #[pyo3(signature = (ask, progress=None, threads=None))]
    fn waveform(
        &self,
        py: Python<'_>,
        ask: &str,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Focused> {
        Focused::of(py, self.task(py, ask, (progress, threads), Held::waveform)?)
    }

    /// Computes a drive whose focus moves along a path, and evaluates it. `ask` is that of the task `stroke`, as JSON in SI units; its surface is
    /// these responses, and nothing is written.
    ///
    /// Raises what the task raises, and AskError of sampled responses, of those under fingers, and of an output.
    #[pyo3(signature = (ask, progress=None, threads=None))]
    fn stroke(
        &self,
        py: Python<'_>,
        ask: &str,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Focused> {
        Focused::of(py, self.task(py, ask, (progress, threads), Held::stroke)?)
    }

    /// Evaluates what a drive does to the surface. `ask` is that of the task `field`, as JSON in SI units; its surface is these responses, its
    /// drive is `drive`, and nothing is written. A surface is evaluated on modes up to twice its band, or up to `max_hz` where the responses have
    /// one, under their fingers if the request has none.
    ///
    /// Raises what the task raises, and AskError of an output.
    #[pyo3(signature = (ask, drive, progress=None, threads=None))]
    fn field(
        &self,
        py: Python<'_>,
        ask: &str,
        drive: &Bound<'_, Drive>,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Field> {
        // As it is emitted, and as a WAV file holds it: in float32.
        let drive = Arc::new(unripple::core::Drive::clone(drive.get().inner()).as_emitted());
        let run = move |held: &Held, ask, progress: &mut dyn Progress| held.field(ask, drive, progress);
        Ok(Field::of(self.task(py, ask, (progress, threads), run)?))
    }

    /// Does a task that fills a folder: "focus", "waveform", "stroke" or "field". `ask` is that of the task, as JSON in SI units; its surface is
    /// these responses, as they are held here: nothing is read again.
    ///
    /// Raises what the task raises, and AskError of another task.
    #[pyo3(signature = (command, ask, progress=None, threads=None))]
    fn run(
        &self,
        py: Python<'_>,
        command: &str,
        ask: &str,
        progress: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Done> {
        let call = (progress, threads);
        match command {
            focus::Ask::COMMAND => self.task(py, ask, call, |held, ask: focus::Ask, progress| {
                held.fill(ask, |ask| &mut ask.surface, focus::run_on, progress)
            }),
            waveform::Ask::COMMAND => self.task(py, ask, call, |held, ask: waveform::Ask, progress| {
                held.fill(ask, |ask| &mut ask.surface, waveform::run_on, progress)
            }),
            stroke::Ask::COMMAND => self.task(py, ask, call, |held, ask: stroke::Ask, progress| {
                held.fill(ask, |ask| &mut ask.surface, stroke::run_on, progress)
            }),
            field::Ask::COMMAND => self.task(py, ask, call, |held, ask: field::Ask, progress| {
                held.fill(ask, |ask| &mut ask.surface, field::run_on, progress)
            }),
            _ => {
                let expected = "focus, waveform, stroke or field";
                Err(crate::error::ask(py, "command", expected, format!("`{command}`")))
            }
        }
    }
}

/// Numbers of points, actuators and samples.
fn shape(responses: &SampledResponses) -> [usize; 3] {
    [responses.points.len(), responses.ports.len(), responses.samples()]
}
