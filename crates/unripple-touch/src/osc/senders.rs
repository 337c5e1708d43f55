//! Senders on a port, with quotas.

use super::sequence::Sequence;
use std::net::SocketAddr;

/// Addresses known at once; further ones are counted and dropped, so that memory is bounded.
const MOST: usize = 16;
/// Names that one address may use: several trackers on one machine.
const MOST_NAMES: usize = 4;
/// The longest name of a sender, in bytes; a longer one is refused.
const LONGEST_NAME: usize = 128;
/// Lists of fingers that one name keeps: 2Dcur, 2Dobj, 2Dblb, and that of TUIO 2.
pub(super) const LISTS: usize = 4;

#[derive(Clone, Debug)]
struct Sender {
    address: SocketAddr,
    peer: u32,
    names: Vec<(String, [Sequence; LISTS])>,
    spoken: f64,
}

/// The addresses that have sent something lately. A known sender keeps its place until it has been silent for a
/// while; new ones are refused while all places are taken.
#[derive(Clone, Debug, Default)]
pub(super) struct Senders {
    known: Vec<Sender>,
    given: u32,
}

impl Senders {
    /// Index of the sender at an address, which sends a packet at a time in s, and whether it is new; none if there
    /// is no room for it.
    pub(super) fn find(&mut self, address: SocketAddr, now: f64) -> Option<(usize, bool)> {
        if let Some(i) = self.known.iter().position(|sender| sender.address == address) {
            self.known[i].spoken = now;
            return Some((i, false));
        }
        if self.known.len() >= MOST {
            return None;
        }
        let names = vec![(String::new(), Default::default())];
        self.known.push(Sender { address, peer: self.given, names, spoken: now });
        self.given = self.given.wrapping_add(1);
        Some((self.known.len() - 1, true))
    }

    /// Unique number of the sender at an index.
    pub(super) fn peer(&self, i: usize) -> u32 {
        self.known[i].peer
    }

    /// Index of a name among those of a sender; none if there is no room for it.
    pub(super) fn name(&mut self, i: usize, name: &str) -> Option<usize> {
        let names = &mut self.known[i].names;
        if let Some(found) = names.iter().position(|(known, _)| known == name) {
            return Some(found);
        }
        if names.len() >= MOST_NAMES || name.len() > LONGEST_NAME {
            return None;
        }
        names.push((name.to_owned(), Default::default()));
        Some(names.len() - 1)
    }

    /// The frame numbers of one list of a sender.
    pub(super) fn sequence(&mut self, i: usize, name: usize, list: usize) -> &mut Sequence {
        &mut self.known[i].names[name].1[list]
    }

    /// Forgets senders whose last packet came before a time in s.
    pub(super) fn forget(&mut self, before: f64) {
        self.known.retain(|sender| sender.spoken >= before);
    }

    /// How many addresses and names are kept.
    pub(super) fn count(&self) -> usize {
        self.known.iter().map(|sender| 1 + sender.names.len()).sum()
    }
}
