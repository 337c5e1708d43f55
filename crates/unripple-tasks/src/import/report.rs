//! Report of the task `import`.

use super::Ask;
use super::assembled::Assembled;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeSet;
use unripple::act::Note;
use unripple_store::LibraryPlan;

/// The library that was made of files of other programs.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Name of the surface in its file.
    pub surface: String,
    /// Path of the library's folder.
    pub library: String,
    /// Paths of the files that were read, as in the request.
    pub sources: Vec<String>,
    /// What the files hold: `frequency-responses`, `impulse-responses`, `filters` or `modes`, joined by commas if several.
    pub kind: String,
    /// What was measured: `velocity`, `displacement` or `acceleration`, joined by commas if several.
    pub quantity: String,
    /// Unit of the reference: `N`, `V` or `A`, joined by commas if several.
    pub per: String,
    /// Number of modes that responses were computed from; `None` of measured responses.
    pub modes: Option<usize>,
    /// Lowest frequency of integrated accelerations, in Hz; `None` of other quantities.
    pub integrated_from_hz: Option<f64>,
    /// Number of points in the library.
    pub points: usize,
    /// Number of actuators.
    pub actuators: usize,
    /// Names of the actuators without responses.
    pub without: Vec<String>,
    /// Number of samples in each response.
    pub samples: usize,
    /// Sample rate of the responses, in Hz.
    pub sample_rate_hz: f64,
    /// Lowest and highest frequency of the responses within the surface's band, in Hz.
    pub band_hz: [f64; 2],
    /// Shortest wavelength of the band, in m.
    pub lambda_min_m: f64,
    /// The wavelength from how responses correlate in space, beside that of the surface's file; `None` where they do not tell it.
    pub wavelength: Option<Value>,
    /// Notes on what was left out, and on the wavelength.
    pub notes: Vec<Note>,
}

impl Report {
    /// The report on a library of this plan.
    pub(super) fn of(
        ask: &Ask,
        surface: &str,
        plan: &LibraryPlan,
        assembled: Assembled,
        wavelength: Option<Value>,
    ) -> Self {
        let joined = |names: BTreeSet<&'static str>| names.into_iter().collect::<Vec<_>>().join(", ");
        let note = |text| Note { topic: "left-out", text };
        let waves = wavelength.as_ref().and_then(|told| told["said"].as_str());
        let waves = waves.map(|said| Note { topic: "wavelength", text: said.to_owned() });
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "import",
            surface: surface.to_owned(),
            library: ask.output.display().to_string(),
            sources: ask.files.iter().map(|path| path.display().to_string()).collect(),
            kind: joined(assembled.kinds),
            quantity: joined(assembled.quantities),
            per: joined(assembled.per),
            modes: assembled.modes,
            integrated_from_hz: assembled.lowest,
            points: plan.points.len(),
            actuators: plan.ports.len(),
            without: ask.without.clone(),
            samples: plan.samples,
            sample_rate_hz: plan.conditions.rate,
            band_hz: plan.conditions.band,
            lambda_min_m: plan.conditions.lambda_min,
            wavelength,
            notes: assembled.left_out.into_iter().map(note).chain(waves).collect(),
        }
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let [low, high] = self.band_hz;
        let of = match self.modes {
            Some(modes) => format!("{modes} modes"),
            None => format!("{} ({} per {})", self.kind, self.quantity, self.per),
        };
        let integrated = self
            .integrated_from_hz
            .map_or_else(String::new, |hz| format!("accelerations integrated from {hz:.4} Hz on\n"));
        let without = match self.without.is_empty() {
            true => String::new(),
            false => format!(", without {}", self.without.join(", ")),
        };
        let waves = self
            .wavelength
            .as_ref()
            .map_or_else(String::new, |told| format!("wavelength {}\n", crate::wavelength::text(told)));
        format!(
            "{}: {of}\n{} points of {} actuators{without}, {} samples at {} Hz, {low:.4} to {high:.4} Hz\n{integrated}{waves}wrote {}\n",
            self.surface, self.points, self.actuators, self.samples, self.sample_rate_hz, self.library
        )
    }
}
