//! Counts and latencies of a session of play.

use crate::{LiveError, Percentiles};
use unripple_player::{Report, Why};

/// Counts of what was played and what was not, and latencies, of a session of live play.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayStats {
    /// Number of cues played.
    pub cues: u64,
    /// Cues dropped because too many waited.
    pub dropped: u64,
    /// Pulses dropped because they would have begun more than 0.1 s late, or because the player stood still.
    pub stale: u64,
    /// Waveforms that found all inputs of the player taken. Looped ones begin later, others are not played.
    pub crowded: u64,
    /// Pulses and waveforms whose level is beyond the limit, and was reduced to it.
    pub beyond: u64,
    /// Number of cues that failed, for example because of a place off the surface.
    pub failed: u64,
    /// Text of the last failure.
    pub failure: Option<String>,
    /// Commands lost because the queue to the player was full.
    pub lost: u64,
    /// Drives and waveforms that started.
    pub started: u64,
    /// Number of events scaled down by a limit.
    pub limited: u64,
    /// Smallest factor by which a limit scaled an event down.
    pub least: Option<f32>,
    /// Times that the player began to scale down all waveforms together.
    pub waves_limited: u64,
    /// Commands that reached the player after the sample they were meant for.
    pub late: u64,
    /// Commands that the player refused.
    pub refused: u64,
    /// Latencies from a touch to the first sample of its answer, in s. With [`Engine::run`](crate::Engine::run) the
    /// sample counts when it leaves the device, otherwise by the player's clock.
    pub first_sample: Percentiles,
    /// Latencies from a touch to the focus, in s.
    pub focus: Percentiles,
}

impl PlayStats {
    /// Counts a cue that failed.
    pub(crate) fn fail(&mut self, error: &dyn std::error::Error) {
        self.failed += 1;
        self.failure = Some(error.to_string());
    }

    /// Whether a result is good. An error is counted, and only returned if the thread that computes drives is gone.
    pub(crate) fn record(&mut self, result: Result<(), LiveError>) -> Result<bool, LiveError> {
        match result {
            Err(error @ LiveError::Gone { .. }) => return Err(error),
            Err(error) => self.fail(&error),
            Ok(()) => return Ok(true),
        }
        Ok(false)
    }

    /// Counts a report of the player.
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
