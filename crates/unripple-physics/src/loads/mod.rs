//! Mechanical loads on the sheet that move with it: fingers, coils, masses, resonators.

mod footprint;
mod resonator;

pub use footprint::Footprint;
pub use resonator::resonators;
pub(crate) use resonator::{FEW, of_lattice};

use crate::PhysicsError;
use unripple_core::{Contact, Outline, require};
use unripple_linalg::c64;

/// Ratio R/L, in 1/s, from which on a coil's inductance is neglected, so that its current follows its
/// voltage without delay; at 3 kHz the relative error of the coil's force is 2e-5. With twice this value,
/// the error is half as large.
const AT_ONCE: f64 = 1e9;

/// A lumped load on the sheet at one contact: a mass that moves with the contact, a damper and a spring to
/// the ground, and optionally a coil and a housing. Its mechanical impedance is Z(s) = μs + β + κ/s + X(s),
/// with X the impedance of coil and housing ([`Load::reaction`]); it is passive for non-negative values.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    /// Contact of the load with the sheet, as quadrature points and weights.
    pub footprint: Footprint,
    /// Mass μ, in kg.
    pub mass: f64,
    /// Damping β, in N·s/m.
    pub damping: f64,
    /// Stiffness κ to the ground, in N/m.
    pub stiffness: f64,
    /// A coil closed by a voltage source, in which the motion of the contact, relative to the housing if there is one, drives a
    /// current; `None` for no coil.
    pub circuit: Option<Circuit>,
    /// A housing that hangs on the contact by a spring. The coil, and the force of the actuator that has
    /// this load, then act between the housing and the contact, over the load's footprint; with `None`,
    /// they act between the ground and the contact.
    pub housing: Option<Housing>,
}

/// The housing of an inertial exciter: a mass that a spring and a damper connect to the sheet, and that is otherwise free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Housing {
    /// Mass M of the housing with the magnet, in kg; positive.
    pub mass: f64,
    /// Damping c between the housing and the sheet, in N·s/m.
    pub damping: f64,
    /// Stiffness k of the spring between the housing and the sheet, in N/m.
    pub stiffness: f64,
}

/// The electrical circuit of a coil in a magnet's field whose terminals are driven by a voltage source.
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
            housing: None,
        }
    }

    /// Mechanical impedance Z(s), force over velocity, at the complex frequency `s` (1/s), in N·s/m.
    pub fn impedance(&self, s: c64) -> c64 {
        s * self.mass + self.damping + s.inv() * self.stiffness + self.reaction(s)
    }

    /// Mechanical impedance of coil and housing alone at the complex frequency `s` (1/s), in N·s/m:
    /// (bl)²/(R + Ls) for a coil between contact and ground; 1/(1/Ms + 1/T), with T = c + k/s + (bl)²/(R +
    /// Ls), for a housing.
    pub fn reaction(&self, s: c64) -> c64 {
        let coil = Circuit::reaction(self.circuit.as_ref(), s);
        self.housing.map_or(coil, |housing| housing.reaction(coil, s))
    }

    /// Share of the force between housing and contact that acts on a contact held still, at the complex
    /// frequency `s` (1/s), dimensionless: Ms/(Ms + T) with T as in [`Load::reaction`], since spring,
    /// damper and coil pass the motion of the housing back; 1 without a housing. By reciprocity, it is also
    /// the velocity of a moving contact relative to the housing, over the velocity of the contact.
    pub fn transmission(&self, s: c64) -> c64 {
        let coil = Circuit::reaction(self.circuit.as_ref(), s);
        self.housing.map_or(c64::new(1.0, 0.0), |housing| housing.transmission(coil, s))
    }

    /// Whether the load has any effect on the sheet.
    pub(crate) fn acts(&self) -> bool {
        let coil = self.circuit.is_some_and(|circuit| circuit.force_constant != 0.0);
        let tied = self.housing.is_some_and(|housing| housing.damping != 0.0 || housing.stiffness != 0.0);
        self.mass != 0.0 || self.damping != 0.0 || self.stiffness != 0.0 || coil || tied
    }

    /// The load split into two without a housing: the part between contact and ground, and the part between
    /// contact and housing. The first is `None` if the load has a housing and no part to the ground, the
    /// second if it has no housing.
    pub(crate) fn split(&self) -> [Option<Self>; 2] {
        let Some(Housing { damping, stiffness, .. }) = self.housing else {
            return [Some(self.clone()), None];
        };
        let ground = Self { circuit: None, housing: None, ..self.clone() };
        let tied = Self { mass: 0.0, damping, stiffness, housing: None, ..self.clone() };
        [Some(ground).filter(Self::acts), Some(tied)]
    }

    /// The coil, if its inductance is not negligible.
    pub(crate) fn inductive_coil(&self) -> Option<Circuit> {
        self.circuit.filter(Circuit::is_inductive)
    }

    /// Damping (bl)²/R by a coil of negligible inductance, in N·s/m; 0 without such a coil.
    pub(crate) fn direct_coil_damping(&self) -> f64 {
        self.direct_coil_force() * self.circuit.map_or(0.0, |circuit| circuit.force_constant)
    }

    /// Force per volt bl/R of a coil of negligible inductance, in N/V; 0 without such a coil.
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
        if let Some(Housing { mass, damping, stiffness }) = self.housing {
            require("mass of a housing in kg", mass > 0.0, "a positive finite number", mass)?;
            require("damping of a housing in N·s/m", damping >= 0.0, none, damping)?;
            require("stiffness of a housing's spring in N/m", stiffness >= 0.0, none, stiffness)?;
        }
        let Some(Circuit { force_constant, resistance, inductance }) = self.circuit else { return Ok(()) };
        require("force constant of a coil in N/A", true, "a finite number", force_constant)?;
        require("resistance of a coil in Ω", resistance > 0.0, "a positive finite number", resistance)?;
        Ok(require("inductance of a coil in H", inductance >= 0.0, none, inductance)?)
    }
}

impl Housing {
    /// Extension of the housing's spring per unit of the housing's coordinate (√M times its displacement),
    /// in 1/√kg.
    pub(crate) fn weight(&self) -> f64 {
        -1.0 / self.mass.sqrt()
    }

    /// Mechanical impedance (N·s/m) of the housing as seen from the contact, given the impedance `coil` of
    /// the coil.
    fn reaction(&self, coil: c64, s: c64) -> c64 {
        let (inert, tie) = (s * s * self.mass, self.tie(coil, s));
        s * self.mass * tie / (inert + tie)
    }

    /// [`Load::transmission`], dimensionless, for the mechanical impedance `coil` (N·s/m) of the coil.
    pub(crate) fn transmission(&self, coil: c64, s: c64) -> c64 {
        let inert = s * s * self.mass;
        inert / (inert + self.tie(coil, s))
    }

    /// Dynamic stiffness between contact and housing (force per displacement), in N/m; in this form nothing
    /// is divided by s.
    fn tie(&self, coil: c64, s: c64) -> c64 {
        s * (coil + self.damping) + self.stiffness
    }
}

impl Circuit {
    /// Mechanical impedance (bl)²/(R + Ls) between a coil and its magnet, in N·s/m; 0 without a coil.
    pub(crate) fn reaction(coil: Option<&Self>, s: c64) -> c64 {
        coil.map_or(c64::new(0.0, 0.0), |coil| {
            coil.admittance(s) * (coil.force_constant * coil.force_constant)
        })
    }

    /// Whether the inductance is not negligible.
    pub(crate) fn is_inductive(&self) -> bool {
        self.resistance < AT_ONCE * self.inductance
    }

    /// Electrical admittance 1/(R + Ls) of the coil held still, at the complex frequency `s` (1/s), in A/V.
    pub fn admittance(&self, s: c64) -> c64 {
        (s * self.inductance + self.resistance).inv()
    }
}
