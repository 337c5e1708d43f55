//! One TUIO frame of one sender.

use rosc::OscType;

/// One finger of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Set {
    pub(super) session: i64,
    pub(super) place: (f64, f64),
    pub(super) pressure: Option<f64>,
}

/// One TUIO frame of one list of fingers: which are down, and the places of those that moved.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    /// Whether the frame lists all fingers that are down.
    pub(super) listed: bool,
    pub(super) alive: Vec<i64>,
    pub(super) sets: Vec<Set>,
    /// Whether the frame is older than one already accepted, and so is dropped.
    pub(super) late: bool,
}

impl Frame {
    pub(super) fn clear(&mut self) {
        (self.listed, self.late) = (false, false);
        self.alive.clear();
        self.sets.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        !self.listed && self.sets.is_empty()
    }

    /// Sets the list of fingers that are down; false if an entry is not an integer.
    pub(super) fn list(&mut self, sessions: &[OscType]) -> bool {
        self.alive.clear();
        self.alive.extend(sessions.iter().filter_map(int));
        self.alive.sort_unstable();
        self.listed = self.alive.len() == sessions.len();
        self.listed
    }

    /// Sets the place of a finger; of several for one finger the last counts.
    pub(super) fn set(&mut self, set: Set) {
        match self.sets.iter_mut().find(|other| other.session == set.session) {
            Some(other) => *other = set,
            None => self.sets.push(set),
        }
    }
}

/// A whole number, however it was sent.
pub(super) fn int(value: &OscType) -> Option<i64> {
    match value {
        OscType::Int(x) => Some(i64::from(*x)),
        OscType::Long(x) => Some(*x),
        _ => None,
    }
}

/// A number, however it was sent.
pub(super) fn number(value: &OscType) -> Option<f64> {
    match value {
        OscType::Float(x) => Some(f64::from(*x)),
        OscType::Double(x) => Some(*x),
        _ => int(value).map(|x| x as f64),
    }
}
