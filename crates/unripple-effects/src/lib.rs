//! Haptic effects on regions of the surface: touch events in, timed cues for a player out.
//!
//! An [`EffectSet`] defines what is felt in which region. [`Effects`] runs such a set: it takes touches and the time, and adds
//! [`Cue`]s, which say when, where and how strongly a pulse or waveform is to be played. It plays nothing itself. When two
//! effects act at once, it gives the cues of both, and the player mixes and limits them.
//!
//! Times are in seconds of the clock that times the touches; places are in metres on the surface. Nothing here reads a clock:
//! the same calls give the same cues, random variation included.
//!
//! # In reading order
//!
//! [`Kind`] lists the effects, one file each. [`Curve`] and [`Envelope`] are functions of time or speed that effects use.
//! [`Region`] is where an effect acts. [`Act`] is all that a player must implement.
//!
//! ```
//! use unripple_core::{Outline, Phase, Point, Shape, Touch};
//! use unripple_effects::{Act, Button, Effect, EffectSet, Effects, Kind, Level, Region};
//!
//! let button = Button { press_force: None, release: 0.5 };
//! let effect = Effect {
//!     name: "ok".into(),
//!     region: Region::Circle { centre: Point::from_mm(62.0, 90.0), radius: 0.01 },
//!     level: Level::Share(0.8),
//!     kind: Kind::Button(button),
//! };
//! let set = EffectSet { name: "one button".into(), about: String::new(), effects: vec![effect] };
//! let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
//! let mut effects = Effects::new(&set, sheet, 48e3)?;
//!
//! let (mut cues, at) = (Vec::new(), Point::from_mm(64.0, 90.0));
//! effects.touch(&Touch { finger: 1, phase: Phase::Down, at, time: 0.2, force: None }, &mut cues);
//! assert_eq!(cues[0].act, Act::Pulse { place: at, gain: Level::Share(0.8) });
//! # Ok::<(), unripple_effects::EffectsError>(())
//! ```

mod cue;
mod curve;
mod effects;
mod envelope;
mod error;
mod fingers;
mod kinds;
mod level;
pub mod limits;
mod play;
mod region;
mod set;

pub use cue::{Act, Cue, Wave};
pub use curve::Curve;
pub use effects::Effects;
pub use envelope::Envelope;
pub use error::EffectsError;
pub use kinds::{
    Anchor, Button, Edge, Event, Hum, Kind, Line, Notch, Score, Sound, Start, Texture, Tone, Trace, Traced,
    Train,
};
pub use level::Level;
pub use region::Region;
pub use set::{Effect, EffectSet};
