//! Touches and wishes as a source hands them on.

use unripple_core::Touch;

/// Something asked for that is not a touch.
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// The effect of this name.
    Effect(String),
    /// A level over the usual one, in dB.
    Gain(f64),
}

/// The longest name of an effect that is listened to, in bytes. Built-in names have at most a third of that; longer
/// ones are ignored.
const LONGEST_NAME: usize = 64;
/// Levels that may be asked for, in dB over the usual one: from as good as nothing to a hundredfold amplitude.
const GAIN_DB: std::ops::RangeInclusive<f64> = -120.0..=40.0;
/// Wishes kept until the caller takes them: more than anybody asks for between two polls; further ones are counted
/// and dropped.
const MOST_WISHES: usize = 64;

impl Wish {
    /// The wish for an effect, if the name is one: 1 to 64 bytes, no control characters.
    pub fn effect(name: &str) -> Option<Self> {
        let legal = (1..=LONGEST_NAME).contains(&name.len()) && !name.chars().any(char::is_control);
        legal.then(|| Self::Effect(name.to_owned()))
    }

    /// The wish for a level in dB, if it is one: -120 to 40.
    pub fn gain(db: f64) -> Option<Self> {
        GAIN_DB.contains(&db).then_some(Self::Gain(db))
    }
}

/// Touches and wishes that sources received since the caller last looked; the caller clears it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heard {
    /// Touches, in order.
    pub touches: Vec<Touch>,
    /// Wishes, in order.
    pub wishes: Vec<Wish>,
}

impl Heard {
    /// Forgets everything, and keeps the room for more.
    pub fn clear(&mut self) {
        self.touches.clear();
        self.wishes.clear();
    }

    /// Whether there is room for a wish, which is then taken.
    pub(crate) fn wish(&mut self, wish: Wish) -> bool {
        let room = self.wishes.len() < MOST_WISHES;
        if room {
            self.wishes.push(wish);
        }
        room
    }
}
