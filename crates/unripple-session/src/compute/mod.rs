//! Computations that take too long to be done between two pictures: on a thread beside the session, with the
//! same results as on the command line.

mod compare;
mod design;
mod measure;
mod queue;
mod task;
mod window;

pub use queue::Queue;
pub use task::{Asked, Kind, Task};

use crate::edition::Edition;
use crate::outbox::{Out, Outbox};
use crate::simulation::Replay;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use unripple::act::{Judging, Report};
use unripple::core::{Point, Responses, Surface};
use unripple::drafting::Draft;
use unripple::focus::{Method, Options};
use unripple_tasks::{Lane, Progress, TaskError};

/// Name on the command line of a surface that was edited on the page: that of the file in which it is saved.
const SAVED: &str = "surface.toml";

/// Function that returns the responses of a library at some places (m), or the reason in words why it
/// cannot.
pub type Responder = Arc<dyn Fn(&[Point]) -> Result<Responses, String> + Send + Sync>;

/// A result of the compute worker: a message for pages, or simulated drives to be shown.
pub enum Found {
    /// A message for pages.
    Out(Out),
    /// Two simulated drives, to be shown side by side.
    Replay(Box<Replay>),
}

/// Callback that receives each result as soon as it has been computed.
pub type Hear<'a> = dyn FnMut(Found) + 'a;

/// How many calls that were given up may still run while the worker goes on, each with its memory and cores: the next must not wait for
/// the modes of a surface that nobody wants any more.
const BESIDE: usize = 1;

/// Why a task has no result.
enum Unfinished {
    /// The task was cancelled before it had a result.
    Stopped,
    /// Reason in words why it cannot be done.
    Refused(String),
}

impl From<String> for Unfinished {
    fn from(why: String) -> Self {
        Self::Refused(why)
    }
}

impl From<TaskError> for Unfinished {
    fn from(error: TaskError) -> Self {
        match error {
            TaskError::Cancelled => Self::Stopped,
            error => Self::Refused(error.to_string()),
        }
    }
}

/// Worker that computes figures, and keeps intermediate results for the next ones.
pub struct ComputeWorker {
    /// Name of the surface on the command line, and the responses of its library: both of the surface before any edit.
    source: String,
    stored: Option<Responder>,
    /// Reason why the scale of those responses is unknown, if it is.
    without_scale: Option<String>,
    /// The surface that was worked on last, by its edit.
    draft: Option<(u64, Arc<Draft>)>,
    /// Place of the last focus.
    place: Option<Point>,
    /// The newest edit of the surface.
    newest: Arc<AtomicU64>,
    /// Where calls run that cannot be interrupted.
    lane: Lane,
}

impl ComputeWorker {
    /// A worker for a surface, given by its name, the responses of its library if it has one, and the reason
    /// why the scale of these responses is unknown if it is; `newest` is the number of the edit that pages
    /// see.
    pub fn new(
        (source, stored, without_scale): (String, Option<Responder>, Option<String>),
        newest: Arc<AtomicU64>,
    ) -> Self {
        Self { source, stored, without_scale, draft: None, place: None, newest, lane: Lane::new(BESIDE) }
    }

    /// Performs a task, and passes its results to `hear`. Within 0.2 s after `progress` reports a
    /// cancellation, the task is given up, and the page that requested it is informed.
    pub fn work(&mut self, task: Task, progress: &mut dyn Progress, hear: &mut Hear) {
        let asked = task.asked();
        let done = match task {
            Task::Design(edition) => {
                self.design(&edition, progress, hear);
                Ok(())
            }
            Task::Measure { measure, of, page } => self.measure((&measure, page), &of, progress, hear),
            Task::Compare { id, at, methods, window_ms, of, .. } => {
                let window = given(window_ms).map(|ms| ms * 1e-3);
                self.compare(&at, &methods, window, (&of, id), progress, hear)
            }
        };
        let (Err(why), Some(Asked { page, id, .. })) = (done, asked) else { return };
        hear(Found::Out(match why {
            Unfinished::Stopped => Out::Stopped(page, id),
            Unfinished::Refused(why) => Out::Refuse(page, why),
        }));
    }

    /// Runs what cannot be interrupted on a thread of its own, until `progress` reports a cancellation.
    fn aside<R: Send + 'static>(
        &self,
        progress: &mut dyn Progress,
        work: impl FnOnce(&mut (dyn Progress + Send)) -> Result<R, TaskError> + Send + 'static,
    ) -> Result<R, Unfinished> {
        Ok(self.lane.run(work, progress)?)
    }

    /// Whether the surface has been edited again since.
    fn is_overtaken(&self, edition: &Edition) -> bool {
        self.newest.load(Ordering::Relaxed) > edition.edit
    }

    /// Name of a surface on the command line.
    fn source(&self, of: &Edition) -> &str {
        if of.edit == 0 { &self.source } else { SAVED }
    }

    /// Reason why absolute lengths and velocities on a surface are unknown, if they are.
    fn unscaled(&self, of: &Edition) -> Option<&str> {
        self.without_scale.as_deref().filter(|_| of.edit == 0)
    }

    /// The report, without absolute levels where these are unknown.
    fn known_of(&self, report: Report, of: &Edition) -> Report {
        if self.unscaled(of).is_some() { report.without_scale() } else { report }
    }

    /// The modes of a surface, and figures computed from them.
    fn draft(&mut self, of: &Arc<Edition>, progress: &mut dyn Progress) -> Result<Arc<Draft>, Unfinished> {
        if let Some((_, draft)) = self.draft.as_ref().filter(|(edit, _)| *edit == of.edit) {
            return Ok(draft.clone());
        }
        let edition = of.clone();
        let draft = self.aside(progress, move |_| Draft::of(&edition.surface).map_err(TaskError::work))?;
        let draft = Arc::new(draft);
        self.draft = Some((of.edit, draft.clone()));
        Ok(draft)
    }

    /// Responses of a surface that include some places.
    fn known(
        &mut self,
        of: &Arc<Edition>,
        places: &[Point],
        progress: &mut dyn Progress,
    ) -> Result<Arc<Responses>, Unfinished> {
        self.place = places.first().copied();
        if let Some(stored) = self.stored.clone().filter(|_| of.edit == 0) {
            let places = places.to_vec();
            return self.aside(progress, move |_| stored(&places).map(Arc::new).map_err(TaskError::Work));
        }
        let draft = self.draft(of, progress)?;
        self.aside(progress, move |_| draft.responses().cloned().map_err(TaskError::work))
    }

    /// What drives on a surface are evaluated on, and how far its modes go; `None` for a library, on whose own responses they are.
    fn judged(
        &mut self,
        of: &Arc<Edition>,
        progress: &mut dyn Progress,
    ) -> Result<Option<(Arc<Responses>, Judging)>, Unfinished> {
        if of.edit == 0 && self.stored.is_some() {
            return Ok(None);
        }
        let draft = self.draft(of, progress)?;
        self.aside(progress, move |_| draft.judged().cloned().map(Some).map_err(TaskError::work))
    }
}

/// The options of a focus, as the command line makes them.
fn options(surface: &Surface, method: Method, window: f64) -> Options {
    let (limit, rms_limit) = (surface.emission.limit, surface.emission.rms_limit);
    Options { method, window, limit, rms_limit, ..Options::default() }
}

/// A number of a message that says something: 0 stands for none.
fn given(value: Option<f64>) -> Option<f64> {
    value.filter(|value| *value > 0.0)
}

/// Places of a message.
fn places(at: &[[f64; 2]]) -> Vec<Point> {
    at.iter().map(|[x, y]| Point::from_mm(*x, *y)).collect()
}

fn method(name: &str) -> Result<Method, String> {
    name.parse::<Method>().map_err(|error| error.to_string())
}

/// Has a message sent to all pages.
fn tell(hear: &mut Hear, kind: &str, message: &serde_json::Value) {
    let mut out = Outbox::default();
    out.tell(kind, message);
    out.take().into_iter().for_each(|out| hear(Found::Out(out)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::Measure;
    use std::cell::Cell;
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;
    use unripple::act::model;
    use unripple::focus::Target;
    use unripple::physics::design::papers_surface;
    use unripple::physics::sample;
    use unripple_store::load_surface;
    use unripple_tasks::Silent;

    /// Gives a task up when it has been asked so often whether it is still wanted.
    struct Looks {
        most: usize,
        count: Cell<usize>,
    }

    impl Progress for Looks {
        fn cancelled(&self) -> bool {
            self.count.set(self.count.get() + 1);
            self.count.get() >= self.most
        }
    }

    /// Ten looks take a fifth of a second.
    fn ten() -> Looks {
        Looks { most: 10, count: Cell::new(0) }
    }

    fn small() -> Surface {
        let mut film = papers_surface();
        film.emission.band[1] = 700.0;
        film
    }

    fn worker(stored: Option<Responder>) -> ComputeWorker {
        ComputeWorker::new(("small".into(), stored, None), Arc::default())
    }

    /// What page 7 hears of its request 3 for a focus on a surface, with a window in ms.
    fn measured(
        worker: &mut ComputeWorker,
        (edit, surface): (u64, Surface),
        window_ms: Option<f64>,
        progress: &mut dyn Progress,
    ) -> Vec<Out> {
        let measure = Measure { id: 3, at: vec![[62.0, 90.0]], window_ms, ..Measure::default() };
        let task = Task::Measure { measure, of: Arc::new(Edition { edit, surface }), page: 7 };
        let mut heard = Vec::new();
        worker.work(task, progress, &mut |found| match found {
            Found::Out(out) => heard.push(out),
            Found::Replay(_) => panic!("nothing was to be compared"),
        });
        heard
    }

    #[test]
    fn a_focus_on_a_heavy_surface_is_given_up_at_the_first_look_that_says_so() {
        // The modes of this outline need a mesh and take seconds: longer than ten looks.
        let film = load_surface("stadium-film").unwrap();
        let mut looks = ten();
        let heard = measured(&mut worker(None), (1, film), None, &mut looks);
        assert!(matches!(heard[..], [Out::Stopped(7, 3)]), "{heard:?}");
        assert_eq!(looks.count.get(), 10);
    }

    #[test]
    fn what_was_given_up_keeps_nothing_else_waiting() {
        let released = Arc::new(AtomicBool::new(false));
        let waits = released.clone();
        let library: Responder = Arc::new(move |_| {
            while !waits.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err("nobody waits for this".into())
        });
        let (mut worker, mut looks) = (worker(Some(library)), ten());
        let heard = measured(&mut worker, (0, small()), None, &mut looks);
        assert!(matches!(heard[..], [Out::Stopped(7, 3)]), "{heard:?}");
        assert_eq!(looks.count.get(), 10);
        // A surface that was edited has modes, while the library still gives no answer.
        let heard = measured(&mut worker, (1, small()), None, &mut Silent);
        assert!(matches!(heard[..], [Out::Measured(_), Out::Answer(7, _)]), "{heard:?}");
        released.store(true, Ordering::Relaxed);
    }

    /// Why a focus with a window in ms is refused.
    fn refused(worker: &mut ComputeWorker, edit: u64, window_ms: f64) -> String {
        match &measured(worker, (edit, small()), Some(window_ms), &mut Silent)[..] {
            [Out::Refuse(7, why)] => why.clone(),
            other => panic!("{window_ms} ms is not refused: {other:?}"),
        }
    }

    #[test]
    fn a_window_is_refused_in_the_words_of_the_command_line() {
        let Responses::Modal(modal) = model(&small(), None, &[]).unwrap() else { panic!("no modes") };
        let place = [Point::from_mm(62.0, 90.0)];
        let sampled = Responses::Sampled(sample(&modal, &place, 500));
        let options = options(&small(), Method::default(), 0.1);
        let error = unripple::focus::focus(&sampled, &[Target::at(place[0])], &options).unwrap_err();
        let mut worker = worker(Some(Arc::new(move |_| Ok(sampled.clone()))));
        assert_eq!(refused(&mut worker, 0, 100.0), error.to_string());
        // Modes have no end, but nothing is left of them after a while.
        let why = refused(&mut worker, 1, 9000.0);
        assert!(why.starts_with("samples of the window: expected at most "), "{why}");
        assert!(why.contains(", the length of the responses") && why.ends_with(", found 432001"), "{why}");
        let why = refused(&mut worker, 1, 1.0);
        assert!(why.starts_with("window_ms: expected at least 1.4286 ms"), "{why}");
    }
}
