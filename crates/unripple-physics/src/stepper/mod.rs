//! The surface in the time domain.

mod bank;
mod couplings;
mod engine;
mod field;
mod lanes;
mod plant;
mod run;
mod small;
mod surface;
mod touch;

pub use plant::{Channel, Footing, Plant};
pub use surface::{FingerMotion, Reading, Snapshot, StepperOptions, VirtualSurface};
