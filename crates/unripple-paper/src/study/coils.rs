//! Effect of real coils on a surface: their mass, and the damping by an amplifier that holds their voltage.

use super::StudyError;
use std::f64::consts::{PI, TAU};
use unripple_core::{ActuatorKind, CoilDrive, Point, Responses, Surface};
use unripple_dsp::median;
use unripple_field::Field;
use unripple_focus::{Options, Target, focus};
use unripple_physics::{Medium, ResponseOptions, responses};

/// Permeability of vacuum μ_0, in H/m; resistivity and density of copper, in Ω·m and kg/m³; remanence of a good magnet, in T.
const PERMEABILITY: f64 = 4e-7 * PI;
const COPPER: (f64, f64) = (1.68e-8, 8960.0);
const REMANENCE: f64 = 1.2;

/// Cells per shortest wavelength of the grid on which contrast is evaluated, as everywhere.
const CELLS: f64 = 8.0;

/// A kind of moving-magnet actuator, used at all actuators of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coils {
    /// Force constant bl, in N/A.
    pub force_constant: f64,
    /// Resistance, in Ω.
    pub resistance: f64,
    /// Inductance, in H.
    pub inductance: f64,
    /// Mass of the magnet that moves with the sheet, in kg.
    pub moving_mass: f64,
    /// Quantity that the amplifier imposes, current or voltage; `None` for an ideal force with the same mass.
    pub driven_by: Option<CoilDrive>,
}

impl Coils {
    /// The paper's coil with the printed data (section 4: 6.2 Ω, 1.9 mH, 6 N/A) and a mass of 100 mg, which the paper
    /// does not give.
    pub fn papers(driven_by: CoilDrive) -> Self {
        Self {
            force_constant: 6.0,
            resistance: 6.2,
            inductance: 1.9e-3,
            moving_mass: 100e-6,
            driven_by: Some(driven_by),
        }
    }

    fn kind(&self) -> ActuatorKind {
        let driven_by = self.driven_by.unwrap_or(CoilDrive::Current);
        let Self { force_constant, resistance, inductance, moving_mass, .. } = *self;
        ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by }
    }

    /// The drive, in A or V, that exerts 1 N on an immovable body at low frequency.
    pub fn drive_for_one_newton(&self) -> f64 {
        match self.driven_by {
            Some(CoilDrive::Voltage) => self.resistance / self.force_constant,
            _ => 1.0 / self.force_constant,
        }
    }
}

/// Decay time of a surface with coils of one kind, and its time-reversed focus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coiled {
    /// The kind of coil.
    pub coils: Coils,
    /// Median amplitude decay time of the oscillating modes, in s.
    pub decay_time_s: f64,
    /// Contrast of a time-reversed focus (ratio).
    pub contrast: f64,
    /// Peak velocity of this focus, in m/s, with a drive whose peak would exert 1 N on an immovable body.
    pub peak_velocity_m_s: f64,
}

/// Computes a time-reversed focus at a point with a window (s) for each kind of coil, at the surface's actuator
/// positions, with magnets in contact over discs of radius `contact_radius` (m).
///
/// # Errors
/// [`StudyError`] where responses, focus or field cannot be computed.
pub fn coils(
    surface: &Surface,
    kinds: &[Coils],
    contact_radius: f64,
    (at, window): (Point, f64),
) -> Result<Vec<Coiled>, StudyError> {
    let row = |coils: &Coils| {
        let mut fitted = surface.clone();
        for actuator in &mut fitted.actuators {
            (actuator.kind, actuator.contact_radius) = (coils.kind(), contact_radius);
        }
        let responses = responses(&fitted, &ResponseOptions::default())?;
        let options = Options { window, limit: coils.drive_for_one_newton(), ..Options::default() };
        let drive = focus(&responses, &[Target::at(at)], &options)?.drive;
        let found = Field::new(&responses, &drive, CELLS)?.at_instant(window, &[at], &[at])?;
        Ok(Coiled {
            coils: *coils,
            decay_time_s: median_decay(&responses),
            contrast: found.contrast().unwrap_or(f64::NAN),
            peak_velocity_m_s: found.velocity,
        })
    };
    kinds.iter().map(row).collect()
}

/// Median of 1/σ over the distinct modes that oscillate.
fn median_decay(responses: &Responses) -> f64 {
    let Responses::Modal(modal) = responses else { return f64::NAN };
    let mut poles: Vec<(f64, f64)> =
        modal.poles.iter().filter(|p| p.sigma < p.omega).map(|p| (p.omega, p.sigma)).collect();
    poles.dedup();
    median(poles.iter().map(|(_, sigma)| 1.0 / sigma)).unwrap_or(f64::NAN)
}

/// Data that show whether a force constant is possible for a coil and its magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Credibility {
    /// Damping (bl)²/R of a coil driven by a voltage source, in N·s/m.
    pub coil_damping: f64,
    /// Point resistance of an infinite sheet, 1/Re Y = 4(R + 2Dk²)/ω, in N·s/m, with the driving-point
    /// mobility Y, tension R, bending stiffness D, wavenumber k and angular frequency ω.
    pub sheet_resistance: f64,
    /// Length of wire that gives the force constant in a field of half the magnet's remanence, in m.
    pub wire_length_m: f64,
    /// Mass of copper wire with the length `wire_length_m` and the coil's resistance, in kg.
    pub copper_kg: f64,
    /// Number of turns that give the coil its inductance at a radius of the magnet's diameter: L ≈ μ_0 N² r
    /// (a coil about as long as wide, within a factor of two).
    pub turns: f64,
    /// Largest force constant with the number of turns `turns`: the magnet's moment times the largest
    /// gradient on the axis of a loop, N B_r V/μ_0 · 0.43 μ_0/r², in N/A.
    pub reachable: f64,
}

/// Computes [`Credibility`] for a coil, a round magnet of given diameter and thickness (m), and a sheet at
/// a frequency (Hz).
pub fn credibility(coils: &Coils, [diameter, thickness]: [f64; 2], medium: &Medium, hz: f64) -> Credibility {
    let k = medium.wavenumber(TAU * hz);
    let slope = medium.tension + 2.0 * medium.bending_stiffness * k * k;
    let wire_length_m = coils.force_constant / (0.5 * REMANENCE);
    let turns = (coils.inductance / (PERMEABILITY * diameter)).sqrt();
    let volume = PI / 4.0 * diameter * diameter * thickness;
    // On the axis of a loop dB/dz = (3/2) μ_0 z r²/(r² + z²)^{5/2} per ampere, at most at z = r/2: 0.429 μ_0/r².
    let gradient = 0.75 * 1.25f64.powf(-2.5) * PERMEABILITY / (diameter * diameter);
    Credibility {
        coil_damping: coils.force_constant.powi(2) / coils.resistance,
        sheet_resistance: 4.0 * slope / (TAU * hz),
        wire_length_m,
        copper_kg: COPPER.1 * COPPER.0 * wire_length_m.powi(2) / coils.resistance,
        turns,
        reachable: turns * gradient * REMANENCE * volume / PERMEABILITY,
    }
}
