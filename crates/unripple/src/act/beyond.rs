//! A level beyond the drive at its limit.

use super::LevelKind;

/// A level asked for that the drive limit does not give.
pub(super) struct Beyond {
    /// The kind of level.
    pub what: LevelKind,
    /// Level that the limit gives, with its unit.
    pub most: String,
    /// Level that was asked for, as text.
    pub wanted: String,
    /// Unit of the value, as people write it.
    pub unit: &'static str,
}
