//! Bubble polynomials that impose the edge conditions along curved edges.
//!
//! A quintic that satisfies the conditions at the two ends of a curved edge vanishes along the curve only approximately: the error is
//! the curve's distance from its chord times a slope, and frequencies would be too low, by a term of order h³ for a membrane.
//! Therefore polynomials (λ_a λ_b)³(λ_a - λ_b)^i are added, and for the slope (λ_a λ_b)² λ_c (λ_a - λ_b)^i, with the barycentric
//! coordinates λ_a and λ_b of the curve's ends, such that u and ∂u/∂n vanish at points of the curve. These polynomials and their
//! gradients are zero along the other two edges, and their second derivatives at the vertices, so that nothing changes elsewhere.
//! The points are the zeros of Jacobi polynomials for the weight given by the ends, so that the remaining error along the curve
//! is orthogonal to the smooth reaction forces of the rim.

use super::border::Border;
use super::monomials::{COUNT, EXPONENTS, Frame, HIGHEST, place};
use unripple_core::{Edge, Point};
use unripple_linalg::{Lu, Mat};

/// Points of a curve at which u vanishes, by their parameter from -1 to 1: zeros of the Jacobi polynomial of
/// degree 2 for the weight (1 - x²)³.
const VALUES: [f64; 2] = [-1.0 / 3.0, 1.0 / 3.0];

/// Points of a clamped curve at which ∂u/∂n vanishes, by their parameter from -1 to 1: zeros 0 and ±√(1/3) of the Jacobi
/// polynomial of degree 3 for the weight (1 - x²)².
const SLOPES: [f64; 3] = [-0.577_350_269_189_625_8, 0.0, 0.577_350_269_189_625_8];

/// Coefficients of a polynomial, one per monomial.
type Polynomial = [f64; COUNT];

/// Adds bubble polynomials to a basis of quintics (rows of monomials, `unknowns` columns) so that it
/// satisfies the edge conditions along the clamped and supported curves among a triangle's borders;
/// `slopes` says on which borders the slope is zero.
pub(crate) fn trim(
    frame: &Frame,
    vertices: [Point; 3],
    borders: &[Border; 3],
    slopes: [bool; 3],
    unknowns: usize,
    basis: &mut Vec<f64>,
) {
    let held = |b: &Border| matches!(b.held, Some(Edge::Clamped | Edge::Supported)) && !b.is_straight();
    let curves: Vec<usize> = (0..3).filter(|i| held(&borders[*i])).collect();
    if curves.is_empty() || unknowns == 0 {
        return;
    }
    let coordinates = barycentric(frame, vertices);
    let mut bubbles: Vec<Polynomial> = Vec::new();
    let mut conditions: Vec<Polynomial> = Vec::new();
    for i in curves {
        let [a, b, c] = [coordinates[i], coordinates[(i + 1) % 3], coordinates[(i + 2) % 3]];
        let across: [f64; 3] = std::array::from_fn(|n| a[n] - b[n]);
        let powers = |factors: &[[f64; 3]], count: usize| {
            let mut next = factors.iter().fold(one(), |p, f| times(&p, f));
            let mut all = vec![next];
            for _ in 1..count {
                next = times(&next, &across);
                all.push(next);
            }
            all
        };
        bubbles.extend(powers(&[a, a, a, b, b, b], VALUES.len()));
        let border = &borders[i];
        conditions.extend(VALUES.map(|x| frame.values(border.at(0.5 + 0.5 * x))));
        if slopes[i] {
            bubbles.extend(powers(&[a, a, b, b, c], SLOPES.len()));
            conditions.extend(SLOPES.map(|x| {
                let s = 0.5 + 0.5 * x;
                let (jets, [nx, ny]) = (frame.jets(border.at(s)), border.directions(s).1);
                std::array::from_fn(|m| frame.scale * (nx * jets[1][m] + ny * jets[2][m]))
            }));
        }
    }
    let dot =
        |p: &Polynomial, column: &dyn Fn(usize) -> f64| (0..COUNT).map(|m| p[m] * column(m)).sum::<f64>();
    let size = bubbles.len();
    let of_bubbles = Mat::from_fn(size, size, |i, j| dot(&conditions[i], &|m| bubbles[j][m]));
    basis.resize(COUNT * unknowns, 0.0);
    let mut taken = Mat::from_fn(size, unknowns, |i, u| dot(&conditions[i], &|m| basis[m * unknowns + u]));
    Lu::new(of_bubbles.as_ref()).solve(taken.as_mut());
    for (m, row) in basis.chunks_exact_mut(unknowns).enumerate() {
        for (u, b) in row.iter_mut().enumerate() {
            *b -= bubbles.iter().enumerate().map(|(j, bubble)| bubble[m] * taken[(j, u)]).sum::<f64>();
        }
    }
}

/// The barycentric coordinate of each vertex, as coefficients of 1, x and y.
fn barycentric(frame: &Frame, vertices: [Point; 3]) -> [[f64; 3]; 3] {
    let local = vertices.map(|p| frame.local(p));
    [0, 1, 2].map(|i| {
        let ([x, y], [ax, ay], [bx, by]) = (local[i], local[(i + 1) % 3], local[(i + 2) % 3]);
        // Twice the area of (p, a, b) over that of (vertex, a, b).
        let parts = [ax * by - ay * bx, ay - by, bx - ax];
        let whole = parts[0] + parts[1] * x + parts[2] * y;
        parts.map(|part| part / whole)
    })
}

fn one() -> Polynomial {
    let mut p = [0.0; COUNT];
    p[0] = 1.0;
    p
}

/// The product of a linear polynomial and a polynomial below the highest degree.
fn times(p: &Polynomial, [c, x, y]: &[f64; 3]) -> Polynomial {
    let mut product = p.map(|v| v * c);
    for (v, [i, j]) in p.iter().zip(EXPONENTS).filter(|(_, [i, j])| i + j < HIGHEST) {
        product[place([i + 1, j])] += v * x;
        product[place([i, j + 1])] += v * y;
    }
    product
}
