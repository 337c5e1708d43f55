//! Surfaces known by natural frequencies alone: moduli, tension and springs that explain measured frequencies in Hz.
//!
//! A hammer and a microphone give frequencies, and nothing says which mode each of them is. [`fit_frequencies()`] finds the values of a
//! few quantities of a surface together with the assignment of frequencies to modes: some modes may not have been heard, and some of what
//! was heard may be no mode. It says what frequencies do not tell, and which other surfaces explain them as well.
//!
//! ```
//! use unripple_calibrate::frequencies::{FrequencyOptions, Heard, Quantity, fit_frequencies};
//! use unripple_core::*;
//!
//! // A membrane of 0.2 x 0.15 m under 300 N/m, in a file that says 200.
//! let sheet = Sheet { material: "film".into(), young: 0.0, density: 1400.0, poisson: 0.3, strength: None,
//!     thickness: 0.1e-3, tension: 200.0, decay: Decay::Time(0.1), air: Air::None, uneven: Uneven::default() };
//! let surface = Surface { name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.2, height: 0.15 }),
//!     sheet, emission: Emission { band: [0.0, 2e3], rate: 48e3, limit: 1.0, rms_limit: None },
//!     finger: Finger::default(), actuators: vec![], accuracy: None };
//! let celerity = (300.0_f64 / (1400.0 * 0.1e-3)).sqrt();
//! let of = |m: f64, n: f64| Heard::at(0.5 * celerity * (m / 0.2).hypot(n / 0.15));
//! let heard = [of(1.0, 1.0), of(2.0, 1.0), of(1.0, 2.0), of(2.0, 2.0)];
//! let options = FrequencyOptions { error: 0.002, ..FrequencyOptions::default() };
//! let found = fit_frequencies(&surface, &heard, &options)?;
//! assert_eq!(found.best.values[0].quantity, Quantity::Tension);
//! assert!((found.best.values[0].value - 300.0).abs() < 0.1);
//! # Ok::<(), unripple_calibrate::CalibrateError>(())
//! ```

mod arranged;
mod explained;
mod heard;
mod losses;
mod matching;
mod model;
mod quantity;
mod run;
mod solve;
mod starts;
mod telling;

pub use explained::{Explained, FittedValue, MatchedMode};
pub use heard::Heard;
pub use losses::FittedLosses;
pub use quantity::Quantity;
pub use run::{FrequencyFit, FrequencyOptions, Other, Untold, fit_frequencies};
pub use telling::Telling;
