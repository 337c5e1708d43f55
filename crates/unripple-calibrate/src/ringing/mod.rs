//! Natural frequencies and decay times of a surface from the recording of a knock.
//!
//! [`listen()`] finds the hits in a recording, takes what rings after the last of them, splits it into sub-bands, and finds in each the
//! exponentials that it is a sum of, by the shift invariance of its signal subspace (ESPRIT), refined by least squares. What does not decay
//! is no mode: mains hum and steady tones are named and left out.
//!
//! ```
//! use std::f64::consts::TAU;
//! use unripple_calibrate::ringing::{ListenOptions, listen};
//!
//! // A knock 0.1 s after the beginning, with modes at 180 and 420 Hz, in a little noise.
//! let mut random = unripple_core::Random::seeded(1);
//! let knock = |t: f64| (-t / 0.08).exp() * (TAU * 180.0 * t).sin() + 0.5 * (-t / 0.05).exp() * (TAU * 420.0 * t).sin();
//! let recording: Vec<f64> = (0..9600)
//!     .map(|n| 1e-3 * random.normal() + if n < 1200 { 0.0 } else { knock(f64::from(n - 1200) / 12e3) })
//!     .collect();
//! let heard = listen(&recording, 12e3, &ListenOptions::default())?;
//! assert_eq!(heard.modes.len(), 2);
//! assert!((heard.modes[0].hz / 180.0 - 1.0).abs() < 1e-3 && (heard.modes[1].decay_time / 0.05 - 1.0).abs() < 0.05);
//! # Ok::<(), unripple_calibrate::CalibrateError>(())
//! ```

mod hits;
mod listened;
mod refined;
mod shifts;
mod sorted;
mod sub_band;

pub use listened::{Knock, ListenOptions, RungMode, SteadyTone, listen};
