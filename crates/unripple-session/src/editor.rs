//! Editing of the surface and of its playing options by pages.

use crate::ViewError;
use crate::draft::Draft;
use crate::edition::{Edition, Editions};
use crate::messages::{Settled, chosen, settings, surface};
use crate::outbox::Outbox;
use crate::simulation::{Instrument, Spec, check_effect};
use crate::stop::{Stop, Underway};
use crate::wire::{Edit, Settings};
use serde_json::Value;
use std::sync::Arc;
use unripple::core::Surface;
use unripple::focus::Method;
use unripple_store::{BUILTINS, load_surface, parse_surface};

/// The surface as pages edit it, and its playing options. Changes made while an instrument is being built go together into the next one.
pub struct Editor {
    draft: Draft,
    spec: Spec,
    /// The specification that is played now.
    played: Spec,
    told: Settled,
    edits: u64,
    /// Whether another specification is to be built, and whether the surface was edited since it was last sent.
    stale: bool,
    edited: bool,
    /// The build of an instrument, while there is one.
    building: Option<Underway>,
    /// Whether the instrument that is played is to be built again, since its device was taken for one that could not be built; and
    /// whether it is being built.
    lost: bool,
    restoring: bool,
}

impl Editor {
    /// An editor that starts from the surface and settings that are played now.
    pub fn new(instrument: &Instrument, told: Settled) -> Self {
        let draft = Draft::new(instrument.spec.surface.clone());
        let spec = instrument.spec.clone();
        let played = spec.clone();
        // The first surface has been sent to nobody yet.
        let (stale, edited, building, lost, restoring) = (false, true, None, false, false);
        Self { draft, spec, played, told, edits: 0, stale, edited, building, lost, restoring }
    }

    /// The settings of an instrument as a message for pages.
    pub fn settings(&self, instrument: &Instrument) -> Value {
        settings(&self.told, instrument)
    }

    /// The playing options that were chosen last, as a message for pages.
    pub fn chosen(&self) -> Value {
        chosen(&self.spec)
    }

    /// Applies an edit of a page, given by its number, to the surface.
    ///
    /// # Errors
    /// [`ViewError`] for an edit that cannot be applied; then nothing has changed.
    pub fn edit(&mut self, page: u64, edit: &Edit) -> Result<(), ViewError> {
        self.draft.edit_by(page, edit)?;
        self.changed(edit.settled != Some(false));
        Ok(())
    }

    /// Undoes the last edit of the surface, if `may` allows it for the number of the page that made it.
    ///
    /// # Errors
    /// [`ViewError::Range`] if it does not.
    pub fn undo(&mut self, may: impl Fn(u64) -> bool) -> Result<(), ViewError> {
        allowed("undo", self.draft.whose().0, may)?;
        if self.draft.undo() {
            self.changed(true);
        }
        Ok(())
    }

    /// Redoes the edit that was undone last, if `may` allows it for the number of the page that made it.
    ///
    /// # Errors
    /// [`ViewError::Range`] if it does not.
    pub fn redo(&mut self, may: impl Fn(u64) -> bool) -> Result<(), ViewError> {
        allowed("redo", self.draft.whose().1, may)?;
        if self.draft.redo() {
            self.changed(true);
        }
        Ok(())
    }

    /// Replaces the surface by a built-in one, for a page, given by its number.
    ///
    /// # Errors
    /// [`ViewError::Range`] if no built-in surface has that name.
    pub fn open(&mut self, page: u64, name: String) -> Result<(), ViewError> {
        let surface = open(&name)?;
        self.draft.hand_to(page);
        self.replace(surface, name);
        Ok(())
    }

    /// Replaces the surface by one read from the text of a surface file. This counts as nobody's edit: any page may undo it.
    ///
    /// # Errors
    /// All faults of the file, as text.
    pub fn load(&mut self, text: &str) -> Result<(), String> {
        let surface = parse_surface(text, "uploaded").map_err(|faults| format!("{faults:#}"))?;
        let name = surface.name.clone();
        self.draft.hand_to(0);
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

    /// Changes the playing options of the surface.
    ///
    /// # Errors
    /// [`ViewError::Range`] for methods and effects that do not exist.
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

    /// The specification of an instrument to be built now, with the flag that cancels the build; `None` if
    /// there is nothing to build, or another build is under way. A build for which a newer specification
    /// waits is cancelled after two seconds.
    pub fn wanted(&mut self) -> Option<(Box<Spec>, Stop)> {
        if let Some(underway) = &self.building {
            if self.stale {
                underway.hurry();
            }
            return None;
        }
        self.restoring = !self.stale && self.lost;
        if !self.stale && !self.lost {
            return None;
        }
        (self.stale, self.lost) = (false, false);
        let spec = if self.restoring { &self.played } else { &self.spec };
        let stop = self.building.insert(Underway::default()).stop();
        Some((Box::new(spec.clone()), stop))
    }

    /// Records that an instrument of this specification has been built.
    pub fn built(&mut self, spec: &Spec, out: &mut Outbox) {
        self.building = None;
        self.played = spec.clone();
        // What could not be built instead is still to be read.
        if !self.restoring {
            out.withdraw("notice");
        }
    }

    /// Records that a build was cancelled because a newer specification was waiting.
    pub fn given_up(&mut self) {
        self.building = None;
    }

    /// Records that the specification could not be built, and tells pages why. If its build has taken the
    /// device from the instrument that is played (`lost`), that instrument is built again.
    pub fn failed(&mut self, why: &str, lost: bool, out: &mut Outbox) {
        self.building = None;
        // One that cannot be built again either is not tried for ever.
        self.lost = lost && !self.restoring;
        if !self.stale {
            // What cannot be played is not what the next change starts from; the surface stays as it was drawn.
            let Spec { surface, stored, without_scale, .. } =
                std::mem::replace(&mut self.spec, self.played.clone());
            (self.spec.surface, self.spec.stored) = (surface, stored);
            self.spec.without_scale = without_scale;
        }
        out.tell("notice", &serde_json::json!({ "is": "notice", "text": why }));
    }

    /// If the surface has been edited since it was last sent, sends it to pages and returns it as a new edition, whose figures are then to
    /// be computed.
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

/// Refuses to take back or repeat an edit of a page (its number) that `may` does not allow.
fn allowed(what: &'static str, by: Option<u64>, may: impl Fn(u64) -> bool) -> Result<(), ViewError> {
    if by.is_none_or(may) {
        return Ok(());
    }
    let (expected, found) = ("a change made on this page".into(), "one made on another open page".into());
    Err(ViewError::Range { what, expected, found })
}

/// A built-in surface: pages open no files.
fn open(name: &str) -> Result<Surface, ViewError> {
    if BUILTINS.iter().any(|builtin| builtin.name == name) {
        return Ok(load_surface(name)?);
    }
    let names = BUILTINS.iter().map(|builtin| builtin.name).collect::<Vec<_>>().join(", ");
    Err(ViewError::Range { what: "surface", expected: format!("one of {names}"), found: name.into() })
}
