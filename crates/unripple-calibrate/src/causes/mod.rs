//! What explains the difference between a recorded drive and its prediction: tension, wires, gains, a saturating amplifier, noise.
//!
//! A drive is played, and the velocity is recorded at some places. Each suspected cause predicts other signals at those
//! places; the one that leaves least of the recordings unexplained is the likeliest.
//!
//! ```
//! use unripple_calibrate::causes::{Cause, Lines, Model, Played, WireFault, find};
//! use unripple_calibrate::signals::Band;
//! use unripple_core::{Point, Responses};
//! use unripple_dsp::convolve;
//! use unripple_physics::{Medium, ResponseOptions, design::papers_surface, responses, sample};
//!
//! let mut surface = papers_surface();
//! surface.emission.band[1] = 500.0;
//! let truth = responses(&surface, &ResponseOptions::default())?;
//! let Responses::Modal(modal) = &truth else { unreachable!() };
//! let places = [Point::from_mm(62.0, 90.0), Point::from_mm(100.0, 40.0)];
//! // A pulse from each actuator, a millisecond after the one before; the first two wires are exchanged.
//! let drive: Vec<Vec<f64>> =
//!     (0..8).map(|a| (0..480).map(|i| f64::from(i / 24 == 2 * a || i / 24 == a * a % 17)).collect()).collect();
//! let mut sent = drive.clone();
//! sent.swap(0, 1);
//! let known = sample(modal, &places, 20_000);
//! let heard: Vec<Vec<f64>> = (0..2)
//!     .map(|place| {
//!         let mut sum = vec![0.0; 20_000];
//!         for (a, line) in sent.iter().enumerate() {
//!             let response: Vec<f64> = known.response(a, place).iter().map(|h| f64::from(*h) / 48e3).collect();
//!             sum.iter_mut().zip(convolve(line, &response)).for_each(|(to, x)| *to += x);
//!         }
//!         sum
//!     })
//!     .collect();
//! let lines = Lines::new(20_000, 48e3, Band { low: [0.0; 2], high: [500.0, 600.0] })?;
//! let model = Model::new(&truth, &places, &Medium::of(&surface.sheet), lines)?;
//! let found = find(&model, &Played { drive: &drive, full: &heard, quiet: None, noise: 0.0 })?;
//! assert_eq!(found.suspects[0].cause, Cause::Wires(vec![WireFault::Swapped(0, 1)]));
//! # Ok::<(), unripple_calibrate::CalibrateError>(())
//! ```

mod agreement;
mod finding;
mod gains;
mod lines;
mod model;
mod saturation;
mod suspect;
mod tension;
mod wires;

pub use finding::{Findings, Played, find};
pub use lines::Lines;
pub use model::Model;
pub use suspect::{Cause, Suspect};
pub use wires::WireFault;
