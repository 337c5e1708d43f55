//! The paper's model of touch: a strip of sheet as wide as the finger (section 3.5).

use std::f64::consts::TAU;
use unripple_core::Finger;

/// A strip of sheet as wide as a finger's contact, along which waves come: the paper's section 3.5.
///
/// An incident wave A_I e^{j(ωt - kx)} meets the finger at x = 0; a reflected one travels back as e^{j(ωt + kx)} and a
/// transmitted one goes on.
///
/// ```
/// use unripple_core::Finger;
/// use unripple_physics::design::Strip;
///
/// let film = Strip::of_sheet(4e9, 1400.0, 0.125e-3, 200.0, 10e-3);
/// let k = std::f64::consts::TAU / 15e-3;
/// assert!((film.power(&Finger::default(), k, 10e-6) / 1.44 - 1.0).abs() < 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Mass per length ρ_l = ρhl, in kg/m.
    pub linear_density: f64,
    /// Tension R_l, in N.
    pub tension: f64,
    /// Bending stiffness D_l = Eh³l/12, in N·m². A strip bends freely across, hence no 1 - ν².
    pub bending_stiffness: f64,
}

/// What a wave of unit power becomes at the finger. The three shares sum to one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Scattering {
    /// Frequency, in Hz.
    pub frequency_hz: f64,
    /// Reflection coefficient abs(A_R/A_I), dimensionless.
    pub reflection: f64,
    /// Transmission coefficient abs(A_T/A_I), dimensionless.
    pub transmission: f64,
    /// Share of the power that goes back.
    pub reflected_power: f64,
    /// Share of the power that goes on.
    pub transmitted_power: f64,
    /// Share of the power that the finger takes.
    pub absorbed_power: f64,
}

impl Strip {
    /// A strip `width` metres wide of a sheet of Young's modulus (Pa), density (kg/m³), thickness (m), tension (N/m).
    pub fn of_sheet(young: f64, density: f64, thickness: f64, tension: f64, width: f64) -> Self {
        Self {
            linear_density: density * thickness * width,
            tension: tension * width,
            bending_stiffness: young * thickness.powi(3) * width / 12.0,
        }
    }

    /// Celerity c = √((R_l + D_l k²)/ρ_l), in m/s (equation 5), at the wavenumber `k` (rad/m).
    pub fn celerity(&self, k: f64) -> f64 {
        (self.stretch(k) / self.linear_density).sqrt()
    }

    /// Impedance Z_S = √(ρ_l (R_l + D_l k²)), in N·s/m (equation 5), at the wavenumber `k` (rad/m).
    pub fn impedance(&self, k: f64) -> f64 {
        (self.linear_density * self.stretch(k)).sqrt()
    }

    /// Wavenumber k at a frequency in Hz, in rad/m.
    pub fn wavenumber(&self, hz: f64) -> f64 {
        let inertia = self.linear_density * (TAU * hz).powi(2);
        let root = (self.tension.powi(2) + 4.0 * self.bending_stiffness * inertia).sqrt();
        (2.0 * inertia / (self.tension + root)).sqrt()
    }

    /// Power of the incident wave that moves the finger with amplitude A_F (m), in W (equation 4):
    /// P = (ω²/4) abs(Z_F + 2Z_S)²/abs(Z_S) A_F².
    ///
    /// As the paper defines it: the crest of the power, twice its mean over a period.
    pub fn power(&self, finger: &Finger, k: f64, amplitude: f64) -> f64 {
        let omega = k * self.celerity(k);
        let strip = self.impedance(k);
        let (resistance, reactance) = finger_impedance(finger, omega);
        let both = (resistance + 2.0 * strip).powi(2) + reactance * reactance;
        omega * omega / 4.0 * both / strip * amplitude * amplitude
    }

    /// What becomes of a wave of a frequency in Hz (equation 3): A_T/A_I = 2Z_S/(Z_F + 2Z_S), A_R/A_I = -Z_F/(Z_F + 2Z_S).
    pub fn scattering(&self, finger: &Finger, hz: f64) -> Scattering {
        let strip = self.impedance(self.wavenumber(hz));
        let (resistance, reactance) = finger_impedance(finger, TAU * hz);
        let both = (resistance + 2.0 * strip).powi(2) + reactance * reactance;
        let reflected = (resistance * resistance + reactance * reactance) / both;
        let transmitted = 4.0 * strip * strip / both;
        Scattering {
            frequency_hz: hz,
            reflection: reflected.sqrt(),
            transmission: transmitted.sqrt(),
            reflected_power: reflected,
            transmitted_power: transmitted,
            absorbed_power: 4.0 * strip * resistance / both,
        }
    }

    fn stretch(&self, k: f64) -> f64 {
        self.tension + self.bending_stiffness * k * k
    }
}

/// Impedance of a finger Z_F = β + j(μω - κ/ω) at angular frequency ω (rad/s), as real and imaginary part, in N·s/m.
pub fn finger_impedance(finger: &Finger, omega: f64) -> (f64, f64) {
    (finger.damping, finger.mass * omega - finger.stiffness / omega)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_is_shared_out() {
        let glass = Strip::of_sheet(69e9, 2300.0, 1e-3, 0.0, 10e-3);
        for hz in [1.0, 100.0, 356.0, 3e3, 4e4] {
            let s = glass.scattering(&Finger::default(), hz);
            assert!((s.reflected_power + s.transmitted_power + s.absorbed_power - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_finger_takes_most_from_a_strip_of_half_its_impedance() {
        let finger = Finger { mass: 0.0, stiffness: 0.0, ..Finger::default() };
        let strip =
            |impedance: f64| Strip { linear_density: impedance, tension: impedance, bending_stiffness: 0.0 };
        let absorbed = |z: f64| strip(z).scattering(&finger, 100.0).absorbed_power;
        assert!((absorbed(0.5) - 0.5).abs() < 1e-12);
        assert!(absorbed(0.45) < 0.5 && absorbed(0.55) < 0.5 && absorbed(1.0) < 0.5);
    }
}
