//! Rectangles between two supported sides, whose properties vary along these: a Ritz problem for each number of half waves across.

use super::line::{self, Jet};
use std::f64::consts::{PI, TAU};
use unripple_core::Edge;

/// Pieces that a strip is divided into.
const PIECES: usize = 4;

/// A sheet at a place.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    /// Bending stiffness, in N·m.
    pub bending: f64,
    /// Tension, in N/m.
    pub tension: f64,
    /// Mass per area, in kg/m².
    pub mass: f64,
}

/// All frequencies up to `max_hz` (Hz) of a rectangle of some sides (m), supported along the lower and the upper one, with the edge
/// conditions on the left and on the right. `at` is the sheet at a distance (m) from the left.
pub fn frequencies(
    sides: [f64; 2],
    edges: [Edge; 2],
    poisson: f64,
    at: impl Fn(f64) -> Local,
    max_hz: f64,
) -> Vec<f64> {
    let top = (TAU * max_hz).powi(2);
    let ends: Vec<f64> = (0..=PIECES).map(|i| sides[0] * i as f64 / PIECES as f64).collect();
    let ends_of = [(edges[0], 0), (edges[1], 2 * PIECES)];
    let springs = ends_of.map(|(edge, first)| line::springs(edge, first, 1.0)).concat();
    let held = ends_of.map(|(edge, first)| line::held(edge, first)).concat();
    let mut found = Vec::new();
    for n in 1.. {
        let q = (f64::from(n) * PI / sides[1]).powi(2);
        let density = |_: usize, x: f64, u: &Jet, v: &Jet| {
            let Local { bending, tension, mass } = at(x);
            // The curvatures of u sin(√q y), with the mean of sin² and of cos².
            let bent = u[2] * v[2] - poisson * q * (u[2] * v[0] + u[0] * v[2])
                + q * q * u[0] * v[0]
                + 2.0 * (1.0 - poisson) * q * u[1] * v[1];
            [bending * bent + tension * (u[1] * v[1] + q * u[0] * v[0]), mass * u[0] * v[0]]
        };
        let all = line::squares(&ends, density, &springs, &held, 1e-3 * top);
        let before = found.len();
        found.extend(all.into_iter().filter(|s| *s < top).map(|s| s.sqrt() / TAU));
        if found.len() == before {
            break;
        }
    }
    found.sort_by(f64::total_cmp);
    found
}
