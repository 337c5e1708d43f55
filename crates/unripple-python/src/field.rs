//! The field of a drive as Python holds it: maps, snapshots and traces as arrays.

use crate::arrays::{moved, places, points, shared};
use crate::commands::Done;
use crate::error::ask;
use crate::focused::{Draw, drawn};
use crate::progress::{brief, work};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::sync::Arc;
use unripple::act::CELLS;
use unripple::core::Point;
use unripple::field::Maps;
use unripple_tasks::{TaskError, field};

/// What the task `field` made of a drive, and how its figures are drawn.
pub(crate) struct Seen {
    /// The report, with its record if there is one.
    pub done: Done,
    /// Everything that the report was made from.
    pub made: Arc<field::Made>,
    /// The figures that the task writes in its folder.
    pub draw: Draw,
}

impl Seen {
    /// The field of the drive, which can be evaluated anywhere. It borrows what was made, so that it is built anew for each call. Traces need
    /// the shapes of the modes at their points alone; snapshots need those at every point of the grid, which takes memory for points x modes
    /// float32 values and most of the time that a few snapshots take.
    fn field(&self) -> Result<unripple::field::Field<'_>, TaskError> {
        let field::Made { responses, drive, .. } = &*self.made;
        unripple::field::Field::new(responses, drive, CELLS).map_err(TaskError::input)
    }

    /// Velocity (m/s) and displacement (m) at all points at some instants (s), [time, point].
    fn snapshots(&self, instants: &[f64]) -> Result<[Vec<f32>; 2], TaskError> {
        let found = self.field()?.snapshots(instants).map_err(TaskError::input)?;
        let [mut velocity, mut displacement] = [Vec::new(), Vec::new()];
        for snapshot in found {
            velocity.extend(snapshot.velocity);
            displacement.extend(snapshot.displacement);
        }
        Ok([velocity, displacement])
    }

    /// Velocity (m/s) and displacement (m) at some points (m) up to an instant (s), [point, time].
    fn traces(&self, points: &[Point], until: f64) -> Result<[Vec<f64>; 2], TaskError> {
        let found = self.field()?.traces(points, until).map_err(TaskError::input)?;
        let [mut velocity, mut displacement] = [Vec::new(), Vec::new()];
        for trace in found {
            velocity.extend(trace.velocity);
            displacement.extend(trace.displacement);
        }
        Ok([velocity, displacement])
    }
}

/// Two arrays of the same shape: velocity and displacement.
type Both<'py, T> = (Bound<'py, PyArray2<T>>, Bound<'py, PyArray2<T>>);

/// The motion that a drive causes on a surface: report, maps, and the motion at any instant or point. Of responses without a scale, velocities
/// and displacements are known but for a factor.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Field(Arc<Seen>);

impl Field {
    /// What the task `field` made, for Python.
    pub(crate) fn of(seen: Seen) -> Self {
        Self(Arc::new(seen))
    }

    fn maps(&self) -> &Maps {
        &self.0.made.judged.measured.maps
    }
}

#[pymethods]
impl Field {
    /// The report. Its JSON has a record, the key "run", unless the responses are those of an array; the record holds the drive's samples,
    /// and is written when it is first asked for.
    #[getter]
    fn done(&self) -> Done {
        self.0.done.clone()
    }

    /// The points that maps and snapshots have values for, in metres: float64 [point, 2]; centres of the cells of a grid, or the points of a
    /// library.
    #[getter]
    fn points_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        places(py, self.maps().points.iter().copied())
    }

    /// Columns and rows of the grid, and width and height of its cells in metres; None for the points of a library.
    #[getter]
    fn grid(&self) -> Option<(usize, usize, f64, f64)> {
        self.maps().grid.as_ref().map(|grid| (grid.columns, grid.rows, grid.width, grid.height))
    }

    /// The cell of the grid that each point is the centre of, row * columns + column from the bottom: int64 [point]; None for the points of a
    /// library.
    #[getter]
    fn inside<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray1<i64>>>> {
        let Some(grid) = &self.maps().grid else { return Ok(None) };
        let cells: Vec<i64> = grid.inside.iter().map(|cell| *cell as i64).collect();
        let count = cells.len();
        moved(py, cells, count).map(Some)
    }

    /// Number of samples, from the drive's first, for which the field is known.
    #[getter]
    fn known(&self, py: Python<'_>) -> PyResult<usize> {
        brief(py, || Ok(self.0.field()?.known()))
    }

    /// Samples per second, in Hz.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.0.made.drive.rate()
    }

    /// Velocity (m/s) and displacement (m) at all points at some instants (s from the drive's first sample), each rounded to a sample: two
    /// arrays of float32 [time, point].
    ///
    /// The shapes of all modes at all points are evaluated anew in each call: ask for many instants at once. Raises AskError without instants,
    /// and InputError of instants at which the field is not known, or of too many.
    fn snapshots<'py>(&self, py: Python<'py>, instants_s: Vec<f64>) -> PyResult<Both<'py, f32>> {
        if instants_s.is_empty() {
            return Err(ask(py, "instants_s", "at least one instant", "none"));
        }
        let (seen, shape) = (self.0.clone(), [instants_s.len(), self.maps().points.len()]);
        let [velocity, displacement] = work(py, None, None, move |_| seen.snapshots(&instants_s))?;
        Ok((moved(py, velocity, shape)?, moved(py, displacement, shape)?))
    }

    /// Velocity (m/s) and displacement (m) at points, float32 or float64 [point, 2] in metres, from the drive's first sample up to `until_s`
    /// (s), included: two arrays of float64 [point, time].
    ///
    /// Raises AskError without points, and InputError of points without responses and of times at which the field is not known.
    fn traces<'py>(
        &self,
        py: Python<'py>,
        points_m: &Bound<'py, PyAny>,
        until_s: f64,
    ) -> PyResult<Both<'py, f64>> {
        let points = points(points_m, "points_m")?;
        if points.is_empty() {
            return Err(ask(py, "points_m", "at least one point", "none"));
        }
        let (seen, rows) = (self.0.clone(), points.len());
        let [velocity, displacement] = work(py, None, None, move |_| seen.traces(&points, until_s))?;
        let shape = [rows, velocity.len() / rows];
        Ok((moved(py, velocity, shape)?, moved(py, displacement, shape)?))
    }

    /// Largest magnitude of the velocity at each point over the span evaluated, in m/s: float32 [point]. Read-only; shares memory.
    #[getter]
    fn peak_velocity<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f32>>> {
        shared(slf, |field| field.maps().peak_velocity.as_slice(), slf.get().maps().peak_velocity.len())
    }

    /// Largest magnitude of the displacement at each point over the span evaluated, in metres: float32 [point]. Read-only; shares memory.
    #[getter]
    fn peak_displacement<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let count = slf.get().maps().peak_displacement.len();
        shared(slf, |field| field.maps().peak_displacement.as_slice(), count)
    }

    /// Largest vibration at each point over the span evaluated, as felt, in dB above the threshold of touch: float32 [point]; None of responses
    /// without a scale, and where nothing moves.
    #[getter]
    fn felt_db<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray1<f32>>>> {
        let felt = &self.maps().felt_peak;
        if !self.0.made.scaled || felt.iter().all(|times| *times <= 0.0) {
            return Ok(None);
        }
        let levels: Vec<f32> = felt.iter().map(|times| 20.0 * times.log10()).collect();
        moved(py, levels, felt.len()).map(Some)
    }

    /// Whether each point lies outside the focal discs around the places where the field was measured: bool [point]. Read-only; shares memory.
    #[getter]
    fn outside<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<bool>>> {
        shared(slf, |field| field.maps().outside.as_slice(), slf.get().maps().outside.len())
    }

    /// Whether velocities are in m/s and displacements in metres; otherwise they are known but for a factor.
    #[getter]
    fn scaled(&self) -> bool {
        self.0.made.scaled
    }

    /// The displacement in motion, as the task writes it in its folder: the bytes of an animated PNG of so many frames over a span, start and
    /// end in s from the drive's first sample; None: from 6 ms before the first place's instant to 3 ms after. `progress` is told stages.
    ///
    /// Raises AskError of no frame or too many, of a span that makes no sense or ends after the field is known, and InputError at the points
    /// of a library.
    #[pyo3(signature = (frames, movie_s=None, progress=None))]
    fn animation<'py>(
        &self,
        py: Python<'py>,
        frames: usize,
        movie_s: Option<[f64; 2]>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let made = self.0.made.clone();
        let found = work(py, progress, None, move |progress| {
            progress.stage("animation");
            field::animation(&made, movie_s, frames)?.ok_or_else(|| {
                let expected = "a field on a surface, which is evaluated on a grid";
                TaskError::Input(format!(
                    "animation: expected {expected}, found one at the points of a library"
                ))
            })
        })?;
        Ok(PyBytes::new(py, &found))
    }

    /// The figures that the task writes in its folder: SVG text by name. They are drawn each time; none if the request wants none, and none of
    /// responses without a scale.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        drawn(py, &self.0.draw)
    }
}
