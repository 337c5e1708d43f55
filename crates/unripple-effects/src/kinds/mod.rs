//! The effects, each a data sheet of its own: what it is given, what is legal, and what it does.

mod button;
mod edge;
mod hum;
mod notch;
mod score;
mod shape;
mod texture;
mod train;

pub use button::Button;
pub use edge::{Edge, Line};
pub use hum::{Hum, Tone};
pub use notch::Notch;
pub use score::{Event, Score, Sound, Start};
pub use shape::{Anchor, Trace, Traced};
pub use texture::Texture;
pub use train::Train;

use crate::play::Maker;
use crate::{Effect, EffectsError};

/// The kinds of effects, each with its values.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Clicks at the finger, when pressed and let go.
    Button(Button),
    /// Grains along the finger's path.
    Texture(Texture),
    /// A pulse where a line or a border is crossed.
    Edge(Edge),
    /// Detents along an axis, as of a ruler.
    Notch(Notch),
    /// Pulses in time while touched.
    Train(Train),
    /// A shape drawn on a resting hand.
    Shape(Traced),
    /// A steady waveform while touched.
    Hum(Hum),
    /// A score: pulses and waveforms over time.
    Score(Score),
}

impl Kind {
    /// The name of the kind that files use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Button(_) => "button",
            Self::Texture(_) => "texture",
            Self::Edge(_) => "edge",
            Self::Notch(_) => "notch",
            Self::Train(_) => "pulse-train",
            Self::Shape(_) => "shape",
            Self::Hum(_) => "hum",
            Self::Score(_) => "score",
        }
    }

    /// Refuses values that are not legal.
    pub(crate) fn check(&self) -> Result<(), EffectsError> {
        match self {
            Self::Button(button) => button.check(),
            Self::Texture(texture) => texture.check(),
            Self::Edge(edge) => edge.check(),
            Self::Notch(notch) => notch.check(),
            Self::Train(train) => train.check(),
            Self::Shape(shape) => shape.check(),
            Self::Hum(hum) => hum.check(),
            Self::Score(score) => score.check(),
        }
    }

    /// Seconds of waveforms that it keeps in memory.
    pub(crate) fn sounding(&self) -> f64 {
        match self {
            Self::Hum(hum) => hum.sounding(),
            Self::Score(score) => score.sounding(),
            _ => 0.0,
        }
    }

    /// What plays it, waveforms at `rate` samples per second.
    pub(crate) fn maker(&self, effect: &Effect, rate: f64) -> Result<Maker, EffectsError> {
        Ok(match self {
            Self::Button(button) => button.maker(),
            Self::Texture(texture) => texture.maker(),
            Self::Edge(edge) => edge.maker(effect.region.clone()),
            Self::Notch(notch) => notch.maker(),
            Self::Train(train) => train.maker(),
            Self::Shape(shape) => shape.maker(),
            Self::Hum(hum) => hum.maker(rate)?,
            Self::Score(score) => score.maker(rate)?,
        })
    }
}
