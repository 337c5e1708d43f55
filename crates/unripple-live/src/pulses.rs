//! Pulses: drives that are played once and end by themselves.

use crate::{Conductor, LiveError};
use std::collections::BTreeSet;
use unripple_core::Point;
use unripple_effects::Level;
use unripple_player::{At, Command, Hold, Report, Voice, Why};

/// Delay beyond which a late pulse is not begun, in s. It would be felt where the finger no longer is.
pub(crate) const STALE: f64 = 0.1;

/// Withdrawn pulses whose voice numbers are remembered until the player reports them; it does not report those that had
/// begun.
const MOST_TAKEN: usize = 1 << 12;

/// Pulses that were sent ahead of their time, so that a stop can withdraw those that have not begun.
#[derive(Debug, Default)]
pub(crate) struct Ahead {
    /// Voice, the player's voice number, and the hold of each.
    given: Vec<(u64, u64, Hold)>,
    taken: BTreeSet<u64>,
}

impl Ahead {
    /// Cancels the pulses of a voice that have not begun; those that have begun play to their end.
    pub fn take_back(&mut self, voice: u64) {
        for (_, player_voice, _) in self.given.extract_if(.., |(of, ..)| *of == voice) {
            self.taken.insert(player_voice);
            if self.taken.len() > MOST_TAKEN {
                self.taken.pop_first();
            }
        }
    }

    /// Removes the pulses that are over.
    pub fn forget_over(&mut self) {
        self.given.retain(|(_, _, hold)| hold.over().is_none());
    }

    /// Whether a report refuses a pulse only because [`Self::take_back`] cancelled it.
    pub fn meant(&mut self, report: &Report) -> bool {
        matches!(report, Report::Refused { voice: Some(number), why: Why::Stale } if self.taken.remove(&number.0))
    }
}

impl Conductor {
    /// Plays a pulse of a voice that was to begin at a sample.
    pub(crate) fn pulse(
        &mut self,
        voice: u64,
        (points, level): (&[Point], Level),
        asked: Option<u64>,
        (sample, at): (u64, At),
    ) -> Result<(), LiveError> {
        if self.desk.clock() > sample + (STALE * self.rate) as u64 {
            // The player went on while other drives were made.
            self.tally.stale += 1;
            return Ok(());
        }
        if !self.can_begin() {
            return Ok(());
        }
        let gain = self.pulse_gain(points, level)?;
        let drive = self.drives.at(points)?.prepared;
        let player_voice = self.new_player_voice(asked);
        let start = Command::Start { voice: Voice(player_voice), drive, at, gain, period: None };
        match at {
            At::Now => drop(self.send(start)),
            At::Sample(_) => {
                let hold = self.hold(start);
                self.ahead.given.extend(hold.map(|hold| (voice, player_voice, hold)));
            }
        }
        Ok(())
    }

    pub(crate) fn pulse_gain(&mut self, points: &[Point], level: Level) -> Result<f32, LiveError> {
        let (gain, beyond) = self.drives.pulse_gain(points, level.scaled(self.trim))?;
        self.tally.beyond += u64::from(beyond);
        Ok(gain as f32)
    }

    /// Whether a sound that ends by itself may begin now; if not, it is counted.
    pub(crate) fn can_begin(&mut self) -> bool {
        let full = self.desk.room() == 0;
        self.tally.stale += u64::from(self.stands);
        self.tally.lost += u64::from(full && !self.stands);
        !self.stands && !full
    }
}
