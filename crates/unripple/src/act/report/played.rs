//! Part of a report on waveforms and strokes.

use crate::field::{SilenceFigures, TargetFigures, WaveformFigures};
use serde::Serialize;

/// A target that follows a waveform: what was prescribed, and how well it is followed.
#[derive(Clone, Debug, Serialize)]
pub struct Followed {
    /// Metrics of how well the target follows its waveform.
    #[serde(flatten)]
    pub figures: WaveformFigures,
    /// Start of the waveform, in seconds from the drive's first sample.
    pub start_s: f64,
    /// Largest prescribed displacement, in metres, after the waveform was restricted to the band and scaled
    /// to the drive limits.
    pub asked_peak_m: f64,
    /// Share of the waveform's energy, 0 to 1, outside the band, which was left out.
    pub lost: f64,
}

/// A focus that moves along a path (stroke): what was prescribed, and how even its level is.
#[derive(Clone, Debug, Serialize)]
pub struct Stroked {
    /// Number of pulses along the path.
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

/// Motion of each target and point of silence, a line each; `targets` are those of the waveforms, in their order, or the middle of
/// the path of a stroke.
pub(super) fn lines(
    waveforms: &[Followed],
    silent: &[SilenceFigures],
    stroke: Option<&Stroked>,
    targets: &[TargetFigures],
) -> Vec<String> {
    let waveforms = waveforms.iter().enumerate().map(|(i, followed)| followed.line(targets.get(i)));
    let still = |s: &SilenceFigures| format!("silence {}: {:.1} dB", place(&s.at_m), s.level_db);
    let middle = stroke.and(targets.first()).map(middle);
    let stroke = stroke.map(Stroked::line);
    waveforms.chain(silent.iter().map(still)).chain(stroke).chain(middle).collect()
}

impl Followed {
    /// Line on how well a waveform was followed, what is felt at its target, and the strongest motion
    /// elsewhere.
    fn line(&self, target: Option<&TargetFigures>) -> String {
        let w = &self.figures;
        let others = w.crosstalk_db.map_or(String::new(), |db| format!(", others {db:.1} dB"));
        let felt = target.and_then(|t| t.felt_level_db);
        let felt = felt.map_or(String::new(), |db| format!("; felt {db:.1} dB above threshold"));
        let elsewhere = target.and_then(|t| t.displacement_worst_spot);
        let elsewhere = elsewhere.map_or(String::new(), |ratio| {
            format!("; strongest elsewhere: {:.0} % of its largest displacement", 100.0 / ratio)
        });
        format!(
            "waveform {}: {:.3} µm asked, gain {:.4}, error {:.1} dB{others}{felt}{elsewhere}",
            place(&w.at_m),
            self.asked_peak_m * 1e6,
            w.gain,
            w.error_db
        )
    }
}

impl Stroked {
    /// Line on how even the level is along the path.
    fn line(&self) -> String {
        let ([low, high], [least, most]) = (self.level_range_db, self.peak_range_db);
        format!(
            "stroke: {} pulses in {:.1} ms, asked to move the surface at {:.3} mm/s at the focus (the level, not the speed along the path); \
             level along the path {low:.2} to {high:.2} dB, largest velocity in passing {least:.2} to {most:.2} dB",
            self.pulses,
            self.duration_s * 1e3,
            self.asked_m_s * 1e3
        )
    }
}

/// Line on the focus in the middle of a stroke's path.
fn middle(target: &TargetFigures) -> String {
    let contrast = target.contrast.map_or(String::new(), |ratio| format!(", contrast {ratio:.2}"));
    let spot = target.spot_diameter_m.map_or(String::new(), |m| format!(", spot diameter {:.3} mm", m * 1e3));
    format!("pulse in the middle of the path, {}{contrast}{spot}", place(&target.at_m))
}

fn place(at: &[f64; 2]) -> String {
    format!("({:.2}, {:.2}) mm", at[0] * 1e3, at[1] * 1e3)
}
