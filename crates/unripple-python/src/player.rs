//! Live play that Python steps block by block, with touches that Python pushes.

use crate::arguments::{finite, place, whole};
use crate::arrays::owned;
use crate::commands::{Done, asked};
use crate::error::{ask, raised};
use crate::progress::{brief, work};
use crate::surface::Surface;
use crate::virtual_surface::{Heard, TURN};
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;
use unripple::core::{Phase, Point, Touch};
use unripple_tasks::play::{self, Stepped};
use unripple_tasks::{TaskError, commands};
use unripple_touch::{Pusher, TouchError, pushed};

/// Fewest and most samples of a block, as the player takes.
const BLOCKS: (u64, u64) = (8, 8192);

/// Largest number of samples over all actuators that one call returns, 1 GiB of float32. Twice as many are asked for by mistake rather
/// than on purpose.
const MOST_SAMPLES: u64 = 1 << 28;

/// A surface in play, stepped block by block: touches that are pushed here set off effects, whose drives are computed and mixed under the
/// limits of the actuators, as the task play does with a simulated surface. Time passes only in step(): the same touches at the same times
/// give the same samples. Real devices are played by the task play alone. It may be used from several threads, whose calls take turns.
///
/// `effect` is the name of a built-in effect or the path of a file. `method` is the focusing method. `window_s` is the time from a touch to
/// its focus, in seconds, at most 10; None: the shortest window that reaches three quarters of the largest contrast. `block` is the number
/// of samples of a block, 8 to 8192. `full_limit` lets a gain of 1 be the surface's drive limit, instead of a level that moves the sheet by
/// about half its thickness.
#[pyclass(frozen, module = "unripple._unripple")]
pub struct Player {
    surface: Arc<unripple::core::Surface>,
    names: Vec<String>,
    block: usize,
    window: f64,
    pusher: Pusher,
    /// Samples played.
    clock: AtomicU64,
    session: Mutex<Session>,
}

/// What is played, and what the last call recorded.
struct Session {
    stepped: Stepped,
    heard: Vec<f32>,
    samples: usize,
}

/// What one finger felt: number of the touch, place (m), level (dB), contrast, and the time until which it felt it (s).
type Felt = (u64, (f64, f64), Option<f64>, Option<f64>, f64);

#[pymethods]
impl Player {
    #[new]
    #[pyo3(signature = (surface, effect, method, window_s, block, full_limit))]
    fn new(
        surface: &Bound<'_, Surface>,
        effect: String,
        method: &str,
        window_s: Option<&Bound<'_, PyAny>>,
        block: &Bound<'_, PyAny>,
        full_limit: bool,
    ) -> PyResult<Self> {
        let py = surface.py();
        let named = serde_json::json!({ "method": method }).to_string();
        let ask = play::Ask {
            surface: surface.get().ask().clone(),
            effect,
            window_s: window_s.map(|window| finite(window, "window_s")).transpose()?,
            block: whole(block, "block", BLOCKS.0..=BLOCKS.1)? as usize,
            full_limit,
            ..asked(&named).map_err(|error| raised(py, error))?
        };
        let (block, surface) = (ask.block, surface.get().inner().clone());
        let (pusher, source) = pushed(&surface.outline);
        let stepped = work(py, None, None, move |progress| Stepped::open(&ask, Box::new(source), progress))?;
        let (names, window) = (stepped.layout().outputs.clone(), stepped.window());
        let session = Mutex::new(Session { stepped, heard: Vec::new(), samples: 0 });
        Ok(Self { surface, names, block, window, pusher, clock: AtomicU64::new(0), session })
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

    /// Time from a touch to its focus, in seconds.
    #[getter]
    fn window_s(&self) -> f64 {
        self.window
    }

    /// Time played, in seconds: that of the next block's first sample.
    #[getter]
    fn time_s(&self) -> f64 {
        self.clock.load(Ordering::Acquire) as f64 / self.surface.emission.rate
    }

    /// Puts a finger down at a place, x and y in metres, at a time in seconds; None: now. It is noticed at the beginning of the first block
    /// at this time or later. `finger` is a number of the caller's, which may be used again once the finger has been lifted. `force_n` is
    /// the force that it presses with, 0 to 100 N; None: unknown.
    ///
    /// Raises AskError for a finger that is down, a place off the surface, a time that has passed, and where too many fingers or touches
    /// wait.
    #[pyo3(signature = (finger, at_m, time_s=None, force_n=None))]
    fn down(
        &self,
        finger: &Bound<'_, PyAny>,
        at_m: &Bound<'_, PyAny>,
        time_s: Option<&Bound<'_, PyAny>>,
        force_n: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        self.push(finger, Phase::Down, Some(at_m), time_s, force_n)
    }

    /// Moves a finger that is down, as down() does; its times may not decrease.
    #[pyo3(name = "move", signature = (finger, at_m, time_s=None, force_n=None))]
    fn shift(
        &self,
        finger: &Bound<'_, PyAny>,
        at_m: &Bound<'_, PyAny>,
        time_s: Option<&Bound<'_, PyAny>>,
        force_n: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        self.push(finger, Phase::Move, Some(at_m), time_s, force_n)
    }

    /// Lifts a finger where it was last, at a time in seconds; None: now.
    #[pyo3(signature = (finger, time_s=None))]
    fn up(&self, finger: &Bound<'_, PyAny>, time_s: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        self.push(finger, Phase::Up, None, time_s, None)
    }

    /// Plays so many blocks, with the GIL released, and returns what is sent to the actuators: float32 [actuator, blocks · block] in their
    /// units. An exception of a signal's handler, as of Ctrl+C, ends a long call; a part has been played then.
    fn step<'py>(&self, blocks: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (py, actuators) = (blocks.py(), self.names.len());
        let most = MOST_SAMPLES / (self.block * (actuators + 1)) as u64;
        let blocks = whole(blocks, "blocks", 0..=most.max(1))? as usize;
        let samples = blocks * self.block;
        let mut drive = vec![0.0_f32; actuators * samples];
        let mut heard = vec![0.0_f32; (actuators + 1) * samples];
        let mut done = 0;
        while done < samples {
            done = brief(py, || self.play([&mut drive, &mut heard], samples, done))?;
            if done < samples {
                py.check_signals()?;
            }
        }
        brief(py, || {
            let mut session = self.session();
            (session.heard, session.samples) = (heard, samples);
            Ok(())
        })?;
        owned(py, drive, [actuators, samples])
    }

    /// What the simulated surface answered to the blocks of the last step(): the signals of the sensors, float32 [actuator, sample] in the
    /// sensors' units, and the velocity at the probe, in the middle of the surface, float32 [sample] in m/s.
    fn heard<'py>(&self, py: Python<'py>) -> PyResult<Heard<'py>> {
        let (mut sensors, samples) = brief(py, || {
            let session = self.session();
            Ok((session.heard.clone(), session.samples))
        })?;
        let probe = sensors.split_off(self.names.len() * samples);
        Ok((owned(py, sensors, [self.names.len(), samples])?, probe.into_pyarray(py)))
    }

    /// What fingers felt of the simulated surface, at the last of the looks that are made every 0.2 s of played time: for each touch its
    /// number, counted from 1 in the order of coming, its place (x and y in metres), the level in dB above the threshold of touch (None: it
    /// felt nothing), the contrast (None: it felt nothing), and the time of the look in seconds, up to which it felt this since the look before.
    fn felt(&self, py: Python<'_>) -> PyResult<Vec<Felt>> {
        brief(py, || {
            let session = self.session();
            let (felt, until) = (session.stepped.feelings(), session.stepped.felt_at());
            Ok(felt.iter().map(|f| (f.finger, (f.at.x, f.at.y), f.level_db, f.contrast, until)).collect())
        })
    }

    /// The report on what was played and felt so far, with the keys that the task play reports, as JSON.
    fn report(&self, py: Python<'_>) -> PyResult<String> {
        Ok(brief(py, || commands::Done::of(&self.session().stepped.report(), None))?.json)
    }

    /// The same report, as JSON and as text.
    #[getter]
    fn done(&self, py: Python<'_>) -> PyResult<Done> {
        brief(py, || Done::of(&self.session().stepped.report(), None))
    }
}

impl Player {
    fn session(&self) -> MutexGuard<'_, Session> {
        self.session.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pushes a touch of a finger; one that is lifted has no place of its own.
    fn push(
        &self,
        finger: &Bound<'_, PyAny>,
        phase: Phase,
        at_m: Option<&Bound<'_, PyAny>>,
        time_s: Option<&Bound<'_, PyAny>>,
        force_n: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (py, now) = (finger.py(), self.time_s());
        let finger = whole(finger, "finger", 0..=u64::MAX)?;
        let at = at_m.map_or(Ok(Point::default()), |at| place(at, "at_m", &self.surface.outline))?;
        let force = force_n.map(|force| finite(force, "force_n")).transpose()?;
        let time = time_s.map_or(Ok(now), |time| finite(time, "time_s"))?;
        if time < now {
            return Err(ask(py, "time_s", format!("{now} or later, the time that has been played"), time));
        }
        brief(py, || self.pusher.push(Touch { finger, phase, at, time, force }).map_err(refused))
    }

    /// Plays the blocks from the sample `first` on, until all have been played or it is time to look for signals, and returns the first
    /// sample that has not been played. The drive and what is recorded are put into planes of `samples`, one channel after the other.
    fn play(
        &self,
        [drive, heard]: [&mut [f32]; 2],
        samples: usize,
        mut first: usize,
    ) -> Result<usize, TaskError> {
        let (mut session, began, block) = (self.session(), Instant::now(), self.block);
        while first < samples {
            session.stepped.step()?;
            self.clock.fetch_add(block as u64, Ordering::Release);
            for (to, from) in [(&mut *drive, session.stepped.drive()), (&mut *heard, session.stepped.heard())]
            {
                for (plane, from) in to.chunks_exact_mut(samples).zip(from.chunks_exact(block)) {
                    plane[first..first + block].copy_from_slice(from);
                }
            }
            first += block;
            if began.elapsed() >= TURN {
                break;
            }
        }
        Ok(first)
    }
}

/// A touch that is refused, as an error of the argument that it names.
fn refused(error: TouchError) -> TaskError {
    match error {
        TouchError::Pushed { what, expected, found } => TaskError::ask(what, expected, found),
        error => TaskError::from(error),
    }
}
