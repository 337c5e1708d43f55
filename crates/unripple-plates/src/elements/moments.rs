//! Integrals of monomials times the sheet's mass, tension and stiffness, and the bilinear forms computed from them.

use super::monomials::{COUNT, EXPONENTS, Frame, HIGHEST};
use crate::fabric::Local;
use unripple_core::Point;

/// Integrals of x^a y^b over a triangle, entry [a][b], in the triangle's own coordinates.
type Table = [[f64; POWERS]; POWERS];

/// Number of powers that products of two polynomials of the highest degree have, from 0 to 14.
const POWERS: usize = 2 * HIGHEST + 1;

/// A symmetric bilinear form on monomials, with an entry for each pair.
pub(crate) type Form = [[f64; COUNT]; COUNT];

/// The integrals over one triangle from which its mass, tension and bending forms follow: of mass per area, tension and D11,
/// D12, D16, D22, D26, D66 times monomials.
#[derive(Clone, Debug)]
pub(crate) struct Moments {
    scale: f64,
    /// Number of monomials of the forms.
    count: usize,
    /// Degrees of products of two monomials of the forms, of their gradients and of their second
    /// derivatives.
    degrees: [usize; 3],
    mass: Table,
    tension: Table,
    bending: [Table; 6],
}

impl Moments {
    /// Integrals of zero, for polynomials of `count` monomials.
    pub(crate) fn new(frame: &Frame, count: usize) -> Self {
        let none = [[0.0; POWERS]; POWERS];
        let [i, j] = EXPONENTS[count.clamp(1, COUNT) - 1];
        let degrees = [0, 2, 4].map(|less| (2 * (i + j)).saturating_sub(less));
        Self { scale: frame.scale, count, degrees, mass: none, tension: none, bending: [none; 6] }
    }

    /// Adds the integrals over points (m) with weights (m²), for a uniform sheet.
    pub(crate) fn add_even(&mut self, frame: &Frame, points: &[(Point, f64)], sheet: &Local) {
        let mut plain = [[0.0; POWERS]; POWERS];
        for (p, w) in points {
            accumulate(&mut plain, &powers(frame.local(*p)), *w, self.degrees[0]);
        }
        add(&mut self.mass, &plain, sheet.mass);
        add(&mut self.tension, &plain, sheet.tension);
        self.bending.iter_mut().zip(sheet.bending).for_each(|(table, d)| add(table, &plain, d));
    }

    /// Adds the integrals over points (m) with weights (m²), for a sheet that varies.
    pub(crate) fn add_varying(
        &mut self,
        frame: &Frame,
        points: &[(Point, f64)],
        sheet: impl Fn(Point) -> Local,
    ) {
        for (p, w) in points {
            let (local, powers) = (sheet(*p), powers(frame.local(*p)));
            accumulate(&mut self.mass, &powers, w * local.mass, self.degrees[0]);
            accumulate(&mut self.tension, &powers, w * local.tension, self.degrees[1]);
            for (table, d) in self.bending.iter_mut().zip(local.bending).filter(|(_, d)| *d != 0.0) {
                accumulate(table, &powers, w * d, self.degrees[2]);
            }
        }
    }

    /// The form of kinetic energy, ∫ρ_s u v, in kg.
    pub(crate) fn mass(&self) -> Form {
        self.form(|[a, b], [c, d]| self.mass[a + c][b + d])
    }

    /// The form of tension, ∫T ∇u·∇v, in J/m².
    pub(crate) fn tension(&self) -> Form {
        let unit = self.scale.powi(-2);
        let table = &self.tension;
        self.form(|[a, b], [c, d]| {
            let x = if a * c > 0 { (a * c) as f64 * table[a + c - 2][b + d] } else { 0.0 };
            let y = if b * d > 0 { (b * d) as f64 * table[a + c][b + d - 2] } else { 0.0 };
            unit * (x + y)
        })
    }

    /// The form of bending, ∫κᵀ D κ with κ = (u_xx, u_yy, 2u_xy), in J/m².
    pub(crate) fn bending(&self) -> Form {
        let unit = self.scale.powi(-4);
        let curvatures = EXPONENTS.map(curvatures);
        let mut all = [[0.0; COUNT]; COUNT];
        for (p, left) in curvatures.iter().enumerate().take(self.count) {
            for (q, right) in curvatures.iter().enumerate().take(p + 1) {
                let mut sum = 0.0;
                for (i, (f, [a, b])) in left.iter().enumerate().filter(|(_, (f, _))| *f != 0.0) {
                    for (j, (g, [c, d])) in right.iter().enumerate().filter(|(_, (g, _))| *g != 0.0) {
                        sum += f * g * self.bending[ENTRY[i][j]][a + c][b + d];
                    }
                }
                (all[p][q], all[q][p]) = (unit * sum, unit * sum);
            }
        }
        all
    }

    /// A symmetric form on monomials, computed entry by entry from their exponents.
    fn form(&self, entry: impl Fn([usize; 2], [usize; 2]) -> f64) -> Form {
        let mut all = [[0.0; COUNT]; COUNT];
        for p in 0..self.count {
            for q in 0..=p {
                let value = entry(EXPONENTS[p], EXPONENTS[q]);
                (all[p][q], all[q][p]) = (value, value);
            }
        }
        all
    }
}

/// Index among D11, D12, D16, D22, D26, D66 of the stiffness between two curvatures: Voigt's order of a
/// symmetric matrix.
const ENTRY: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// The factors and exponents of u_xx, u_yy and 2u_xy, where u is a monomial with the given exponents.
fn curvatures([a, b]: [usize; 2]) -> [(f64, [usize; 2]); 3] {
    let less = |x: usize, by: usize| x.saturating_sub(by);
    [
        ((a * less(a, 1)) as f64, [less(a, 2), b]),
        ((b * less(b, 1)) as f64, [a, less(b, 2)]),
        (2.0 * (a * b) as f64, [less(a, 1), less(b, 1)]),
    ]
}

/// Powers 0 to 14 of both coordinates.
fn powers([x, y]: [f64; 2]) -> [[f64; POWERS]; 2] {
    let rise = |x: f64| {
        let mut p = [1.0; POWERS];
        for i in 1..POWERS {
            p[i] = p[i - 1] * x;
        }
        p
    };
    [rise(x), rise(y)]
}

fn accumulate(table: &mut Table, [px, py]: &[[f64; POWERS]; 2], weight: f64, degree: usize) {
    for (a, row) in table.iter_mut().enumerate().take(degree + 1) {
        let weight = weight * px[a];
        row[..=degree - a].iter_mut().zip(py).for_each(|(sum, p)| *sum += weight * p);
    }
}

fn add(table: &mut Table, other: &Table, factor: f64) {
    for (row, other) in table.iter_mut().zip(other) {
        row.iter_mut().zip(other).for_each(|(sum, v)| *sum += factor * v);
    }
}
