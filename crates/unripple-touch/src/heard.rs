//! What sources report: touches, and requests for an effect or a level.

use unripple_core::Touch;

/// A request from a sender, other than a touch: for an effect or for a level.
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// Start the effect of this name.
    Effect(String),
    /// Set the level of everything that is played, in dB relative to that of the effects.
    Gain(f64),
}

/// The longest name of an effect that is accepted, in bytes. Built-in names have at most a third of that; longer ones
/// are ignored.
const LONGEST_NAME: usize = 64;
/// Levels that may be requested, in dB: from practically silence to a hundredfold amplitude.
const GAIN_DB: std::ops::RangeInclusive<f64> = -120.0..=40.0;
/// Requests kept until the caller takes them: more than anybody sends between two polls; further ones are counted and
/// dropped.
const MOST_WISHES: usize = 64;

impl Wish {
    /// A request for an effect; `None` if the name is invalid. A valid name has 1 to 64 bytes and no control
    /// characters.
    pub fn effect(name: &str) -> Option<Self> {
        let legal = (1..=LONGEST_NAME).contains(&name.len()) && !name.chars().any(char::is_control);
        legal.then(|| Self::Effect(name.to_owned()))
    }

    /// A request for a level in dB; `None` if it is not from -120 to 40.
    pub fn gain(db: f64) -> Option<Self> {
        GAIN_DB.contains(&db).then_some(Self::Gain(db))
    }
}

/// Touches and requests that sources have appended since the caller last cleared this buffer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heard {
    /// Touches, in the order in which they were reported.
    pub touches: Vec<Touch>,
    /// Requests for effects and levels, in order.
    pub wishes: Vec<Wish>,
}

impl Heard {
    /// Removes all touches and requests, and keeps the allocated memory.
    pub fn clear(&mut self) {
        self.touches.clear();
        self.wishes.clear();
    }

    /// Appends a request if there is room; returns whether there was.
    pub(crate) fn wish(&mut self, wish: Wish) -> bool {
        let room = self.wishes.len() < MOST_WISHES;
        if room {
            self.wishes.push(wish);
        }
        room
    }
}
