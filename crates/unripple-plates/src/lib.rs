//! Plates, membranes and all between: how waves run in them, and their modes, whatever the outline.
//!
//! # In reading order
//!
//! `dispersion` is an endless sheet, `damping` what it loses. `modes` is the eigenvalue problem and decides how it is solved: rectangles by
//! sums of polynomials and sines, anything else by `mesh` (triangles that cover it), `fabric` (what it is made of, place by place),
//! `elements` (quintic finite elements) and `spectrum` (all eigenpairs below a bound).
//!
//! ```
//! use unripple_core::{Air, Decay, Sheet, Uneven};
//! use unripple_plates::Medium;
//!
//! let film = Sheet {
//!     material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None, thickness: 0.125e-3, tension: 200.0,
//!     decay: Decay::Time(0.07), air: Air::None, uneven: Uneven::default(),
//! };
//! // Tension alone would carry waves at √(T/ρh).
//! let long = Medium::of(&film).phase_celerity(1.0);
//! assert!((long - (200.0f64 / (1400.0 * 0.125e-3)).sqrt()).abs() < 1e-3);
//! ```

mod damping;
mod dispersion;
mod elements;
mod error;
mod fabric;
mod mesh;
mod modes;
#[allow(dead_code)]
mod spectrum;

pub use damping::decay_rate;
pub use dispersion::{AIR_CELERITY, AIR_DENSITY, Medium};
pub use error::PhysicsError;
pub use modes::{Modes, gauss};
