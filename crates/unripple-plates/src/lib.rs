//! Plates, membranes and plates under tension: the dispersion relation of their waves, and their modes for any outline.
//!
//! The sheet is alone here, in vacuum or in air, uniform or not. Actuators and fingers are put on it in `unripple-physics`, which also
//! computes impulse responses.
//!
//! # In reading order
//!
//! [`Medium`] describes waves on an infinite sheet, [`decay_rate()`] is the damping of a mode, and [`Modes`] are the natural frequencies,
//! decay times and shapes of a sheet of any outline; [`PhysicsError`] says why there are none.
//!
//! Inside, `dispersion` and `damping` hold the first two. `modes` states the eigenvalue problem and chooses how it is
//! solved: uniform rectangles by products of sines or polynomials (Ritz), all other sheets by `mesh` (a mesh of triangles), `fabric` (mass,
//! tension and stiffness at each point), `elements` (quintic finite elements) and `spectrum` (all eigenpairs below a bound).
//!
//! ```
//! use unripple_core::{Air, Decay, Emission, Finger, Outline, Shape, Sheet, Surface, Uneven};
//! use unripple_plates::{Medium, Modes};
//!
//! let film = Sheet {
//!     material: "BoPET".into(), young: 4e9, density: 1400.0, poisson: 0.3, strength: None, thickness: 0.125e-3, tension: 200.0,
//!     decay: Decay::Time(0.07), air: Air::None, uneven: Uneven::default(),
//! };
//! // Tension alone would carry waves at √(T/ρh).
//! let long = Medium::of(&film).phase_celerity(1.0);
//! assert!((long - (200.0f64 / (1400.0 * 0.125e-3)).sqrt()).abs() < 1e-3);
//!
//! let surface = Surface {
//!     name: "film".into(), outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }), sheet: film, actuators: Vec::new(),
//!     emission: Emission { band: [0.0, 1e3], rate: 48e3, limit: 1.0, rms_limit: None }, finger: Finger::default(), accuracy: None,
//! };
//! let modes = Modes::solve(&surface, 400.0, 1e-6)?.frequencies_hz();
//! assert!(modes.len() == 6 && (modes[0] - 163.7436).abs() < 1e-3);
//! // On a square, modes with 1 x 2 and 2 x 1 half waves have the same frequency.
//! assert!((modes[2] / modes[1] - 1.0).abs() < 1e-5);
//! # Ok::<(), unripple_plates::PhysicsError>(())
//! ```

mod accuracy;
mod damping;
mod dispersion;
mod elements;
mod error;
mod fabric;
mod mesh;
mod modes;
#[allow(dead_code)]
mod spectrum;

pub use accuracy::Accuracy;
pub use damping::decay_rate;
pub use dispersion::{AIR_CELERITY, AIR_DENSITY, Medium};
pub use error::PhysicsError;
pub use modes::{Modes, gauss};
