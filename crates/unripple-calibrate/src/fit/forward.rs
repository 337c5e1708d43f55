//! The forward model: responses between places at complex frequencies, with derivatives by the unknowns.

use super::basis::Basis;
use super::layout::{Unknown, around};
use super::system::System;
use rayon::prelude::*;
use std::f64::consts::TAU;
use unripple_core::Shapes;
use unripple_linalg::{Accum, Lu, Mat, MatRef, Par, c64, multiply, product};

/// Number of frequencies in one task of the thread pool: enough to outweigh its set-up, few enough that no
/// thread waits long for another at the end.
const CHUNK: usize = 8;

/// The admittance (velocity at every place per force at every place, places x places, in m/s/N) at one complex
/// frequency, with its derivatives by the unknowns.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    /// The admittance, places x places, in m/s/N.
    pub admittance: Mat<c64>,
    /// Derivatives of the admittance by each unknown on which the sheet's responses depend, in the order of
    /// `Layout::unknowns`.
    pub derivatives: Vec<Mat<c64>>,
}

/// Intermediate results at one frequency.
pub(super) struct Point {
    /// The complex frequency, 1/s.
    pub s: c64,
    /// Modal velocities of the sheet alone, modes x places.
    pub free: Mat<c64>,
    /// Modal velocities under loads, modes x places.
    pub moved: Mat<c64>,
    /// (1 + Z Y₀)⁻¹, with Z the impedance of the loads and Y₀ the admittance of the sheet alone.
    pub shared: Mat<c64>,
    /// The admittance, places x places.
    pub admittance: Mat<c64>,
}

/// Admittances at one frequency of candidate places for a point mass: between them and the other places, and of each at itself.
#[derive(Clone, Debug)]
pub(super) struct Look {
    s: c64,
    admittance: Mat<c64>,
    /// Admittances between candidates and places, candidates x places.
    between: Mat<c64>,
    /// Admittance of each candidate at its own place.
    own: Vec<c64>,
}

impl Look {
    /// The admittance, with its changes by a mass (kg) at each candidate place in the field `derivatives`.
    pub fn with(&self, mass: f64) -> Answer {
        let places = self.admittance.nrows();
        let change = |c: usize| {
            let z = self.s * mass / (self.s * mass * self.own[c] + 1.0);
            Mat::from_fn(places, places, |p, q| -z * self.between[(c, p)] * self.between[(c, q)])
        };
        Answer { admittance: self.admittance.clone(), derivatives: (0..self.own.len()).map(change).collect() }
    }
}

impl System {
    /// For each of the complex `frequencies` (1/s): the driving-point admittance at each candidate place for a point mass, and the
    /// transfer admittances between the candidates and the places of actuators and taps.
    pub fn looks(
        &self,
        basis: &Basis,
        candidates: &[unripple_core::Point],
        frequencies: &[c64],
    ) -> Vec<Look> {
        let count = self.sheet.squares.len();
        let shapes = basis.modes.at_all(candidates);
        let shapes = product(self.sheet.turn.transpose(), shapes.subcols(0, count).transpose());
        let look = |s: &c64| {
            let point = self.point(*s);
            let own = |c: usize| {
                let modes = self.sheet.squares.iter().zip(&self.sheet.sigmas).enumerate();
                let sum: c64 = modes
                    .map(|(m, (square, sigma))| {
                        *s / (s * s + s * (2.0 * sigma) + *square) * shapes[(m, c)].powi(2)
                    })
                    .sum();
                sum + self.compliance(*s)
            };
            Look {
                s: *s,
                between: transposed_real(&shapes, &point.moved),
                own: (0..candidates.len()).map(own).collect(),
                admittance: point.admittance,
            }
        };
        frequencies.par_iter().map(look).collect()
    }

    /// Driving-point admittance (m/s/N) of all modes that are left out.
    fn compliance(&self, s: c64) -> c64 {
        let sigma = self.sheet.sigmas.last().copied().unwrap_or(0.0);
        s * self.rest.weight / (s * s + s * (2.0 * sigma) + self.rest.square)
    }

    /// The admittances at complex frequencies (1/s).
    ///
    /// With Y₀ the admittance of the sheet alone and Z the impedance of the loads, Y = Y₀ G, G = (1 + Z Y₀)⁻¹ (Woodbury).
    pub fn admittances(&self, frequencies: &[c64]) -> Vec<Mat<c64>> {
        frequencies.par_iter().map(|s| self.point(*s).admittance).collect()
    }

    /// The admittances at complex frequencies (1/s) with derivatives by the unknowns, in SI.
    ///
    /// From dY = Gᵀ dY₀ G - Y dZ Y and dY₀ = -(1/s) Xᵀ dK X, X the modal velocities.
    pub fn answers(&self, basis: &Basis, frequencies: &[c64]) -> Vec<Answer> {
        let stiffnesses = self.stiffnesses(basis);
        frequencies
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| {
                let points: Vec<Point> = chunk.iter().map(|s| self.point(*s)).collect();
                let bent = self.stiffened(&points, &stiffnesses);
                points.into_iter().zip(bent).map(|(point, bent)| self.answer(point, bent)).collect::<Vec<_>>()
            })
            .collect()
    }

    /// Derivatives of the stiffness by each unknown that changes it: a matrix, nominal modes x nominal modes, and a factor.
    pub(super) fn stiffnesses<'a>(&'a self, basis: &'a Basis) -> Vec<(MatRef<'a, f64>, f64)> {
        let count = self.sheet.squares.len();
        let mut all = vec![(self.sheet.tension.as_ref(), 1.0), (self.sheet.bending.as_ref(), 1.0)];
        let rest = std::iter::once(&basis.skew).chain(&basis.terms);
        all.extend(rest.map(|matrix| (matrix.as_ref().submatrix(0, 0, count, count), self.ratio)));
        all
    }

    /// Velocity of each mode per modal force at a complex frequency (1/s), in s.
    pub(super) fn mobility(&self, s: c64) -> Vec<c64> {
        let modes = self.sheet.squares.iter().zip(&self.sheet.sigmas);
        modes.map(|(square, sigma)| s / (s * s + s * (2.0 * sigma) + *square)).collect()
    }

    /// Impedance (N·s/m) of the load at a place at a complex frequency (1/s).
    pub(super) fn impedance(&self, place: usize, s: c64) -> c64 {
        let added = self.coils[place].as_ref().map_or(c64::new(0.0, 0.0), |coil| coil.added(s));
        s * self.masses[place] + self.resistances[place] + added
    }

    /// Intermediate results at a complex frequency (1/s).
    pub(super) fn point(&self, s: c64) -> Point {
        let (modes, places, loaded) = (self.shapes.nrows(), self.places(), self.layout.loaded());
        let mobility = self.mobility(s);
        let free = Mat::from_fn(modes, places, |m, p| mobility[m] * self.shapes[(m, p)]);
        let mut alone = transposed_real(&self.shapes, &free);
        let rest = self.compliance(s);
        (0..loaded).for_each(|p| alone[(p, p)] += rest);
        let mut system = Mat::<c64>::identity(places, places);
        for p in 0..loaded {
            let impedance = self.impedance(p, s);
            (0..places).for_each(|q| system[(p, q)] += impedance * alone[(p, q)]);
        }
        let shared = Lu::new(system.as_ref()).inverse();
        let moved = product(free.as_ref(), shared.as_ref());
        Point { s, moved, admittance: product(alone.as_ref(), shared.as_ref()), shared, free }
    }

    /// Derivatives of the admittance by each unknown that changes the stiffness, `[frequency][unknown]`.
    fn stiffened(&self, points: &[Point], stiffnesses: &[(MatRef<'_, f64>, f64)]) -> Vec<Vec<Mat<c64>>> {
        let (modes, places) = (self.shapes.nrows(), self.places());
        let block = |i: usize| (2 * i * places, (2 * i + 1) * places);
        let mut moved = Mat::<f64>::zeros(modes, 2 * places * points.len());
        for (i, point) in points.iter().enumerate() {
            let (re, im) = block(i);
            for p in 0..places {
                for m in 0..modes {
                    let x = point.moved[(m, p)];
                    (moved[(m, re + p)], moved[(m, im + p)]) = (x.re, x.im);
                }
            }
        }
        let mut nominal = Mat::<f64>::zeros(modes, moved.ncols());
        multiply_alone(&mut nominal, self.sheet.turn.as_ref(), moved.as_ref());
        let mut forces = Mat::<f64>::zeros(modes, moved.ncols());
        let mut found = vec![Vec::new(); points.len()];
        for (stiffness, scale) in stiffnesses {
            multiply_alone(&mut forces, *stiffness, nominal.as_ref());
            for (i, point) in points.iter().enumerate() {
                let (re, im) = block(i);
                let part = |m: &Mat<f64>, from: usize| m.subcols(from, places).to_owned();
                let (a, b, f, g) =
                    (part(&nominal, re), part(&nominal, im), part(&forces, re), part(&forces, im));
                let meet = |a: &Mat<f64>, b: &Mat<f64>| product(a.transpose(), b.as_ref());
                let (real, imaginary) = (meet(&a, &f) - meet(&b, &g), meet(&a, &g) + meet(&b, &f));
                let factor = -point.s.inv() * *scale;
                found[i].push(Mat::from_fn(places, places, |p, q| {
                    factor * c64::new(real[(p, q)], imaginary[(p, q)])
                }));
            }
        }
        found
    }

    fn answer(&self, point: Point, mut derivatives: Vec<Mat<c64>>) -> Answer {
        for unknown in self.layout.unknowns() {
            match unknown {
                Unknown::Knot(_) => {
                    derivatives.extend(if unknown == Unknown::Knot(0) {
                        self.damped(&point)
                    } else {
                        Vec::new()
                    });
                }
                Unknown::Place(place, axis) => derivatives.push(self.displaced(&point, place, axis)),
                Unknown::Mass(place) => derivatives.push(outer(&point.admittance, place, -point.s)),
                Unknown::Resistance(place) => {
                    derivatives.push(outer(&point.admittance, place, c64::new(-1.0, 0.0)));
                }
                _ => {}
            }
        }
        Answer { admittance: point.admittance, derivatives }
    }

    /// Derivatives of the admittance by the logarithms of the decay rates at the knots: d(mobility)/dσ = -2 mobility².
    fn damped(&self, point: &Point) -> Vec<Mat<c64>> {
        let places = self.places();
        let mut all = vec![Mat::<c64>::zeros(places, places); super::layout::KNOTS.len()];
        for (m, square) in self.sheet.squares.iter().enumerate() {
            let sigma = self.sheet.sigmas[m];
            for (knot, weight) in around(square.max(0.0).sqrt() / (TAU * self.top)) {
                if weight == 0.0 {
                    continue;
                }
                for q in 0..places {
                    let right = point.moved[(m, q)] * (-2.0 * sigma * weight);
                    (0..places).for_each(|p| all[knot][(p, q)] += point.moved[(m, p)] * right);
                }
            }
        }
        all
    }

    /// Derivative of the admittance by the coordinate of a place along an axis (0 for x, 1 for y).
    fn displaced(&self, point: &Point, place: usize, axis: usize) -> Mat<c64> {
        let (modes, places) = (self.shapes.nrows(), self.places());
        let slope = self.slopes[axis].col(place);
        // Slope of the loaded sheet's velocity at the place along the axis.
        let felt: Vec<c64> =
            (0..places).map(|q| (0..modes).map(|m| point.moved[(m, q)] * slope[m]).sum()).collect();
        let shared: Vec<c64> = (0..places).map(|q| point.shared[(place, q)]).collect();
        Mat::from_fn(places, places, |p, q| shared[p] * felt[q] + felt[p] * shared[q])
    }
}

/// factor · Y e eᵀ Y, e picking a place.
fn outer(admittance: &Mat<c64>, place: usize, factor: c64) -> Mat<c64> {
    let places = admittance.nrows();
    Mat::from_fn(places, places, |p, q| factor * admittance[(p, place)] * admittance[(place, q)])
}

/// Aᵀ B of a real and a complex matrix.
fn transposed_real(a: &Mat<f64>, b: &Mat<c64>) -> Mat<c64> {
    Mat::from_fn(a.ncols(), b.ncols(), |i, j| a.col(i).iter().zip(b.col(j).iter()).map(|(x, y)| y * *x).sum())
}

/// Matrix product on one thread, since frequencies already run in parallel.
pub(super) fn multiply_alone(out: &mut Mat<f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    multiply(out.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
}
