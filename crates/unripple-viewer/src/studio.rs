//! All that pages share: the surface at work, and whoever works on what they ask for.

use crate::bench::{Bench, Task};
use crate::board::{Board, Notice};
use crate::edition::{Edition, Editions};
use crate::jobs::Jobs;
use crate::link::Caller;
use crate::lock::lock;
use crate::rig::{Instrument, Order, Rig};
use crate::told::Settled;
use crate::wire::{Command, Phase};
use crate::workshop::{Outlets, Work, Workshop};
use crate::{View, ViewError};
use std::sync::atomic::AtomicUsize;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use unripple::core::Point;

/// The last act that was measured: as files.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The number that the page gave it.
    pub id: u64,
    /// `drive.wav`.
    pub drive: Vec<u8>,
    /// `report.json`.
    pub json: String,
    /// `report.md`.
    pub markdown: String,
}

/// Where everything a page asks for goes.
pub struct Studio {
    /// What all pages are shown.
    pub board: Arc<Board>,
    rig: Sender<Order>,
    shop: Sender<Work>,
    bench: Sender<Task>,
    editions: Arc<Editions>,
    jobs: Jobs,
    measured: Arc<Mutex<Option<Measured>>>,
    /// The thread that plays.
    playing: Mutex<Option<JoinHandle<()>>>,
    quiet: bool,
}

impl Studio {
    /// Makes a surface ready and puts everybody to work; other machines come by the address `elsewhere`.
    ///
    /// # Errors
    /// Those of [`Instrument::build`]; [`ViewError::Gone`] if a thread cannot be had.
    pub fn open(view: &View, elsewhere: Option<String>) -> Result<Arc<Self>, ViewError> {
        let board = Arc::new(Board::new());
        let instrument = Instrument::build(view.spec())?;
        let told =
            Settled { source: view.source.clone(), device: view.device_name.clone(), address: elsewhere };
        let (rig, orders) = channel();
        let (bench, tasks) = channel();
        let (shop, work) = channel();
        let measured = Arc::new(Mutex::new(None));
        let pending = Arc::new(AtomicUsize::new(0));
        let editions = Arc::new(Editions::default());
        let outlets = Outlets {
            rig: rig.clone(),
            bench: bench.clone(),
            pending: pending.clone(),
            editions: editions.clone(),
        };
        let workshop = Workshop::new(board.clone(), outlets, &instrument, told);
        let known = (view.source.clone(), view.respond.clone(), view.without_scale.clone());
        let worker = Bench::new(board.clone(), rig.clone(), measured.clone(), known, pending);
        let stage = Rig::new(board.clone(), instrument);
        let playing = Mutex::new(Some(thread("surface", move || stage.run(orders))?));
        thread("workshop", move || workshop.run(work))?;
        thread("bench", move || worker.run(tasks))?;
        let jobs = Jobs::new(board.clone(), view.program.clone(), view.folder.clone());
        let quiet = view.quiet;
        Ok(Arc::new(Self { board, rig, shop, bench, editions, jobs, measured, playing, quiet }))
    }

    /// Has something put up for a page that came.
    pub fn look(&self) {
        self.order(Order::Look);
    }

    /// A page's finger, by its number over all pages.
    pub fn touch(&self, finger: u64, phase: Phase, [x, y]: [f64; 2]) {
        self.order(Order::Touch(finger, phase, Point::from_mm(x, y)));
    }

    /// Does what a page asks for, or sees to it.
    pub fn obey(&self, command: Command, caller: &Caller) {
        let asker = || caller.clone();
        match command {
            Command::Transport(transport) => self.order(Order::Transport(transport)),
            Command::Probe(probe) => self.order(Order::Probe(probe)),
            Command::Settings(settings) => {
                match settings.quantity.as_deref() {
                    None => {}
                    Some("displacement") => self.order(Order::Velocity(false)),
                    Some("velocity") => self.order(Order::Velocity(true)),
                    Some(other) => {
                        caller.refuse(&format!("quantity: expected displacement or velocity, found {other}"))
                    }
                }
                if settings.plays() {
                    self.work(Work::Settings(settings, asker()));
                }
            }
            Command::Edit(edit) => self.work(Work::Edit(edit, asker())),
            Command::Undo => self.work(Work::Undo),
            Command::Redo => self.work(Work::Redo),
            Command::Open { name } => self.work(Work::Open(name, asker())),
            Command::Measure(measure) => {
                self.ask(measure.edit, caller, |of| Task::Measure { measure, of, caller: asker() });
            }
            Command::Compare { off: true, .. } => {
                self.board.withdraw("compare");
                self.order(Order::Replay(None));
            }
            Command::Compare { at, methods, window_ms, edit, .. } => {
                let task = |of| Task::Compare { at, methods, window_ms, of, caller: asker() };
                self.ask(edit, caller, task);
            }
            Command::Job(job) => self.jobs.obey(&job, self.toml(), caller),
            Command::Touch { .. } | Command::Seen { .. } => {}
        }
    }

    /// Takes in a surface file's text.
    ///
    /// # Errors
    /// All its faults, as text.
    pub async fn load(&self, text: String) -> Result<(), String> {
        let (answer, loaded) = tokio::sync::oneshot::channel();
        self.work(Work::Load(text, answer));
        loaded.await.unwrap_or_else(|_| Err("the program is ending".into()))
    }

    /// The surface as it is, as the text of its file.
    pub fn toml(&self) -> String {
        let Some(Notice::Text(text)) = self.board.newest("surface") else { return String::new() };
        let value: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
        value.get("toml").and_then(|toml| toml.as_str()).unwrap_or_default().to_owned()
    }

    /// The last act that was measured.
    pub fn measured(&self) -> Option<Measured> {
        lock(&self.measured).clone()
    }

    /// A line on standard error.
    pub fn log(&self, line: &str) {
        if !self.quiet {
            eprintln!("{line}");
        }
    }

    /// Ends jobs and the play; returns when the device is let go.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if the play ended before.
    pub fn close(&self) -> Result<(), ViewError> {
        self.order(Order::Stop);
        self.jobs.close();
        let ended = lock(&self.playing).take().map_or(Ok(()), JoinHandle::join);
        ended.map_err(|_| ViewError::Gone { why: "the surface's own failed".into() })
    }

    // Whoever has gone has told why, and the program is at its end.
    fn order(&self, order: Order) {
        let _ = self.rig.send(order);
    }

    fn work(&self, work: Work) {
        let _ = self.shop.send(work);
    }

    /// Has something computed of the surface that a page shows.
    fn ask(&self, edit: Option<u64>, caller: &Caller, task: impl FnOnce(Arc<Edition>) -> Task) {
        match self.editions.find(edit) {
            Ok(of) => drop(self.bench.send(task(of))),
            Err(why) => caller.refuse(&why),
        }
    }
}

fn thread(name: &str, work: impl FnOnce() + Send + 'static) -> Result<JoinHandle<()>, ViewError> {
    let spawned = std::thread::Builder::new().name(name.into()).spawn(work);
    spawned.map_err(|error| ViewError::Gone { why: error.to_string() })
}
