//! The surface as pages change it, and how it is to be played.

use crate::ViewError;
use crate::draft::Draft;
use crate::edition::{Edition, Editions};
use crate::messages::{Settled, settings, surface};
use crate::outbox::Outbox;
use crate::simulation::{Instrument, Spec, check_effect};
use crate::wire::{Edit, Settings};
use serde_json::Value;
use std::sync::Arc;
use unripple::core::Surface;
use unripple::focus::Method;
use unripple_store::{BUILTINS, load_surface, parse_surface};

/// The surface as pages change it. What has been asked for meanwhile is made in one.
pub struct Editor {
    draft: Draft,
    spec: Spec,
    /// What is played.
    played: Spec,
    told: Settled,
    edits: u64,
    /// Whether what is played is not what is wanted, and whether the surface is another.
    stale: bool,
    edited: bool,
    /// Whether something is being made ready.
    building: bool,
}

impl Editor {
    /// An editor of what is played now.
    pub fn new(instrument: &Instrument, told: Settled) -> Self {
        let draft = Draft::new(instrument.spec.surface.clone());
        let spec = instrument.spec.clone();
        let played = spec.clone();
        // The first surface has been sent to nobody yet.
        Self { draft, spec, played, told, edits: 0, stale: false, edited: true, building: false }
    }

    /// The settings of an instrument as a message for pages.
    pub fn settings(&self, instrument: &Instrument) -> Value {
        settings(&self.told, instrument)
    }

    /// Another surface, bit by bit.
    ///
    /// # Errors
    /// [`ViewError`] for what cannot be; then nothing has changed.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), ViewError> {
        self.draft.edit(edit)?;
        self.changed(edit.settled != Some(false));
        Ok(())
    }

    /// Goes back to the surface before the last edit.
    pub fn undo(&mut self) {
        if self.draft.undo() {
            self.changed(true);
        }
    }

    /// Goes forth to the surface that was undone.
    pub fn redo(&mut self) {
        if self.draft.redo() {
            self.changed(true);
        }
    }

    /// A built-in surface.
    ///
    /// # Errors
    /// [`ViewError::Range`] for a name that none has.
    pub fn open(&mut self, name: String) -> Result<(), ViewError> {
        let surface = open(&name)?;
        self.replace(surface, name);
        Ok(())
    }

    /// The text of a surface file.
    ///
    /// # Errors
    /// All its faults, as text.
    pub fn load(&mut self, text: &str) -> Result<(), String> {
        let surface = parse_surface(text, "uploaded").map_err(|faults| format!("{faults:#}"))?;
        let name = surface.name.clone();
        self.replace(surface, name);
        Ok(())
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

    /// Changes how the surface is played.
    ///
    /// # Errors
    /// [`ViewError::Range`] for names that there are not.
    pub fn set(&mut self, settings: &Settings) -> Result<(), ViewError> {
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
        self.stale = true;
        Ok(())
    }

    /// What is to be made ready now, if it is not what is played and nothing is being made.
    pub fn wanted(&mut self) -> Option<Box<Spec>> {
        if self.building || !std::mem::take(&mut self.stale) {
            return None;
        }
        self.building = true;
        Some(Box::new(self.spec.clone()))
    }

    /// Something has been made ready.
    pub fn built(&mut self, spec: &Spec, out: &mut Outbox) {
        self.building = false;
        self.played = spec.clone();
        out.withdraw("notice");
    }

    /// Says that what was wanted cannot be made, and why.
    pub fn failed(&mut self, why: &str, out: &mut Outbox) {
        self.building = false;
        if !self.stale {
            // What cannot be played is not what the next change starts from; the surface stays as it was drawn.
            let Spec { surface, stored, without_scale, .. } =
                std::mem::replace(&mut self.spec, self.played.clone());
            (self.spec.surface, self.spec.stored) = (surface, stored);
            self.spec.without_scale = without_scale;
        }
        out.tell("notice", &serde_json::json!({ "is": "notice", "text": why }));
    }

    /// Tells the surface that pages are shown, if it has been edited since it was last sent; then it is to be computed, and can be asked
    /// about.
    pub fn renew(&mut self, editions: &mut Editions, out: &mut Outbox) -> Option<Arc<Edition>> {
        if !std::mem::take(&mut self.edited) {
            return None;
        }
        let edition = Arc::new(Edition { edit: self.edits, surface: self.draft.surface().clone() });
        self.edits += 1;
        editions.publish(edition.clone());
        let library = self.spec.stored.is_some();
        out.tell("surface", &surface(&edition, self.draft.ways(), &self.told.source, library));
        Some(edition)
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
