//! The state that all pages share, as a state machine. It takes the pages' commands and the time that passes; it gives messages, pictures
//! and work to be done beside it. It uses no thread, clock or network: whoever runs it provides them.

use crate::ViewError;
use crate::compute::{ComputeWorker, Found, Queue, Responder, Task};
use crate::edition::{Edition, Editions};
use crate::editor::Editor;
use crate::messages::Settled;
use crate::outbox::{Out, Outbox};
use crate::simulation::{Instrument, Order, Simulation, Spec};
use crate::wire::Command;
use std::sync::Arc;
use unripple::core::Point;

/// Work that takes longer than a picture may wait. It is done on other threads, one of each kind at a time.
pub enum Errand {
    /// Build the instrument that plays a surface: [`build`](Self::build) does it.
    Build(Box<Spec>),
    /// Compute figures, by the session's [`ComputeWorker`].
    Compute(Task),
}

/// Result of an errand.
pub enum Done {
    /// An instrument that was built, or the reason why it cannot be.
    Built(Result<Box<Instrument>, String>),
    /// One result of a computation.
    Found(Found),
    /// The computation is complete.
    Computed,
}

impl Errand {
    /// Builds the instrument of a specification.
    pub fn build(spec: Box<Spec>) -> Done {
        Done::Built(Instrument::build(*spec).map(Box::new).map_err(|error| error.to_string()))
    }
}

/// The state that all pages share: simulation, editor and messages.
pub struct Session {
    simulation: Simulation,
    editor: Editor,
    editions: Editions,
    tasks: Queue,
    /// Whether figures are being computed.
    computing: bool,
    out: Outbox,
}

impl Session {
    /// A session that plays an instrument.
    pub fn new(instrument: Instrument, told: Settled) -> Self {
        let editor = Editor::new(&instrument, told);
        let mut out = Outbox::default();
        out.tell("settings", &editor.settings(&instrument));
        let mut simulation = Simulation::new(instrument);
        simulation.begin(&mut out);
        let (editions, tasks) = (Editions::default(), Queue::default());
        let mut session = Self { simulation, editor, editions, tasks, computing: false, out };
        session.renew();
        session
    }

    /// The worker that computes figures for this session. `known` is the name of the first surface on the command line, the responses of
    /// its library, and the reason why their scale is unknown.
    pub fn compute(&self, known: (String, Option<Responder>, Option<String>)) -> ComputeWorker {
        ComputeWorker::new(known, self.editions.newest())
    }

    /// Notes that a page came, which must be shown a picture.
    pub fn come(&mut self) {
        self.simulation.obey(Order::Look, &mut self.out);
    }

    /// Notes that a page went; its fingers are lifted.
    pub fn leave(&mut self, page: u64) {
        self.simulation.obey(Order::Leave(page), &mut self.out);
    }

    /// Carries out a command of a page; pages are numbered from 1. Commands for the link or for jobs are ignored here.
    pub fn hear(&mut self, page: u64, command: Command) {
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
                if settings.plays() {
                    let set = self.editor.set(&settings);
                    self.refuse(page, set);
                }
            }
            Command::Edit(edit) => {
                let edited = self.editor.edit(&edit);
                self.refuse(page, edited);
            }
            Command::Undo => self.editor.undo(),
            Command::Redo => self.editor.redo(),
            Command::Open { name } => {
                let opened = self.editor.open(name);
                self.refuse(page, opened);
            }
            Command::Measure(measure) => {
                self.ask(page, measure.edit, |of| Task::Measure { measure, of, page });
            }
            Command::Compare { off: true, .. } => {
                self.out.withdraw("compare");
                self.order(Order::Replay(None));
            }
            Command::Compare { at, methods, window_ms, edit, .. } => {
                self.ask(page, edit, |of| Task::Compare { at, methods, window_ms, of, page });
            }
            Command::Job(_) | Command::Seen { .. } => {}
        }
    }

    /// Replaces the surface by one read from the text of a surface file; pages are sent it at once.
    ///
    /// # Errors
    /// All faults of the file, as text.
    pub fn load(&mut self, text: &str) -> Result<(), String> {
        self.editor.load(text)?;
        self.renew();
        Ok(())
    }

    /// Lets `seconds` of the pages' time pass. The surface is stepped as long as `more` returns true; `viewers` is the number of open
    /// pages.
    pub fn advance(&mut self, seconds: f64, viewers: usize, more: &mut dyn FnMut() -> bool) {
        self.renew();
        self.simulation.advance(seconds, viewers, more, &mut self.out);
    }

    /// The next work to be done beside the session, if there is any.
    pub fn errand(&mut self) -> Option<Errand> {
        self.renew();
        if let Some(spec) = self.editor.wanted() {
            return Some(Errand::Build(spec));
        }
        let task = if self.computing { None } else { self.tasks.next() };
        self.computing |= task.is_some();
        task.map(Errand::Compute)
    }

    /// Takes in the result of an errand.
    pub fn done(&mut self, done: Done) {
        match done {
            Done::Built(Ok(instrument)) => {
                self.editor.built(&instrument.spec, &mut self.out);
                let told = self.editor.settings(&instrument);
                self.order(Order::Play(instrument, told));
            }
            Done::Built(Err(why)) => self.editor.failed(&why, &mut self.out),
            Done::Found(Found::Out(out)) => self.out.push(out),
            Done::Found(Found::Replay(replay)) => self.order(Order::Replay(Some(replay))),
            Done::Computed => self.computing = false,
        }
    }

    /// Takes out the messages and pictures for pages, the oldest first.
    pub fn take(&mut self) -> Vec<Out> {
        self.out.take()
    }

    fn order(&mut self, order: Order) {
        self.simulation.obey(order, &mut self.out);
    }

    fn refuse(&mut self, page: u64, done: Result<(), ViewError>) {
        if let Err(error) = done {
            self.out.refuse(page, error.to_string());
        }
    }

    /// Queues a computation for the surface that a page shows.
    fn ask(&mut self, page: u64, edit: Option<u64>, task: impl FnOnce(Arc<Edition>) -> Task) {
        // What was edited just before can be asked about.
        self.renew();
        match self.editions.find(edit) {
            Ok(of) => self.wait(task(of)),
            Err(why) => self.out.refuse(page, why),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::PULSES;
    use serde_json::Value;
    use unripple::focus::Method;
    use unripple::physics::design::papers_surface;

    fn session() -> Session {
        let mut surface = papers_surface();
        surface.emission.band[1] = 700.0;
        let spec = Spec {
            surface,
            stored: None,
            without_scale: false,
            method: Method::TimeReversal,
            effect: PULSES.into(),
            window: None,
            rate: 10.0,
            load: false,
            device: None,
            follow: None,
        };
        let told = Settled { source: "small".into(), device: "virtual".into(), address: None };
        Session::new(Instrument::build(spec).unwrap(), told)
    }

    /// A page's words, as its link reads them.
    fn hear(session: &mut Session, page: u64, words: &str) {
        session.hear(page, Command::read(words).unwrap());
    }

    /// So many seconds in pictures, with time for everything.
    fn pass(session: &mut Session, seconds: f64) {
        (0..(seconds * 30.0) as usize).for_each(|_| session.advance(1.0 / 30.0, 1, &mut || true));
    }

    /// The messages of a kind.
    fn told(out: &[Out], kind: &str) -> Vec<Value> {
        let text = |out: &Out| match out {
            Out::Text(of, text) if of == kind => Some(serde_json::from_str(text).unwrap()),
            _ => None,
        };
        out.iter().filter_map(text).collect()
    }

    #[test]
    fn fingers_of_a_page_that_goes_are_lifted_and_no_others() {
        let mut session = session();
        for page in [1, 2] {
            hear(&mut session, page, r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
        }
        pass(&mut session, 0.4);
        let fingers = |out: &[Out]| told(out, "status").pop().unwrap()["fingers"].as_array().unwrap().len();
        assert_eq!(fingers(&session.take()), 2);
        session.leave(1);
        pass(&mut session, 0.4);
        assert_eq!(fingers(&session.take()), 1);
    }

    #[test]
    fn what_is_edited_while_something_is_built_is_built_next_and_once() {
        let mut session = session();
        assert!(matches!(session.errand(), Some(Errand::Compute(Task::Design(of))) if of.edit == 0));
        session.take();
        let thicker = |mm: f64| format!(r#"{{"do":"edit","thickness_mm":{mm}}}"#);
        hear(&mut session, 1, &thicker(0.2));
        let Some(Errand::Build(first)) = session.errand() else { panic!("nothing to build") };
        for mm in [0.21, 0.22, 0.23] {
            hear(&mut session, 1, &thicker(mm));
            assert!(session.errand().is_none(), "two are built at once");
        }
        session.done(Errand::build(first));
        let Some(Errand::Build(last)) = session.errand() else { panic!("the last edit is lost") };
        assert!((last.surface.sheet.thickness - 0.23e-3).abs() < 1e-12);
        session.done(Errand::build(last));
        assert!(session.errand().is_none());
        let out = session.take();
        let surfaces = told(&out, "surface");
        assert_eq!(surfaces.last().unwrap()["values"]["thickness_mm"], 0.23);
        assert_eq!(told(&out, "settings").len(), 2);
        // Of the figures that were asked for, only the newest surface's are left to do.
        session.done(Done::Computed);
        let edit = surfaces.last().unwrap()["edit"].as_u64().unwrap();
        assert!(matches!(session.errand(), Some(Errand::Compute(Task::Design(of))) if of.edit == edit));
    }

    #[test]
    fn what_a_page_asks_for_is_refused_to_that_page() {
        let mut session = session();
        session.take();
        hear(&mut session, 7, r#"{"do":"open","name":"nowhere"}"#);
        hear(&mut session, 8, r#"{"do":"measure","id":1,"at":[[62,90]],"edit":99}"#);
        let refused = |out: &Out| match out {
            Out::Refuse(page, why) => Some((*page, why.clone())),
            _ => None,
        };
        let refused: Vec<_> = session.take().iter().filter_map(refused).collect();
        assert_eq!(refused.iter().map(|(page, _)| *page).collect::<Vec<_>>(), [7, 8]);
        assert!(refused[0].1.contains("hudin-2012") && refused[1].1.contains("found 99"), "{refused:?}");
    }

    #[test]
    fn the_same_words_and_times_give_the_same_pictures() {
        let pictures = || {
            let mut session = session();
            hear(&mut session, 1, r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
            pass(&mut session, 0.3);
            let frames = session.take().into_iter().filter_map(|out| match out {
                Out::Frame(_, bytes, _) => Some(bytes),
                _ => None,
            });
            frames.collect::<Vec<_>>()
        };
        let (one, other) = (pictures(), pictures());
        assert!(one.len() > 5 && one == other);
    }
}
