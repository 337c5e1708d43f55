//! Loaded surfaces that tests share.
#![allow(dead_code)]

use std::sync::Arc;
use unripple_core::*;
use unripple_linalg::c64;
use unripple_physics::*;

/// Transfer function of an oscillation at the complex frequency s: velocity per impulse of drive, as the derivative of displacement.
pub fn transfer(pole: &Pole, s: c64) -> c64 {
    let below = s * s + s * (2.0 * pole.sigma) + pole.omega * pole.omega;
    match pole.onset {
        Onset::Velocity => s / below,
        Onset::Displacement => s * (s + 2.0 * pole.sigma) / (below * pole.omega),
    }
}

/// Transfer function of modal responses from an actuator to a footprint with the weights `read`.
pub fn modal_transfer(
    poles: &[Pole],
    input: unripple_linalg::MatRef<f64>,
    actuator: usize,
    read: &[f64],
    s: c64,
) -> c64 {
    (0..poles.len()).map(|m| transfer(&poles[m], s) * input[(actuator, m)] * read[m]).sum()
}

/// The modal form of responses.
pub fn modal(surface: &Surface, options: &ResponseOptions) -> ModalResponses {
    match responses(surface, options).unwrap() {
        Responses::Modal(modal) => modal,
        Responses::Sampled(_) => panic!("not modal"),
    }
}

/// A force at a point.
pub fn force(at: Point) -> Transducer {
    Transducer { footprint: Footprint::point(at), gain: 1.0, entry: Entry::Force, load: None, unit: "N" }
}

/// A load at a footprint, of mass, damping and stiffness.
pub fn load(footprint: Footprint, mass: f64, damping: f64, stiffness: f64) -> Load {
    Load { footprint, mass, damping, stiffness, circuit: None, housing: None }
}

/// Modes ready to be loaded.
pub fn modes(surface: &Surface, max_hz: f64) -> (Arc<dyn Shapes>, Vec<Pole>) {
    let modes = Modes::solve(surface, max_hz, 1e-8).unwrap();
    let poles = modes.poles().to_vec();
    (Arc::new(modes), poles)
}

/// The paper's coil at a place.
pub fn coil(name: &str, at: Point, driven_by: CoilDrive) -> Actuator {
    let kind = ActuatorKind::MovingMagnet {
        force_constant: 6.0,
        resistance: 6.2,
        inductance: 1.9e-3,
        moving_mass: 100e-6,
        driven_by,
    };
    Actuator { name: name.into(), at, kind, contact_radius: 0.75e-3 }
}
