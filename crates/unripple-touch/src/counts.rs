//! Counts of what a source of touches accepted and refused.

use std::ops::Add;

/// Counts of what a source has accepted and refused since it was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Packets, messages or events that came in, good and bad.
    pub packets: u64,
    /// Touches handed on.
    pub touches: u64,
    /// Wishes handed on.
    pub wishes: u64,
    /// Senders seen: addresses, connections.
    pub senders: u64,
    /// Packets or messages that could not be read: truncated, too long, nested too deep, of wrong types.
    pub malformed: u64,
    /// Messages that can be read but mean nothing here.
    pub unknown: u64,
    /// Positions, forces or levels that are no numbers, or impossible ones.
    pub numbers: u64,
    /// Positions that are not on the surface.
    pub outside: u64,
    /// Frames older than one already taken.
    pub late: u64,
    /// Fingers, senders, connections or wishes beyond the most there may be.
    pub crowded: u64,
    /// Fingers lifted because nobody spoke of them any more.
    pub expired: u64,
    /// Connections refused for where they came from.
    pub foreign: u64,
    /// Connections dropped for saying nothing, or for taking nothing.
    pub silent: u64,
    /// Readings that the system refused: an unplugged screen, a broken socket.
    pub failed: u64,
}

impl Counts {
    /// Number of all refusals, of whatever kind.
    pub fn errors(&self) -> u64 {
        let read = self.malformed + self.unknown + self.numbers + self.outside;
        read + self.late + self.crowded + self.foreign + self.silent + self.failed
    }
}

impl Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            packets: self.packets + other.packets,
            touches: self.touches + other.touches,
            wishes: self.wishes + other.wishes,
            senders: self.senders + other.senders,
            malformed: self.malformed + other.malformed,
            unknown: self.unknown + other.unknown,
            numbers: self.numbers + other.numbers,
            outside: self.outside + other.outside,
            late: self.late + other.late,
            crowded: self.crowded + other.crowded,
            expired: self.expired + other.expired,
            foreign: self.foreign + other.foreign,
            silent: self.silent + other.silent,
            failed: self.failed + other.failed,
        }
    }
}
