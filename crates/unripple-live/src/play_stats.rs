//! Counts and latencies of a session of play.

use crate::{LiveError, Percentiles};
use unripple_player::{Report, Why};

/// Counts of what was played and what was not, and latencies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayStats {
    /// Number of cues played.
    pub cues: u64,
    /// Cues dropped because too many waited.
    pub dropped: u64,
    /// Pulses dropped because they came too late to be felt where they belong.
    pub stale: u64,
    /// Waveforms that found all inputs taken: not played, or later if they go on.
    pub crowded: u64,
    /// Levels asked for that the limit does not allow: played as strongly as it does.
    pub beyond: u64,
    /// Cues that failed, places beyond the rim for example, and the last failure.
    pub failed: u64,
    /// Text of the last failure.
    pub failure: Option<String>,
    /// Commands that found no room on their way to the player.
    pub lost: u64,
    /// Drives and waveforms that started.
    pub started: u64,
    /// Events scaled down by a limit, and the least factor.
    pub limited: u64,
    /// The least factor that a limit left of an event.
    pub least: Option<f32>,
    /// Blocks from which on all waveforms were scaled down.
    pub waves_limited: u64,
    /// Commands that came too late for their sample.
    pub late: u64,
    /// Commands that the player refused.
    pub refused: u64,
    /// Latencies from a touch to the first sample that answers it, on the engine's own clock, in s.
    pub first_sample: Percentiles,
    /// Latencies from a touch to the focus, in s.
    pub focus: Percentiles,
}

impl PlayStats {
    /// One that failed.
    pub(crate) fn fail(&mut self, error: &dyn std::error::Error) {
        self.failed += 1;
        self.failure = Some(error.to_string());
    }

    /// Whether something went well; what failed is counted, unless no drive can be made any more.
    pub(crate) fn record(&mut self, result: Result<(), LiveError>) -> Result<bool, LiveError> {
        match result {
            Err(error @ LiveError::Gone { .. }) => return Err(error),
            Err(error) => self.fail(&error),
            Ok(()) => return Ok(true),
        }
        Ok(false)
    }

    /// What the player says.
    pub(crate) fn hear(&mut self, report: &Report) {
        match report {
            Report::Started { .. } => self.started += 1,
            Report::Limited { scale, .. } => {
                self.limited += 1;
                self.least = Some(self.least.map_or(*scale, |least| least.min(*scale)));
            }
            Report::WavesLimited { .. } => self.waves_limited += 1,
            Report::Late { .. } => self.late += 1,
            Report::Refused { why: Why::Stale, .. } => self.stale += 1,
            Report::Refused { .. } => self.refused += 1,
            Report::Ended { .. } => {}
        }
    }
}
