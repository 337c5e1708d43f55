//! Figures of the task `listen`: the recording, and the modes.

use super::Report;
use unripple_plot::{Along, Axis, Band, Figure, Ink, Layer, Mark, Plot, Points, Rule, Scale, Span};

/// Pieces of the recording that are drawn, each with its least and its greatest sample: two for each point of a printed column.
const PIECES: usize = 600;

/// The figures with their names.
pub(super) fn all(report: &Report, sound: &[f64]) -> Vec<(&'static str, Figure)> {
    let mut all = vec![("recording", recording(report, sound))];
    if !report.modes.is_empty() {
        all.push(("modes", modes(report)));
    }
    all
}

/// The recording, its hits, and the part that was used.
fn recording(report: &Report, sound: &[f64]) -> Figure {
    let piece = sound.len().div_ceil(PIECES).max(1);
    let (mut x, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new());
    for (n, part) in sound.chunks(piece).enumerate() {
        x.push((n * piece) as f64 / report.sample_rate_hz);
        low.push(part.iter().copied().fold(f64::INFINITY, f64::min));
        high.push(part.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    }
    let used = Span {
        from: report.used_s[0],
        to: report.used_s[1],
        along: Along::Y,
        label: "used".into(),
        ..Span::default()
    };
    let band = Band { x, low, high, label: "recording".into(), ink: Ink::Palette(0) };
    let mut layers: Vec<Layer> = vec![used.into(), band.into()];
    layers.extend(report.hits_s.iter().map(|hit| Layer::from(Rule { at: *hit, ..Rule::default() })));
    let plot =
        Plot { x: Axis::new("Time (s)"), y: Axis::new("Recording (full scale)"), layers, ..Plot::default() };
    let description =
        "The recording: least and greatest samples over time, the hits, and the part that was used".into();
    Figure { description, ..Figure::of(plot) }
}

/// The decay time of every mode, over its frequency.
fn modes(report: &Report) -> Figure {
    let error = |mode: &super::Rung| {
        let [low, high] = mode.decay_interval_s;
        [mode.decay_time_s - low, high - mode.decay_time_s]
    };
    let points = Points {
        x: report.modes.iter().map(|mode| mode.frequency_hz).collect(),
        y: report.modes.iter().map(|mode| mode.decay_time_s).collect(),
        error: report.modes.iter().map(error).collect(),
        label: String::new(),
        ink: Ink::Palette(0),
        mark: Mark::Disc,
    };
    let plot = Plot {
        x: Axis { scale: Scale::Logarithmic, ..Axis::new("Frequency (Hz)") },
        y: Axis::new("Decay time (ms)").times(1e3),
        layers: vec![points.into()],
        ..Plot::default()
    };
    let description = "Decay times of the modes against their frequencies, with 95 % intervals".into();
    Figure { description, ..Figure::of(plot) }
}
