//! Mechanical loads on the sheet that move with it: fingers, coils, masses.

mod footprint;

pub use footprint::Footprint;

use crate::PhysicsError;
use unripple_core::{Contact, Outline, require};
use unripple_linalg::c64;

/// For R/L from this on, in 1/s, a coil's inductance is neglected, so that its current follows its voltage at once; at 3 kHz
/// this is a relative error of 2e-5 of the coil's force. Doubled, the error is half as large.
const AT_ONCE: f64 = 1e9;

/// A lumped load on the sheet: a mass, a damper and a spring to the ground, and optionally a coil, all moving with the sheet at
/// one contact. Its mechanical impedance is Z(s) = μs + β + κ/s + (bl)²/(R + Ls), which is passive for non-negative values.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Contact with the sheet, as points and weights.
    pub footprint: Footprint,
    /// Mass μ, in kg.
    pub mass: f64,
    /// Damping β, in N·s/m.
    pub damping: f64,
    /// Stiffness κ to the ground, in N/m.
    pub stiffness: f64,
    /// A coil closed by a voltage source, in which the motion drives a current; `None` for no coil.
    pub circuit: Option<Circuit>,
}

/// The electrical circuit of a coil in a magnet's field whose terminals are held at a voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circuit {
    /// Force constant bl, in N/A, which is also the electromotive force per velocity, in V·s/m.
    pub force_constant: f64,
    /// Resistance R, in Ω; positive.
    pub resistance: f64,
    /// Inductance L, in H.
    pub inductance: f64,
}

impl Load {
    /// A finger on a sheet as a load (mass, damper and spring to the ground: Hudin et al. 2012, section 3.5).
    pub fn finger(contact: &Contact, outline: &Outline) -> Self {
        let finger = &contact.finger;
        Self {
            footprint: Footprint::disc(contact.at, finger.contact_radius, outline),
            mass: finger.mass,
            damping: finger.damping,
            stiffness: finger.stiffness,
            circuit: None,
        }
    }

    /// Mechanical impedance Z(s), force over velocity, at the complex frequency `s` (1/s), in N·s/m.
    pub fn impedance(&self, s: c64) -> c64 {
        let coil = self.circuit.map_or(c64::new(0.0, 0.0), |circuit| {
            circuit.admittance(s) * (circuit.force_constant * circuit.force_constant)
        });
        s * self.mass + self.damping + s.inv() * self.stiffness + coil
    }

    /// Whether the load has any effect on the sheet.
    pub(crate) fn acts(&self) -> bool {
        let coil = self.circuit.is_some_and(|circuit| circuit.force_constant != 0.0);
        self.mass != 0.0 || self.damping != 0.0 || self.stiffness != 0.0 || coil
    }

    /// The coil, if its inductance is not negligible.
    pub(crate) fn inductive_coil(&self) -> Option<Circuit> {
        self.circuit.filter(|circuit| circuit.resistance < AT_ONCE * circuit.inductance)
    }

    /// Damping (bl)²/R by a coil of negligible inductance, in N·s/m; 0 for any other.
    pub(crate) fn direct_coil_damping(&self) -> f64 {
        self.direct_coil_force() * self.circuit.map_or(0.0, |circuit| circuit.force_constant)
    }

    /// Force per volt bl/R of a coil of negligible inductance, in N/V; 0 for any other.
    pub(crate) fn direct_coil_force(&self) -> f64 {
        match self.circuit {
            Some(circuit) if self.inductive_coil().is_none() => circuit.force_constant / circuit.resistance,
            _ => 0.0,
        }
    }

    /// # Errors
    /// [`PhysicsError::Range`] unless its values are those of a passive load.
    pub(crate) fn check(&self) -> Result<(), PhysicsError> {
        let none = "0 or more";
        require("mass of a load in kg", self.mass >= 0.0, none, self.mass)?;
        require("damping of a load in N·s/m", self.damping >= 0.0, none, self.damping)?;
        require("stiffness of a load in N/m", self.stiffness >= 0.0, none, self.stiffness)?;
        let Some(Circuit { force_constant, resistance, inductance }) = self.circuit else { return Ok(()) };
        require("force constant of a coil in N/A", true, "a finite number", force_constant)?;
        require("resistance of a coil in Ω", resistance > 0.0, "a positive finite number", resistance)?;
        Ok(require("inductance of a coil in H", inductance >= 0.0, none, inductance)?)
    }
}

impl Circuit {
    /// Electrical admittance 1/(R + Ls) of the coil at rest, at the complex frequency `s` (1/s), in A/V.
    pub fn admittance(&self, s: c64) -> c64 {
        (s * self.inductance + self.resistance).inv()
    }
}
