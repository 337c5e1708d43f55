//! A simulated surface that Python steps block by block.

use crate::arguments::{finite, on_surface, place, positive, shown, whole};
use crate::arrays::{self, owned};
use crate::error::ask;
use crate::progress::{brief, work};
use crate::surface::Surface;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use unripple::core::{Contact, Device, Finger, Point};
use unripple_devices::{Handle, Tap, Virtual, VirtualOptions};
use unripple_tasks::{DeviceAsk, TaskError, device, judge};

/// Time after which long stepping looks for signals: a quarter of the 0.2 s in which a call is to end after Ctrl+C.
pub(crate) const TURN: Duration = Duration::from_millis(50);

/// Largest number of samples of a block, as the device takes, and largest distance of the samples that are watched.
const LONGEST_BLOCK: u64 = 1_000_000;
const LONGEST_STRIDE: u64 = LONGEST_BLOCK;

/// Largest number of fingers at once, as the simulation takes, and how many there may be by default. Each costs a coordinate in every
/// step.
const MOST_FINGERS: u64 = 64;
const FINGERS: u64 = 4;

/// Largest number of places that are watched: a grid of 64 by 64. Each costs a sum over all modes in every step.
const MOST_WATCHED: usize = 4096;

/// Longest tap, in s, as the device plays it. A finger that presses for longer is put down.
const LONGEST_TAP: f64 = 1.0;

/// Signals of the sensors [actuator, sample] and of the probe [sample].
pub(crate) type Heard<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray1<f32>>);

/// Motion of a finger: share in contact, force (N), velocity (m/s), displacement (m), power (W).
type Motion = (f64, f64, f64, f64, f64);

/// A simulated surface, stepped block by block: drive in, signals of the actuators' sensors and of a velocity probe out, while fingers are
/// put down, moved and lifted. Time passes only in exchange(). It may be used from several threads, whose calls take turns.
///
/// `block` is the number of samples of a block, 1 to 1000000. `max_hz` is the highest frequency of the modes, in Hz; None: that of the
/// band, or 1.5 times that where coils or masses load the sheet. `seed` makes a surface that differs at random from its file, in gains,
/// places, tension, damping, stray masses and noise, as the field `unknowns` of the task calibrate does: one seed gives one surface; None:
/// the surface itself. `probe_m` is the place of the probe at first, x and y in metres; None: the middle of the bounding box. `fingers` is
/// how many fingers there may be at once, those that are being lifted included, 0 to 64; None: 4.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct VirtualSurface {
    surface: Arc<unripple::core::Surface>,
    names: Vec<String>,
    block: usize,
    handle: Handle,
    bench: Mutex<Bench>,
}

/// What a simulated surface is made of, besides the surface.
struct Asked {
    block: usize,
    max_hz: Option<f64>,
    seed: Option<u64>,
    probe: Option<Point>,
    fingers: usize,
}

#[pymethods]
impl VirtualSurface {
    #[new]
    #[pyo3(signature = (surface, block, max_hz=None, seed=None, probe_m=None, fingers=None))]
    fn new(
        surface: &Bound<'_, Surface>,
        block: &Bound<'_, PyAny>,
        max_hz: Option<&Bound<'_, PyAny>>,
        seed: Option<&Bound<'_, PyAny>>,
        probe_m: Option<&Bound<'_, PyAny>>,
        fingers: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (py, surface) = (surface.py(), surface.get().inner().clone());
        let fingers = fingers.map(|number| whole(number, "fingers", 0..=MOST_FINGERS)).transpose()?;
        let asked = Asked {
            block: whole(block, "block", 1..=LONGEST_BLOCK)? as usize,
            max_hz: max_hz.map(|hz| positive(hz, "max_hz")).transpose()?,
            seed: seed.map(|seed| whole(seed, "seed", 0..=u64::MAX)).transpose()?,
            probe: probe_m.map(|at| place(at, "probe_m", &surface.outline)).transpose()?,
            fingers: fingers.unwrap_or(FINGERS) as usize,
        };
        let (block, simulated) = (asked.block, surface.clone());
        let device = work(py, None, None, move |_| open(&simulated, &asked))?;
        let (names, handle) = (device.layout().outputs.clone(), device.handle());
        let bench = Mutex::new(Bench::new(device));
        Ok(Self { surface, names, block, handle, bench })
    }

    /// The names of the actuators, in the order of the drive's rows.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.names.iter().map(String::as_str).collect()
    }

    /// Samples per second, in Hz.
    #[getter]
    fn rate_hz(&self) -> f64 {
        self.surface.emission.rate
    }

    /// Samples of a block.
    #[getter]
    fn block(&self) -> usize {
        self.block
    }

    /// Samples that have passed since the surface was made or last at rest.
    #[getter]
    fn samples(&self, py: Python<'_>) -> PyResult<u64> {
        brief(py, || Ok(self.handle.samples()))
    }

    /// Time that has passed since then, in seconds.
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.samples(py)? as f64 / self.surface.emission.rate)
    }

    /// Plays a drive, with the GIL released, and returns what is recorded meanwhile.
    ///
    /// `drive` has a row for each actuator and as many samples as fill whole blocks, in the actuators' units; it is played as it is, also
    /// beyond the surface's limit. float32 [actuator, n] is taken without conversion. The result is the signals of the sensors, float32
    /// [actuator, n] in the sensors' units, and the velocity at the probe, float32 [n] in m/s; sample i has the effect of the drive's sample
    /// i. An exception of a signal's handler, as of Ctrl+C, ends a long exchange; a part has been played then.
    ///
    /// Raises AskError for a drive of another shape, InputError for one of another type or with numbers that are not finite.
    fn exchange<'py>(&self, drive: &Bound<'py, PyAny>) -> PyResult<Heard<'py>> {
        let py = drive.py();
        let (mut planes, samples) = self.planes(drive)?;
        let (mut probe, mut done) = (vec![0.0_f32; samples], 0);
        while done < samples {
            done = brief(py, || {
                let mut bench = self.bench.lock().unwrap_or_else(PoisonError::into_inner);
                bench.exchange(&mut planes, &mut probe, done)
            })?;
            if done < samples {
                py.check_signals()?;
            }
        }
        Ok((owned(py, planes, [self.names.len(), samples])?, probe.into_pyarray(py)))
    }

    /// Puts a finger down at a place, x and y in metres, under a number of the caller's. `contact` is its mass (kg), damping (N·s/m),
    /// stiffness (N/m) and radius (m); None: those of the surface file. The load comes within 8 ms, from the next block on.
    ///
    /// Raises AskError for values that cannot be, InputError for a number that is down or for too many fingers.
    #[pyo3(signature = (id, at_m, contact=None))]
    fn touch(
        &self,
        id: &Bound<'_, PyAny>,
        at_m: &Bound<'_, PyAny>,
        contact: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let contact = Contact { at: self.place(at_m)?, finger: self.finger(contact)? };
        let (py, id) = (id.py(), number(id)?);
        brief(py, || Ok(self.handle.touch(id, &contact)?))
    }

    /// Moves a finger to a place, x and y in metres, where its load is within 5 ms, from the next block on.
    ///
    /// Raises InputError if no finger of this number is down.
    #[pyo3(name = "move")]
    fn shift(&self, id: &Bound<'_, PyAny>, at_m: &Bound<'_, PyAny>) -> PyResult<()> {
        let (py, id, at) = (id.py(), number(id)?, self.place(at_m)?);
        brief(py, || Ok(self.handle.move_finger(id, at)?))
    }

    /// Lifts a finger: its load goes within 8 ms, from the next block on; its number is free at once.
    ///
    /// Raises InputError if no finger of this number is down.
    fn lift(&self, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let (py, id) = (id.py(), number(id)?);
        brief(py, || Ok(self.handle.lift(id)?))
    }

    /// Motion of a finger after the last block: how far it is in contact (0 to 1), the force on it (N), the velocity of the sheet under it
    /// (m/s), the displacement of the finger (m) and the mean power into it over the block (W); None if it is not down.
    fn finger_motion(&self, id: &Bound<'_, PyAny>) -> PyResult<Option<Motion>> {
        let (py, id) = (id.py(), number(id)?);
        let motion = brief(py, || Ok(self.handle.finger_motion(id)))?;
        Ok(motion.map(|m| (m.grip, m.force, m.velocity, m.displacement, m.power)))
    }

    /// Puts the probe at a place, x and y in metres, from the next block on.
    fn probe(&self, at_m: &Bound<'_, PyAny>) -> PyResult<()> {
        let (py, at) = (at_m.py(), self.place(at_m)?);
        brief(py, || Ok(self.handle.move_probe(at)?))
    }

    /// Taps at a place, x and y in metres, with half a sine of force: its peak in newtons, its duration in seconds, at most 1. It begins
    /// `after_s` seconds after the start of the next block, at most a day; None: at once. One tap at a time: two may not share a block.
    ///
    /// Raises AskError for values that cannot be, InputError for a second tap in a block.
    #[pyo3(signature = (at_m, newtons, seconds, after_s=None))]
    fn tap(
        &self,
        at_m: &Bound<'_, PyAny>,
        newtons: &Bound<'_, PyAny>,
        seconds: &Bound<'_, PyAny>,
        after_s: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (py, at) = (at_m.py(), self.place(at_m)?);
        let (peak, duration) = (finite(newtons, "newtons")?, positive(seconds, "seconds")?);
        if duration > LONGEST_TAP {
            return Err(ask(py, "seconds", format!("at most {LONGEST_TAP}"), duration));
        }
        let after = after_s.map_or(Ok(0.0), |after| finite(after, "after_s"))?;
        let tap = Tap::half_sine(peak, duration, self.surface.emission.rate);
        brief(py, || Ok(self.handle.tap(&tap, at, after)?))
    }

    /// Watches the displacement at some places, an array [place, 2] of x and y in metres, instead of those before: every `stride`-th sample
    /// from the next block on; None: every sample. At most 4096 places.
    #[pyo3(signature = (points_m, stride=None))]
    fn watch(&self, points_m: &Bound<'_, PyAny>, stride: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let py = points_m.py();
        let points = arrays::points(points_m, "points_m")?;
        let outline = &self.surface.outline;
        points.iter().try_for_each(|at| on_surface(py, *at, "points_m", outline).map(drop))?;
        if points.len() > MOST_WATCHED {
            return Err(ask(py, "points_m", format!("at most {MOST_WATCHED} places"), points.len()));
        }
        let stride = stride.map_or(Ok(1), |stride| whole(stride, "stride", 1..=LONGEST_STRIDE))?;
        brief(py, || Ok(self.handle.watch(&points, stride as usize)?))
    }

    /// Displacement at the watched places since this was last called, in metres: float32 [place, sample], of each place the newest 65536
    /// samples at most. It has no noise.
    fn watched<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let traces = brief(py, || Ok(self.handle.watched()))?;
        let samples = traces.first().map_or(0, Vec::len);
        owned(py, traces.concat(), [traces.len(), samples])
    }

    /// Puts the surface at rest as it was made, at time 0: without taps, fingers and watched places, the probe at its first place. The noise
    /// of a surface with a seed is another for each `seed` here; None: the same again.
    #[pyo3(signature = (seed=None))]
    fn rest(&self, py: Python<'_>, seed: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let seed = seed.map_or(Ok(0), |seed| whole(seed, "seed", 0..=u64::MAX))?;
        brief(py, || {
            self.handle.rest(seed);
            Ok(())
        })
    }
}

impl VirtualSurface {
    /// The samples of a drive, one actuator after the other, and the number of samples of each.
    fn planes(&self, drive: &Bound<'_, PyAny>) -> PyResult<(Vec<f32>, usize)> {
        let (values, [rows, samples]) = arrays::singles::<2>(drive, "drive")?;
        let actuators = self.names.len();
        if rows != actuators || !samples.is_multiple_of(self.block) {
            let expected = format!("{actuators} x n numbers, n a multiple of {}", self.block);
            return Err(ask(drive.py(), "drive", expected, format!("{rows} x {samples}")));
        }
        Ok((values, samples))
    }

    fn place(&self, at_m: &Bound<'_, PyAny>) -> PyResult<Point> {
        place(at_m, "at_m", &self.surface.outline)
    }

    /// A finger from its four numbers, or that of the surface file.
    fn finger(&self, contact: Option<&Bound<'_, PyAny>>) -> PyResult<Finger> {
        let Some(contact) = contact else { return Ok(self.surface.finger) };
        let legal = |numbers: &[f64; 4]| numbers.iter().all(|number| number.is_finite() && *number >= 0.0);
        let found = contact.extract::<[f64; 4]>().ok().filter(legal);
        let [mass, damping, stiffness, contact_radius] = found.ok_or_else(|| {
            let expected = "mass (kg), damping (N·s/m), stiffness (N/m) and radius (m), each 0 or more";
            ask(contact.py(), "contact", expected, shown(contact))
        })?;
        Ok(Finger { mass, damping, stiffness, contact_radius })
    }
}

/// The device, and the buffers of one block.
struct Bench {
    device: Virtual,
    drive: Vec<f32>,
    heard: Vec<f32>,
}

impl Bench {
    fn new(device: Virtual) -> Self {
        let layout = device.layout();
        let buffer = |channels: usize| vec![0.0; channels * layout.block];
        let (drive, heard) = (buffer(layout.outputs.len()), buffer(layout.inputs.len()));
        Self { device, drive, heard }
    }

    /// Plays the blocks from the sample `first` on, until all have passed or it is time to look for signals, and returns the first sample
    /// that has not been played. In `planes`, what the sensors record takes the place of the drive.
    fn exchange(
        &mut self,
        planes: &mut [f32],
        probe: &mut [f32],
        mut first: usize,
    ) -> Result<usize, TaskError> {
        let (block, scale) = (self.device.layout().block, self.device.layout().full_scale);
        let (samples, began) = (probe.len(), Instant::now());
        while first < samples {
            let span = first..first + block;
            for (to, plane) in self.drive.chunks_exact_mut(block).zip(planes.chunks_exact(samples)) {
                let values = to.iter_mut().zip(&plane[span.clone()]);
                values.for_each(|(to, value)| *to = (f64::from(*value) / scale) as f32);
            }
            self.device.exchange(&self.drive, &mut self.heard).map_err(TaskError::work)?;
            let (sensors, velocity) = self.heard.split_at(self.drive.len());
            for (plane, from) in planes.chunks_exact_mut(samples).zip(sensors.chunks_exact(block)) {
                plane[span.clone()].copy_from_slice(from);
            }
            probe[span].copy_from_slice(velocity);
            first += block;
            if began.elapsed() >= TURN {
                break;
            }
        }
        Ok(first)
    }
}

/// Opens a simulated surface as a calibration does.
fn open(surface: &unripple::core::Surface, asked: &Asked) -> Result<Virtual, TaskError> {
    let mut options = VirtualOptions::to_be_measured(surface)?;
    options.block = asked.block;
    options.stepper.max_fingers = asked.fingers;
    options.probe = asked.probe;
    options.max_hz = asked.max_hz;
    options.accuracy = judge::accuracy(surface);
    let unknowns = DeviceAsk { unknowns: asked.seed, ..DeviceAsk::default() };
    Ok(device::virtual_surface(&unknowns, surface, &options)?.0)
}

/// A finger's number.
fn number(id: &Bound<'_, PyAny>) -> PyResult<u64> {
    whole(id, "id", 0..=u64::MAX)
}
