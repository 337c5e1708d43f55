//! A set of effects: what is felt on a surface.

use crate::error::{counted, within};
use crate::{EffectsError, Kind, Level, Region, limits};
use std::collections::HashSet;

/// A set of effects: what is felt on a surface, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectSet {
    /// What it is called, for people.
    pub name: String,
    /// What it is like, in a line; may be empty.
    pub about: String,
    /// The effects. Where several hold, all of them play.
    pub effects: Vec<Effect>,
}

/// One effect: what, where and how strong.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Its name, its own within the set.
    pub name: String,
    /// The region where it holds.
    pub region: Region,
    /// How strong it is at a gain of 1.
    pub level: Level,
    /// Kind of the effect, with its own values.
    pub kind: Kind,
}

impl EffectSet {
    /// Checks every value of the set, and its size.
    ///
    /// # Errors
    /// The first value that is not legal.
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
