//! The profiles of TUIO 1.1, and how each writes a finger.

use super::frame::{Set, int, number};
use rosc::OscType;

/// The profiles of TUIO 1.1 that are fingers on a surface, or things that stand for one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Profile {
    Cursor,
    Object,
    Blob,
}

impl Profile {
    pub(super) fn of(name: &str) -> Option<Self> {
        match name {
            "2Dcur" => Some(Self::Cursor),
            "2Dobj" => Some(Self::Object),
            "2Dblb" => Some(Self::Blob),
            _ => None,
        }
    }

    /// Index of the profile's list of fingers.
    pub(super) fn list(self) -> usize {
        match self {
            Self::Cursor => 0,
            Self::Object => 1,
            Self::Blob => 2,
        }
    }

    /// Reads `s x y …` of a cursor or a blob, `s i x y …` of an object; velocities are left aside.
    pub(super) fn set(self, args: &[OscType]) -> Option<Set> {
        let skip = if self == Self::Object { 2 } else { 1 };
        let place = (number(args.get(skip)?)?, number(args.get(skip + 1)?)?);
        Some(Set { session: int(args.first()?)?, place, pressure: None })
    }
}
