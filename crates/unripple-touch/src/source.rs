use crate::{Counts, Heard};

/// Whatever tells of touches.
///
/// From any source, a finger comes ([`Down`](unripple_core::Phase::Down)) before it moves, leaves once, and its number is
/// never used again; times never run back.
pub trait Source: Send {
    /// What people call it: `UDP 127.0.0.1:3333`.
    fn name(&self) -> &str;

    /// Appends what happened up to `now`, in s of the caller's clock. Never blocks, and does bounded work: what is left
    /// over comes at the next call. Call it some hundred times a second.
    fn poll(&mut self, now: f64, heard: &mut Heard);

    /// What was taken in and what was refused so far.
    fn counts(&self) -> Counts;
}
