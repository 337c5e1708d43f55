//! Frequency dependence of a coil in the model of a fit: by its circuit, and by the housing of an exciter.

use unripple_linalg::c64;
use unripple_physics::{Entry, Load, Sensor, Transducer};

/// A coil whose force and sensor signal depend on frequency, so that a gain and a latency do not describe
/// it.
///
/// If its terminals are held at a voltage V, its force is bl V/(R + Ls), its signal for a velocity v the current bl v/(R + Ls), and its
/// damping bl²/(R + Ls). Each is that of the resistance R alone times 1/(1 + τs), τ = L/R. With a housing, force and signal are
/// multiplied by the share [`Load::transmission`] as well, and all of the housing's impedance is added to that of the moving mass.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coil {
    sensor: Sensor,
    /// The load of the actuator without its mass.
    load: Load,
    /// Signal of the coil per velocity (m/s), without inductance and without housing.
    plain: f64,
    /// bl²/R of a coil without housing, in N·s/m.
    damping: f64,
    /// τ, in s.
    time: f64,
}

impl Coil {
    /// The coil of an actuator as drive and as sensor; `None` for one without housing that is not driven by a voltage or has no
    /// inductance.
    pub fn of(transducer: &Transducer, sensor: &Sensor) -> Option<Self> {
        let load = transducer.load.as_ref()?;
        let circuit = load.circuit.filter(|_| transducer.entry == Entry::Voltage);
        let matters = load.housing.is_some() || circuit.is_some_and(|circuit| circuit.inductance > 0.0);
        (matters && transducer.gain != 0.0).then(|| Self {
            sensor: sensor.clone(),
            load: Load { mass: 0.0, ..load.clone() },
            plain: sensor.gain / circuit.map_or(1.0, |circuit| circuit.resistance),
            damping: circuit.map_or(0.0, |circuit| circuit.force_constant.powi(2) / circuit.resistance),
            time: circuit.map_or(0.0, |circuit| circuit.inductance / circuit.resistance),
        })
    }

    /// Force and signal at a complex frequency s (1/s), as a share of those without inductance and without
    /// housing: the low-pass 1/(1 + τs) of the circuit times the transmission of the housing.
    pub fn lag(&self, s: c64) -> c64 {
        (s * self.time + 1.0).inv() * self.load.transmission(s)
    }

    /// Mechanical impedance, in N·s/m, at a complex frequency s (1/s), that the housing adds, or that the
    /// inductance adds to the damping by the resistance alone.
    pub fn added(&self, s: c64) -> c64 {
        match self.load.housing {
            Some(_) => self.load.reaction(s),
            None => (self.lag(s) - 1.0) * self.damping,
        }
    }

    /// The impedance of [`Coil::added`] at an angular frequency (rad/s), as a stiffness (N/m) and a damping (N·s/m).
    pub fn in_mode(&self, omega: f64) -> [f64; 2] {
        let added = self.added(c64::new(0.0, omega));
        [-omega * added.im, added.re]
    }

    /// Filters a signal by the inductance of the circuit and by the housing: `signal` is the signal of a coil without inductance and
    /// without housing, the result is the signal with both. `rate` is in Hz.
    pub fn filtered(&self, signal: &[f64], rate: f64) -> Vec<f64> {
        self.sensor.signal(signal, rate).into_iter().map(|x| x / self.plain).collect()
    }
}

/// The factor of [`Coil::lag`], dimensionless; 1 if `coil` is `None`.
pub(crate) fn lag(coil: Option<&Coil>, s: c64) -> c64 {
    coil.map_or(c64::new(1.0, 0.0), |coil| coil.lag(s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use unripple_core::{Actuator, ActuatorKind, CoilDrive, Point};
    use unripple_physics::{design::papers_surface, sensors, transducers};

    /// Drive, sensor and load against the equations of coil and housing at one frequency.
    #[test]
    fn an_exciter_is_its_gain_behind_coil_and_housing() {
        let (bl, resistance, inductance, mass, quality) = (2.5, 4.0, 0.2e-3, 0.04, 3.0);
        let omega = TAU * 150.0;
        for driven_by in [CoilDrive::Current, CoilDrive::Voltage] {
            let kind = ActuatorKind::Exciter {
                force_constant: bl,
                resistance,
                inductance,
                moving_mass: 1.2e-3,
                housing_mass: mass,
                resonance: 150.0,
                quality_factor: quality,
                driven_by,
            };
            let at = Point::from_mm(62.0, 90.0);
            let mut surface = papers_surface();
            surface.actuators = vec![Actuator { name: "e".into(), at, kind, contact_radius: 0.0 }];
            let (transducer, sensor) =
                (transducers(&surface).unwrap().remove(0), sensors(&surface).unwrap().remove(0));
            let coil = Coil::of(&transducer, &sensor).unwrap();
            for s in [c64::new(30.0, 400.0), c64::new(0.0, 900.0), c64::new(20.0, 9e3)] {
                let closed = s * inductance + resistance;
                let (low_pass, electric) = match driven_by {
                    CoilDrive::Current => (c64::new(1.0, 0.0), c64::new(0.0, 0.0)),
                    CoilDrive::Voltage => {
                        (c64::new(resistance, 0.0) / closed, c64::new(bl * bl, 0.0) / closed)
                    }
                };
                let tied = s.inv() * (mass * omega * omega) + mass * omega / quality + electric;
                let free = (tied / (s * mass) + 1.0).inv();
                let near = |found: c64, exact: c64| (found - exact).norm() < 1e-12 * exact.norm();
                assert!(near(coil.lag(s), low_pass * free), "{driven_by:?} {s}");
                assert!(near(coil.added(s), ((s * mass).inv() + tied.inv()).inv()), "{driven_by:?} {s}");
            }
            // In time: a slow swell of velocity, long after its beginning.
            let (rate, s) = (48e3, c64::new(0.0, TAU * 400.0));
            let swell: Vec<f64> = (0..9600).map(|i| (s.im * i as f64 / rate).cos()).collect();
            let share = coil.lag(s);
            for (i, found) in coil.filtered(&swell, rate).iter().enumerate().skip(6000) {
                let exact = (share * c64::new(0.0, s.im * i as f64 / rate).exp()).re;
                assert!((found - exact).abs() < 1e-3, "{driven_by:?} {i}: {found} {exact}");
            }
        }
    }
}
