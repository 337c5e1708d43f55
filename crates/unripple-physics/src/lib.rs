//! From a surface to its modes, responses and design figures.

mod damping;
pub mod design;
mod dispersion;
mod error;
mod modes;
mod responses;

pub use design::{Design, design};
pub use dispersion::{AIR_CELERITY, AIR_DENSITY, Medium};
pub use error::PhysicsError;
pub use modes::Modes;
pub use responses::{ResponseOptions, responses, sample};
