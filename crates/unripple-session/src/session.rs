//! The state that all pages share, as a state machine. It takes the pages' commands and the time that passes; it gives messages, pictures
//! and work to be done beside it. It uses no thread, clock or network: whoever runs it provides them.

use crate::ViewError;
use crate::compute::{Asked, ComputeWorker, Found, Kind, Queue, Responder, Task};
use crate::edition::{Edition, Editions};
use crate::editor::Editor;
use crate::messages::Settled;
use crate::outbox::{Out, Outbox};
use crate::simulation::{Instrument, Order, Simulation, Spec};
use crate::stop::Stop;
use crate::wire::Command;
use serde_json::json;
use std::collections::BTreeSet;
use std::sync::Arc;
use unripple::core::Point;
use unripple_tasks::{Lane, TaskError};

#[cfg(test)]
mod tests;

/// Work too slow to be done between two pictures, with the flag that cancels it. It is done on other threads, one of each kind
/// at a time.
pub enum Errand {
    /// Build the instrument that plays a surface: [`build`](Self::build) does it.
    Build(Box<Spec>, Stop),
    /// Compute figures, by the session's [`ComputeWorker`].
    Compute(Task, Stop),
}

/// Result of work that the session had others do on threads of their own: builds, computations and tasks.
pub enum Done {
    /// An instrument that was built, or the reason why it cannot be; [`ViewError::Stopped`] if its build was
    /// cancelled.
    Built(Result<Box<Instrument>, ViewError>),
    /// One result of a computation.
    Found(Found),
    /// The computation is complete.
    Computed,
}

impl Errand {
    /// Builds the instrument (device, engine and modes of a surface) that a specification describes, on a thread of `lane`; stops when
    /// `stop` says that it is no longer wanted.
    pub fn build(spec: Box<Spec>, stop: &Stop, lane: &Lane) -> Done {
        let built = lane.run(move |progress| Ok(Instrument::build(*spec, progress)), &mut stop.watch());
        let built = built.unwrap_or_else(|error| match error {
            TaskError::Cancelled => Err(ViewError::Stopped),
            error => Err(ViewError::Gone { why: error.to_string() }),
        });
        Done::Built(built.map(Box::new))
    }
}

/// The state that all pages share: simulation, editor and messages.
pub struct Session {
    simulation: Simulation,
    editor: Editor,
    editions: Editions,
    tasks: Queue,
    /// Numbers of the open pages that have said something.
    pages: BTreeSet<u64>,
    out: Outbox,
}

impl Session {
    /// A session that plays an instrument.
    pub fn new(instrument: Instrument, told: Settled) -> Self {
        let editor = Editor::new(&instrument, told);
        let mut out = Outbox::default();
        out.tell("settings", &editor.settings(&instrument));
        out.tell("chosen", &editor.chosen());
        let mut simulation = Simulation::new(instrument);
        simulation.begin(&mut out);
        let (editions, tasks) = (Editions::default(), Queue::default());
        let mut session = Self { simulation, editor, editions, tasks, pages: BTreeSet::new(), out };
        session.renew();
        session
    }

    /// The worker that computes figures for this session. `known` is the name of the first surface on the command line, the responses of
    /// its library, and the reason why their scale is unknown.
    pub fn compute(&self, known: (String, Option<Responder>, Option<String>)) -> ComputeWorker {
        ComputeWorker::new(known, self.editions.newest())
    }

    /// Records that a page was opened, which must be sent a picture.
    pub fn come(&mut self) {
        self.simulation.obey(Order::Look, &mut self.out);
    }

    /// Records that a page was closed; its fingers are lifted, and the computations that it requested are
    /// cancelled.
    pub fn leave(&mut self, page: u64) {
        self.pages.remove(&page);
        self.simulation.obey(Order::Leave(page), &mut self.out);
        self.give_up(|asked| asked.page == page);
    }

    /// Carries out a command of a page; pages are numbered from 1. Commands for the link or for jobs are ignored here.
    pub fn hear(&mut self, page: u64, command: Command) {
        self.pages.insert(page);
        match command {
            Command::Touch { finger, phase, at_mm: [x, y] } => {
                self.order(Order::Touch((page, finger), phase, Point::from_mm(x, y)));
            }
            Command::Transport(transport) => self.order(Order::Transport(transport)),
            Command::Probe(probe) => self.order(Order::Probe(probe)),
            Command::Settings(settings) => {
                match settings.quantity.as_deref() {
                    None => {}
                    Some("displacement") => self.order(Order::Velocity(false)),
                    Some("velocity") => self.order(Order::Velocity(true)),
                    Some(other) => {
                        let why = format!("quantity: expected displacement or velocity, found {other}");
                        self.out.refuse(page, why);
                    }
                }
                if let Some(db) = settings.gain_db {
                    self.order(Order::Gain(db));
                }
                if settings.plays() {
                    let set = self.editor.set(&settings);
                    // What was refused is put back by this.
                    self.out.tell("chosen", &self.editor.chosen());
                    self.refuse(page, set);
                }
            }
            Command::Edit(edit) => {
                let edited = self.editor.edit(page, &edit);
                self.refuse(page, edited);
            }
            Command::Undo => self.step_in_edits(page, false),
            Command::Redo => self.step_in_edits(page, true),
            Command::Open { name } => {
                let opened = self.editor.open(page, name);
                self.refuse(page, opened);
            }
            Command::Measure(measure) => {
                self.ask(page, measure.edit, |of| Task::Measure { measure, of, page });
            }
            Command::Compare { off: true, .. } => {
                self.give_up(|asked| asked.page == page && asked.kind == Kind::Compare);
                self.out.withdraw("compare");
                self.order(Order::Replay(None));
            }
            Command::Compare { id, at, methods, window_ms, edit, .. } => {
                self.ask(page, edit, |of| Task::Compare { id, at, methods, window_ms, of, page });
            }
            Command::Stop { id } => {
                // Of what has ended there is nothing left to compute either.
                if !self.give_up(|asked| asked.page == page && asked.id == id) {
                    self.out.stopped(page, id);
                }
            }
            Command::Job(_) | Command::Seen { .. } => {}
        }
    }

    /// Replaces the surface by one read from the text of a surface file, and sends the new surface to all open
    /// pages at once.
    ///
    /// # Errors
    /// All faults of the file, as text.
    pub fn load(&mut self, text: &str) -> Result<(), String> {
        self.editor.load(text)?;
        self.renew();
        Ok(())
    }

    /// Advances by `seconds` of real time, as people at the pages experience it; simulated time may run slower, stand still or run
    /// backwards. The surface is stepped as long as `more` returns true; `viewers` is the number of open pages.
    pub fn advance(&mut self, seconds: f64, viewers: usize, more: &mut dyn FnMut() -> bool) {
        self.renew();
        self.simulation.advance(seconds, viewers, more, &mut self.out);
    }

    /// The next work to be done on another thread; `None` if there is none.
    pub fn errand(&mut self) -> Option<Errand> {
        self.renew();
        if let Some((spec, stop)) = self.editor.wanted() {
            self.tell_building(true);
            return Some(Errand::Build(spec, stop));
        }
        self.tasks.next().map(|(task, stop)| Errand::Compute(task, stop))
    }

    /// Processes the result of an errand.
    pub fn done(&mut self, done: Done) {
        if let Done::Built(_) = done {
            self.tell_building(false);
        }
        match done {
            Done::Built(Ok(instrument)) => {
                self.editor.built(&instrument.spec, &mut self.out);
                let told = self.editor.settings(&instrument);
                self.order(Order::Play(instrument, told));
            }
            Done::Built(Err(ViewError::Stopped)) => self.editor.given_up(),
            Done::Built(Err(error)) => {
                self.editor.failed(&error.to_string(), self.simulation.rests(), &mut self.out);
                self.out.tell("chosen", &self.editor.chosen());
            }
            Done::Found(Found::Out(out)) => self.out.push(out),
            Done::Found(Found::Replay(replay)) => self.order(Order::Replay(Some(replay))),
            Done::Computed => self.tasks.done(),
        }
    }

    /// Removes and returns the messages and pictures for pages, the oldest first.
    pub fn take(&mut self) -> Vec<Out> {
        self.out.take()
    }

    /// Tells pages whether an instrument is being built, so that what is drawn is not what is played yet.
    fn tell_building(&mut self, on: bool) {
        self.out.tell("building", &json!({ "is": "building", "on": on }));
    }

    fn order(&mut self, order: Order) {
        self.simulation.obey(order, &mut self.out);
    }

    fn refuse(&mut self, page: u64, done: Result<(), ViewError>) {
        if let Err(error) = done {
            self.out.refuse(page, error.to_string());
        }
    }

    /// Undoes or redoes an edit for a page: its own, or one of a page that is closed.
    fn step_in_edits(&mut self, page: u64, redo: bool) {
        let may = |by: u64| by == page || !self.pages.contains(&by);
        let done = if redo { self.editor.redo(may) } else { self.editor.undo(may) };
        self.refuse(page, done);
    }

    /// Queues a computation for the surface that a page shows.
    fn ask(&mut self, page: u64, edit: Option<u64>, task: impl FnOnce(Arc<Edition>) -> Task) {
        // What was edited just before can be asked about.
        self.renew();
        match self.editions.find(edit) {
            Ok(of) => {
                let task = task(of);
                let wanted = task.asked();
                // Whoever asks for something newer wants the older no more.
                self.give_up(|asked| {
                    wanted.is_some_and(|wanted| (asked.page, asked.kind) == (wanted.page, wanted.kind))
                });
                self.wait(task);
            }
            Err(why) => self.out.refuse(page, why),
        }
    }

    /// Gives up the computations that answer some requests; pages are told of each. Returns whether there was one.
    fn give_up(&mut self, which: impl Fn(&Asked) -> bool) -> bool {
        let (removed, runs) = self.tasks.give_up(which);
        // The worker answers for the one that runs.
        removed.iter().for_each(|asked| self.out.stopped(asked.page, asked.id));
        runs || !removed.is_empty()
    }

    fn wait(&mut self, task: Task) {
        if let Err((page, why)) = self.tasks.push(task) {
            self.out.refuse(page, why);
        }
    }

    /// If the surface was edited, sends it to the pages, and queues the computation of its figures.
    pub fn renew(&mut self) {
        if let Some(edition) = self.editor.renew(&mut self.editions, &mut self.out) {
            self.wait(Task::Design(edition));
        }
    }
}
