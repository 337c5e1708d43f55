//! The coupled equations of a sheet and its loads, including the contribution of modes that are left out
//! (residual flexibility).

use super::basis::Basis;
use super::coil::Coil;
use super::layout::{Layout, Values};
use super::sheet::Sheet;
use crate::CalibrateError;
use unripple_core::Point;
use unripple_linalg::{Mat, Scale, product};
use unripple_physics::{Footprint, Medium};

/// Half the distance of the central difference for slopes of mode shapes, in metres.
const STEP: f64 = 1e-6;

/// Smallest size of a point contact, in metres: without one, a membrane without bending stiffness would have an infinite compliance at
/// a point.
const FINEST: f64 = 1e-4;

/// The modes that are left out, as one equivalent mode at each load (residual flexibility).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rest {
    /// Squared weight of the equivalent mode at the load, in 1/kg.
    pub weight: f64,
    /// Squared angular frequency of the equivalent mode, in (rad/s)².
    pub square: f64,
    /// Share of bending in the equivalent mode's elastic energy, 0 to 1.
    pub bending_share: f64,
}

/// A sheet with loads on it: actuators and stray masses.
#[derive(Clone, Debug)]
pub(super) struct System {
    /// The sheet without loads, for the values of the unknowns.
    pub sheet: Sheet,
    /// The unknowns of the fit, and their order in the vector of unknowns.
    pub layout: Layout,
    /// Mode shapes at the places of actuators, of stray masses, then of taps: modes x places.
    pub shapes: Mat<f64>,
    /// Slopes of the shapes along x and y at actuators and stray masses, each modes x loads.
    pub slopes: [Mat<f64>; 2],
    /// Residual flexibility: all modes that are left out, as one equivalent mode at each load.
    pub rest: Rest,
    /// Mass at each actuator and stray mass, in kg.
    pub masses: Vec<f64>,
    /// Damping to the ground at each actuator and stray mass, in N·s/m.
    pub resistances: Vec<f64>,
    /// Coil of each actuator whose force depends on frequency; `None` for all other actuators and for stray
    /// masses.
    pub coils: Vec<Option<Coil>>,
    /// Highest frequency of the band, in Hz.
    pub top: f64,
    /// Ratio of the tension to its nominal value, dimensionless.
    pub ratio: f64,
}

impl System {
    /// The coupled equations of the sheet and its loads for `values` of the unknowns, from the first `count`
    /// modes of the nominal sheet. Its motion can be read at the places `taps`, where the sheet was tapped;
    /// `top` is the top of the band in Hz.
    pub fn new(
        basis: &Basis,
        layout: &Layout,
        values: &Values,
        taps: &[Point],
        (count, top): (usize, f64),
    ) -> Result<Self, CalibrateError> {
        let sheet = Sheet::new(basis, values, count, top)?;
        let read = |footprints: &[Footprint]| {
            let all = Footprint::all_weights(footprints, basis.modes.as_ref());
            product(sheet.turn.transpose(), all.subcols(0, count).transpose())
        };
        let touching = |d: Point| -> Vec<Footprint> {
            let places = values.places.iter().enumerate();
            places.map(|(n, p)| basis.footprint(n, Point::new(p.x + d.x, p.y + d.y))).collect()
        };
        let mut all = touching(Point::new(0.0, 0.0));
        all.extend(taps.iter().map(|at| Footprint::point(*at)));
        let shapes = read(&all);
        let slopes = [Point::new(STEP, 0.0), Point::new(0.0, STEP)].map(|d| {
            let back = Point::new(-d.x, -d.y);
            (read(&touching(d)) - read(&touching(back))) * Scale(0.5 / STEP)
        });
        let medium = Medium {
            tension: basis.medium.tension * values.tension.exp(),
            bending_stiffness: basis.medium.bending_stiffness * values.bending.exp(),
            air_sides: 0.0,
            ..basis.medium
        };
        let highest = sheet.squares.last().copied().unwrap_or(0.0).max(1.0).sqrt();
        Ok(Self {
            rest: Rest::above(&medium, medium.wavenumber(highest)),
            sheet,
            layout: layout.clone(),
            shapes,
            slopes,
            masses: values.masses.clone(),
            resistances: values.resistances.clone(),
            coils: (0..layout.loaded()).map(|n| basis.coil(n).cloned()).collect(),
            top,
            ratio: values.tension.exp(),
        })
    }

    /// Number of places in the equations: actuators, stray masses and taps.
    pub fn places(&self) -> usize {
        self.shapes.ncols()
    }
}

impl Rest {
    /// Response of an infinite sheet, with wavenumbers above `k` (rad/m) only, to a force at a point: compliance C₀ = 1/4π ∫ du/(u(R +
    /// Du)) and inertia C₁ = ρ/4π ∫ du/(u(R + Du))², u from k² on. One mode of weight² C₀²/C₁ and frequency² C₀/C₁ has both. Bending
    /// contributes 1/4π ∫ D du/(R + Du)² to the energy of C₀.
    fn above(medium: &Medium, k: f64) -> Self {
        let (tension, bending) = (medium.tension, medium.bending_stiffness);
        let (start, end) = (k * k, (1.0 / FINEST).powi(2).max(100.0 * k * k));
        // With the substitution u = k²/t the integrands are smooth down to the end.
        let last = start / end;
        let line = Footprint::line(Point::new(last, 0.0), Point::new(1.0, 0.0), 24);
        let stiffness = |t: f64| tension * t + bending * start;
        let sum =
            |f: &dyn Fn(f64) -> f64| (1.0 - last) * line.points.iter().map(|(p, w)| w * f(p.x)).sum::<f64>();
        let quarter = 1.0 / (4.0 * std::f64::consts::PI);
        let compliance = quarter * sum(&|t| 1.0 / stiffness(t));
        let inertia = quarter * medium.areal_density / start * sum(&|t| (t / stiffness(t)).powi(2));
        let bent = quarter * sum(&|t| bending * start / stiffness(t).powi(2));
        Self {
            weight: compliance * compliance / inertia,
            square: compliance / inertia,
            bending_share: bent / compliance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_has_the_compliance_of_the_closed_form() {
        let medium =
            Medium { areal_density: 0.175, tension: 200.0, bending_stiffness: 7.15e-4, air_sides: 0.0 };
        let k = 500.0;
        let rest = Rest::above(&medium, k);
        let closed = (1.0 + 200.0 / (7.15e-4 * k * k)).ln() / (4.0 * std::f64::consts::PI * 200.0);
        // The closed form goes on beyond the finest size.
        assert!((rest.weight / rest.square / closed - 1.0).abs() < 0.01, "{rest:?} {closed}");
        let bent = 1.0 / (200.0 + 7.15e-4 * k * k) / (4.0 * std::f64::consts::PI);
        assert!((rest.bending_share / (bent / closed) - 1.0).abs() < 0.01, "{rest:?} {bent}");
    }
}
