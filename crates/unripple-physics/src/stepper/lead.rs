//! Factors of a channel in the time-domain simulation: the effect of its drive at a port, and its sensor signal.

use super::Channel;
use crate::Circuit;

/// The port of a channel, and the factors from drive to motion and from motion to sensor signal there.
///
/// A coil of inductance L driven by a voltage V gives the force bl·i with L di/dt + R i = V - bl·v. The sensor signal is the
/// current j that only the motion drives through the coil, L dj/dt + R j = bl·v, which is a state of its own beside the current
/// that the drive would cause in the coil at rest. Over a step, forces are constant and motion is averaged, so that the coil
/// delays both by (dt/2)·coth(θ/2), θ = R dt/L, instead of by L/R = dt/θ. Therefore the share κ = 1 - (2/θ)·tanh(θ/2) of the drive
/// acts at once as an impulse, and the same share of the velocity contributes to the signal at once. κ is 1 without inductance, and about
/// θ²/12 if the current is slow. It is equal for drive and sensor, which keeps responses reciprocal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    /// Index of the port at which the channel acts.
    pub(super) port: usize,
    /// Index of the port of an exciter's twin (a copy of the housing without a sheet), which gets the same
    /// drive and whose signal is subtracted; `None` for other channels.
    pub(super) twin: Option<usize>,
    /// Impulse (N·s) per unit of drive in one sample.
    pub(super) strike: f64,
    /// Sensor signal per velocity (m/s) of the port.
    pub(super) felt: f64,
    /// Step of the coil's current (A) per unit of drive in one sample.
    pub(super) jump: f64,
    /// Sensor signal per ampere of the current that the motion drives.
    pub(super) driven: f64,
}

impl Lead {
    /// The factors of a channel for a port; `dt` is the length of a step, in s.
    pub(super) fn of(channel: &Channel, port: usize, rate: f64, dt: f64) -> Self {
        let gain = channel.gain;
        let struck = |share: f64| Self {
            port,
            twin: None,
            strike: share * gain / rate,
            felt: share * gain,
            jump: 0.0,
            driven: 0.0,
        };
        let coil = channel.load.as_ref().and_then(|load| load.circuit).filter(|_| channel.voltage);
        let Some(Circuit { force_constant, resistance, inductance }) = coil else { return struck(1.0) };
        let at_once = force_constant / resistance;
        if inductance == 0.0 {
            return struck(at_once);
        }
        let theta = resistance * dt / inductance;
        let share = sudden(theta);
        let slow = (1.0 - share) * gain;
        Self { jump: slow / (inductance * rate), driven: slow, ..struck(share * at_once) }
    }

    /// The indices of the ports on which the drive acts: the channel's own port and that of a twin.
    #[inline(always)]
    pub(super) fn ports(&self) -> impl Iterator<Item = usize> {
        [Some(self.port), self.twin].into_iter().flatten()
    }

    /// Whether any part of the drive acts on the sheet instantly, as an impulse.
    pub(super) fn strikes(&self) -> bool {
        self.strike != 0.0
    }

    /// The sensor signal, in the sensor's unit, from the port's velocity (m/s) and the current (A, positive
    /// in the direction of the drive's current) that the motion drives through its coil.
    #[inline(always)]
    pub(super) fn hears(&self, velocity: f64, driven: f64) -> f64 {
        self.felt * velocity - self.driven * driven
    }
}

/// Share κ of a coil's drive that acts instantly, from θ = R dt/L.
fn sudden(theta: f64) -> f64 {
    let x = 0.5 * theta;
    // By its power series where the difference would cancel.
    if x < 1e-2 { x * x / 3.0 * (1.0 - 0.4 * x * x) } else { 1.0 - x.tanh() / x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slow_coil_takes_nothing_at_once_and_a_fast_one_all() {
        assert!((sudden(1e-4) / (1e-8 / 12.0) - 1.0).abs() < 1e-8);
        assert!((sudden(0.02 - 1e-9) / sudden(0.02 + 1e-9) - 1.0).abs() < 1e-6);
        assert!((sudden(1e12) - 1.0).abs() < 1e-11);
    }

    #[test]
    fn what_is_held_comes_as_late_as_the_coil_makes_it() {
        // The mean time of what strikes at once and of what is held over steps, in steps, against L/R.
        for theta in [1e-2, 0.3, 1.0, 5.0, 100.0f64] {
            let held = 0.5 + 1.0 / theta.exp_m1();
            assert!(((1.0 - sudden(theta)) * held * theta - 1.0).abs() < 1e-9, "{theta}");
        }
    }
}
