//! From a surface with all that hangs on it to its responses and design figures; its modes are those of `unripple-plates`.

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
