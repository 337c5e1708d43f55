//! Holds on the audio thread: what each keeps playing, and which are released.

use crate::hold::Held;
use crate::outlet::Outlet;
use crate::shelf::Garbage;
use std::sync::Arc;

/// What is held, by the number of the command that began it.
pub(crate) struct Leases {
    all: Vec<Lease>,
    most: usize,
}

struct Lease {
    id: u64,
    held: Arc<Held>,
    /// Whether the hold was released, and what it kept playing was ended.
    ended: bool,
}

/// A hold that is released.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LetGo {
    /// Number of the command that began what is held.
    pub(crate) id: u64,
    /// Sample of the clock at which the hold is released.
    pub(crate) sample: u64,
    /// Samples of the fade-out; `None` to ring out.
    pub(crate) fade: Option<u32>,
}

impl Leases {
    /// Room for at most `most` holds at once.
    pub(crate) fn new(most: usize) -> Self {
        Self { all: Vec::with_capacity(most), most }
    }

    /// Whether there are as many as may be.
    pub(crate) fn is_full(&self) -> bool {
        self.all.len() >= self.most
    }

    /// Notes what the command of number `id` began.
    pub(crate) fn put(&mut self, id: u64, held: Arc<Held>) {
        self.all.push(Lease { id, held, ended: false });
    }

    /// The hold that is released first, if it is released before sample `end`.
    pub(crate) fn next(&self, end: u64) -> Option<LetGo> {
        let going = self.all.iter().filter(|lease| !lease.ended);
        let (sample, lease) =
            going.map(|lease| (lease.held.until(), lease)).min_by_key(|(until, _)| *until)?;
        (sample < end).then(|| LetGo { id: lease.id, sample, fade: lease.held.fade() })
    }

    /// Notes that what the command of number `id` began was let go.
    pub(crate) fn let_go(&mut self, id: u64) {
        self.all.iter_mut().filter(|lease| lease.id == id).for_each(|lease| lease.ended = true);
    }

    /// Removes the holds of what no longer plays, and marks them as over at `sample`.
    pub(crate) fn settle(&mut self, sample: u64, is_on: impl Fn(u64) -> bool, outlet: &mut Outlet) {
        let mut at = 0;
        while at < self.all.len() {
            if is_on(self.all[at].id) {
                at += 1;
                continue;
            }
            let over = self.all.swap_remove(at);
            over.held.set_over(sample);
            outlet.discard(Garbage::Held(over.held));
        }
    }
}
