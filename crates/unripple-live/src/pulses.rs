//! What is over by itself: one drive, once.

use crate::{Conductor, LiveError};
use unripple_core::Point;
use unripple_effects::Level;
use unripple_player::{At, Command, Voice};

/// A pulse that is begun so late, in s, is not begun at all.
pub(crate) const STALE: f64 = 0.1;

impl Conductor {
    /// Plays a pulse that was to begin at a sample.
    pub(crate) fn pulse(
        &mut self,
        points: &[Point],
        level: Level,
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
        let voice = Voice(self.name(asked));
        self.send(Command::Start { voice, drive, at, gain, period: None });
        Ok(())
    }

    pub(crate) fn pulse_gain(&mut self, points: &[Point], level: Level) -> Result<f32, LiveError> {
        let (gain, beyond) = self.drives.pulse_gain(points, level.scaled(self.trim))?;
        self.tally.beyond += u64::from(beyond);
        Ok(gain as f32)
    }

    /// Whether what is over by itself may begin now; what may not is counted.
    pub(crate) fn can_begin(&mut self) -> bool {
        let full = self.desk.room() == 0;
        self.tally.stale += u64::from(self.stands);
        self.tally.lost += u64::from(full && !self.stands);
        !self.stands && !full
    }
}
