//! What real coils do to a surface: their mass, and the damping by an amplifier that holds their voltage.

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

/// Cells of the grid per shortest wavelength that contrast is taken on, as everywhere.
const CELLS: f64 = 8.0;

/// A kind of actuator put at all of a surface's places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coils {
    /// Force constant bl, in N/A.
    pub force_constant: f64,
    /// Resistance, in Ω.
    pub resistance: f64,
    /// Inductance, in H.
    pub inductance: f64,
    /// Mass on the sheet, in kg.
    pub moving_mass: f64,
    /// What the amplifier holds; `None` for an ideal force with the mass.
    pub driven_by: Option<CoilDrive>,
}

impl Coils {
    /// The paper's coil as printed (section 4: 6.2 Ω, 1.9 mH, 6 N/A), with a mass of 100 mg, which it does not print.
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

    /// The drive that presses with 1 N on what does not move: in A or V, at low frequency.
    pub fn drive_for_one_newton(&self) -> f64 {
        match self.driven_by {
            Some(CoilDrive::Voltage) => self.resistance / self.force_constant,
            _ => 1.0 / self.force_constant,
        }
    }
}

/// A surface with such coils.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coiled {
    /// The kind of coil.
    pub coils: Coils,
    /// Median amplitude decay time of the oscillations in the band, in s.
    pub decay_time_s: f64,
    /// Contrast of a time-reversed focus.
    pub contrast: f64,
    /// Its peak velocity where the drive's peak would press with 1 N on what does not move, in m/s.
    pub peak_velocity_m_s: f64,
}

/// A focus at a place for a window (s), made with each kind of coil at the surface's places, contacts of some radius (m).
///
/// # Errors
/// [`StudyError`] where responses, focus or field cannot be made.
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

/// Median of 1/σ over the distinct oscillations that swing.
fn median_decay(responses: &Responses) -> f64 {
    let Responses::Modal(modal) = responses else { return f64::NAN };
    let mut poles: Vec<(f64, f64)> =
        modal.poles.iter().filter(|p| p.sigma < p.omega).map(|p| (p.omega, p.sigma)).collect();
    poles.dedup();
    median(poles.iter().map(|(_, sigma)| 1.0 / sigma)).unwrap_or(f64::NAN)
}

/// Whether a force constant can belong to a coil and a magnet, in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Credibility {
    /// Damping (bl)²/R by a source of voltage, in N·s/m.
    pub coil_damping: f64,
    /// Point resistance of an infinite sheet at the frequency, 1/Re Y = 4(R + 2Dk²)/ω, in N·s/m.
    pub sheet_resistance: f64,
    /// Length of wire that has the force constant in a field of half the remanence, in m.
    pub wire_length_m: f64,
    /// Mass of copper of that length and of the coil's resistance, in kg.
    pub copper_kg: f64,
    /// Turns that give the coil its inductance at a radius of the magnet's diameter: L ≈ μ_0 N² r (a coil about as long as
    /// wide, within a factor of two).
    pub turns: f64,
    /// Force constant that those turns can have: the magnet's moment times the largest gradient on a loop's axis,
    /// N B_r V/μ_0 · 0.43 μ_0/r², in N/A.
    pub reachable: f64,
}

/// The numbers for a coil, a round magnet of some diameter and thickness (m), and a sheet at a frequency (Hz).
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
