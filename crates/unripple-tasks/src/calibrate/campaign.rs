//! All that a calibration knows before anything is measured, and the plan of its library.

use super::ask::{Ask, By};
use super::before;
use super::points::Places;
use super::scale::Scales;
use crate::{Progress, TaskError, go_on, record};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::collections::BTreeMap;
use unripple::core::{ModalResponses, Surface};
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan, OutputDir};

/// Key in the provenance of a library's plan: the number of points measured by a probe or by taps.
pub(super) const PROBED: &str = "probed points";

/// Key in the provenance of a library's plan: whether points were measured by a probe, by taps or by a hammer.
const BY: &str = "by";

/// Whether a library's points were measured by taps or blows, not by a probe.
pub(crate) fn by_taps(library: &Library) -> bool {
    library.plan().provenance.get(BY).is_some_and(|by| by == "tap" || by == "hammer")
}

/// Request, surface, model and settings of a calibration, as known before anything is measured.
pub(crate) struct Campaign<'a> {
    /// The request of the task.
    pub ask: &'a Ask,
    /// The surface as its file describes it.
    pub surface: &'a Surface,
    /// Model of the surface, from its file.
    pub model: &'a ModalResponses,
    /// How responses are measured.
    pub settings: MeasureOptions,
    /// Values at full scale of inputs and outputs.
    pub scales: Scales,
    /// The places to be measured.
    pub places: Places,
    /// Folder for a figure of the library's quality, if one is requested.
    pub figure: Option<OutputDir>,
    /// The callback that reports progress.
    pub(super) progress: RefCell<&'a mut dyn Progress>,
}

impl Campaign<'_> {
    /// Shows the user a line of text.
    pub fn tell(&self, line: &str) {
        self.progress.borrow_mut().tell(line);
    }

    /// Calls `work` with the callback that reports progress.
    pub fn with_progress<T>(&self, work: impl FnOnce(&mut dyn Progress) -> T) -> T {
        work(*self.progress.borrow_mut())
    }

    /// Returns an error if the task has been cancelled.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`].
    pub fn go_on(&self) -> Result<(), TaskError> {
        self.with_progress(|progress| go_on(progress))
    }

    /// Warns of sweeps or responses that are too short for the surface.
    pub(super) fn warn(&self) {
        self.settings
            .warnings(self.model)
            .iter()
            .for_each(|warning| self.tell(&format!("warning: {warning}")));
    }

    /// The plan of the library: its points, actuators, length of responses, and provenance.
    pub(super) fn plan(&self) -> LibraryPlan {
        let (ask, settings, surface) = (self.ask, &self.settings, self.surface);
        let by = format!("{:?}", ask.by).to_lowercase();
        let provenance = BTreeMap::from([
            ("software".to_owned(), format!("unripple {}", env!("CARGO_PKG_VERSION"))),
            ("created".to_owned(), record::now()),
            ("device".to_owned(), format!("{:?}", ask.device.device).to_lowercase()),
            (BY.to_owned(), by),
            (PROBED.to_owned(), self.places.probed.to_string()),
            (before::SWEEP.to_owned(), settings.sweep.to_string()),
            (before::SWEPT.to_owned(), settings.swept(surface).map(|hz| hz.to_string()).join(" ")),
            ("repeats".to_owned(), settings.repeats.to_string()),
            ("level".to_owned(), settings.level.to_string()),
        ]);
        let samples = settings.samples(surface.emission.rate);
        let (ports, conditions) = (self.model.ports.clone(), self.model.conditions.clone());
        let known = LibraryPlan::new(ports, self.places.points.clone(), conditions, samples);
        LibraryPlan { surface: Some(surface.clone()), provenance, ..known }
    }

    /// Scales of the inputs and outputs, for the log. With taps, their strength follows from the model.
    pub(super) fn scale_told(&self) -> Value {
        match self.ask.by {
            By::Probe | By::Hammer => self.scales.told(),
            By::Tap => json!({ "by": "the model, for each tap" }),
        }
    }
}
