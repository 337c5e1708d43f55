//! Text forms of what requests contain: numbers, places, targets, waveforms and names, as people type them.
//!
//! Lengths are in mm, times in ms and displacements in µm; what is read is in SI units, as requests have it. A [`FormError`] says what is wrong
//! with a text; who reads it knows what the text was typed for, and names that by [`FormError::of`].
//!
//! ```
//! use unripple_tasks::text_forms;
//!
//! let point = text_forms::point("62,90,-0.5")?;
//! assert_eq!((point.at_m, point.gain), ([0.062, 0.09], -0.5));
//! let error = text_forms::point("62").unwrap_err();
//! assert_eq!(error.of("--at"), "--at 62: expected X,Y[,GAIN[,HZ]] in mm and Hz, found 1 numbers");
//! # Ok::<(), text_forms::FormError>(())
//! ```

mod frequencies;
mod named;
mod numbers;
mod places;
mod targets;
mod waveforms;

pub use frequencies::frequencies;
pub use named::{input_scales, key_and_value, values, wire};
pub use numbers::{FormError, above_zero, band, interval, numbers};
pub use places::{distances, place, polygon, weighted, weighted_polygon};
pub use targets::{path, point, shape};
pub use waveforms::waveform;
