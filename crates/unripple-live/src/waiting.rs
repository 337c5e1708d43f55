//! Cues that wait for the time at which their drives begin.

use crate::Conductor;
use crate::pulses::STALE;
use unripple_core::Touch;
use unripple_effects::{Act, Cue};
use unripple_player::At;

/// Cues that may wait for their time; more are counted and dropped.
const MOST_WAITING: usize = 1 << 16;

/// A cue that waits for its time, and the time of the touch that it is the first answer to, in samples.
pub(crate) struct Waiting {
    /// The cue that is to be played.
    pub cue: Cue,
    /// Time of the touch that it answers, in samples.
    pub asked: Option<u64>,
}

impl Conductor {
    /// Queues cues for the time at which their drives begin.
    pub(crate) fn queue(&mut self, cues: &mut Vec<Cue>, now: u64, touch: Option<&Touch>) {
        let mut voice = None;
        for cue in cues.drain(..) {
            let focus = self.sample(cue.at);
            let sample = focus.saturating_sub(self.lead).max(now);
            let late = now.saturating_sub(focus) as f64 / self.rate;
            if late > STALE && passes(&cue.act) {
                // It is too late for it to be felt; computing its drive would only delay the next.
                self.tally.stale += 1;
                continue;
            }
            // Of the cues of one voice that a touch sets off, the first counts as its answer.
            let first = voice.replace(cue.voice) != Some(cue.voice);
            let asked = touch.filter(|_| first).map(|touch| self.sample(touch.time));
            if let Act::Stop { fade } = cue.act
                && self.stop(&cue, fade, sample, now)
            {
                continue;
            }
            if self.overtake(&cue, now) {
                continue;
            }
            if self.waiting.len() >= MOST_WAITING {
                self.tally.dropped += 1;
                continue;
            }
            self.order += 1;
            self.waiting.insert((sample, self.order), Waiting { cue, asked });
        }
    }

    /// Ends a voice from a sample on, at once rather than in turn, since drives that were requested before may take
    /// long to compute. Returns whether that was all; a stop known ahead is also queued.
    fn stop(&mut self, cue: &Cue, fade: f64, sample: u64, now: u64) -> bool {
        let fade = self.fade(fade);
        if sample > now {
            self.waiting.retain(|(at, _), other| other.cue.voice != cue.voice || *at < sample);
            if let Some(hold) = self.sounding.get(&cue.voice).and_then(|state| state.hold.as_ref()) {
                hold.stop(At::Sample(sample), fade);
            }
            return false;
        }
        let (old, late) = (self.old, self.late);
        self.waiting.retain(|(_, order), Waiting { cue: other, .. }| {
            // Pulses that came in the same moment are played, unless there is no time for all of them.
            let along = passes(&other.act) && *order > old && !late && other.at <= cue.at;
            other.voice != cue.voice || along
        });
        self.ahead.take_back(cue.voice);
        self.let_go(cue.voice, fade, At::Now);
        self.tally.cues += 1;
        true
    }

    /// Replaces the place or level of a waiting cue that there was no time for: only the last is worth a drive.
    /// Returns whether there was one.
    fn overtake(&mut self, cue: &Cue, now: u64) -> bool {
        if !matches!(cue.act, Act::Move { .. } | Act::Gain { .. }) {
            return false;
        }
        let old = self.old;
        let mut of_voice = self.waiting.iter_mut().rev().filter(|(_, waits)| waits.cue.voice == cue.voice);
        match of_voice.next() {
            Some(((at, order), waits))
                if *at <= now
                    && *order <= old
                    && std::mem::discriminant(&waits.cue.act) == std::mem::discriminant(&cue.act) =>
            {
                waits.cue = cue.clone();
                true
            }
            _ => false,
        }
    }
}

/// Whether an act ends by itself.
fn passes(act: &Act) -> bool {
    matches!(act, Act::Pulse { .. } | Act::Shape { .. })
}
