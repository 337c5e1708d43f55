//! Channels as the stepper knows them: what a drive does at a port, and what its sensor reads.

use super::Channel;
use crate::Circuit;

/// Where a channel leads: its port, and the factors of drive and sensor there.
///
/// A coil of inductance L on a voltage V makes the force bl·i with L di/dt + R i = V - bl·v. What is heard of the motion is
/// what the motion alone drives through the coil, j with L dj/dt + R j = bl·v: a state of its own beside the current that the drive
/// would make flow in the coil at rest. Over a step forces are held and motion is a mean, so that both pass
/// the coil (dt/2)·coth(θ/2) late, θ = R dt/L, where dt/θ = L/R is right. The share κ = 1 - (2/θ)·tanh(θ/2) of the drive therefore strikes
/// at once, and of the velocity is heard at once, as all of it is without inductance: κ goes to 1 there and to θ²/12 where the
/// current is slow. Drive and sensor share it alike, which keeps responses reciprocal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    /// Index of the port that it leads to.
    pub(super) port: usize,
    /// Impulse (N·s) per unit of drive in one sample.
    pub(super) strike: f64,
    /// What is heard per velocity (m/s) of the port.
    pub(super) felt: f64,
    /// Jump of the coil's current (A) per unit of drive in one sample.
    pub(super) jump: f64,
    /// What is heard per ampere driven by the motion.
    pub(super) driven: f64,
}

impl Lead {
    /// `dt` is the length of a step, in s.
    pub(super) fn of(channel: &Channel, port: usize, rate: f64, dt: f64) -> Self {
        let gain = channel.gain;
        let struck = |share: f64| Self {
            port,
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

    /// Whether any of it goes to the sheet without passing a coil's current.
    pub(super) fn strikes(&self) -> bool {
        self.strike != 0.0
    }

    /// What is heard, in the sensor's unit, from the port's velocity (m/s) and the current that motion drives
    /// through its coil, against the drive's (A).
    #[inline(always)]
    pub(super) fn hears(&self, velocity: f64, driven: f64) -> f64 {
        self.felt * velocity - self.driven * driven
    }
}

/// Share κ of a coil's drive that takes effect at once, from θ = R dt/L.
fn sudden(theta: f64) -> f64 {
    let x = 0.5 * theta;
    // By its series where the difference would cancel.
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
