//! Electrical circuit of a voltage-driven coil in the model of a fit.

use unripple_linalg::c64;
use unripple_physics::{Entry, Sensor, Transducer};

/// A coil whose terminals are held at a voltage V: its force is bl V/(R + Ls), its signal for a velocity v is the current bl v/(R + Ls),
/// and its damping is bl²/(R + Ls). Each is that of the resistance R alone times 1/(1 + τs), τ = L/R. Unlike a latency, this delay
/// depends on frequency.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coil {
    sensor: Sensor,
    /// Its signal per m/s of slowly changing velocity.
    slow: f64,
    /// bl²/R, in N·s/m.
    damping: f64,
    /// τ, in s.
    time: f64,
}

impl Coil {
    /// The circuit of an actuator as drive and as sensor; `None` for one that is not driven by a voltage or has no inductance.
    pub fn of(transducer: &Transducer, sensor: &Sensor) -> Option<Self> {
        let circuit = transducer.load.as_ref()?.circuit.filter(|_| transducer.entry == Entry::Voltage)?;
        let matters = circuit.inductance > 0.0 && transducer.gain != 0.0;
        matters.then(|| Self {
            sensor: sensor.clone(),
            slow: sensor.gain / circuit.resistance,
            damping: circuit.force_constant.powi(2) / circuit.resistance,
            time: circuit.inductance / circuit.resistance,
        })
    }

    /// The low-pass 1/(1 + τs) of the circuit, without unit, at a complex frequency s (1/s).
    pub fn lag(&self, s: c64) -> c64 {
        (s * self.time + 1.0).inv()
    }

    /// Mechanical impedance, in N·s/m, that the inductance adds to the damping by the resistance alone, at a complex frequency s (1/s).
    pub fn added(&self, s: c64) -> c64 {
        (self.lag(s) - 1.0) * self.damping
    }

    /// The impedance of [`Coil::added`] at an angular frequency (rad/s), as a stiffness (N/m) and a damping (N·s/m).
    pub fn in_mode(&self, omega: f64) -> [f64; 2] {
        let added = self.added(c64::new(0.0, omega));
        [-omega * added.im, added.re]
    }

    /// Filters a signal by the inductance: `signal` is that with the resistance alone, the result that of the whole circuit. `rate` is
    /// in Hz.
    pub fn behind(&self, signal: &[f64], rate: f64) -> Vec<f64> {
        self.sensor.hear(signal, rate).into_iter().map(|x| x / self.slow).collect()
    }
}

/// 1/(1 + τs) of a coil; 1 where there is none.
pub(crate) fn lag(coil: Option<&Coil>, s: c64) -> c64 {
    coil.map_or(c64::new(1.0, 0.0), |coil| coil.lag(s))
}
