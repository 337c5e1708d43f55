//! Transfer functions of a loaded sheet: velocity per drive at a complex frequency.

use super::Loaded;
use crate::Footprint;
use unripple_linalg::{Lu, Mat, c64};

impl Loaded {
    /// Transfer function of the loaded sheet: velocity (m/s) averaged over the footprint `at` per unit of
    /// drive of the transducer with this index, at the complex frequency `s` (1/s); s = jω for a steady
    /// tone.
    ///
    /// By Woodbury's identity from the admittances Y of the sheet without loads: Y_ba - Y_bL (1 + Z Y_LL)⁻¹ Z Y_La.
    pub fn admittance(&self, transducer: usize, at: &Footprint, s: c64) -> c64 {
        let read = at.weights(self.shapes.as_ref());
        // What of the drive's force reaches a sheet that is held still, past a housing.
        let through =
            self.own[transducer].map_or(c64::new(1.0, 0.0), |load| self.loads[load].transmission(s));
        let source: Vec<c64> = match self.driven_coil(transducer) {
            Some(load) => {
                let force = self.loads[load]
                    .circuit
                    .map_or(c64::new(0.0, 0.0), |circuit| circuit.admittance(s) * circuit.force_constant);
                self.at_loads.row(load).iter().map(|w| force * through * *w).collect()
            }
            None => self.driven.row(transducer).iter().map(|w| through * *w).collect(),
        };
        let mobility = self.mobilities(s);
        let moved: Vec<c64> = source.iter().zip(&mobility).map(|(f, y)| f * y).collect();
        let direct: c64 = read.iter().zip(&moved).map(|(r, v)| v * *r).sum();
        let count = self.loads.len();
        if count == 0 {
            return direct;
        }
        let dot = |j: usize, other: &[c64]| -> c64 {
            self.at_loads.row(j).iter().zip(other).map(|(w, v)| v * *w).sum()
        };
        let answers: Vec<Vec<c64>> = (0..count)
            .map(|k| self.at_loads.row(k).iter().zip(&mobility).map(|(w, y)| y * *w).collect())
            .collect();
        let impedances: Vec<c64> = self.loads.iter().map(|load| load.impedance(s)).collect();
        let system = Mat::from_fn(count, count, |j, k| {
            impedances[j] * dot(j, &answers[k]) + if j == k { 1.0 } else { 0.0 }
        });
        let mut forces = Mat::from_fn(count, 1, |j, _| impedances[j] * dot(j, &moved));
        Lu::new(system.as_ref()).solve(forces.as_mut());
        let back = |k: usize| -> c64 { read.iter().zip(&answers[k]).map(|(r, v)| v * *r).sum() };
        direct - (0..count).map(|k| back(k) * forces[(k, 0)]).sum::<c64>()
    }

    /// Velocity of each mode without loads per unit of modal force: s/(s² + 2σs + ω²).
    fn mobilities(&self, s: c64) -> Vec<c64> {
        self.poles.iter().map(|pole| s / (s * s + s * (2.0 * pole.sigma) + pole.omega * pole.omega)).collect()
    }
}
