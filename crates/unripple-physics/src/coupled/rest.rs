//! Residual flexibility: the response at the loads of the modes above those computed.

use super::remainder::{Profile, Remainder};
use crate::{Footprint, Load, Medium};
use std::sync::Arc;
use unripple_core::{Point, Pole, Shapes};
use unripple_linalg::{Mat, product, symmetric};

/// A combination of deflections whose inertia is less than this share of the largest counts as linearly
/// dependent on the others. Larger, contacts that lie close to each other would count as one.
const ALIKE: f64 = 1e-9;

/// Modes, followed by a few added modes that stand for the residual flexibility of all higher modes at the loads.
///
/// Modes above some wavenumber K respond to a load as those of an infinite sheet do: their sum Σ φ_m φ_m(load)/ω_m² is the part of
/// the infinite sheet's static deflection under the load that has wavenumbers above K ([`Remainder`]). These deflections, one per
/// load, have the stiffness and the mass of the infinite sheet; the modes of this small system are the added modes.
/// They are exact at low frequency, with an error of about (ω/ω_K)⁴ of a small part at others. Within half a wavelength 2π/K of a
/// rim, the infinite sheet is a poor approximation.
#[derive(Debug)]
pub(super) struct WithRest {
    base: Arc<dyn Shapes>,
    places: Vec<(Point, Arc<Profile>)>,
    /// Combinations of the deflections under the loads, loads x added modes.
    mixing: Mat<f64>,
}

impl WithRest {
    /// Appends the poles of the added modes to `poles` (those of `base`), and returns the shapes of all
    /// modes; `None` if none are added. `decay` gives the decay rate (1/s) of an added mode from its frequency (rad/s) and wavenumber
    /// (rad/m).
    pub fn add(
        base: Arc<dyn Shapes>,
        poles: &mut Vec<Pole>,
        loads: &[Load],
        remainder: &Remainder,
        decay: impl Fn(f64, f64) -> f64,
    ) -> Option<Self> {
        let contacts: Vec<(Point, f64)> =
            loads.iter().map(|load| contact(&load.footprint, remainder.finest)).collect();
        let mutual = |power: i32| {
            Mat::from_fn(contacts.len(), contacts.len(), |i, j| {
                let ((a, first), (b, second)) = (contacts[i], contacts[j]);
                remainder.sum(a.distance(b), [first, second], power)
            })
        };
        let (squares, mixing) = pencil(&mutual(1), &mutual(2))?;
        for square in &squares {
            let omega = square.sqrt();
            let medium = Medium { air_sides: 0.0, ..remainder.medium };
            poles.push(Pole::new(omega, decay(omega, medium.wavenumber(omega))));
        }
        let mut profiles: Vec<(f64, Arc<Profile>)> = Vec::new();
        let places = contacts
            .iter()
            .map(|(at, radius)| {
                // Contacts of one size share a profile.
                let known = profiles.iter().find(|(r, _)| (r / radius - 1.0).abs() < 1e-9);
                let profile = known.map_or_else(|| Arc::new(remainder.profile(*radius)), |(_, p)| p.clone());
                profiles.push((*radius, profile.clone()));
                (*at, profile)
            })
            .collect();
        Some(Self { base, places, mixing })
    }

    /// The shapes of the added modes alone.
    pub fn added(&self) -> Added<'_> {
        Added(self)
    }

    fn rest(&self, point: Point, row: &mut [f64]) {
        row.fill(0.0);
        for (j, (at, profile)) in self.places.iter().enumerate() {
            let deflection = profile.at(at.distance(point));
            row.iter_mut().enumerate().for_each(|(m, w)| *w += deflection * self.mixing[(j, m)]);
        }
    }
}

/// The added modes without those of the sheet.
#[derive(Debug)]
pub(super) struct Added<'a>(&'a WithRest);

impl Shapes for Added<'_> {
    fn modes(&self) -> usize {
        self.0.mixing.ncols()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        self.0.rest(point, row);
    }
}

impl Shapes for WithRest {
    fn modes(&self) -> usize {
        self.base.modes() + self.mixing.ncols()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let (base, rest) = row.split_at_mut(self.base.modes());
        self.base.at(point, base);
        self.rest(point, rest);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let base = self.base.at_all(points);
        let (known, added) = (base.ncols(), self.mixing.ncols());
        let mut all = Mat::zeros(points.len(), known + added);
        all.as_mut().subcols_mut(0, known).copy_from(&base);
        let mut row = vec![0.0; added];
        for (p, point) in points.iter().enumerate() {
            self.rest(*point, &mut row);
            row.iter().enumerate().for_each(|(m, w)| all[(p, known + m)] = *w);
        }
        all
    }
}

/// Centre of a contact, and the radius of the uniform disc with the same mean square distance from the
/// centre, at least `finest`.
fn contact(footprint: &Footprint, finest: f64) -> (Point, f64) {
    let sum = |f: &dyn Fn(Point) -> f64| footprint.points.iter().map(|(p, w)| w * f(*p)).sum::<f64>();
    let centre = Point::new(sum(&|p| p.x), sum(&|p| p.y));
    let spread = sum(&|p| p.distance(centre).powi(2));
    (centre, (2.0 * spread.max(0.0)).sqrt().max(finest))
}

/// Squared frequencies and mass-normalised modes of a generalised eigenvalue problem with a stiffness and a
/// mass matrix.
fn pencil(stiffness: &Mat<f64>, mass: &Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let (values, vectors) = symmetric(mass.as_ref())?;
    let most = values.iter().copied().fold(0.0, f64::max);
    let kept: Vec<usize> = (0..values.len()).filter(|i| values[*i] > ALIKE * most).collect();
    let normal =
        Mat::from_fn(mass.nrows(), kept.len(), |j, i| vectors[(j, kept[i])] / values[kept[i]].sqrt());
    let half = product(normal.transpose(), stiffness.as_ref());
    let reduced = product(half.as_ref(), normal.as_ref());
    let (squares, modes) = symmetric(reduced.as_ref())?;
    squares
        .iter()
        .all(|square| *square > 0.0 && square.is_finite())
        .then(|| (squares, product(normal.as_ref(), modes.as_ref())))
}
