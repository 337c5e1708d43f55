//! The kinds of effects, one file each: their parameters, allowed values, and behaviour.

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
use crate::{EffectsError, Region};

/// The kinds of effects, each with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A button: one pulse when it is pressed, one when it is released.
    Button(Button),
    /// A texture: pulses at distances along the finger's path.
    Texture(Texture),
    /// An edge: a pulse where the finger crosses a line or the border of the region.
    Edge(Edge),
    /// Notches: equally spaced detents along an axis.
    Notch(Notch),
    /// A pulse train in time while the finger is in the region.
    Train(Train),
    /// A shape: a path that pulses draw repeatedly on a resting finger or palm.
    Shape(Traced),
    /// A waveform at the finger while it is in the region.
    Hum(Hum),
    /// A score: pulses and waveforms at given times.
    Score(Score),
}

impl Kind {
    /// The name of this kind in effect files.
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

    /// Refuses parameters that are out of range.
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

    /// Total duration of the waveforms that an effect of this kind keeps in memory, in s.
    pub(crate) fn sounding(&self) -> f64 {
        match self {
            Self::Hum(hum) => hum.sounding(),
            Self::Score(score) => score.sounding(),
            _ => 0.0,
        }
    }

    /// The function that starts an effect of this kind in a region, under a contact, with waveforms at `rate` samples per second.
    pub(crate) fn maker(&self, region: &Region, rate: f64) -> Result<Maker, EffectsError> {
        Ok(match self {
            Self::Button(button) => button.maker(),
            Self::Texture(texture) => texture.maker(),
            Self::Edge(edge) => edge.maker(region.clone()),
            Self::Notch(notch) => notch.maker(),
            Self::Train(train) => train.maker(),
            Self::Shape(shape) => shape.maker(),
            Self::Hum(hum) => hum.maker(rate)?,
            Self::Score(score) => score.maker(rate)?,
        })
    }
}
