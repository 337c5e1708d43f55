//! Unknown point masses, sought by trial at every place.

use super::forward::Answer;
use super::layout::Unknown;
use super::residual::Case;
use super::solve::{Found, solve};
use crate::CalibrateError;
use unripple_core::{Outline, Point};
use unripple_linalg::{Mat, Scale, product};

/// Masses that are tried at every place, in kg. A factor of three apart, so that the derivative at the
/// nearest of them leads to the mass sought.
const TRIED: [f64; 3] = [3e-6, 10e-6, 30e-6];

/// Places that are tried per shortest wavelength of the fitted band. Half as many may miss a mass between two places;
/// twice as many take four times as long.
const DENSE: f64 = 6.0;

/// Places worked on at once, which bounds memory: places x responses x frequencies.
const BATCH: usize = 128;

impl Case<'_> {
    /// Place and mass (kg) of the point mass that would explain most of the residual; `None` if none explains enough.
    ///
    /// A mass μ at x changes every response by -z Y_ix Y_xj, z = sμ/(1 + sμ Y_xx). The part of this change that the other
    /// unknowns could explain is removed first.
    pub fn stray(&self, found: &Found, outline: &Outline) -> Result<Option<(Point, f64)>, CalibrateError> {
        let places = self.grid(outline);
        let system = self.system(&found.values)?;
        let excess = found.excess.max(1.0);
        let none = vec![0.0; found.residual.slopes.ncols()];
        let (normal, _) = self.normal(&found.residual, &none, excess);
        let slopes = &found.residual.slopes;
        let left = Mat::from_fn(found.residual.values.len(), 1, |i, _| found.residual.values[i]);
        let mut best: Option<(f64, Point, f64)> = None;
        for batch in places.chunks(BATCH) {
            let looks = system.looks(self.basis, batch, &self.spectra.frequencies);
            for mass in TRIED {
                let answers: Vec<Answer> = looks.iter().map(|look| look.with(mass)).collect();
                let signatures = self.columns(&found.values, &answers, &vec![Unknown::Mass(0); batch.len()]);
                let known = product(slopes.transpose(), signatures.as_ref()) * Scale(1.0 / excess.powi(2));
                let explained = product(slopes.as_ref(), solve(&normal, &known, 0.0)?.as_ref());
                let along = product(signatures.transpose(), left.as_ref());
                for (n, place) in batch.iter().enumerate() {
                    let column = signatures.col(n);
                    let own: f64 = column.iter().zip(explained.col(n).iter()).map(|(v, e)| v * (v - e)).sum();
                    // The residual is model less measurement, so that a mass has to bring it down.
                    let drop = if along[(n, 0)] < 0.0 {
                        along[(n, 0)].powi(2) / own.max(f64::MIN_POSITIVE)
                    } else {
                        0.0
                    };
                    // The linear estimate holds only near the mass that was tried.
                    let strength = (-along[(n, 0)] / own.max(f64::MIN_POSITIVE)).clamp(0.1, 3.0);
                    if drop.is_finite() && best.is_none_or(|(most, ..)| drop > most) {
                        best = Some((drop, *place, mass * strength));
                    }
                }
            }
        }
        Ok(best.filter(|(drop, ..)| *drop > 10.0 * excess.powi(2)).map(|(_, at, mass)| (at, mass)))
    }

    fn grid(&self, outline: &Outline) -> Vec<Point> {
        let top = self.spectra.frequencies.last().map_or(1.0, |s| s.im);
        let pitch = std::f64::consts::TAU / self.basis.medium.wavenumber(top) / DENSE;
        let (width, height) = outline.extent();
        let count = |side: f64| ((side / pitch).ceil() as usize).clamp(4, 60);
        let (columns, rows) = (count(width), count(height));
        (0..columns * rows)
            .map(|n| ((n % columns) as f64 + 0.5, (n / columns) as f64 + 0.5))
            .map(|(x, y)| Point::new(x * width / columns as f64, y * height / rows as f64))
            .filter(|p| outline.contains(*p))
            .collect()
    }
}
