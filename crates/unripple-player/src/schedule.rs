use crate::Command;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Commands that wait for their sample: the earliest first, and among those of one sample the first that was sent.
pub(crate) struct Schedule {
    heap: BinaryHeap<Reverse<Waiting>>,
    most: usize,
    order: u64,
}

struct Waiting {
    sample: u64,
    order: u64,
    command: Command,
}

impl Waiting {
    fn key(&self) -> (u64, u64) {
        (self.sample, self.order)
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
    pub(crate) fn new(most: usize) -> Self {
        Self { heap: BinaryHeap::with_capacity(most), most, order: 0 }
    }

    /// Lets a command wait; gives it back if as many wait as may.
    pub(crate) fn push(&mut self, sample: u64, command: Command) -> Result<(), Command> {
        if self.heap.len() >= self.most {
            return Err(command);
        }
        self.order += 1;
        self.heap.push(Reverse(Waiting { sample, order: self.order, command }));
        Ok(())
    }

    /// The sample of the next.
    pub(crate) fn next(&self) -> Option<u64> {
        self.heap.peek().map(|Reverse(waiting)| waiting.sample)
    }

    /// Takes the next.
    pub(crate) fn pop(&mut self) -> Option<(u64, Command)> {
        self.heap.pop().map(|Reverse(waiting)| (waiting.sample, waiting.command))
    }
}
