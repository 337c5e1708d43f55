//! From recordings to responses: sweeps and deconvolution, kriging between points, model updating, a Kalman filter
//! for drift.
//!
//! It opens no device and writes no file: recordings come from the device of a [`measure::Rig`], finished responses go
//! to a [`measure::Sink`]. The models that measurements are compared with come from `unripple-physics`.
//!
//! # In reading order
//!
//! [`signals::Sweep`] and [`signals::Deconvolver`] are the two halves of a measurement: the signal that is
//! played, and the computation of the response from its recording. A [`measure::Session`] measures the
//! responses of all actuators at a place, and [`measure::campaign()`] does so at many. [`Between`]
//! interpolates responses between the measured points, [`fit()`] finds the model of the surface that
//! explains them, [`verify::check()`] compares the two, and a [`Tracker`] follows the tension of the sheet
//! afterwards.
//!
//! ```
//! use unripple_calibrate::signals::{Deconvolver, Inversion, Sweep};
//! use unripple_core::Pole;
//! use unripple_dsp::convolve;
//!
//! // A surface with a single mode, at 300 Hz, driven by a sweep from 30 to 3600 Hz.
//! let mode = Pole::new(std::f64::consts::TAU * 300.0, 15.0);
//! let truth: Vec<f64> = (0..9600).map(|i| mode.velocity(f64::from(i) / 48e3)).collect();
//! let stimulus = Sweep { seconds: 0.5, ..Sweep::default() }.stimulus()?;
//! // What a device with a latency of 100 samples records of it.
//! let mut heard = vec![0.0; 100];
//! heard.extend(convolve(stimulus.samples(), &truth).iter().map(|v| v / 48e3));
//!
//! let inversion = Inversion { latency: 100.0, ..Inversion::default() };
//! let plan = Deconvolver::new(&stimulus, heard.len(), &inversion)?;
//! let mut found = vec![0.0; 4800];
//! plan.deconvolve(&heard, &mut found, &mut plan.workspace())?;
//! // Frequencies above the sweep are missing, which shows in the first millisecond.
//! let energy: f64 = truth[48..4800].iter().map(|v| v * v).sum();
//! let error: f64 = (48..4800).map(|i| (found[i] - truth[i]).powi(2)).sum();
//! assert!(error < 0.01 * energy);
//! # Ok::<(), unripple_dsp::DspError>(())
//! ```

mod between;
pub mod causes;
mod drift;
mod error;
mod fit;
pub mod frequencies;
pub mod measure;
pub mod ringing;
pub mod signals;
pub mod verify;

pub use between::{Between, BetweenOptions, Interpolation, Uncertainty, Wavelength, central, wavelength};
pub use drift::*;
pub use error::CalibrateError;
pub use fit::*;
