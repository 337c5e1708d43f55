//! Report of a calibration on its library.

use super::filler::{BLOWS, SAID};
use super::points::Places;
use crate::TaskError;
use crate::wavelength;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write;
use std::time::Duration;
use unripple_store::{Library, PointState, Quality};

/// A measured library and its quality, in SI units.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    library: String,
    points: usize,
    probed: usize,
    measured: usize,
    bad: Vec<usize>,
    latency_samples: Option<f64>,
    latency_spread_samples: Option<f64>,
    signal_to_noise_db: Spread,
    distortion_db: Spread,
    decay_time_s: Spread,
    /// Relative error of reciprocity, after one gain per actuator has been fitted.
    reciprocity_error: Option<f64>,
    seconds_per_recording: f64,
    seconds: f64,
    /// Blows of a hammer with a force sensor, if points were measured by them.
    #[serde(skip_serializing_if = "Option::is_none")]
    blows: Option<Blows>,
    /// The wavelength from how responses correlate in space, if they tell it.
    #[serde(skip_serializing_if = "Option::is_none")]
    wavelength: Option<Value>,
    /// Why the library is not to be trusted, if it is not.
    doubtful: Vec<String>,
    /// Other notes.
    notes: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    truth: Option<String>,
}

/// Blows of a hammer at all points.
#[derive(Clone, Debug, Default, Serialize)]
struct Blows {
    used: usize,
    refused: usize,
    /// Lowest frequency, over all points, above which a force is not usable; `null` if all are usable up to the end of the band.
    usable_to_hz: Option<f64>,
}

impl Blows {
    /// The blows in the log of a library's points; `None` if there are none.
    fn of(library: &Library) -> Option<Self> {
        let mut all = None;
        for point in 0..library.points().len() {
            let Some(log) = library.logged_point(point).and_then(|log| log.get(BLOWS)) else { continue };
            let Some(used) = log["used"].as_u64() else { continue };
            let all = all.get_or_insert_with(Self::default);
            all.used += used as usize;
            all.refused += log["refused"].as_array().map_or(0, Vec::len);
            let hz = log["usable_to_hz"].as_f64();
            all.usable_to_hz = all.usable_to_hz.into_iter().chain(hz).min_by(f64::total_cmp);
        }
        all
    }

    fn text(&self) -> String {
        let band = match self.usable_to_hz {
            Some(hz) => format!("the force is usable to {hz:.0} Hz"),
            None => "the force is usable over the whole band".into(),
        };
        format!("{} used, {} refused; {band}", self.used, self.refused)
    }
}

/// Median and worst over all responses; `null` where it is not known.
#[derive(Clone, Debug, Serialize)]
struct Spread {
    median: Option<f64>,
    worst: Option<f64>,
}

impl Spread {
    /// Median and worst of the values that are known; the worst is the one with the greatest `toll`.
    fn of(values: impl Iterator<Item = f64>, toll: impl Fn(f64) -> f64) -> Self {
        let mut known: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        known.sort_unstable_by(|a, b| toll(*a).total_cmp(&toll(*b)));
        Self { median: known.get(known.len() / 2).copied(), worst: known.last().copied() }
    }

    fn text(&self, unit: &str, scale: f64) -> String {
        match (self.median, self.worst) {
            (Some(median), Some(worst)) => {
                format!("{:.1} {unit} (worst {:.1})", median * scale, worst * scale)
            }
            _ => "not known".into(),
        }
    }
}

impl Report {
    pub(super) fn of(
        library: &Library,
        places: &Places,
        latency: Option<[f64; 2]>,
        truth: Option<&str>,
        seconds_per_recording: f64,
        taken: Duration,
    ) -> Result<Self, TaskError> {
        let qualities: Vec<Quality> = library
            .done()
            .into_iter()
            .map(|point| library.quality(point))
            .collect::<Result<Vec<_>, _>>()?
            .into_iter()
            .flatten()
            .collect();
        let over = |value: fn(&Quality) -> f64| qualities.iter().map(value).collect::<Vec<_>>().into_iter();
        Ok(Self {
            library: library.path().display().to_string(),
            points: library.points().len(),
            probed: places.probed,
            measured: library.done().len(),
            bad: library.in_state(PointState::Bad),
            latency_samples: latency.map(|found| found[0]),
            latency_spread_samples: latency.map(|found| found[1]),
            signal_to_noise_db: Spread::of(over(|q| q.signal_to_noise_db), |db| -db),
            distortion_db: Spread::of(over(|q| 20.0 * q.distortion.log10()), |db| db),
            decay_time_s: Spread::of(over(|q| q.decay_time), |s| -s),
            reciprocity_error: reciprocity(library)?,
            seconds_per_recording,
            seconds: taken.as_secs_f64(),
            blows: Blows::of(library),
            wavelength: wavelength::logged(library),
            doubtful: library.doubts().iter().map(ToString::to_string).collect(),
            notes: notes(library),
            truth: truth.map(str::to_owned),
        })
    }

    /// The report as a few lines of text for people.
    pub fn text(&self) -> String {
        let mut text = format!("{}: {} of {} points measured", self.library, self.measured, self.points);
        if !self.bad.is_empty() {
            let bad: Vec<String> = self.bad.iter().map(|point| (point + 1).to_string()).collect();
            let _ = write!(text, ", bad: {}", bad.join(", "));
        }
        let _ = writeln!(text, "\n  signal to noise  {}", self.signal_to_noise_db.text("dB", 1.0));
        let _ = writeln!(text, "  distortion       {}", self.distortion_db.text("dB", 1.0));
        let _ = writeln!(text, "  decay time       {}", self.decay_time_s.text("ms", 1e3));
        if let (Some(late), Some(spread)) = (self.latency_samples, self.latency_spread_samples) {
            let _ =
                writeln!(text, "  latency          {late:.2} samples (actuators agree within {spread:.2})");
        }
        if let Some(error) = self.reciprocity_error {
            let _ = writeln!(text, "  reciprocity      {:.2} % error, with gains fitted", error * 100.0);
        }
        if let Some(blows) = &self.blows {
            let _ = writeln!(text, "  blows            {}", blows.text());
        }
        if let Some(told) = &self.wavelength {
            let _ = writeln!(text, "  wavelength       {}", wavelength::text(told));
        }
        for note in &self.notes {
            let _ = writeln!(text, "  note             {note}");
        }
        if let Some(truth) = &self.truth {
            let _ = writeln!(text, "  true surface     {truth}");
        }
        text
    }
}

/// The reciprocity error from the library's log, with gains fitted; without an entry, the error of its
/// responses as they are.
fn reciprocity(library: &Library) -> Result<Option<f64>, TaskError> {
    let judged = library.logged("reciprocity").and_then(|log| log["error"].as_f64());
    Ok(judged.map_or_else(|| library.reciprocity_error(), |error| Ok(Some(error)))?)
}

/// Largest number of notes on single points that are printed: all are in the library.
const LISTED: usize = 8;

/// Notes: sentences of the library's log, then those on single recordings, then the reason why absolute levels are unknown.
fn notes(library: &Library) -> Vec<String> {
    let said = library.log_book().values().filter_map(|entry| entry.get("said")?.as_str());
    let mut notes: Vec<String> = said.map(str::to_owned).collect();
    let points = (0..library.points().len()).filter_map(|point| {
        let said = library.logged_point(point)?.get(SAID)?.as_array()?;
        let said: Vec<&str> = said.iter().filter_map(|one| one.as_str()).collect();
        Some((point + 1, said.join("; ")))
    });
    let mut by_words: Vec<(String, Vec<usize>)> = Vec::new();
    for (point, said) in points {
        match by_words.iter_mut().find(|(words, _)| *words == said) {
            Some((_, points)) => points.push(point),
            None => by_words.push((said, vec![point])),
        }
    }
    let more = by_words.len().saturating_sub(LISTED);
    notes.extend(by_words.into_iter().take(LISTED).map(|(said, points)| match points[..] {
        [point] => format!("point {point}: {said}"),
        [first, ..] => format!("point {first} and {} more: {said}", points.len() - 1),
        [] => said,
    }));
    if more > 0 {
        notes.push(format!("{more} more notes on points are in the library's log"));
    }
    notes.extend(library.without_scale().map(str::to_owned));
    notes
}
