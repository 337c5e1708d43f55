//! Corners of an outline and the singularity there (Williams 1952): how small edges must be.

use super::williams::exponent;
use crate::PhysicsError;
use std::f64::consts::PI;
use unripple_core::plane::Rims;
use unripple_core::{Edge, Outline};

/// Shortest edge at a corner, as a share of the local size: there coordinates have about seven digits
/// left. Halved, the strongest singularities get one or two more rings of triangles.
const FLOOR: f64 = 1e-9;
/// Power up to which an element at a corner misses the share [`LOOSE`] of the singular energy it holds. See
/// [`missed`].
const ROUGH: f64 = 0.6;
/// Share of the singular energy that an element at a corner misses at low powers, measured; see
/// [`missed`].
const LOOSE: f64 = 0.2;
/// Exponential decay of that share with the power beyond [`ROUGH`], measured; see [`missed`].
const DECAY: f64 = 5.0;

/// A corner where two sides meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// The interior angle of the sheet, in radians from 0 to 2π.
    pub(crate) angle: f64,
    /// The edge conditions of the side that ends there and of the one that starts there.
    pub(crate) edges: [Edge; 2],
}

/// The corners of an outline, at the start of each side, in the order of [`Mesh::sides`](super::Mesh::sides).
///
/// # Errors
/// [`PhysicsError::Outline`] for an invalid outline.
pub(crate) fn corners(outline: &Outline) -> Result<Vec<Corner>, PhysicsError> {
    let rims = Rims::new(outline)?;
    let corner = |i: usize| {
        let (_, edge) = rims.sides[i];
        Corner { angle: rims.angles[i], edges: [rims.sides[rims.previous(i)].1, edge] }
    };
    Ok((0..rims.sides.len()).map(corner).collect())
}

/// The smallest edge at a corner, as a share of the edge length elsewhere, for which the error of the elements in the singular
/// part of the solution changes no eigenvalue by more than the relative `accuracy`; 1 if no smaller edge is needed, at least
/// 1e-9.
///
/// If the solution is singular as r^ν, the energy that elements of size r miss is as (r/size)^(2p), p = ν - 1 with bending and ν
/// without.
pub(crate) fn smallest_edge(angle: f64, edges: [Edge; 2], bending: bool, accuracy: f64) -> f64 {
    // Between equal edge conditions the singular part vanishes as the angle approaches a straight one; not so between
    // supported edges with bending, where a polygon differs from the curve that it approaches.
    let alike =
        edges[0].moves() == edges[1].moves() && (edges[0] == edges[1] || !bending || edges[0].moves());
    let fades = alike && !(bending && edges[0] == Edge::Supported);
    let strength = if fades { (angle - PI).powi(2).min(1.0) } else { 1.0 };
    let most = ROUGH + (LOOSE * strength / accuracy).ln() / DECAY;
    if most.is_nan() || most <= 0.0 {
        return 1.0;
    }
    let power = if bending { exponent(angle, edges, most) } else { membrane(angle, edges, most) };
    if power.is_finite() {
        (accuracy / (strength * missed(power))).powf(0.5 / power).clamp(FLOOR, 1.0)
    } else {
        1.0
    }
}

/// The relative error of an eigenvalue if elements at a corner are as large as elsewhere, as a function of the power p. Measured
/// with Argyris's elements, 1/10 of a wavelength long, on an L-shaped membrane (p = 2/3: 0.10), clamped (0.54: 0.14) and
/// supported (1/3: 0.17) L-shaped plates, a cantilever (1.07: 7e-4) and a free square (1.76: 6e-6); rounded up, more for higher
/// powers, since waves may be shorter.
fn missed(power: f64) -> f64 {
    LOOSE * (-DECAY * (power - ROUGH).max(0.0)).exp()
}

/// The least power ν of r^ν at the corner of a membrane that is not a whole number: kπ/α between equal edges, (k - ½)π/α
/// between a fixed and a free one. Infinite if there is none below `most`.
fn membrane(angle: f64, edges: [Edge; 2], most: f64) -> f64 {
    let step = PI / angle;
    let first = if edges[0].moves() == edges[1].moves() { step } else { 0.5 * step };
    let powers = (0..32).map(|k| first + f64::from(k) * step);
    // Whole powers are polynomials, which elements hold exactly.
    powers.take_while(|p| *p < most).find(|p| (p - p.round()).abs() > 1e-5).unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Edge::{Clamped, Free, Supported};
    use std::f64::consts::{FRAC_PI_2, TAU};

    #[test]
    fn what_is_smooth_is_not_refined() {
        for accuracy in [1e-3, 1e-6] {
            for bending in [true, false] {
                assert_eq!(smallest_edge(FRAC_PI_2, [Supported; 2], bending, accuracy), 1.0);
                for edge in [Clamped, Supported, Free] {
                    assert_eq!(smallest_edge(PI, [edge; 2], bending, accuracy), 1.0);
                    assert!(smallest_edge(PI - 0.01, [edge; 2], false, accuracy) > 0.5);
                }
            }
        }
        assert_eq!(smallest_edge(FRAC_PI_2, [Free; 2], true, 1e-3), 1.0);
    }

    #[test]
    fn sharper_and_more_accurate_is_smaller() {
        let l = |accuracy| smallest_edge(1.5 * PI, [Supported; 2], false, accuracy);
        assert!((l(1e-6) / l(1e-5) - 10.0_f64.powf(-0.75)).abs() < 1e-9);
        assert!(l(1e-6) > 5e-5 && l(1e-6) < 5e-4, "{}", l(1e-6));
        let at = |angle| smallest_edge(angle, [Clamped; 2], true, 1e-5);
        assert!(at(1.2 * PI) > at(1.5 * PI) && at(1.5 * PI) > at(0.999 * TAU));
        assert!(smallest_edge(PI, [Clamped, Free], true, 1e-5) < 1e-4);
        assert_eq!(smallest_edge(1.02 * PI, [Supported; 2], true, 1e-6), FLOOR);
    }
}
