//! Quadrature over triangles with curved edges.
//!
//! A region is the signed sum of the cones from an apex a to the pieces γ(s) of its border: x = a + r (γ(s) - a), r and s from
//! 0 to 1, dA = r (γ - a) x γ' dr ds. The integral of a polynomial does not depend on the apex. With Gauss-Legendre quadrature in r
//! and s it is exact for straight borders and converges spectrally for curves.

use super::border::Border;
use super::monomials::{HIGHEST, QUINTIC};
use crate::modes::gauss;
use unripple_core::Point;

/// Quadrature rules for triangles, chosen by the number of monomials of their polynomials.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    quintic: Rule,
    higher: Rule,
    /// The rule for functions with jumps of curvature, applied on either side of a jump.
    pub(crate) across: Rule,
}

/// Numbers of points of the rule on either side of a jump: along rays and straight borders, and along
/// curves. Exact to degree 22, the degree of the products of the highest functions in the mass matrix.
const ACROSS: [usize; 2] = [12, 16];

/// Gauss-Legendre rules on [0, 1]: along a cone's rays, along straight borders and along curves.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    radial: Vec<(f64, f64)>,
    straight: Vec<(f64, f64)>,
    curved: Vec<(f64, f64)>,
}

impl Rules {
    /// Rules for products of two polynomials; if `varying`, also for such products times coefficients that
    /// vary over the sheet.
    pub(crate) fn new(varying: bool) -> Self {
        let more = if varying { 3 } else { 0 };
        Self {
            quintic: Rule::new(6 + more, 12 + more),
            higher: Rule::new(HIGHEST + 1 + more, 14 + more),
            across: Rule::new(ACROSS[0], ACROSS[1]),
        }
    }

    /// The rule for polynomials with a given number of monomials.
    pub(crate) fn of(&self, monomials: usize) -> &Rule {
        if monomials <= QUINTIC { &self.quintic } else { &self.higher }
    }
}

impl Rule {
    /// A rule with `plain` points along rays and straight borders, and `curved` points along curves.
    fn new(plain: usize, curved: usize) -> Self {
        let rule = |count| gauss(count).into_iter().map(|(x, w)| (0.5 * (1.0 + x), 0.5 * w)).collect();
        Self { radial: rule(plain), straight: rule(plain), curved: rule(curved) }
    }

    /// Quadrature points and weights (m²) over a triangle. Weights are positive if the triangle is
    /// star-shaped with respect to the vertex opposite its only curved edge, or, with several curved edges,
    /// to the mean of its vertices.
    pub(crate) fn triangle(&self, borders: &[Border; 3]) -> Vec<(Point, f64)> {
        let curved: Vec<usize> = (0..3).filter(|i| !borders[*i].is_straight()).collect();
        let mut points = Vec::new();
        match curved[..] {
            [] => self.cone(borders[2].at(0.0), &borders[0], &mut points),
            [i] => self.cone(borders[(i + 2) % 3].at(0.0), &borders[i], &mut points),
            _ => self.region(borders, &mut points),
        }
        points
    }

    /// Adds quadrature points (m) and weights (m²) over the region enclosed by borders, which have the
    /// region to their left.
    pub(crate) fn region(&self, borders: &[Border], points: &mut Vec<(Point, f64)>) {
        let share = 1.0 / borders.len().max(1) as f64;
        let mean = |f: fn(Point) -> f64| borders.iter().map(|b| share * f(b.at(0.0))).sum();
        let apex = Point::new(mean(|p| p.x), mean(|p| p.y));
        borders.iter().for_each(|border| self.cone(apex, border, points));
    }

    /// Adds quadrature points and signed weights of the cone from an apex to a border.
    fn cone(&self, apex: Point, border: &Border, points: &mut Vec<(Point, f64)>) {
        for piece in border.pieces() {
            for &(s, ws) in if piece.is_straight() { &self.straight } else { &self.curved } {
                let (q, d) = (piece.at(s), piece.derivative(s));
                let (x, y) = (q.x - apex.x, q.y - apex.y);
                let swept = ws * (x * d.y - y * d.x);
                let on_ray =
                    |&(r, wr): &(f64, f64)| (Point::new(apex.x + r * x, apex.y + r * y), swept * wr * r);
                points.extend(self.radial.iter().map(on_ray));
            }
        }
    }

    /// Quadrature points along a border: the point, the unit normal to its left, and the weight in metres.
    pub(crate) fn along(&self, border: &Border) -> Vec<(Point, [f64; 2], f64)> {
        let pieces = border.pieces().flat_map(|piece| {
            let rule = if piece.is_straight() { &self.straight } else { &self.curved };
            rule.iter().map(move |&(s, w)| {
                let d = piece.derivative(s);
                (piece.at(s), piece.directions(s).1, w * d.x.hypot(d.y))
            })
        });
        pieces.collect()
    }
}
