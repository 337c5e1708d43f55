//! Round sheets by their number of nodal diameters: a Ritz problem along the radius, in polynomials piece by piece.

use super::pencil;
use std::f64::consts::{PI, TAU};
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

/// A ring of a sheet, uniform and isotropic.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Inner and outer radius, in metres.
    pub radii: [f64; 2],
    /// Bending stiffness, in N·m.
    pub bending: f64,
    pub poisson: f64,
    /// Tension, in N/m.
    pub tension: f64,
    /// Mass per area, in kg/m².
    pub mass: f64,
}

/// All frequencies up to `max_hz` (Hz) of a round sheet of pieces that follow each other from the inside out, with the edge conditions at
/// the innermost (not at a radius of 0) and outermost radius; rigid modes are left out, those with nodal diameters are there twice.
pub fn frequencies(pieces: &[Piece], edges: [Edge; 2], max_hz: f64) -> Vec<f64> {
    let top = (TAU * max_hz).powi(2);
    let mut found = Vec::new();
    for n in 0.. {
        let all: Vec<f64> = squares(pieces, edges, n, 1e-3 * top)
            .into_iter()
            .filter(|s| *s < top && *s > 1e-9 * top)
            .collect();
        if all.is_empty() && n > 2 {
            break;
        }
        let times = if n == 0 { 1 } else { 2 };
        found.extend(all.iter().flat_map(|s| std::iter::repeat_n(s.sqrt() / TAU, times)));
    }
    found.sort_by(f64::total_cmp);
    found
}

/// ω² for n nodal diameters.
fn squares(pieces: &[Piece], edges: [Edge; 2], n: u32, shift: f64) -> Vec<f64> {
    // Unknowns: value and slope at each node, then the bubbles of each piece.
    let nodes = 2 * (pieces.len() + 1);
    let size = nodes + BUBBLES * pieces.len();
    let (mut stiffness, mut mass) = (Mat::zeros(size, size), Mat::zeros(size, size));
    for (e, piece) in pieces.iter().enumerate() {
        let place = |i: usize| if i < 4 { 2 * e + i } else { nodes + BUBBLES * e + i - 4 };
        let [a, b] = piece.radii;
        for (x, w) in gauss(NODES) {
            let (r, w) = (0.5 * (a + b) + 0.5 * (b - a) * x, 0.5 * (b - a) * w);
            let jets = functions(x, 0.5 * (b - a));
            for i in 0..EACH {
                for j in 0..EACH {
                    stiffness[(place(i), place(j))] += w * r * energy(piece, n, r, &jets[i], &jets[j]);
                    mass[(place(i), place(j))] += w * r * piece.mass * jets[i][0] * jets[j][0];
                }
            }
        }
    }
    let held = held(pieces, edges, n);
    let free: Vec<usize> = (0..size).filter(|i| !held.contains(i)).collect();
    let kept = |m: &Mat<f64>| Mat::from_fn(free.len(), free.len(), |i, j| m[(free[i], free[j])]);
    pencil(&kept(&stiffness), &kept(&mass), shift)
}

/// Unknowns that are zero, by the edge conditions and at the centre.
fn held(pieces: &[Piece], edges: [Edge; 2], n: u32) -> Vec<usize> {
    let last = 2 * pieces.len();
    let of = |edge: Edge, first: usize| match edge {
        Edge::Clamped => vec![first, first + 1],
        Edge::Supported => vec![first],
        _ => Vec::new(),
    };
    let inner = if pieces[0].radii[0] > 0.0 {
        of(edges[0], 0)
    } else {
        // As r^n, with even powers more.
        match n {
            0 => vec![1],
            1 => vec![0],
            _ => vec![0, 1],
        }
    };
    [inner, of(edges[1], last)].concat()
}

/// The density of twice the elastic energy of two deflections times cos nθ, over a quarter turn's mean.
fn energy(piece: &Piece, n: u32, r: f64, u: &[f64; 3], v: &[f64; 3]) -> f64 {
    let n2 = f64::from(n * n);
    let around = |f: &[f64; 3]| f[1] / r - n2 * f[0] / (r * r);
    let twist = |f: &[f64; 3]| f[1] / r - f[0] / (r * r);
    let laplacian = |f: &[f64; 3]| f[2] + around(f);
    let bent = laplacian(u) * laplacian(v)
        - (1.0 - piece.poisson) * (u[2] * around(v) + v[2] * around(u) - 2.0 * n2 * twist(u) * twist(v));
    piece.bending * bent + piece.tension * (u[1] * v[1] + n2 * u[0] * v[0] / (r * r))
}

/// Values and derivatives by r of all functions at x from -1 to 1; `half` is half the piece's length.
fn functions(x: f64, half: f64) -> [[f64; 3]; EACH] {
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

/// The mean radius of a circle of some area, in metres.
pub fn radius_of(area: f64) -> f64 {
    (area / PI).sqrt()
}
