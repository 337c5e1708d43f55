//! Ritz problems along a line, in polynomials piece by piece whose value and slope are continuous.

use super::pencil;
use unripple_core::Edge;
use unripple_linalg::Mat;
use unripple_plates::gauss;

/// Number of polynomials within a piece that vanish with their slope at both ends: more change the frequencies used here by less than
/// 1e-10.
const BUBBLES: usize = 18;
/// Number of functions of a piece: the value and the slope at both ends (Hermite's cubics), then the bubbles.
const EACH: usize = 4 + BUBBLES;
/// Nodes of the quadrature along a piece.
const NODES: usize = BUBBLES + 12;

/// A function's value and its first and second derivative at a place.
pub type Jet = [f64; 3];

/// Eigenvalues, ascending, of the quotient of ∫ stiffness(u, u) and ∫ mass u² over the functions on a line that is divided at `ends`, the
/// first and the last of which bound it. Unknowns are value and slope at each of the ends, in turn; those of `held` are zero.
/// `density` gives the density of stiffness of two functions and that of mass at a place of a piece (by its index), and `springs` are
/// added to the stiffness: an unknown and its stiffness. `shift` is a small part of the eigenvalues sought.
pub fn squares(
    ends: &[f64],
    density: impl Fn(usize, f64, &Jet, &Jet) -> [f64; 2],
    springs: &[(usize, f64)],
    held: &[usize],
    shift: f64,
) -> Vec<f64> {
    let pieces = ends.len() - 1;
    let nodes = 2 * ends.len();
    let size = nodes + BUBBLES * pieces;
    let (mut stiffness, mut mass) = (Mat::zeros(size, size), Mat::zeros(size, size));
    for e in 0..pieces {
        let place = |i: usize| if i < 4 { 2 * e + i } else { nodes + BUBBLES * e + i - 4 };
        let (a, b) = (ends[e], ends[e + 1]);
        for (x, w) in gauss(NODES) {
            let (at, w) = (0.5 * (a + b) + 0.5 * (b - a) * x, 0.5 * (b - a) * w);
            let jets = functions(x, 0.5 * (b - a));
            for i in 0..EACH {
                for j in 0..EACH {
                    let [stiff, heavy] = density(e, at, &jets[i], &jets[j]);
                    stiffness[(place(i), place(j))] += w * stiff;
                    mass[(place(i), place(j))] += w * heavy;
                }
            }
        }
    }
    for (unknown, spring) in springs {
        stiffness[(*unknown, *unknown)] += spring;
    }
    let free: Vec<usize> = (0..size).filter(|i| !held.contains(i)).collect();
    let kept = |m: &Mat<f64>| Mat::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
    pencil(&kept(&stiffness), &kept(&mass), shift)
}

/// Unknowns that an edge condition holds at zero, of a value and a slope that follow each other from `first` on.
pub fn held(edge: Edge, first: usize) -> Vec<usize> {
    match edge {
        Edge::Clamped => vec![first, first + 1],
        Edge::Supported => vec![first],
        _ => Vec::new(),
    }
}

/// The springs of an edge of some length at these unknowns.
pub fn springs(edge: Edge, first: usize, length: f64) -> Vec<(usize, f64)> {
    match edge {
        Edge::Elastic { lift, tilt } => vec![(first, length * lift), (first + 1, length * tilt)],
        _ => Vec::new(),
    }
}

/// Values and derivatives of all functions at x from -1 to 1; `half` is half the piece's length.
fn functions(x: f64, half: f64) -> [Jet; EACH] {
    let mut all = [[0.0; 3]; EACH];
    // Hermite's cubics: value and slope at -1, value and slope at 1.
    let cubics = [
        [0.5, -0.75, 0.0, 0.25],
        [0.25, -0.25, -0.25, 0.25],
        [0.5, 0.75, 0.0, -0.25],
        [-0.25, -0.25, 0.25, 0.25],
    ];
    for (f, c) in all.iter_mut().zip(cubics) {
        *f = [
            c[0] + x * (c[1] + x * (c[2] + x * c[3])),
            c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]),
            2.0 * c[2] + 6.0 * c[3] * x,
        ];
    }
    for (f, b) in all[4..].iter_mut().zip(super::ritz::bubbles(x, BUBBLES)) {
        *f = b;
    }
    for (i, f) in all.iter_mut().enumerate() {
        let unit = if i == 1 || i == 3 { half } else { 1.0 };
        *f = [unit * f[0], unit * f[1] / half, unit * f[2] / (half * half)];
    }
    all
}
