//! Computes drives whose waves focus on targets, from the impulse responses of a surface to its actuators.
//!
//! A surface is known here only as a linear system ([`Responses`](unripple_core::Responses)). What a drive does to the
//! surface is evaluated by the crate `unripple-field`.
//!
//! # In reading order
//!
//! [`Target`] says where to focus, [`Pattern`] turns shapes into the points of a target, [`Options`] and its [`Method`]
//! say how the drive is computed, [`focus`] computes one drive, and [`Focuser`] computes many for one surface. [`play`]
//! computes drives for prescribed waveforms at several points, [`strike`] for many focal pulses with prescribed levels,
//! and a [`Stroke`] is the sequence of pulses of a focus that moves along a path.
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
//!     frequency_error: 0.0,
//!     mode_errors: Vec::new(),
//! });
//! let focused = focus(&string, &[Target::at(Point::new(0.6, 0.05))], &Options { window: 0.02, ..Options::default() })?;
//! assert_eq!(focused.drive.samples(), 161);
//! assert_eq!(focused.timing[0].instant, 160);
//! assert_eq!(focused.drive.peak(), 1.0);
//! # Ok::<(), unripple_focus::FocusError>(())
//! ```

mod error;
mod felt;
mod focused;
mod focuser;
mod gains;
mod level;
mod limited;
mod magnitude;
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
pub use focused::{Focused, Shaping};
pub use focuser::{Focuser, focus};
pub use options::{LossCorrection, Method, Options};
pub use pattern::{Line, Pattern};
pub use pulses::{Pulse, PulseOptions, Struck, strike};
pub use schedule::Timing;
pub use stroke::Stroke;
pub use target::Target;
pub use waveform::{PlayOptions, Played, Quantity, Waveform, play};
