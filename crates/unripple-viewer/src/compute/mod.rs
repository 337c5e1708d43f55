//! Where figures are computed, as the command line computes them: what takes longer than a picture may wait, done beside the session.

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

/// What a surface is called on the command line that is none of those it knows: as its file is saved.
const SAVED: &str = "surface.toml";

/// The responses of a library at some places.
pub type Responder = Arc<dyn Fn(&[Point]) -> Result<Responses, String> + Send + Sync>;

/// What is to be computed. An act is of the surface that was shown where it was asked for, whatever has become of it meanwhile.
pub enum Task {
    /// The figures of a surface.
    Design(Arc<Edition>),
    /// One act of focusing, with all its figures.
    Measure {
        /// Targets, method and level.
        measure: Measure,
        /// Of which surface.
        of: Arc<Edition>,
        /// The page that asked.
        page: u64,
    },
    /// Two methods on the same touch.
    Compare {
        /// Where, in mm.
        at: Vec<[f64; 2]>,
        /// Names of the two methods.
        methods: Vec<String>,
        /// The window, in ms; 0 or nothing for the surface's own.
        window_ms: Option<f64>,
        /// Of which surface.
        of: Arc<Edition>,
        /// The page that asked.
        page: u64,
    },
}

/// What the worker finds.
pub enum Found {
    /// A message for pages.
    Out(Out),
    /// Two acts side by side, to be played.
    Replay(Box<Replay>),
}

/// Whoever hears at once what is found.
pub type Hear<'a> = dyn FnMut(Found) + 'a;

/// Computes figures, and keeps what the next ones need too.
pub struct ComputeWorker {
    /// What the surface is called on the command line, and the responses of a library: both of the surface before any edit.
    source: String,
    stored: Option<Responder>,
    /// Why nobody knows what those responses mean, if nobody does.
    without_scale: Option<String>,
    /// The surface that was worked on last, by its edit.
    draft: Option<(u64, Arc<Draft>)>,
    /// Where the last act was.
    place: Option<Point>,
    /// The newest edit of the surface.
    newest: Arc<AtomicU64>,
}

impl ComputeWorker {
    /// A worker for a surface, by its name, and its library, if it has one; `newest` is the edit that pages see.
    pub fn new(
        (source, stored, without_scale): (String, Option<Responder>, Option<String>),
        newest: Arc<AtomicU64>,
    ) -> Self {
        Self { source, stored, without_scale, draft: None, place: None, newest }
    }

    /// Does a task.
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

    /// Whether pages see another surface by now.
    fn is_overtaken(&self, edition: &Edition) -> bool {
        self.newest.load(Ordering::Relaxed) > edition.edit
    }

    /// What a surface is called on the command line.
    fn source(&self, of: &Edition) -> &str {
        if of.edit == 0 { &self.source } else { SAVED }
    }

    /// Why lengths and velocities on a surface mean nothing, if they do not.
    fn unscaled(&self, of: &Edition) -> Option<&str> {
        self.without_scale.as_deref().filter(|_| of.edit == 0)
    }

    /// A report without what nobody knows.
    fn known_of(&self, report: Report, of: &Edition) -> Report {
        if self.unscaled(of).is_some() { report.without_scale() } else { report }
    }

    /// The modes of a surface, and what stands on them.
    fn draft(&mut self, of: &Edition) -> Result<Arc<Draft>, ActError> {
        if let Some((_, draft)) = self.draft.as_ref().filter(|(edit, _)| *edit == of.edit) {
            return Ok(draft.clone());
        }
        let draft = Arc::new(Draft::of(&of.surface)?);
        self.draft = Some((of.edit, draft.clone()));
        Ok(draft)
    }

    /// The window in s that is asked for, or else the recommended one and the note that says why it is that.
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

    /// The responses of a surface, which hold some places.
    fn known(&mut self, of: &Edition, places: &[Point]) -> Result<Arc<Responses>, String> {
        self.place = places.first().copied();
        if let Some(stored) = self.stored.as_ref().filter(|_| of.edit == 0) {
            return Ok(Arc::new(stored(places)?));
        }
        Ok(self.draft(of).map_err(text)?.responses().map_err(text)?.clone())
    }
}

/// The options of an act, as the command line makes them.
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
