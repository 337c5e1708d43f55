//! The force with which an actuator pushes a sheet that moves under it.

use super::{Entry, Transducer};
use crate::Load;
use unripple_dsp::Convolver;
use unripple_linalg::c64;

/// Logarithm of the ratio by which signals are damped over their length before they are transformed. What a response longer than twice the
/// signal wraps round to is below e^-18 of it, and rounding grows by e^9. With twice this value, rounding errors would grow to 1e-8.
const DAMPED: f64 = 9.0;

impl Transducer {
    /// Force (N) through the footprint on the sheet and the mass fixed to it, or for a patch the moment per length of its rim (N), at each
    /// sample of a drive, in the drive's unit, and of the velocity (m/s) that the sheet has under the footprint, from rest, at `rate`
    /// samples per second. Its product with that velocity is the power that the actuator gives to the sheet, in W.
    ///
    /// Where coil and housing answer to the motion it is T(s) d - X(s) v, with T the force per unit of drive on a sheet that is held still
    /// and X the impedance [`Load::reaction`]; both are taken at s = σ + jω, on signals damped by e^{-σt}, so that nothing of what rings
    /// longer than the drive comes back at its beginning (Kausel and Roësset, *J. Eng. Mech.* 118, 721, 1992).
    pub fn forces(&self, drive: &[f64], velocity: &[f64], rate: f64) -> Vec<f64> {
        let answers = |load: &&Load| load.circuit.is_some() || load.housing.is_some();
        let Some(load) = self.load.as_ref().filter(answers) else {
            return drive.iter().map(|d| self.gain * d).collect();
        };
        let length = drive.len().min(velocity.len());
        let plan = Convolver::new(2 * length.max(1));
        let decay = DAMPED / length.max(1) as f64;
        let damped = |signal: &[f64]| {
            plan.spectrum(signal[..length].iter().enumerate().map(|(i, x)| x * (-decay * i as f64).exp()))
        };
        let (sent, moved) = (damped(drive), damped(velocity));
        let step = std::f64::consts::TAU / plan.size() as f64;
        let mut force = sent;
        for (k, (d, v)) in force.iter_mut().zip(&moved).enumerate() {
            let s = c64::new(decay * rate, step * k as f64 * rate);
            let pushed =
                self.blocked(load, s) * c64::new(d.re, d.im) - load.reaction(s) * c64::new(v.re, v.im);
            (d.re, d.im) = (pushed.re, pushed.im);
        }
        let signal = plan.signal(force);
        signal.iter().take(length).enumerate().map(|(i, x)| x * (decay * i as f64).exp()).collect()
    }

    /// Force per unit of drive on a sheet that is held still, at the complex frequency `s` (1/s), for this load of the actuator.
    fn blocked(&self, load: &Load, s: c64) -> c64 {
        let force = match (self.entry, load.circuit) {
            (Entry::Force, _) => c64::new(self.gain, 0.0),
            (Entry::Voltage, Some(circuit)) => circuit.admittance(s) * circuit.force_constant,
            (Entry::Voltage, None) => c64::new(0.0, 0.0),
        };
        force * load.transmission(s)
    }
}
