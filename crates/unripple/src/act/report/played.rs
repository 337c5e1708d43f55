//! The report of waveforms and strokes.

use crate::field::{SilenceFigures, WaveformFigures};
use serde::Serialize;

/// A target that follows a waveform: what was asked of it, and how well it did.
#[derive(Clone, Debug, Serialize)]
pub struct Followed {
    /// How well the target followed its waveform.
    #[serde(flatten)]
    pub figures: WaveformFigures,
    /// Start of the waveform, in seconds from the drive's first sample.
    pub start_s: f64,
    /// Largest magnitude asked for, in metres, after the limit and within the band.
    pub asked_peak_m: f64,
    /// Share of the waveform's energy outside the band, which was not asked for.
    pub lost: f64,
}

/// A moving focus (stroke): what was asked of it, and how even it was.
#[derive(Clone, Debug, Serialize)]
pub struct Stroked {
    /// Pulses that make it.
    pub pulses: usize,
    /// Duration of the stroke, in seconds.
    pub duration_s: f64,
    /// Start of the stroke, in seconds from the drive's first sample.
    pub start_s: f64,
    /// Velocity asked of every pulse, after the limit, in m/s.
    pub asked_m_s: f64,
    /// Least and greatest velocity along the path, each place at the pulse nearest to its own instant, over what was asked, in dB.
    pub level_range_db: [f64; 2],
    /// The same for the largest velocity of a place within half a pulse interval of its instant.
    pub peak_range_db: [f64; 2],
}

/// Motion of each target and point of silence, a line each.
pub(super) fn lines(
    waveforms: &[Followed],
    silent: &[SilenceFigures],
    stroke: Option<&Stroked>,
) -> Vec<String> {
    let mm = |at: &[f64; 2]| format!("({:.2}, {:.2}) mm", at[0] * 1e3, at[1] * 1e3);
    let follow = |f: &Followed| {
        let w = &f.figures;
        let others = w.crosstalk_db.map_or(String::new(), |db| format!(", others {db:.1} dB"));
        let (at, asked) = (mm(&w.at_m), f.asked_peak_m * 1e6);
        format!("waveform {at}: {asked:.3} µm asked, gain {:.4}, error {:.1} dB{others}", w.gain, w.error_db)
    };
    let still = |s: &SilenceFigures| format!("silence {}: {:.1} dB", mm(&s.at_m), s.level_db);
    let along = |s: &Stroked| {
        let [low, high] = s.level_range_db;
        let (ms, v) = (s.duration_s * 1e3, s.asked_m_s * 1e3);
        format!(
            "stroke: {} pulses in {ms:.1} ms, {v:.3} mm/s asked, level along the path {low:.2} to {high:.2} dB",
            s.pulses
        )
    };
    waveforms.iter().map(follow).chain(silent.iter().map(still)).chain(stroke.map(along)).collect()
}
