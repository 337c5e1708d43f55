//! A queue of commands by sample.

use crate::desk::Sent;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Commands that wait for their sample: the earliest first, and among those of one sample the first that was sent.
pub(crate) struct Schedule {
    heap: BinaryHeap<Reverse<Waiting>>,
    most: usize,
}

struct Waiting {
    sample: u64,
    sent: Sent,
}

impl Waiting {
    fn key(&self) -> (u64, u64) {
        (self.sample, self.sent.id)
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.key().cmp(&other.key())
    }
}

impl Schedule {
    /// Room for a number of commands.
    pub(crate) fn new(most: usize) -> Self {
        Self { heap: BinaryHeap::with_capacity(most), most }
    }

    /// Queues a command until a sample of the clock; returns the command if the queue is full.
    pub(crate) fn push(&mut self, sample: u64, sent: Sent) -> Result<(), Sent> {
        if self.heap.len() >= self.most {
            return Err(sent);
        }
        self.heap.push(Reverse(Waiting { sample, sent }));
        Ok(())
    }

    /// Whether no command waits.
    pub(crate) fn is_empty(&self) -> bool {
        self.heap.is_empty()
    }

    /// The sample at which the first command in the queue acts.
    pub(crate) fn next(&self) -> Option<u64> {
        self.heap.peek().map(|Reverse(waiting)| waiting.sample)
    }

    /// Removes the first command from the queue, and returns it with the sample at which it acts.
    pub(crate) fn pop(&mut self) -> Option<(u64, Sent)> {
        self.heap.pop().map(|Reverse(waiting)| (waiting.sample, waiting.sent))
    }
}
