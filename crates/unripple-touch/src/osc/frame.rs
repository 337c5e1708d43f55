//! One TUIO frame of one sender.

use rosc::OscType;

/// One finger of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Set {
    pub(super) session: i64,
    pub(super) place: (f64, f64),
    pub(super) pressure: Option<f64>,
}

/// One frame of one list of a sender: which fingers are there, and where those are that moved.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    /// Whether the frame lists all that are there.
    pub(super) listed: bool,
    pub(super) alive: Vec<i64>,
    pub(super) sets: Vec<Set>,
    /// Whether it is to be dropped.
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

    /// Lists who is there; false if that is not a list of numbers.
    pub(super) fn list(&mut self, sessions: &[OscType]) -> bool {
        self.alive.clear();
        self.alive.extend(sessions.iter().filter_map(int));
        self.alive.sort_unstable();
        self.listed = self.alive.len() == sessions.len();
        self.listed
    }

    /// A finger is somewhere; the last word on it counts.
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
