//! From responses and targets to a drive.
//!
//! A surface is known here only as a linear system ([`Responses`](unripple_core::Responses)), and how good a drive is
//! is for others to measure.
//!
//! # In reading order
//!
//! [`Target`] says what is to be felt and where, [`Pattern`] turns shapes into the points of one, [`Options`] and its
//! [`Method`] say how, [`focus`] makes the drive, and [`Focuser`] makes many for one surface. [`play`] makes places follow
//! whole waveforms, [`strike`] gives many pulses their levels, and a [`Stroke`] is the pulses of a focus that moves.
//!
//! ```
//! use unripple_linalg::Mat;
//! use std::sync::Arc;
//! use unripple_core::{Conditions, ModalResponses, Outline, Point, Pole, Port, Responses, Shape, Shapes};
//! use unripple_focus::{Options, Target, focus};
//!
//! #[derive(Debug)]
//! struct String2; // The first two modes of a string of unit length and mass.
//! impl Shapes for String2 {
//!     fn modes(&self) -> usize {
//!         2
//!     }
//!     fn at(&self, p: Point, row: &mut [f64]) {
//!         (1..).zip(row).for_each(|(m, w)| *w = 2f64.sqrt() * (f64::from(m) * std::f64::consts::PI * p.x).sin());
//!     }
//! }
//!
//! let at = Point::new(0.3, 0.05);
//! let outline = Outline::new(Shape::Rectangle { width: 1.0, height: 0.1 });
//! let string = Responses::Modal(ModalResponses {
//!     ports: vec![Port { name: "a1".into(), at }],
//!     poles: vec![Pole::new(600.0, 10.0), Pole::new(1200.0, 10.0)],
//!     input: Mat::from_fn(1, 2, |_, m| String2.at_all(&[at])[(0, m)]),
//!     shapes: Arc::new(String2),
//!     conditions: Conditions { rate: 8000.0, band: [0.0, 200.0], lambda_min: 1.0, outline },
//! });
//! let focused = focus(&string, &[Target::at(Point::new(0.6, 0.05))], &Options { window: 0.02, ..Options::default() })?;
//! assert_eq!(focused.drive.samples(), 161);
//! assert_eq!(focused.timing[0].instant, 160);
//! assert_eq!(focused.drive.peak(), 1.0);
//! # Ok::<(), unripple_focus::FocusError>(())
//! ```

mod error;
mod felt;
mod focuser;
mod gains;
mod level;
mod limited;
mod modal;
mod objective;
mod options;
mod pattern;
mod planned;
mod pulses;
mod recording;
mod schedule;
mod settle;
mod state;
mod stroke;
mod target;
pub mod waveform;

pub use error::FocusError;
pub use felt::{FeltOptions, FeltPlan};
pub use focuser::{Focused, Focuser, focus};
pub use options::{LossCorrection, Method, Options};
pub use pattern::{Line, Pattern};
pub use pulses::{Pulse, PulseOptions, Struck, strike};
pub use schedule::Timing;
pub use stroke::Stroke;
pub use target::Target;
pub use waveform::{PlayOptions, Played, Quantity, Waveform, play};
