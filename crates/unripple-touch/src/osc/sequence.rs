//! Order of TUIO frames: late ones dropped, restarts noticed.

/// Silence after which a smaller frame number means that the sender has restarted, in s. TUIO trackers repeat
/// themselves once a second; with a shorter time, late packets would count as a restart.
const SILENCE: f64 = 1.0;
/// Largest lag of a late frame; a number further behind means that the sender has restarted.
const LATEST: u32 = 100;

/// The order of a frame by its number: new, late or a restart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// The next frame, or another part of the last one.
    Next,
    /// A later frame was accepted already.
    Late,
    /// The sender has restarted: its frame numbers begin anew.
    Restart,
}

/// The numbers of a sender's frames, which grow, wrap round, and begin anew when the sender does.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sequence {
    last: Option<u32>,
    taken: f64,
}

impl Sequence {
    /// Judges the frame `id` of a count that wraps at 2 to the power of `bits`, at a time in s.
    pub(super) fn judge(&mut self, id: u32, bits: u32, now: f64) -> Verdict {
        let mask = u32::MAX >> (32 - bits);
        let verdict = match self.last {
            None => Verdict::Next,
            Some(last) => {
                let ahead = id.wrapping_sub(last) & mask;
                let behind = last.wrapping_sub(id) & mask;
                match ahead <= mask / 2 {
                    true => Verdict::Next,
                    false if behind <= LATEST && now - self.taken < SILENCE => Verdict::Late,
                    false => Verdict::Restart,
                }
            }
        };
        if verdict != Verdict::Late {
            (self.last, self.taken) = (Some(id), now);
        }
        verdict
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Late, Next, Restart};
    use super::*;

    #[test]
    fn tells_late_from_begun_anew() {
        let mut sequence = Sequence::default();
        let mut judge = |id: u32, now: f64| sequence.judge(id, 31, now);
        assert_eq!(judge(500, 0.0), Next);
        assert_eq!(judge(500, 0.01), Next);
        assert_eq!(judge(503, 0.02), Next);
        assert_eq!(judge(501, 0.03), Late);
        assert_eq!(judge(403, 0.03), Late);
        assert_eq!(judge(402, 0.04), Restart);
        assert_eq!(judge(403, 0.05), Next);
        assert_eq!(judge(398, 0.06), Late);
        assert_eq!(judge(398, 1.06), Restart);
    }

    #[test]
    fn wraps_round() {
        let mut signed = Sequence::default();
        assert_eq!(signed.judge(i32::MAX as u32, 31, 0.0), Next);
        assert_eq!(signed.judge(0, 31, 0.0), Next);
        assert_eq!(signed.judge(i32::MAX as u32, 31, 0.0), Late);
        let mut signed = Sequence::default();
        assert_eq!(signed.judge(i32::MAX as u32, 31, 0.0), Next);
        assert_eq!(signed.judge(i32::MIN as u32, 31, 0.0), Next);
        let mut unsigned = Sequence::default();
        assert_eq!(unsigned.judge(u32::MAX, 32, 0.0), Next);
        assert_eq!(unsigned.judge(1, 32, 0.0), Next);
        assert_eq!(unsigned.judge(u32::MAX, 32, 0.0), Late);
    }
}
