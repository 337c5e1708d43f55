//! Part of a report on waveforms and strokes.

use crate::field::{SilenceFigures, WaveformFigures};
use serde::Serialize;

/// A target that follows a waveform: what was prescribed, and how well it is followed.
#[derive(Clone, Debug, Serialize)]
pub struct Followed {
    /// Metrics of how well the target follows its waveform.
    #[serde(flatten)]
    pub figures: WaveformFigures,
    /// Start of the waveform, in seconds from the drive's first sample.
    pub start_s: f64,
    /// Largest displacement prescribed, in metres, after scaling to the limits and within the band.
    pub asked_peak_m: f64,
    /// Share of the waveform's energy, 0 to 1, outside the band, which was left out.
    pub lost: f64,
}

/// A focus that moves along a path (stroke): what was prescribed, and how even its level is.
#[derive(Clone, Debug, Serialize)]
pub struct Stroked {
    /// Number of pulses in the stroke.
    pub pulses: usize,
    /// Duration of the stroke, in seconds.
    pub duration_s: f64,
    /// Start of the stroke, in seconds from the drive's first sample.
    pub start_s: f64,
    /// Velocity prescribed for every pulse, after scaling to the limits, in m/s.
    pub asked_m_s: f64,
    /// Least and greatest velocity along the path, in dB relative to `asked_m_s`. The velocity at each point of the path is
    /// taken at the instant of the pulse nearest to the time at which the focus passes it.
    pub level_range_db: [f64; 2],
    /// Least and greatest peak velocity along the path, in dB relative to `asked_m_s`. The peak at each point is the largest
    /// velocity within half a pulse interval of the time at which the focus passes it.
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
