//! Statistics of time-reversed focusing over many placements of actuators and targets, compared with the closed forms.
//!
//! [`Sampling`] draws random places for actuators along the edge and for targets inside, [`ContrastModel`] holds what a
//! surface's modes need for many foci. [`against_window`], [`against_period`], [`against_band`] and [`against_noise`]
//! give tables of simulated and predicted contrast, [`size()`] the width of foci in space and time. Actuators are ideal
//! point forces, whatever those of the surface are.
//!
//! ```
//! use unripple_paper::study::*;
//!
//! let surface = unripple_physics::design::papers_surface();
//! let model = ContrastModel::of(&surface, CELLS)?;
//! let sampling = Sampling { placements: 8, targets: 1, ..Sampling::default() };
//! let (n, window) = (8, 0.030);
//! let mut rows = against_window(&model, &surface, &[window], &[n], &sampling);
//! rows.extend(against_period(&model, &surface, window, &[0.070], &[n], &sampling));
//! rows.extend(against_noise(&model, &surface, &[1.0], (n, window), &sampling));
//! rows.extend(against_band(&model, &surface, &[2000.0], (n, window), &sampling)?);
//! for row in rows {
//!     assert!((row.simulated / row.predicted - 1.0).abs() < 0.3, "{row:?}");
//! }
//! let focus = size(&model, &surface, (n, window), &sampling);
//! assert!((focus.spot_diameter_m / focus.spot_predicted_m - 1.0).abs() < 0.15);
//! # Ok::<(), StudyError>(())
//! ```

mod cavities;
mod coils;
mod contrast;
mod contrast_model;
mod finger;
mod replay;
mod sampling;
mod size;

pub use cavities::cavities;
pub use coils::{Coiled, Coils, Credibility, coils, credibility};
pub use contrast::{Compared, against_band, against_noise, against_period, against_window};
pub use contrast_model::{CELLS, ContrastModel, Outside, StudyError};
pub use finger::{Touched, finger};
pub use replay::Replay;
pub use sampling::{Draw, Sampling};
pub use size::{Size, size};
pub use unripple_core::Random;
