//! A set of effects on a surface.

use crate::error::{counted, within};
use crate::{EffectsError, Kind, Level, Region, limits};
use std::collections::HashSet;

/// A set of effects on a surface: what is felt, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectSet {
    /// Name of the set, for people.
    pub name: String,
    /// Description in one line; may be empty.
    pub about: String,
    /// The effects. Where regions overlap, all effects there are played.
    pub effects: Vec<Effect>,
}

/// One effect: its kind, region and level.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Name of the effect, unique within the set.
    pub name: String,
    /// The region in which it acts.
    pub region: Region,
    /// Level of the effect at a gain of 1.
    pub level: Level,
    /// The kind of effect, with its parameters.
    pub kind: Kind,
}

impl EffectSet {
    /// Checks all values of the set against [`limits`], and its names.
    ///
    /// # Errors
    /// The error of the first value or name that is not allowed.
    pub fn check(&self) -> Result<(), EffectsError> {
        counted("effects", self.effects.len(), 1, limits::MOST_EFFECTS)?;
        let mut names = HashSet::new();
        if let Some(effect) = self.effects.iter().find(|effect| !names.insert(&effect.name)) {
            return Err(EffectsError::Twice { name: effect.name.clone() });
        }
        for effect in &self.effects {
            effect.region.check()?;
            match effect.level {
                Level::Share(share) => within("gain", share, limits::SHARE)?,
                Level::Felt(db) => within("level above threshold", db, limits::FELT)?,
            }
            effect.kind.check()?;
            let is_nowhere = matches!(&effect.kind, Kind::Edge(edge) if edge.line.is_none());
            if is_nowhere && effect.region == Region::Everywhere {
                return Err(EffectsError::Nowhere { name: effect.name.clone() });
            }
        }
        let sounding: f64 = self.effects.iter().map(|effect| effect.kind.sounding()).sum();
        within("waveforms of a set, in seconds", sounding, [0.0, limits::LONGEST])
    }
}
