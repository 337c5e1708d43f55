//! Plates, membranes and plates under tension: the dispersion relation of their waves, and their modes for any outline.
//!
//! # In reading order
//!
//! `dispersion` describes waves on an infinite sheet, `damping` their decay. `modes` states the eigenvalue problem and chooses how it is
//! solved: uniform rectangles by products of sines or polynomials (Ritz), all other sheets by `mesh` (a mesh of triangles), `fabric` (mass,
//! tension and stiffness at each point), `elements` (quintic finite elements) and `spectrum` (all eigenpairs below a bound).
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
