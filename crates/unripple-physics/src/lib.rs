//! Impulse responses of a surface with its actuators and fingers, its simulation in the time domain, and its design figures. The modes of
//! the sheet come from `unripple-plates`.

mod actuators;
mod coupled;
pub mod design;
mod loads;
mod responses;
pub mod stepper;

pub use actuators::{Entry, Sensor, Transducer, sensed, sensors, transducers};
pub use coupled::{Loaded, Oscillations};
pub use design::{Design, design};
pub use loads::{Circuit, Footprint, Load};
pub use responses::{ResponseOptions, response_modes, responses, responses_on, sample, stepped_hz};
pub use stepper::{Channel, Plant, StepperOptions, VirtualSurface};
pub use unripple_plates::{AIR_CELERITY, AIR_DENSITY, Medium, Modes, PhysicsError};
