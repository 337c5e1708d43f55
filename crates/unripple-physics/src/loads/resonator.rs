//! Resonators as loads: a mass on a spring and a damper that stand on the sheet.

use super::{Footprint, Housing, Load};
use crate::{Medium, PhysicsError};
use std::f64::consts::{PI, TAU};
use unripple_core::{Air, Resonator, Surface, require};

/// Largest number of resonators to each of which the modes that are not computed yield as those of an infinite sheet, like other loads. With
/// more, modes of the sheet are computed until there is one for each resonator. Such a correction takes the square of the number of
/// resonators, and a fine mesh of them would have more corrections than modes. With twice this value, four times as many integrals.
pub(crate) const FEW: usize = 64;

impl Load {
    /// A resonator as a load. Its base moves with the sheet, so that a mass m with natural frequency ω_0 and quality factor Q reacts to the
    /// displacement u of the sheet with the force m ω² (1 + jω/Qω_0) / (1 - (ω/ω_0)² + jω/Qω_0) u on it (den Hartog, *Mechanical
    /// Vibrations*, chapter 3): a mass far below resonance, a spring above it.
    pub fn resonator(resonator: &Resonator) -> Self {
        let Resonator { at, mass, frequency, quality_factor } = *resonator;
        let omega = TAU * frequency;
        let (damping, stiffness) = (mass * omega / quality_factor, mass * omega * omega);
        Self {
            footprint: Footprint::point(at),
            mass: 0.0,
            damping: 0.0,
            stiffness: 0.0,
            circuit: None,
            housing: Some(Housing { mass, damping, stiffness }),
        }
    }

    /// Whether this is a resonator: nothing but a mass on a spring.
    pub(crate) fn resonates(&self) -> bool {
        self.housing.is_some() && self.circuit.is_none() && self.mass == 0.0
    }
}

/// The resonators on a surface, those of lattices too, as loads.
///
/// # Errors
/// [`PhysicsError::Unsupported`] for a place outside the outline, [`PhysicsError::Range`] for a value out of its range.
pub fn resonators(surface: &Surface) -> Result<Vec<Load>, PhysicsError> {
    let load = |resonator: &Resonator| {
        let Resonator { at, frequency, quality_factor, .. } = *resonator;
        if !surface.outline.contains(at) {
            return Err(PhysicsError::Unsupported {
                what: "place of a resonator",
                expected: "a point inside the outline",
                found: format!("{at}; the nearest is {}", surface.outline.nearest(at)),
            });
        }
        let positive = "a positive finite number";
        require("frequency of a resonator in Hz", frequency > 0.0, positive, frequency)?;
        require("quality factor of a resonator", quality_factor > 0.0, positive, quality_factor)?;
        let load = Load::resonator(resonator);
        load.check()?;
        Ok(load)
    };
    surface.resonators().iter().map(load).collect()
}

/// Frequency (Hz) up to which a sheet has as many modes as `resonators` stand on it, by Weyl's law without edges; 0 if they are few enough
/// to be corrected for one by one. A lattice's own waves are as short as twice its pitch, whatever their frequency, and the modes of the
/// sheet that are as short are as many as its cells.
pub(crate) fn of_lattice(surface: &Surface, resonators: usize) -> f64 {
    if resonators <= FEW {
        return 0.0;
    }
    let wavenumber = (4.0 * PI * resonators as f64 / surface.outline.area()).sqrt();
    Medium::of(&surface.sheet).with_air(Air::None).omega(wavenumber) / TAU
}
