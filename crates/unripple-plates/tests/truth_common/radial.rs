//! Round sheets by their number of nodal diameters: a Ritz problem along the radius.

use super::line::{self, Jet};
use std::f64::consts::TAU;
use unripple_core::Edge;

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
    let mut found = Vec::new();
    for n in 0.. {
        let all = of_diameters(pieces, edges, n, max_hz);
        if all.is_empty() && n > 2 {
            break;
        }
        let times = if n == 0 { 1 } else { 2 };
        found.extend(all.iter().flat_map(|hz| std::iter::repeat_n(*hz, times)));
    }
    found.sort_by(f64::total_cmp);
    found
}

/// The frequencies up to `max_hz` (Hz) of the modes with n nodal diameters, each once, without rigid ones.
pub fn of_diameters(pieces: &[Piece], edges: [Edge; 2], n: u32, max_hz: f64) -> Vec<f64> {
    let top = (TAU * max_hz).powi(2);
    let all = squares(pieces, edges, n, 1e-3 * top);
    all.into_iter().filter(|s| *s < top && *s > 1e-9 * top).map(|s| s.sqrt() / TAU).collect()
}

/// ω² for n nodal diameters.
fn squares(pieces: &[Piece], edges: [Edge; 2], n: u32, shift: f64) -> Vec<f64> {
    let ends: Vec<f64> =
        pieces.iter().map(|p| p.radii[0]).chain([pieces[pieces.len() - 1].radii[1]]).collect();
    let density = |e: usize, r: f64, u: &Jet, v: &Jet| {
        [r * energy(&pieces[e], n, r, u, v), r * pieces[e].mass * u[0] * v[0]]
    };
    let last = 2 * pieces.len();
    // For each radian; none at a radius of 0.
    let springs =
        [line::springs(edges[0], 0, ends[0]), line::springs(edges[1], last, ends[pieces.len()])].concat();
    line::squares(&ends, density, &springs, &held(pieces, edges, n), shift)
}

/// Unknowns that are zero, by the edge conditions and at the centre.
fn held(pieces: &[Piece], edges: [Edge; 2], n: u32) -> Vec<usize> {
    let inner = if pieces[0].radii[0] > 0.0 {
        line::held(edges[0], 0)
    } else {
        // As r^n, with even powers more.
        match n {
            0 => vec![1],
            1 => vec![0],
            _ => vec![0, 1],
        }
    };
    [inner, line::held(edges[1], 2 * pieces.len())].concat()
}

/// The density of twice the elastic energy of two deflections times cos nθ, over a quarter turn's mean.
fn energy(piece: &Piece, n: u32, r: f64, u: &Jet, v: &Jet) -> f64 {
    let n2 = f64::from(n * n);
    let around = |f: &Jet| f[1] / r - n2 * f[0] / (r * r);
    let twist = |f: &Jet| f[1] / r - f[0] / (r * r);
    let laplacian = |f: &Jet| f[2] + around(f);
    let bent = laplacian(u) * laplacian(v)
        - (1.0 - piece.poisson) * (u[2] * around(v) + v[2] * around(u) - 2.0 * n2 * twist(u) * twist(v));
    piece.bending * bent + piece.tension * (u[1] * v[1] + n2 * u[0] * v[0] / (r * r))
}
