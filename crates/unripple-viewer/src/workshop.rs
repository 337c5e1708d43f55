//! Where surfaces are changed and made ready to be played: a thread, so that pictures go on meanwhile.

use crate::board::Board;
use crate::draft::Draft;
use crate::edition::{Edition, Editions};
use crate::rig::{Instrument, Order, Spec, check_effect};
use crate::told::{Settled, settings, surface};
use crate::wire::{Edit, Settings};
use crate::{Caller, ViewError};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender};
use unripple::core::Surface;
use unripple::focus::Method;
use unripple_store::{BUILTINS, load_surface, parse_surface};

/// What the workshop is asked for.
pub enum Work {
    /// Another surface, bit by bit.
    Edit(Box<Edit>, Caller),
    /// Back.
    Undo,
    /// Forth.
    Redo,
    /// A built-in surface.
    Open(String, Caller),
    /// A surface file's text; the answer is nothing or all its faults.
    Load(String, tokio::sync::oneshot::Sender<Result<(), String>>),
    /// How the surface is played.
    Settings(Settings, Caller),
}

/// What comes out of the workshop.
pub struct Outlets {
    /// What is played.
    pub rig: Sender<Order>,
    /// What is computed.
    pub bench: Sender<crate::bench::Task>,
    /// Surfaces on their way to the bench.
    pub pending: Arc<AtomicUsize>,
    /// What pages may ask about.
    pub editions: Arc<Editions>,
}

/// The thread's own.
pub struct Workshop {
    board: Arc<Board>,
    out: Outlets,
    draft: Draft,
    spec: Spec,
    /// What is played.
    played: Spec,
    told: Settled,
    edits: u64,
    /// Whether what is played is not what is wanted, and whether the surface is another.
    stale: bool,
    edited: bool,
}

impl Workshop {
    /// A workshop for what is played now.
    pub fn new(board: Arc<Board>, out: Outlets, instrument: &Instrument, told: Settled) -> Self {
        let draft = Draft::new(instrument.spec.surface.clone());
        let spec = instrument.spec.clone();
        let played = spec.clone();
        let workshop = Self { board, out, draft, spec, played, told, edits: 0, stale: false, edited: false };
        workshop.publish();
        workshop.board.tell("settings", &settings(&workshop.told, instrument));
        workshop
    }

    /// Works until nobody asks any more. What has been asked for meanwhile is made in one.
    pub fn run(mut self, work: Receiver<Work>) {
        while let Ok(first) = work.recv() {
            self.take(first);
            while let Ok(next) = work.try_recv() {
                self.take(next);
            }
            self.renew();
            if std::mem::take(&mut self.stale) {
                self.rebuild();
            }
        }
    }

    fn take(&mut self, work: Work) {
        match work {
            Work::Edit(edit, caller) => match self.draft.edit(&edit) {
                Ok(()) => self.changed(edit.settled != Some(false)),
                Err(error) => caller.refuse(&error.to_string()),
            },
            Work::Undo if self.draft.undo() => self.changed(true),
            Work::Redo if self.draft.redo() => self.changed(true),
            Work::Undo | Work::Redo => {}
            Work::Open(name, caller) => match open(&name) {
                Ok(surface) => self.replace(surface, name),
                Err(error) => caller.refuse(&error.to_string()),
            },
            Work::Load(text, answer) => {
                let loaded = parse_surface(&text, "uploaded").map_err(|faults| format!("{faults:#}"));
                let loaded = loaded.map(|surface| {
                    let name = surface.name.clone();
                    self.replace(surface, name);
                    // Whoever is answered finds it in its place.
                    self.renew();
                });
                // The page may have gone meanwhile.
                let _ = answer.send(loaded);
            }
            Work::Settings(settings, caller) => match self.set(&settings) {
                Ok(()) => self.stale = true,
                Err(error) => caller.refuse(&error.to_string()),
            },
        }
    }

    fn changed(&mut self, settled: bool) {
        self.edited = true;
        // Responses that were measured are of the surface as it was.
        self.spec.stored = None;
        self.spec.without_scale = false;
        if settled {
            self.spec.surface = self.draft.surface().clone();
            self.stale = true;
        }
    }

    fn replace(&mut self, surface: Surface, source: String) {
        self.told.source = source;
        self.draft.replace(surface);
        self.changed(true);
    }

    fn set(&mut self, settings: &Settings) -> Result<(), ViewError> {
        if let Some(name) = &settings.method {
            let refused = |found: String| ViewError::Range {
                what: "method",
                expected: Method::ALL.map(Method::name).join(", "),
                found,
            };
            self.spec.method = name.parse().map_err(|_| refused(name.clone()))?;
        }
        if let Some(effect) = &settings.effect {
            check_effect(effect)?;
            self.spec.effect.clone_from(effect);
        }
        if let Some(ms) = settings.window_ms {
            self.spec.window = (ms > 0.0).then_some(ms * 1e-3);
        }
        self.spec.load = settings.load.unwrap_or(self.spec.load);
        self.spec.rate = settings.rate_hz.unwrap_or(self.spec.rate);
        Ok(())
    }

    /// Makes what is wanted, and has it played; says so if that cannot be.
    fn rebuild(&mut self) {
        match Instrument::build(self.spec.clone()) {
            Ok(instrument) => {
                let told = settings(&self.told, &instrument);
                self.board.withdraw("notice");
                self.played = self.spec.clone();
                // Without a rig the program is at its end.
                let _ = self.out.rig.send(Order::Play(Box::new(instrument), told));
            }
            Err(error) => {
                // What cannot be played is not what the next change starts from; the surface stays as it was drawn.
                let Spec { surface, stored, without_scale, .. } =
                    std::mem::replace(&mut self.spec, self.played.clone());
                (self.spec.surface, self.spec.stored) = (surface, stored);
                self.spec.without_scale = without_scale;
                let text = error.to_string();
                self.board.tell("notice", &serde_json::json!({ "is": "notice", "text": text }));
            }
        }
    }

    /// Makes what has been edited since the last time the surface that pages are shown.
    fn renew(&mut self) {
        if std::mem::take(&mut self.edited) {
            self.edits += 1;
            self.publish();
        }
    }

    /// Has the surface computed, and tells it: whoever knows of it can ask about it.
    fn publish(&self) {
        let edition = Arc::new(Edition { edit: self.edits, surface: self.draft.surface().clone() });
        self.out.editions.publish(edition.clone());
        self.out.pending.fetch_add(1, Ordering::Relaxed);
        // Without a bench the program is at its end.
        let _ = self.out.bench.send(crate::bench::Task::Design(edition.clone()));
        let library = self.spec.stored.is_some();
        let message = surface(&edition, self.draft.ways(), &self.told.source, library);
        self.board.tell("surface", &message);
    }
}

/// A built-in surface: pages open no files.
fn open(name: &str) -> Result<Surface, ViewError> {
    if BUILTINS.iter().any(|builtin| builtin.name == name) {
        return Ok(load_surface(name)?);
    }
    let names = BUILTINS.iter().map(|builtin| builtin.name).collect::<Vec<_>>().join(", ");
    Err(ViewError::Range { what: "surface", expected: format!("one of {names}"), found: name.into() })
}
