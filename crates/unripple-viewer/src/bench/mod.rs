//! Where figures are computed, as the command line computes them: a thread of its own.

mod compare;
mod design;
mod measure;

use crate::board::Board;
use crate::link::Caller;
use crate::rig::Order;
use crate::studio::Measured;
use crate::wire::Measure;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender};
use std::sync::{Arc, Mutex};
use unripple::act::{self, ActError};
use unripple::core::{Point, Responses, Surface};
use unripple::drafting::Draft;
use unripple::focus::{Method, Options};

/// Tasks that may wait.
const MOST_WAITING: usize = 16;

/// What a surface is called on the command line that is none of those it knows: as its file is saved.
const SAVED: &str = "surface.toml";

/// The responses of a library at some places.
pub type Responder = Arc<dyn Fn(&[Point]) -> Result<Responses, String> + Send + Sync>;

/// What is to be computed.
pub enum Task {
    /// The figures of a surface, and the number of its edit.
    Design {
        /// Which edit made it.
        edit: u64,
        /// The surface.
        surface: Box<Surface>,
    },
    /// One act.
    Measure(Measure, Caller),
    /// Two methods on the same touch.
    Compare {
        /// Where, in mm.
        at: Vec<[f64; 2]>,
        /// Which.
        methods: Vec<String>,
        /// The window, in ms; 0 or nothing for the surface's own.
        window_ms: Option<f64>,
        /// Who asked.
        caller: Caller,
    },
}

/// The thread's own.
pub struct Bench {
    board: Arc<Board>,
    rig: Sender<Order>,
    measured: Arc<Mutex<Option<Measured>>>,
    source: String,
    /// Responses of a library at some places, as long as the surface is the library's.
    stored: Option<Responder>,
    surface: Option<Surface>,
    draft: Option<Arc<Draft>>,
    /// Where the last act was.
    place: Option<Point>,
    waiting: VecDeque<Task>,
    /// Surfaces that were asked for and not begun.
    pending: Arc<AtomicUsize>,
}

impl Bench {
    /// A bench that shows results to pages and acts to the rig; `pending` counts surfaces on their way here.
    pub fn new(
        board: Arc<Board>,
        rig: Sender<Order>,
        measured: Arc<Mutex<Option<Measured>>>,
        (source, stored): (String, Option<Responder>),
        pending: Arc<AtomicUsize>,
    ) -> Self {
        let (surface, draft, place) = (None, None, None);
        Self {
            board,
            rig,
            measured,
            source,
            stored,
            surface,
            draft,
            place,
            waiting: VecDeque::new(),
            pending,
        }
    }

    /// Works until nobody asks any more. Of surfaces only the newest is computed.
    pub fn run(mut self, tasks: Receiver<Task>) {
        while let Ok(task) = tasks.recv() {
            self.waiting.push_back(task);
            while let Some(task) = self.next(&tasks) {
                self.work(task);
            }
        }
    }

    /// The next task, surfaces that were overtaken left out.
    fn next(&mut self, tasks: &Receiver<Task>) -> Option<Task> {
        self.waiting.extend(tasks.try_iter());
        self.pending.store(0, Ordering::Relaxed);
        let newest = self.waiting.iter().rposition(|task| matches!(task, Task::Design { .. }));
        let mut index = 0;
        self.waiting.retain(|task| {
            index += 1;
            !matches!(task, Task::Design { .. }) || Some(index - 1) == newest
        });
        while self.waiting.len() > MOST_WAITING {
            match self.waiting.pop_back() {
                Some(Task::Measure(_, caller) | Task::Compare { caller, .. }) => {
                    caller.refuse("measuring: expected one after the other, found too many at once");
                }
                Some(Task::Design { .. }) | None => {}
            }
        }
        self.waiting.pop_front()
    }

    fn work(&mut self, task: Task) {
        match task {
            Task::Design { edit, surface } => {
                if edit > 0 {
                    self.stored = None;
                    self.source = SAVED.into();
                }
                self.draft = None;
                self.surface = Some((*surface).clone());
                self.design(edit, *surface);
            }
            Task::Measure(measure, caller) => {
                self.measure(&measure).unwrap_or_else(|why| caller.refuse(&why))
            }
            Task::Compare { at, methods, window_ms, caller } => {
                let window = given(window_ms).map(|ms| ms * 1e-3);
                self.compare(&at, &methods, window).unwrap_or_else(|why| caller.refuse(&why));
            }
        }
    }

    /// Whether another surface is on its way.
    fn is_overtaken(&self) -> bool {
        self.pending.load(Ordering::Relaxed) > 0
    }

    /// The surface and its responses, which hold some places.
    fn known(&mut self, places: &[Point]) -> Result<(Surface, Arc<Responses>), String> {
        let surface = self.surface.clone().ok_or("no surface yet")?;
        self.place = places.first().copied();
        if let Some(stored) = &self.stored {
            return Ok((surface, Arc::new(stored(places)?)));
        }
        if self.draft.is_none() {
            self.draft = Some(Arc::new(Draft::of(&surface).map_err(text)?));
        }
        let draft = self.draft.as_ref().ok_or("no surface yet")?;
        Ok((surface, draft.responses().map_err(text)?.clone()))
    }
}

/// The options of an act, as the command line makes them.
fn options(surface: &Surface, responses: &Responses, method: Method, window: Option<f64>) -> Options {
    let window = window.unwrap_or_else(|| act::recommended_window(surface, responses));
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
