//! Counts and latencies of a session of play.

use crate::{LiveError, Percentiles};
use unripple_player::{Report, Why};

/// Counts of what was played and what was not, and latencies, of a session of live play.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayStats {
    /// Number of cues played.
    pub cues: u64,
    /// Number of cues dropped because too many were waiting for their time.
    pub dropped: u64,
    /// Number of pulses dropped because they would have begun more than 0.1 s late, or because the player
    /// stood still.
    pub stale: u64,
    /// Number of waveforms that found all inputs of the player in use. Looped ones begin later, others are
    /// not played.
    pub crowded: u64,
    /// Number of pulses and waveforms whose requested level was beyond the limit, and was reduced to the
    /// limit.
    pub beyond: u64,
    /// Number of cues that failed, for example because of a place off the surface.
    pub failed: u64,
    /// Text of the last failure.
    pub failure: Option<String>,
    /// Number of commands lost because the queue to the player was full.
    pub lost: u64,
    /// Number of drives and waveforms that started.
    pub started: u64,
    /// Number of drives that the player scaled down to stay within a limit.
    pub limited: u64,
    /// Smallest factor by which the player scaled down a drive; `None` if it scaled down none.
    pub least: Option<f32>,
    /// Number of times that the player began to scale down all waveforms together.
    pub waves_limited: u64,
    /// Number of commands and starts that the player carried out later than requested.
    pub late: u64,
    /// Number of commands that the player refused.
    pub refused: u64,
    /// Latencies, in s, from a touch to the first sample of the drive that answers it. With
    /// [`Engine::run`](crate::Engine::run) they end when that sample leaves the device, otherwise at its
    /// time on the player's clock.
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
