//! Frame counters of the two sides of a card, and whether both run on one clock.

use super::side::Side;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU32, Ordering};

/// Largest lag of a side behind the other if both run on one clock, as a multiple of the sum of their
/// largest chunks: a card holds two of each, and the system that transfers them between card and program may
/// be late by one more.
const SLACK: u32 = 3;

/// Number of chunks after the start of a side in which a lag is not taken for a difference of clocks. A
/// card's sides start one after the other, and the first chunks that are played only fill the card's buffer.
const FIRST: u32 = 8;

/// Counter of one side.
#[derive(Debug, Default)]
struct Count {
    /// Number of frames so far, modulo 2^32.
    at: AtomicU32,
    /// Number of chunks so far, modulo 2^32.
    chunks: AtomicU32,
    /// Largest chunk so far, in frames.
    largest: AtomicU32,
}

/// Frame counters of both sides of a card.
///
/// Recorded samples are matched to played ones by their number, so both have to count the same time. A side
/// that was not called for a while, or whose clock is slower, is behind; its counter is then set to that of
/// the other side, so that nobody waits for frames that never come.
#[derive(Debug, Default)]
pub(super) struct Counts {
    sides: [Count; 2],
    /// Frames by which a side was behind when that was first noticed: positive for playing, negative for recording; 0 if
    /// never.
    apart: AtomicI64,
    /// Whether the counter of recording is to be set to that of playing, however little it is behind.
    catch_up: AtomicBool,
}

impl Counts {
    fn side(&self, side: Side) -> &Count {
        &self.sides[side as usize]
    }

    /// The number of the first frame of a side's next chunk, given the side's counter `at`.
    pub(super) fn next(&self, side: Side, at: u32, frames: usize) -> u32 {
        let (own, other) = (self.side(side), self.side(side.other()));
        let frames = frames as u32;
        let largest = own.largest.fetch_max(frames, Ordering::Relaxed).max(frames);
        let chunks = own.chunks.load(Ordering::Relaxed);
        if other.chunks.load(Ordering::Acquire) == 0 {
            return at;
        }
        // Drive is counted before it is played, sound after it was recorded.
        let now = if side == Side::Playback { at } else { at.wrapping_add(frames) };
        let behind = other.at.load(Ordering::Acquire).wrapping_sub(now) as i32;
        let most = SLACK.saturating_mul(largest.saturating_add(other.largest.load(Ordering::Relaxed)));
        let asked = side == Side::Capture && self.catch_up.swap(false, Ordering::Relaxed);
        if behind <= 0 || (behind as u32 <= most && !asked) {
            return at;
        }
        if chunks >= FIRST && !asked {
            let signed = if side == Side::Playback { i64::from(behind) } else { -i64::from(behind) };
            let _ = self.apart.compare_exchange(0, signed, Ordering::Relaxed, Ordering::Relaxed);
        }
        at.wrapping_add(behind as u32)
    }

    /// Records that a side has processed a chunk, after which its counter is `at`.
    pub(super) fn passed(&self, side: Side, at: u32) {
        let own = self.side(side);
        own.at.store(at, Ordering::Release);
        // Never 0 again, since 0 means that the side has not begun.
        let more = |chunks: u32| Some(chunks.checked_add(1).unwrap_or(FIRST));
        let _ = own.chunks.fetch_update(Ordering::Release, Ordering::Relaxed, more);
    }

    /// Requests that the counter of recording be set to that of playing: it is too late for the program,
    /// though not by so much that the clocks must differ.
    pub(super) fn catch_up(&self) {
        self.catch_up.store(true, Ordering::Relaxed);
    }

    /// Number of chunks of a side so far, modulo 2^32.
    pub(super) fn chunks(&self, side: Side) -> u32 {
        self.side(side).chunks.load(Ordering::Acquire)
    }

    /// A side's largest chunk so far, in frames.
    pub(super) fn largest(&self, side: Side) -> usize {
        self.side(side).largest.load(Ordering::Relaxed) as usize
    }

    /// Message that the counters of the two sides have drifted apart; `None` if they have not.
    pub(super) fn apart(&self) -> Option<String> {
        let [late, ahead] = match self.apart.load(Ordering::Relaxed) {
            0 => return None,
            1.. => ["plays", "records"],
            _ => ["records", "plays"],
        };
        let frames = self.apart.load(Ordering::Relaxed).unsigned_abs();
        Some(format!(
            "the side that {late} fell {frames} frames behind the one that {ahead}: they run on two clocks, or one of them \
             stopped for a while; choose one card for both (`unripple devices` lists them), and larger blocks if it is one"
        ))
    }
}
