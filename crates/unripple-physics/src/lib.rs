//! Impulse responses of a surface with its actuators and fingers, its simulation in the time domain, and its design figures.
//!
//! The modes of the sheet alone come from `unripple-plates`; here they are coupled to the coils, magnets, piezo patches and fingers on it.
//! Drives are computed in `unripple-focus`, and what they do to the surface is evaluated in `unripple-field`.
//!
//! # In reading order
//!
//! [`responses()`] computes the impulse responses of a surface in modal form, with [`ResponseOptions`], and [`sample()`] turns them into
//! samples at points. A [`Transducer`] is an actuator as a force on the sheet, a [`Load`] what moves with the sheet, and [`Loaded`] the
//! modes coupled to both. A [`VirtualSurface`] is the surface in the time domain, block by block, by the scheme of [`stepper`]. [`design()`]
//! predicts window, contrast and focal spot before anything is built; [`mod@design`] has the closed forms and the paper's surface.
//!
//! ```
//! use unripple_core::{Point, Responses};
//! use unripple_physics::{ResponseOptions, design::papers_surface, responses, sample};
//!
//! // The paper's membrane, 150 mm square, in a third of its band.
//! let mut film = papers_surface();
//! film.emission.band = [0.0, 1000.0];
//! let Responses::Modal(modal) = responses(&film, &ResponseOptions::default())? else { unreachable!() };
//! // The first mode of a square membrane is at √(T/ρh)/(√2 L); bending stiffness at the clamped rim adds a few per cent.
//! let membrane = (200.0_f64 / (1400.0 * 0.125e-3)).sqrt() / (2.0_f64.sqrt() * 0.15);
//! let first = modal.poles[0].omega / std::f64::consts::TAU;
//! assert!((1.01..1.05).contains(&(first / membrane)));
//!
//! // Reciprocity: actuator a1 moves the place of a2 as a2 moves the place of a1.
//! let places: Vec<Point> = modal.ports.iter().map(|port| port.at).collect();
//! let sampled = sample(&modal, &places, 480);
//! let (there, back) = (sampled.response(0, 1), sampled.response(1, 0));
//! let largest = there.iter().fold(0.0, |most: f32, v| most.max(v.abs()));
//! assert!(largest > 0.0 && there.iter().zip(back).all(|(v, w)| (v - w).abs() < 1e-3 * largest));
//! # Ok::<(), unripple_physics::PhysicsError>(())
//! ```

mod actuators;
mod cost;
mod coupled;
pub mod design;
mod loads;
mod response_error;
mod responses;
pub mod stepper;
mod surface_modes;

pub use actuators::{Entry, Sensor, Transducer, sensed, sensors, transducers};
pub use cost::response_cost;
pub use coupled::{Loaded, Oscillations};
pub use design::{Design, design};
pub use loads::{Circuit, Footprint, Housing, Load, resonators};
pub use response_error::{left_out, response_error};
pub use responses::{
    ResponseOptions, SAMPLING_ERROR, accuracy, response_modes, responses, responses_on, sample, sampled_hz,
    stepped_hz,
};
pub use stepper::{Channel, Plant, StepperOptions, VirtualSurface};
pub use surface_modes::SurfaceModes;
pub use unripple_plates::{AIR_CELERITY, AIR_DENSITY, Accuracy, Medium, Modes, PhysicsError};
