//! Drives computed on demand, from modes or from a library's responses.

use crate::LiveError;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use unripple_calibrate::{Between, BetweenOptions};
use unripple_core::threads;
use unripple_core::{Drive, Point, Responses, SampledResponses};
use unripple_field::{Aim, Field, Reach};
use unripple_focus::{Focuser, Options, Target};
use unripple_physics::Medium;

/// A drive, scaled to the actuators' limit, that focuses once: at one or more points simultaneously, at the
/// instant of its last sample.
#[derive(Clone, Debug)]
pub struct FocusDrive {
    /// The drive, in the actuators' unit, at the limit of the focusing options; gains below 1 make it weaker.
    pub drive: Arc<Drive>,
    /// Index of the sample at the focal instant.
    pub instant: usize,
    /// Points of the focus, in m: those requested, or the nearest ones for which responses are stored.
    pub points: Vec<Point>,
}

/// Computes drives for one state of the surface, on a thread of its own that owns the responses and what was prepared
/// for them; where there are no threads, on that of its caller.
///
/// ```
/// use std::sync::Arc;
/// use unripple_core::Point;
/// use unripple_focus::Options;
/// use unripple_live::FocusWorker;
/// use unripple_physics::{ResponseOptions, design::papers_surface, responses};
///
/// let mut film = papers_surface();
/// film.emission.band[1] = 500.0;
/// let known = Arc::new(responses(&film, &ResponseOptions::default())?);
/// let maker = FocusWorker::new(known, &Options::default())?;
/// let made = maker.focus(&[Point::from_mm(62.0, 90.0)])?;
/// assert_eq!(made.drive.peak(), 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FocusWorker(Maker);

/// What answers requests.
enum Maker {
    /// A thread of its own.
    Thread(Sender<Ask>),
    /// The caller's thread.
    Here(Box<dyn Fn(Work) -> Result<Answer, LiveError> + Send + Sync>),
}

impl std::fmt::Debug for Maker {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Thread(_) => "Thread",
            Self::Here(_) => "Here",
        })
    }
}

/// A request to a maker's thread, and where the answer goes.
struct Ask {
    work: Work,
    reply: Sender<Result<Answer, LiveError>>,
}

enum Work {
    /// Asks for a priority; nothing is answered but that it was done.
    Hurry(Option<u8>),
    Focus(Vec<Point>),
    Trace(FocusDrive),
    Reach(FocusDrive),
}

enum Answer {
    Hurried,
    FocusDrive(FocusDrive),
    Trace(Vec<f64>),
    Reach(Reach),
}

impl FocusWorker {
    /// Starts the worker's thread, and waits until it has prepared a method of focusing for these responses.
    ///
    /// # Errors
    /// [`LiveError::Focus`] for responses or options that the method does not allow.
    pub fn new(responses: Arc<Responses>, options: &Options) -> Result<Self, LiveError> {
        Self::planned(responses, options, || ())
    }

    /// As [`FocusWorker::new`], with a function that is called before each drive is computed.
    pub(crate) fn planned(
        responses: Arc<Responses>,
        options: &Options,
        before: impl Fn() + Send + 'static,
    ) -> Result<Self, LiveError> {
        if !threads::AVAILABLE {
            return Self::here(responses, options);
        }
        let options = options.clone();
        Self::spawn(move |ready| {
            let focuser = match Focuser::new(&responses, &options) {
                Ok(focuser) => focuser,
                Err(error) => return ready.fail(error.into()),
            };
            ready.serve(|work| match work {
                Work::Hurry(priority) => Ok(hurried(priority)),
                Work::Focus(points) => {
                    before();
                    focus(&focuser, points).map(Answer::FocusDrive)
                }
                Work::Trace(made) => trace(&responses, &made).map(Answer::Trace),
                Work::Reach(made) => reach(&responses, &made).map(Answer::Reach),
            });
        })
    }

    /// A worker without a thread: whoever asks computes. The method of focusing is prepared for each drive, which takes longer with those
    /// that solve systems of equations.
    fn here(responses: Arc<Responses>, options: &Options) -> Result<Self, LiveError> {
        let options = options.clone();
        // What the method does not allow is refused now.
        Focuser::new(&responses, &options)?;
        let answer = move |work| match work {
            Work::Hurry(_) => Ok(Answer::Hurried),
            Work::Focus(points) => {
                focus(&Focuser::new(&responses, &options)?, points).map(Answer::FocusDrive)
            }
            Work::Trace(made) => trace(&responses, &made).map(Answer::Trace),
            Work::Reach(made) => reach(&responses, &made).map(Answer::Reach),
        };
        Ok(Self(Maker::Here(Box::new(answer))))
    }

    /// A worker for responses measured at points, which focuses at any place between them. [`Between`]
    /// interpolates the responses there, with the wavenumbers of `medium`. For each focus the method has
    /// responses at the points of the focus only. So only time reversal and its variants are useful; methods
    /// that minimise motion elsewhere on the surface are not.
    ///
    /// # Errors
    /// [`LiveError::Calibrate`] for a library without points, and those of [`FocusWorker::new`]; [`LiveError::Gone`] where there are no
    /// threads.
    pub fn between(
        stored: Arc<SampledResponses>,
        medium: Medium,
        options: &Options,
    ) -> Result<Self, LiveError> {
        let options = options.clone();
        Self::spawn(move |ready| {
            let plan = Between::plan(&stored, |omega| medium.wavenumber(omega), &BetweenOptions::default());
            let between = match plan {
                Ok(between) => between,
                Err(error) => return ready.fail(error.into()),
            };
            let at = |points: &[Point]| between.onto(points).map(Responses::Sampled);
            ready.serve(|work| match work {
                Work::Hurry(priority) => Ok(hurried(priority)),
                Work::Focus(points) => {
                    let responses = at(&points)?;
                    focus(&Focuser::new(&responses, &options)?, points).map(Answer::FocusDrive)
                }
                Work::Trace(made) => trace(&at(&made.points)?, &made).map(Answer::Trace),
                Work::Reach(made) => reach(&at(&made.points)?, &made).map(Answer::Reach),
            });
        })
    }

    /// Starts a thread that prepares first, and then answers requests.
    fn spawn(work: impl FnOnce(Ready) + Send + 'static) -> Result<Self, LiveError> {
        if !threads::AVAILABLE {
            return Err(LiveError::Gone { why: "there are no threads here".into() });
        }
        let (asks, asked) = channel();
        let (planned, ready) = channel();
        let spawned = threads::start("focus", move || work(Ready { planned, asked }));
        spawned.map_err(|error| LiveError::Gone { why: error.to_string() })?;
        ready.recv().map_err(|_| gone())??;
        Ok(Self(Maker::Thread(asks)))
    }

    fn ask(&self, work: Work) -> Result<Answer, LiveError> {
        let asks = match &self.0 {
            Maker::Thread(asks) => asks,
            Maker::Here(answer) => return answer(work),
        };
        let (reply, answer) = channel();
        asks.send(Ask { work, reply }).map_err(|_| gone())?;
        answer.recv().map_err(|_| gone())?
    }

    /// Requests a real-time priority, 1 to 99, for the thread, for play on a busy machine; `None` requests nothing. A
    /// refusal is ignored.
    pub fn request_realtime(&self, priority: Option<u8>) {
        // Without it drives are made all the same.
        let _ = self.ask(Work::Hurry(priority));
    }

    /// The drive that focuses at these points, all at the same instant.
    ///
    /// # Errors
    /// Those of [`Focuser::focus`].
    pub fn focus(&self, points: &[Point]) -> Result<FocusDrive, LiveError> {
        match self.ask(Work::Focus(points.to_vec()))? {
            Answer::FocusDrive(made) => Ok(made),
            _ => Err(gone()),
        }
    }

    /// Displacement that a drive causes at the first point of its focus, in m, one value per sample from the drive's
    /// beginning. It lasts three times as long as the drive, or as long as the responses are known if
    /// that is shorter.
    ///
    /// # Errors
    /// Those of [`Field::traces`].
    pub fn trace(&self, made: &FocusDrive) -> Result<Vec<f64>, LiveError> {
        match self.ask(Work::Trace(made.clone()))? {
            Answer::Trace(trace) => Ok(trace),
            _ => Err(gone()),
        }
    }

    /// Largest motion that a drive causes on the surface. For a worker made by [`FocusWorker::between`], only the
    /// focus is taken into account.
    ///
    /// # Errors
    /// Those of [`Field::reach`].
    pub fn reach(&self, made: &FocusDrive) -> Result<Reach, LiveError> {
        match self.ask(Work::Reach(made.clone()))? {
            Answer::Reach(reach) => Ok(reach),
            _ => Err(gone()),
        }
    }
}

/// A worker's thread, before it has reported that it is ready.
struct Ready {
    planned: Sender<Result<(), LiveError>>,
    asked: Receiver<Ask>,
}

impl Ready {
    fn fail(self, error: LiveError) {
        // Whoever waited may have gone.
        let _ = self.planned.send(Err(error));
    }

    fn serve(self, work: impl Fn(Work) -> Result<Answer, LiveError>) {
        // One drive is too little work to be shared: waiting for threads of less priority takes longer than doing it.
        let _alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        if self.planned.send(Ok(())).is_ok() {
            for ask in self.asked {
                // Whoever asked may have gone meanwhile.
                let _ = ask.reply.send(work(ask.work));
            }
        }
    }
}

fn hurried(priority: Option<u8>) -> Answer {
    // A refusal is reported with the state of the audio thread.
    let _ = crate::priority::at(priority);
    Answer::Hurried
}

fn gone() -> LiveError {
    LiveError::Gone { why: "the one that makes drives ended early".into() }
}

fn focus(focuser: &Focuser, points: Vec<Point>) -> Result<FocusDrive, LiveError> {
    let focused = focuser.focus(&[Target::of(points)])?;
    let instant = focused.timing.first().map_or(0, |timing| timing.instant);
    let points = focused.points.into_iter().next().unwrap_or_default();
    Ok(FocusDrive { drive: Arc::new(focused.drive), instant, points })
}

/// Cells of the grid per shortest wavelength: enough for a level.
const CELLS: f64 = 4.0;

fn reach(responses: &Responses, made: &FocusDrive) -> Result<Reach, LiveError> {
    let drive = made.drive.as_ref().clone().as_emitted();
    let aim = Aim { points: made.points.clone(), instant: made.instant as f64 / drive.rate() };
    Ok(Field::new(responses, &drive, CELLS)?.reach(&[aim], None)?)
}

fn trace(responses: &Responses, made: &FocusDrive) -> Result<Vec<f64>, LiveError> {
    let Some(first) = made.points.first() else { return Ok(Vec::new()) };
    let drive = made.drive.as_ref().clone().as_emitted();
    let field = Field::new(responses, &drive, 1.0)?;
    let taken = (3 * made.instant).min(field.known().saturating_sub(1));
    let traces = field.traces(&[*first], taken as f64 / drive.rate())?;
    Ok(traces.into_iter().next().map_or_else(Vec::new, |trace| trace.displacement))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_physics::design::papers_surface;
    use unripple_physics::{ResponseOptions, responses};

    #[test]
    fn a_worker_makes_the_same_drives_with_and_without_a_thread() {
        let mut film = papers_surface();
        film.emission.band[1] = 300.0;
        let known = Arc::new(responses(&film, &ResponseOptions::default()).unwrap());
        let workers = [FocusWorker::new, FocusWorker::here]
            .map(|make| make(known.clone(), &Options::default()).unwrap());
        let places = [Point::from_mm(62.0, 90.0), Point::from_mm(30.0, 40.0)];
        let [there, here] = workers.each_ref().map(|worker| worker.focus(&places).unwrap());
        assert_eq!((there.drive.channels(), there.instant), (here.drive.channels(), here.instant));
        let traces = workers.each_ref().map(|worker| worker.trace(&here).unwrap());
        assert!(traces[0] == traces[1] && traces[0].iter().any(|x| *x != 0.0));
        let refused = Options { window: -1.0, ..Options::default() };
        assert!(FocusWorker::here(known, &refused).is_err());
    }
}
