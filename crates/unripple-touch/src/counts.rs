//! Counts of what a source of touches accepted and refused.

use std::ops::Add;

/// Counts of what a source has accepted and refused since it was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Packets, messages or events that were received, valid or not.
    pub packets: u64,
    /// Touches passed to the caller: fingers put down, moved and lifted.
    pub touches: u64,
    /// Touches that put a finger down, among those passed to the caller.
    pub downs: u64,
    /// Requests for an effect or a level ([`Wish`](crate::Wish)) passed to the caller.
    pub wishes: u64,
    /// Number of senders, by network address or connection, from which something was received.
    pub senders: u64,
    /// Packets or messages that could not be read: truncated, too long, nested too deep, of wrong types.
    pub malformed: u64,
    /// Well-formed messages that mean nothing to the source: an unknown address, a finger that is not down.
    pub unknown: u64,
    /// Positions, forces or gains that are NaN, infinite or out of range.
    pub numbers: u64,
    /// Positions that are not on the surface.
    pub outside: u64,
    /// Tracker frames that were dropped because a later one had been accepted already.
    pub late: u64,
    /// Fingers, senders, connections or requests refused because the largest number allowed was reached.
    pub crowded: u64,
    /// Fingers lifted because no message about them came within the time-out
    /// ([`Options::timeout`](crate::Options::timeout)).
    pub expired: u64,
    /// Connections refused because of their origin, the web page that opened them.
    pub foreign: u64,
    /// Connections closed because the client sent nothing or did not read its answers.
    pub silent: u64,
    /// Errors of the operating system: an unplugged screen, a broken socket.
    pub failed: u64,
}

impl Counts {
    /// Number of refusals and errors of all kinds. Fingers that expired are not among them.
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
            downs: self.downs + other.downs,
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
