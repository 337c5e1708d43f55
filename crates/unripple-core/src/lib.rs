//! Core types: points, surfaces, impulse responses, drives and audio devices, and the conventions they share.
//!
//! The types hold descriptions and data, and the geometry of outlines is checked here for all crates. Nothing here
//! computes waves, reads a file or opens a device: the crates that do so exchange these types.
//!
//! # Conventions
//!
//! - SI units and `f64` for all values. Files, the command line and messages use millimetres and milliseconds.
//! - Origin at the lower-left corner of the outline's bounding box, x to the right, y up. Displacement is positive
//!   towards the finger.
//! - Time factor e^{+jωt}. A decay time τ is that of the *amplitude*, e^{-t/τ}; a decay rate is σ = 1/τ.
//! - A response `h[actuator][point][sample]` is the normal velocity at the point, in m/s, per unit impulse of drive at
//!   the actuator. Sample 0 is the full value just after the impulse (not half of it).
//! - A drive `d[actuator][sample]` causes the velocity `v[i] = Σ_j h[i-j] d[j] / rate`, summed over actuators.
//! - A window of T seconds holds samples 0 … n with `n = round(T · rate)`, so n + 1 samples; the focal instant is sample n.
//!
//! # In reading order
//!
//! [`Point`], [`Outline`] and [`Surface`] describe a plate or film and its actuators; [`Responses`] are its impulse
//! responses; [`Drive`] is the input signal of its actuators. The other crates exchange data through the last two: models
//! and measurements both give [`Responses`], virtual and real devices both take a [`Drive`].
//!
//! ```
//! use unripple_core::{Outline, Point, Shape};
//!
//! let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
//! assert!(sheet.contains(Point::new(0.062, 0.090)));
//! assert_eq!(sheet.area(), 0.015);
//! ```

mod cache;
pub mod clock;
mod cost;
mod cycle;
mod device;
mod drive;
mod encoded;
mod error;
mod laminate;
mod material;
mod memory;
mod observer;
mod outline;
mod patch;
pub mod plane;
mod point;
mod pole;
mod random;
mod range;
mod resonator;
mod responses;
mod scope;
mod shape;
mod side;
mod surface;
pub mod threads;
mod touch;
mod uneven;

pub use cache::{Cache, Cached};
pub use cost::Cost;
pub use cycle::{Cycle, Work};
pub use device::{CHECK_INTERVAL, Device, DeviceError, FORCE, Layout, PROBE, Server, State, Status};
pub use drive::Drive;
pub use encoded::{Encoded, encode_matrix};
pub use error::CoreError;
pub use laminate::{Laminate, Layer};
pub use material::{MATERIALS, Material};
pub use memory::Memory;
pub use observer::{Observed, Observer, Steps};
pub use outline::{Edge, Edges, Hole, Loop, Outline};
pub use patch::Patch;
pub use plane::OutlineFault;
pub use point::Point;
pub use pole::{Onset, Pole};
pub use random::Random;
pub use range::{OutOfRange, require};
pub use resonator::{Lattice, Resonator};
pub use responses::{
    Conditions, FOCAL_RADIUS, Mixture, ModalResponses, ModeError, Port, Responses, SampledResponses, Shapes,
};
pub use shape::Shape;
pub use side::Side;
pub use surface::{
    Actuator, ActuatorKind, Air, CoilDrive, Contact, Decay, Emission, Finger, Sheet, Surface, VoiceCoil,
    window_samples,
};
pub use touch::{Phase, Touch};
pub use uneven::{Grain, Profile, Scatterer, ScattererKind, Uneven};
