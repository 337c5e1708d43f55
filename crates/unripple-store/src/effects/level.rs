//! Levels in files of effects.

use super::range;
use crate::surface::reader::{Faults, Section};
use unripple_effects::Level;

/// How strong an effect is that does not say. Half of full strength leaves room both ways.
pub(super) const DEFAULT: Level = Level::Share(0.5);

/// `gain` or `felt_db`.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Level> {
    match (section.get("gain"), section.get("felt_db")) {
        (None, None) => Some(DEFAULT),
        (Some(gain), None) => gain.number(&range::SHARE, faults).map(Level::Share),
        (None, Some(db)) => db.number(&range::FELT, faults).map(Level::Felt),
        (Some(_), Some(db)) => {
            db.refuse("only one of gain and felt_db", None, faults);
            None
        }
    }
}
