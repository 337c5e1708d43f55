//! Cues that wait for the time at which their drives begin.

use crate::Conductor;
use crate::pulses::STALE;
use unripple_core::Touch;
use unripple_effects::{Act, Cue};

/// Cues that may wait for their time; more are counted and dropped.
const MOST_WAITING: usize = 1 << 16;

/// A cue that waits for its time, and when the touch came that it answers first, in samples.
pub(crate) struct Waiting {
    pub cue: Cue,
    pub asked: Option<u64>,
}

impl Conductor {
    /// Puts cues where they wait for the beginning of their drives.
    pub(crate) fn queue(&mut self, cues: &mut Vec<Cue>, now: u64, touch: Option<&Touch>) {
        let mut voice = None;
        for cue in cues.drain(..) {
            let focus = self.sample(cue.at);
            let sample = focus.saturating_sub(self.lead).max(now);
            let late = now.saturating_sub(focus) as f64 / self.rate;
            if late > STALE && matches!(cue.act, Act::Pulse { .. } | Act::Shape { .. }) {
                // Nobody feels now what was asked for then; making it would only make the next later.
                self.tally.stale += 1;
                continue;
            }
            if let Act::Stop { .. } = cue.act {
                self.waiting.retain(|(at, _), other| other.cue.voice != cue.voice || *at < sample);
            } else if self.waiting.len() >= MOST_WAITING {
                self.tally.dropped += 1;
                continue;
            }
            // Of what a touch sets off under a voice the first answers it.
            let first = voice.replace(cue.voice) != Some(cue.voice);
            let asked = touch.filter(|_| first).map(|touch| self.sample(touch.time));
            self.order += 1;
            self.waiting.insert((sample, self.order), Waiting { cue, asked });
        }
    }
}
