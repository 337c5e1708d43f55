//! Simulates the motion that a drive causes on a surface, and evaluates how well it focuses.
//!
//! Only linear systems ([`Responses`](unripple_core::Responses)), a [`Drive`](unripple_core::Drive), and the points and
//! instants of the targets are known here: neither what the surface is made of nor how the drive was computed.
//!
//! # In reading order
//!
//! [`Field`] is the motion that a drive causes, as traces at points and snapshots on a [`Grid`]; [`Aim`] says where and
//! when a focus should be; [`measure()`] evaluates it, in velocity, in displacement and as felt above a [`Threshold`].
//! Fields of many drives share a [`Readout`]. [`Radiated`] is how loud a drive is.
//!
//! ```
//! use unripple_linalg::Mat;
//! use std::sync::Arc;
//! use unripple_core::{Conditions, Drive, ModalResponses, Outline, Point, Pole, Port, Responses, Shape, Shapes};
//! use unripple_field::{Aim, MeasureOptions, measure};
//!
//! #[derive(Debug)]
//! struct Piston; // A single mode that moves the whole surface alike.
//! impl Shapes for Piston {
//!     fn modes(&self) -> usize {
//!         1
//!     }
//!     fn at(&self, _: Point, row: &mut [f64]) {
//!         row.fill(1.0);
//!     }
//! }
//!
//! let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
//! let piston = Responses::Modal(ModalResponses {
//!     ports: vec![Port { name: "a1".into(), at: Point::new(0.1, 0.05) }],
//!     poles: vec![Pole::new(0.0, 0.0)],
//!     input: Mat::full(1, 1, 1.0),
//!     shapes: Arc::new(Piston),
//!     conditions: Conditions { rate: 1000.0, band: [0.0, 100.0], lambda_min: 0.03, outline },
//!     frequency_error: 0.0,
//!     mode_errors: Vec::new(),
//! });
//! let push = Drive::new(1000.0, vec!["a1".into()], vec![vec![2.0; 11]])?;
//! let aim = Aim::at(Point::new(0.05, 0.05), 0.010);
//! let found = measure(&piston, &push, &[aim], &MeasureOptions::default())?;
//! let target = &found.targets[0];
//! assert!((target.peak_velocity_m_s - 2.0 * 11.0 / 1000.0).abs() < 1e-12);
//! assert!((target.contrast.unwrap_or(0.0) - 1.0).abs() < 1e-6);
//! assert!((found.drive.energy - 0.044).abs() < 1e-12);
//! # Ok::<(), unripple_field::FieldError>(())
//! ```

mod aim;
mod contact;
mod error;
mod feeling;
mod felt;
mod field;
mod figures;
mod grid;
mod instant;
mod measure;
mod modal;
mod motion;
mod pulse;
mod quadrature;
mod radiated;
mod reach;
mod reading;
mod readout;
mod ringing;
mod sampled;
mod similarity;
mod source;
mod spot;
mod steepness;
mod waveform;

pub use aim::{Aim, MeasureOptions};
pub use error::FieldError;
pub use field::{Field, Snapshot, fits};
pub use figures::{DriveFigures, Maps, Measured, TakenOn, TargetFigures};
pub use grid::Grid;
pub use instant::Instant;
pub use measure::measure;
pub use radiated::{Listener, Pressure, Radiated};
pub use reach::Reach;
pub use readout::Readout;
pub use similarity::{Similarity, ssim};
pub use source::Trace;
pub use steepness::Steepness;
pub use unripple_dsp::Threshold;
pub use waveform::{SilenceFigures, Wanted, WaveformFigures};
