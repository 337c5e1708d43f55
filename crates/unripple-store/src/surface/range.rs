//! Legal ranges of numbers, and their units.

use crate::{decimal, degrees};

/// Legal values of a number, in the file's unit, and how that unit relates to SI.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    /// The unit's name; empty for a pure number.
    pub unit: &'static str,
    /// Power of ten by which a value of the file is multiplied to give its SI value.
    pub power: i32,
    /// Whether the file's unit is the degree and SI's the radian.
    pub turns: bool,
    /// Least legal value.
    pub least: f64,
    /// Greatest legal value.
    pub greatest: f64,
}

impl Limits {
    pub(crate) const fn new(unit: &'static str, power: i32, least: f64, greatest: f64) -> Self {
        Self { unit, power, turns: false, least, greatest }
    }

    const fn degrees(least: f64, greatest: f64) -> Self {
        Self { unit: "degrees", power: 0, turns: true, least, greatest }
    }

    /// The SI value of a decimal number of the file; `None` if it is not one.
    pub(crate) fn si(&self, text: &str) -> Option<f64> {
        if self.turns { degrees::radians(text) } else { decimal::scaled(text, self.power) }
    }

    /// An SI value as the file writes it, such that [`Limits::si`] gives it back.
    pub(crate) fn text(&self, value: f64) -> String {
        if self.turns { degrees::text(value) } else { decimal::text(value, -self.power) }
    }

    pub(crate) fn allow(&self, value: f64) -> bool {
        (self.least..=self.greatest).contains(&value)
    }

    /// Whether a file can hold an SI value.
    pub(crate) fn hold(&self, value: f64) -> bool {
        self.text(value).parse::<f64>().is_ok_and(|written| self.allow(written))
    }

    /// As a message says it.
    pub(crate) fn expected(&self) -> String {
        let range = format!("a number from {} to {}", decimal::text(self.least, 0), {
            decimal::text(self.greatest, 0)
        });
        if self.unit.is_empty() { range } else { format!("{range} {}", self.unit) }
    }

    /// The legal value nearest to one that is not; `None` for not-a-number.
    pub(crate) fn nearest(&self, value: f64) -> Option<String> {
        (!value.is_nan()).then(|| decimal::text(value.clamp(self.least, self.greatest), 0))
    }
}

/// Limits of every number of the format, by key.
pub(crate) mod of {
    use super::Limits;

    // What the solvers of modes take.
    pub(crate) const ACCURACY: Limits = Limits::new("", 0, 1e-12, 0.1);

    pub(crate) const LENGTH: Limits = Limits::new("mm", -3, 1.0, 1e5);
    pub(crate) const STRAIGHT: Limits = Limits::new("mm", -3, 0.0, 1e5);
    pub(crate) const COORDINATE: Limits = Limits::new("mm", -3, -1e6, 1e6);
    pub(crate) const HOLE_LENGTH: Limits = Limits::new("mm", -3, 0.01, 1e5);
    pub(crate) const ARC_RADIUS: Limits = Limits::new("mm", -3, 0.001, 1e6);
    pub(crate) const SLIT_WIDTH: Limits = Limits::new("mm", -3, 0.01, 100.0);
    pub(crate) const DIRECTION: Limits = Limits::degrees(-720.0, 720.0);
    pub(crate) const SWEEP: Limits = Limits::degrees(-360.0, 360.0);
    pub(crate) const LIFT: Limits = Limits::new("N/mm²", 6, 0.0, 1e6);
    pub(crate) const TILT: Limits = Limits::new("N", 0, 0.0, 1e9);
    // The softest foam to steel. A strip whose springs are past the limits above is refused where they are computed.
    pub(crate) const ADHESIVE_YOUNG: Limits = Limits::new("MPa", 6, 0.001, 2e5);
    pub(crate) const ADHESIVE_WIDTH: Limits = Limits::new("mm", -3, 0.01, 1000.0);
    pub(crate) const ADHESIVE_THICKNESS: Limits = Limits::new("mm", -3, 0.01, 100.0);
    pub(crate) const GRAIN_YOUNG: Limits = Limits::new("GPa", 9, 1e-6, 2000.0);
    pub(crate) const THICKNESS_FACTOR: Limits = Limits::new("", 0, 0.05, 20.0);
    pub(crate) const TENSION_FACTOR: Limits = Limits::new("", 0, 0.0, 20.0);
    pub(crate) const ADDED_MASS: Limits = Limits::new("kg/m²", 0, 0.0, 1000.0);
    pub(crate) const SCATTERER_MASS: Limits = Limits::new("mg", -6, 0.0, 1e7);
    pub(crate) const DISC_RADIUS: Limits = Limits::new("mm", -3, 0.1, 1000.0);
    pub(crate) const YOUNG: Limits = Limits::new("GPa", 9, 0.0, 2000.0);
    pub(crate) const DENSITY: Limits = Limits::new("kg/m³", 0, 1.0, 30_000.0);
    pub(crate) const POISSON: Limits = Limits::new("", 0, -0.9999, 0.4999);
    pub(crate) const STRENGTH: Limits = Limits::new("MPa", 6, 0.01, 1e5);
    pub(crate) const THICKNESS: Limits = Limits::new("mm", -3, 0.001, 100.0);
    pub(crate) const TENSION: Limits = Limits::new("N/m", 0, 0.0, 1e6);
    pub(crate) const DECAY_TIME: Limits = Limits::new("ms", -3, 0.01, 1e6);
    pub(crate) const LOSS_FACTOR: Limits = Limits::new("", 0, 1e-6, 1.0);
    pub(crate) const FREQUENCY: Limits = Limits::new("Hz", 0, 0.0, 5e6);
    pub(crate) const RATE: Limits = Limits::new("Hz", 0, 100.0, 1e7);
    pub(crate) const DRIVE: Limits = Limits::new("of the drive's unit", 0, 1e-6, 1e6);
    pub(crate) const FINGER_MASS: Limits = Limits::new("g", -3, 0.0, 1000.0);
    pub(crate) const FINGER_DAMPING: Limits = Limits::new("N·s/m", 0, 0.0, 1000.0);
    pub(crate) const FINGER_STIFFNESS: Limits = Limits::new("N/mm", 3, 0.0, 1000.0);
    pub(crate) const CONTACT_RADIUS: Limits = Limits::new("mm", -3, 0.1, 100.0);
    pub(crate) const FORCE_CONSTANT: Limits = Limits::new("N/A", 0, 1e-3, 1000.0);
    pub(crate) const RESISTANCE: Limits = Limits::new("Ω", 0, 1e-3, 1e6);
    pub(crate) const INDUCTANCE: Limits = Limits::new("mH", -3, 0.0, 1000.0);
    pub(crate) const MOVING_MASS: Limits = Limits::new("mg", -6, 0.0, 1e6);
    pub(crate) const HOUSING_MASS: Limits = Limits::new("g", -3, 0.01, 1e5);
    pub(crate) const RESONANCE: Limits = Limits::new("Hz", 0, 1.0, 1e5);
    pub(crate) const SPRING: Limits = Limits::new("N/mm", 3, 1e-4, 1e5);
    pub(crate) const QUALITY_FACTOR: Limits = Limits::new("", 0, 0.1, 1000.0);
    pub(crate) const RESONATOR_MASS: Limits = Limits::new("g", -3, 1e-6, 1e5);
    pub(crate) const RESONATOR_QUALITY: Limits = Limits::new("", 0, 0.1, 1e6);
    pub(crate) const MASS_RATIO: Limits = Limits::new("", 0, 1e-6, 100.0);
    pub(crate) const FREQUENCY_SCATTER: Limits = Limits::new("%", -2, 0.0, 20.0);
    pub(crate) const LATTICE_PITCH: Limits = Limits::new("mm", -3, 0.01, 1e5);
    pub(crate) const PAD_RADIUS: Limits = Limits::new("mm", -3, 0.0, 100.0);
    pub(crate) const PATCH_RADIUS: Limits = Limits::new("mm", -3, 0.1, 100.0);
    pub(crate) const PATCH_SIDE: Limits = Limits::new("mm", -3, 0.1, 1000.0);
    pub(crate) const PATCH_MOMENT: Limits = Limits::new("N/V", 0, -1e5, 1e5);
    pub(crate) const PATCH_MASS: Limits = Limits::new("mg", -6, 0.0, 1e7);
    pub(crate) const PATCH_YOUNG: Limits = Limits::new("GPa", 9, 0.001, 2000.0);
    pub(crate) const PATCH_THICKNESS: Limits = Limits::new("mm", -3, 0.001, 10.0);
    pub(crate) const STRAIN_CONSTANT: Limits = Limits::new("pm/V", -12, -1e4, 1e4);
}
