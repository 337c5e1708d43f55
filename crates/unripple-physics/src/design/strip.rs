//! A finger on a strip of sheet as wide as its contact, by the model of Hudin et al. (2012), section 3.5.

use std::f64::consts::TAU;
use unripple_core::Finger;

/// A strip of sheet as wide as a finger's contact, along which waves travel to the finger (Hudin et al. 2012, section 3.5).
/// Equation numbers are those of the paper.
///
/// An incident wave A_I e^{j(ωt - kx)} meets the finger at x = 0; a reflected wave A_R e^{j(ωt + kx)} travels back, and a
/// transmitted wave A_T e^{j(ωt - kx)} goes on.
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
    /// Mass per length ρ_l = ρhl of a strip of thickness h and width l, in kg/m.
    pub linear_density: f64,
    /// Tension of the strip R_l, a force in N.
    pub tension: f64,
    /// Bending stiffness D_l = Eh³l/12, in N·m²: without the factor 1/(1 - ν²) of a plate, since a narrow
    /// strip is free to curve across its width.
    pub bending_stiffness: f64,
}

/// Reflection, transmission and absorption of a wave at the finger. The three shares of the wave's power
/// sum to one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Scattering {
    /// Frequency, in Hz.
    pub frequency_hz: f64,
    /// Reflection coefficient abs(A_R/A_I), dimensionless.
    pub reflection: f64,
    /// Transmission coefficient abs(A_T/A_I), dimensionless.
    pub transmission: f64,
    /// Share of the wave's power that is reflected.
    pub reflected_power: f64,
    /// Share of the wave's power that is transmitted.
    pub transmitted_power: f64,
    /// Share of the wave's power that the finger absorbs.
    pub absorbed_power: f64,
}

impl Strip {
    /// A strip of width `width` (m) of a sheet with a given Young's modulus (Pa), density (kg/m³), thickness (m) and tension (N/m).
    pub fn of_sheet(young: f64, density: f64, thickness: f64, tension: f64, width: f64) -> Self {
        Self {
            linear_density: density * thickness * width,
            tension: tension * width,
            bending_stiffness: young * thickness.powi(3) * width / 12.0,
        }
    }

    /// Phase velocity c = √((R_l + D_l k²)/ρ_l), in m/s (equation 5), at the wavenumber `k` (rad/m).
    pub fn celerity(&self, k: f64) -> f64 {
        (self.stretch(k) / self.linear_density).sqrt()
    }

    /// Wave impedance Z_S = √(ρ_l (R_l + D_l k²)), in N·s/m (equation 5), at the wavenumber `k` (rad/m).
    pub fn impedance(&self, k: f64) -> f64 {
        (self.linear_density * self.stretch(k)).sqrt()
    }

    /// Wavenumber k at a frequency in Hz, in rad/m.
    pub fn wavenumber(&self, hz: f64) -> f64 {
        let inertia = self.linear_density * (TAU * hz).powi(2);
        let root = (self.tension.powi(2) + 4.0 * self.bending_stiffness * inertia).sqrt();
        (2.0 * inertia / (self.tension + root)).sqrt()
    }

    /// Power, in W, of an incident wave of wavenumber `k` (rad/m) that moves the finger with the `amplitude` A_F (m), by
    /// equation 4: P = (ω²/4) abs(Z_F + 2Z_S)²/abs(Z_S) A_F².
    ///
    /// As in the paper, this is the greatest instantaneous power, twice the mean over a period.
    pub fn power(&self, finger: &Finger, k: f64, amplitude: f64) -> f64 {
        let omega = k * self.celerity(k);
        let strip = self.impedance(k);
        let (resistance, reactance) = finger_impedance(finger, omega);
        let both = (resistance + 2.0 * strip).powi(2) + reactance * reactance;
        omega * omega / 4.0 * both / strip * amplitude * amplitude
    }

    /// Scattering at the finger of a wave with the frequency `hz` (Hz), by equation 3: A_T/A_I =
    /// 2Z_S/(Z_F + 2Z_S), A_R/A_I = -Z_F/(Z_F + 2Z_S).
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

/// Mechanical impedance of a finger Z_F = β + j(μω - κ/ω) at the angular frequency ω (rad/s): its real and imaginary parts, in N·s/m.
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
