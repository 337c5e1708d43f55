//! Functions whose curvature jumps across the rim of a glued disc.
//!
//! Deflection and slope are continuous across the rim, and so is the bending moment: where the stiffness jumps, curvature does. Quintics
//! miss that jump in proportion to the edge length. The deflection outside is that under the disc, continued, plus ψg, with a smooth g and
//! ψ = 0 under the disc and ½s² outside, s = (r² - R²)/(2Rh), which is as smooth as the deflection. What the quintics lack of it is
//! ψg - I(ψg), I their interpolation. At each vertex near the rim g is expanded to second order, and the functions N (ψq - I(ψq)) are added
//! for polynomials q of degree 2, with N the polynomial that is 1 at the vertex and 0 at the others (stable generalised finite elements: Babuška
//! and Banerjee, *Comput. Methods Appl. Mech. Eng.* 201, 91, 2012). Meshes need not follow the rim, and errors fall as those of quintics.
//! On a sheet without bending stiffness the slope may jump as well, and ψ = s.

use super::monomials::Jet;
use crate::fabric::Disc;
use unripple_core::Point;

/// Factors of the monomials 1, x, y, x²/2, xy and y²/2 around a vertex, with coordinates in units of the
/// kink's length.
pub(crate) type Factors = [f64; 6];

/// The function ψ of a glued disc: zero under the disc, and with a jump of curvature (or of slope) at its
/// rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kink {
    /// Index of the disc among those of the sheet.
    pub(crate) disc: usize,
    at: Point,
    radius: f64,
    /// The length h by which ψ is scaled, in metres.
    length: f64,
    /// Whether ψ is proportional to s², for a sheet that bends, or to s.
    bending: bool,
}

impl Kink {
    /// The function ψ for the disc with this index, scaled by a length (m).
    pub(crate) fn new(index: usize, disc: &Disc, length: f64, bending: bool) -> Self {
        Self { disc: index, at: disc.at, radius: disc.radius, length, bending }
    }

    /// Whether a point (m) is under the disc, where ψ is 0.
    pub(crate) fn covers(&self, p: Point) -> bool {
        p.distance(self.at) <= self.radius
    }

    /// The function ψq at a point outside the disc, or its continuation as a polynomial under the disc; q
    /// is the sum of the six monomials around a vertex (m) times `factors`.
    pub(crate) fn outside(&self, vertex: Point, factors: &Factors, p: Point) -> Jet {
        let unit = 1.0 / self.length;
        let (x, y) = (unit * (p.x - vertex.x), unit * (p.y - vertex.y));
        let [a, b, c, d, e, f] = *factors;
        let (slope_x, slope_y) = (b + d * x + e * y, c + e * x + f * y);
        let value = a + b * x + c * y + 0.5 * d * x * x + e * x * y + 0.5 * f * y * y;
        let square = unit * unit;
        let polynomial = [value, unit * slope_x, unit * slope_y, square * d, square * e, square * f];
        product(&self.step(p), &polynomial)
    }

    /// The function ψq itself at a point: 0 under the disc.
    pub(crate) fn at(&self, vertex: Point, factors: &Factors, p: Point) -> Jet {
        if self.covers(p) { [0.0; 6] } else { self.outside(vertex, factors, p) }
    }

    /// The function ψ at a point outside the disc, or its continuation under it.
    fn step(&self, p: Point) -> Jet {
        let (x, y) = (p.x - self.at.x, p.y - self.at.y);
        let bow = 1.0 / (self.radius * self.length);
        // Without loss of digits near the rim.
        let r = x.hypot(y);
        let s = 0.5 * bow * (r - self.radius) * (r + self.radius);
        let (sx, sy) = (bow * x, bow * y);
        if self.bending {
            [0.5 * s * s, s * sx, s * sy, sx * sx + s * bow, sx * sy, sy * sy + s * bow]
        } else {
            [s, sx, sy, bow, 0.0, bow]
        }
    }
}

/// The product of two functions; each function is given as its value, first and second derivatives at a
/// point.
pub(crate) fn product(a: &Jet, b: &Jet) -> Jet {
    [
        a[0] * b[0],
        a[1] * b[0] + a[0] * b[1],
        a[2] * b[0] + a[0] * b[2],
        a[3] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[3],
        a[4] * b[0] + a[1] * b[2] + a[2] * b[1] + a[0] * b[4],
        a[5] * b[0] + 2.0 * a[2] * b[2] + a[0] * b[5],
    ]
}
