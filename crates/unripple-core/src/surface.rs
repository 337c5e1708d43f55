//! The whole surface: sheet, outline, actuators, frequency band, finger.

use crate::{Outline, Patch, Point, Resonator, Uneven};

/// A whole surface: sheet, outline, actuators, frequency band and finger. Holds the contents of a surface file, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name of the surface, for people.
    pub name: String,
    /// The outer boundary of the sheet, its edge conditions and its holes.
    pub outline: Outline,
    /// The sheet: a thin plate or membrane, with its material, thickness, tension and damping.
    pub sheet: Sheet,
    /// Frequency band, sample rate and limits of the drive.
    pub emission: Emission,
    /// The mechanical impedance assumed for a fingertip that touches the surface.
    pub finger: Finger,
    /// The actuators, in channel order.
    pub actuators: Vec<Actuator>,
    /// Relative accuracy to which natural frequencies are to be computed, a ratio; `None` for the default
    /// accuracy of each computation.
    pub accuracy: Option<f64>,
}

impl Surface {
    /// All resonators on the sheet: those that stand alone, then those of each lattice.
    pub fn resonators(&self) -> Vec<Resonator> {
        let Uneven { resonators, lattices, .. } = &self.sheet.uneven;
        let of_lattices = lattices.iter().flat_map(|lattice| lattice.resonators(&self.outline));
        resonators.iter().copied().chain(of_lattices).collect()
    }
}

/// The sheet: a thin plate under tension, uniform and isotropic unless [`Sheet::uneven`] says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Name of the material, for reports.
    pub material: String,
    /// Young's modulus E, in Pa.
    pub young: f64,
    /// Density ρ, in kg/m³.
    pub density: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Stress at yield or fracture, in Pa; `None` where unknown.
    pub strength: Option<f64>,
    /// Thickness h, in metres.
    pub thickness: f64,
    /// Tension R, force per length in N/m; 0 for a plate without tension.
    pub tension: f64,
    /// Damping: decay times of the modes, or a loss factor.
    pub decay: Decay,
    /// Added mass of the air that moves with the sheet.
    pub air: Air,
    /// Orthotropy, variation over the surface, and attached masses; empty for a uniform, isotropic sheet.
    pub uneven: Uneven,
}

/// The damping of the sheet, as decay times or as a loss factor.
#[derive(Clone, Debug, PartialEq)]
pub enum Decay {
    /// One amplitude decay time for all modes, in seconds.
    Time(f64),
    /// Amplitude decay time as a table over frequency: pairs (Hz, s), frequencies ascending; constant below
    /// the first and above the last frequency.
    Table(Vec<(f64, f64)>),
    /// Loss factor η of the material, dimensionless; it applies to bending, not to tension.
    LossFactor(f64),
}

/// Air beside the sheet, as added mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Air {
    /// No air: the sheet vibrates in vacuum.
    None,
    /// Air on one side.
    OneSide,
    /// Air on both sides.
    BothSides,
}

impl Air {
    /// Number of sides in contact with air: 0, 1 or 2.
    pub fn sides(self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::OneSide => 1.0,
            Self::BothSides => 2.0,
        }
    }
}

/// What the drive may contain: frequency band, sample rate and limits of amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    /// Lowest and highest frequency, in Hz. Modes outside this band are left out of responses.
    pub band: [f64; 2],
    /// Samples per second.
    pub rate: f64,
    /// Largest magnitude of the drive of each actuator, in the actuator's unit (N, A or V).
    pub limit: f64,
    /// Largest rms of the drive of each actuator, in the actuator's unit; `None` if the rms is not limited.
    pub rms_limit: Option<f64>,
}

/// A fingertip as a lumped mass, damper and spring over a contact disc (a mechanical impedance).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finger {
    /// Moving mass μ, in kg.
    pub mass: f64,
    /// Damping β, in N·s/m.
    pub damping: f64,
    /// Stiffness κ, in N/m.
    pub stiffness: f64,
    /// Radius of the contact disc, in metres.
    pub contact_radius: f64,
}

impl Default for Finger {
    /// The fingertip of Hudin et al. (2012), section 3.5, with a contact disc of 5 mm radius.
    fn default() -> Self {
        Self { mass: 0.2e-3, damping: 1.0, stiffness: 1e3, contact_radius: 5e-3 }
    }
}

/// A finger at a place on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where the centre of the contact disc is, in metres.
    pub at: Point,
    /// Mass, damping, stiffness and contact radius of the finger.
    pub finger: Finger,
}

/// One actuator, driven by one channel of the drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Name of the actuator, unique on the surface.
    pub name: String,
    /// Where the actuator acts on the sheet, in metres.
    pub at: Point,
    /// Kind of transducer and its constants.
    pub kind: ActuatorKind,
    /// Radius in metres of the disc over which a point force, a magnet or an exciter spreads its force
    /// evenly; 0 for a force at a point.
    pub contact_radius: f64,
}

/// The kind of transducer of an actuator, its constants, and the unit of its drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ActuatorKind {
    /// An ideal force on the sheet, without mass or stiffness; its drive is in N.
    Force,
    /// A coil that acts on a magnet fixed to the sheet; its drive is in A or V.
    MovingMagnet {
        /// Force constant Bl (force per coil current), in N/A.
        force_constant: f64,
        /// Coil resistance, in Ω.
        resistance: f64,
        /// Coil inductance, in H.
        inductance: f64,
        /// Mass of the magnet, which moves with the sheet, in kg.
        moving_mass: f64,
        /// Whether the amplifier sets the current or the voltage.
        driven_by: CoilDrive,
    },
    /// A voice coil fixed to the sheet, in the field of a magnet whose housing hangs on a spring (an inertial or tactile exciter); its
    /// drive is in A or V.
    Exciter {
        /// Force constant Bl (force per coil current), in N/A.
        force_constant: f64,
        /// Coil resistance, in Ω.
        resistance: f64,
        /// Coil inductance, in H.
        inductance: f64,
        /// Mass of the coil and its former, which move with the sheet, in kg.
        moving_mass: f64,
        /// Mass of the housing with the magnet, in kg.
        housing_mass: f64,
        /// Natural frequency of the housing on its spring while the coil is held still, in Hz.
        resonance: f64,
        /// Quality factor of the resonance of the housing on its spring, without the electrical damping by
        /// the coil.
        quality_factor: f64,
        /// Whether the amplifier sets the current or the voltage.
        driven_by: CoilDrive,
    },
    /// A piezo patch, which bends the sheet by a moment along its rim; its drive is in V.
    Piezo {
        /// Outline of the patch.
        patch: Patch,
        /// Bending moment per length of the patch's rim and per volt, in N·m/(m·V) = N/V.
        moment: f64,
        /// Mass of the patch, in kg.
        mass: f64,
    },
}

impl ActuatorKind {
    /// The name of this kind in surface files: `force`, `moving-magnet`, `exciter` or `piezo`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::MovingMagnet { .. } => "moving-magnet",
            Self::Exciter { .. } => "exciter",
            Self::Piezo { .. } => "piezo",
        }
    }

    /// The coil of a moving-magnet actuator or an exciter; `None` for an ideal force and a piezo patch,
    /// which have no coil.
    pub fn coil(&self) -> Option<VoiceCoil> {
        match *self {
            Self::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by }
            | Self::Exciter { force_constant, resistance, inductance, moving_mass, driven_by, .. } => {
                Some(VoiceCoil { force_constant, resistance, inductance, moving_mass, driven_by })
            }
            Self::Force | Self::Piezo { .. } => None,
        }
    }
}

/// The coil of a moving-magnet actuator or an exciter: its constants and how it is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoiceCoil {
    /// Force constant Bl (force per coil current), in N/A.
    pub force_constant: f64,
    /// Coil resistance, in Ω.
    pub resistance: f64,
    /// Coil inductance, in H.
    pub inductance: f64,
    /// Mass that moves with the sheet, of the magnet or of the coil, in kg.
    pub moving_mass: f64,
    /// Whether the amplifier sets the current or the voltage.
    pub driven_by: CoilDrive,
}

/// The quantity that the amplifier of a coil controls: its current or its voltage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoilDrive {
    /// Coil current, in A: the back-EMF of the coil drives no current, so it does not damp the sheet.
    Current,
    /// Coil voltage, in V: the back-EMF of the coil drives a current that damps the sheet.
    Voltage,
}

/// Sample index n of the focal instant, the end of a window of `window` seconds at `rate` Hz: `round(window · rate)`.
/// The window holds n + 1 samples.
pub fn window_samples(window: f64, rate: f64) -> usize {
    (window * rate).round().max(0.0) as usize
}
