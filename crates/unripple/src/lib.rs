//! Time-reversed focusing of touch on reverberant surfaces.
//!
//! A few actuators at the rim of a stretched film or a plate send waves that reverberate and meet again under a
//! fingertip, and nowhere else. From a surface to a focus:
//!
//! ```
//! use unripple::core::Point;
//! use unripple::field::{Aim, MeasureOptions, measure};
//! use unripple::focus::{Options, Target, focus};
//! use unripple::physics::design::papers_surface;
//! use unripple::physics::{ResponseOptions, responses};
//!
//! // What the surface does: the membrane of Hudin et al. (2012), mode by mode.
//! let responses = responses(&papers_surface(), &ResponseOptions::default())?;
//! // What to send so that waves meet at (62, 90) mm after 30 ms.
//! let place = Point::from_mm(62.0, 90.0);
//! let focused = focus(&responses, &[Target::at(place)], &Options { window: 0.03, ..Options::default() })?;
//! // What that does to the surface.
//! let measured = measure(&responses, &focused.drive, &[Aim::at(place, 0.03)], &MeasureOptions::default())?;
//! let contrast = measured.targets[0].contrast.unwrap();
//! assert!((contrast - 25.07).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`core`] holds the conventions (axes, signs, units, samples) that everything keeps to.

pub use unripple_core as core;
pub use unripple_dsp as dsp;
pub use unripple_field as field;
pub use unripple_focus as focus;
pub use unripple_physics as physics;

pub mod act;
pub mod contrast_map;
pub mod drafting;
mod touch;

pub use touch::{Touch, touch};
