//! A requested level above that of the drive at its limit.

use super::LevelKind;

/// A requested level above that of the drive at its limit.
pub(super) struct Beyond {
    /// The kind of the requested level.
    pub what: LevelKind,
    /// Level of the drive at its limit, with its unit.
    pub most: String,
    /// Requested level, as text without its unit.
    pub wanted: String,
    /// Unit of `wanted`, as text.
    pub unit: &'static str,
}
