//! Computations on a thread beside the session, with the results of the command line: what takes longer than a picture may wait.

mod compare;
mod design;
mod measure;
mod queue;

pub use queue::Queue;

use crate::edition::Edition;
use crate::outbox::{Out, Outbox};
use crate::simulation::Replay;
use crate::wire::Measure;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use unripple::act::{self, ActError, Note, Report};
use unripple::core::{Point, Responses, Surface};
use unripple::drafting::Draft;
use unripple::focus::{Method, Options};

/// Name on the command line of a surface that was edited on the page: that of the file in which it is saved.
const SAVED: &str = "surface.toml";

/// Function that gives the responses of a library at some places (m), or says in words why it cannot.
pub type Responder = Arc<dyn Fn(&[Point]) -> Result<Responses, String> + Send + Sync>;

/// A computation that a page asks for. A focus is computed for the surface that the page showed, even if it has been edited since.
pub enum Task {
    /// The design figures of a surface.
    Design(Arc<Edition>),
    /// A focus, computed and evaluated with all figures.
    Measure {
        /// Targets, method and level.
        measure: Measure,
        /// The surface that the page showed.
        of: Arc<Edition>,
        /// The page that asked.
        page: u64,
    },
    /// Two focusing methods on the same targets.
    Compare {
        /// Places of the targets, in mm.
        at: Vec<[f64; 2]>,
        /// Names of the two methods.
        methods: Vec<String>,
        /// The window, in ms; 0 or `None` for the recommended one.
        window_ms: Option<f64>,
        /// The surface that the page showed.
        of: Arc<Edition>,
        /// The page that asked.
        page: u64,
    },
}

/// A result of the worker.
pub enum Found {
    /// A message for pages.
    Out(Out),
    /// Two simulated drives, to be shown side by side.
    Replay(Box<Replay>),
}

/// Callback that receives each result at once.
pub type Hear<'a> = dyn FnMut(Found) + 'a;

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
}

impl ComputeWorker {
    /// A worker for a surface: its name, the responses of its library if it has one, and the reason why their scale is unknown if it is;
    /// `newest` is the number of the edit that pages see.
    pub fn new(
        (source, stored, without_scale): (String, Option<Responder>, Option<String>),
        newest: Arc<AtomicU64>,
    ) -> Self {
        Self { source, stored, without_scale, draft: None, place: None, newest }
    }

    /// Performs a task, and passes its results to `hear`.
    pub fn work(&mut self, task: Task, hear: &mut Hear) {
        let (page, done) = match task {
            Task::Design(edition) => return self.design(&edition, hear),
            Task::Measure { measure, of, page } => (page, self.measure(&measure, &of, hear)),
            Task::Compare { at, methods, window_ms, of, page } => {
                let window = given(window_ms).map(|ms| ms * 1e-3);
                (page, self.compare(&at, &methods, window, &of, hear))
            }
        };
        if let Err(why) = done {
            hear(Found::Out(Out::Refuse(page, why)));
        }
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
    fn draft(&mut self, of: &Edition) -> Result<Arc<Draft>, ActError> {
        if let Some((_, draft)) = self.draft.as_ref().filter(|(edit, _)| *edit == of.edit) {
            return Ok(draft.clone());
        }
        let draft = Arc::new(Draft::of(&of.surface)?);
        self.draft = Some((of.edit, draft.clone()));
        Ok(draft)
    }

    /// The window in s that is asked for, or else the recommended one with a note on the reason for it.
    fn window(&self, of: &Edition, responses: &Responses, asked: Option<f64>) -> (f64, Option<Note>) {
        if let Some(seconds) = asked {
            return (seconds, None);
        }
        let stored = of.edit == 0 && self.stored.is_some();
        let known = self.draft.as_ref().filter(|(edit, _)| *edit == of.edit && !stored);
        let (seconds, text) = match known.map(|(_, draft)| draft.design()) {
            Some(design) => (design.window_recommended_s, design.window_text()),
            None => {
                let chosen = act::chosen_window(&of.surface, responses);
                (chosen.seconds, chosen.text())
            }
        };
        (seconds, Some(Note { topic: "window", text }))
    }

    /// Responses of a surface that include some places.
    fn known(&mut self, of: &Edition, places: &[Point]) -> Result<Arc<Responses>, String> {
        self.place = places.first().copied();
        if let Some(stored) = self.stored.as_ref().filter(|_| of.edit == 0) {
            return Ok(Arc::new(stored(places)?));
        }
        Ok(self.draft(of).map_err(text)?.responses().map_err(text)?.clone())
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

fn text(error: ActError) -> String {
    error.to_string()
}

/// Has a message sent to all pages.
fn tell(hear: &mut Hear, kind: &str, message: &serde_json::Value) {
    let mut out = Outbox::default();
    out.tell(kind, message);
    out.take().into_iter().for_each(|out| hear(Found::Out(out)));
}
