//! From a surface to its modes, responses and design figures.

mod actuators;
mod coupled;
mod damping;
pub mod design;
mod dispersion;
mod elements;
mod error;
mod fabric;
mod loads;
mod mesh;
mod modes;
mod responses;
#[allow(dead_code)]
mod spectrum;
pub mod stepper;

pub use actuators::{Entry, Sensor, Transducer, sensed, sensors, transducers};
pub use coupled::{Loaded, Oscillations};
pub use design::{Design, design};
pub use dispersion::{AIR_CELERITY, AIR_DENSITY, Medium};
pub use error::PhysicsError;
pub use loads::{Circuit, Footprint, Load};
pub use modes::Modes;
pub use responses::{ResponseOptions, response_modes, responses, responses_on, sample, stepped_hz};
pub use stepper::{Channel, Plant, StepperOptions, VirtualSurface};
