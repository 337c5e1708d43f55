//! Corners of an outline and the singularity of the solution there (Williams 1952): how short the mesh's
//! edges must be.

use super::field::GROWTH;
use super::williams::exponent;
use crate::PhysicsError;
use std::f64::consts::PI;
use unripple_core::plane::Rims;
use unripple_core::{Edge, Outline};

/// Shortest edge at a corner, relative to the edge length elsewhere: there coordinates have about seven
/// digits left. Halved, the strongest singularities get one or two more rings of triangles.
const FLOOR: f64 = 1e-9;
/// Power p up to which an element at a corner misses the share [`LOOSE`] of the singular energy in it. See
/// [`missed`].
const ROUGH: f64 = 0.6;
/// Share of the singular energy that an element at a corner misses at low powers, measured; see
/// [`missed`].
const LOOSE: f64 = 0.2;
/// Exponential decay of the missed share as the power increases beyond [`ROUGH`], measured; see [`missed`].
const DECAY: f64 = 5.0;

/// Sides that meet at an angle within this of a straight angle, in radians, count as one smooth curve, as
/// in the elements at their vertices.
const SMOOTH: f64 = 1e-3;
/// Accuracy for which singular powers are computed that a comparison of two meshes may not show. Less, and
/// corners are examined that matter at no accuracy that can be reached.
const FAINT: f64 = 1e-7;
/// Power p below which the energy missed by elements of the common size is nearly equal on two meshes: with
/// edges 1.3 times shorter it falls by less than a seventh. Doubled, corners would count that refinement
/// resolves.
const SLOW: f64 = 0.3;
/// Share of the singular energy missed by rings of triangles whose size grows by [`GROWTH`] per distance,
/// whatever the smallest size, for a power halfway between whole numbers: measured on supported L-shaped
/// plates, 5e-5. It falls as the eighth power of the growth.
const GRADED: f64 = 1e-4;
/// Share of the error due to the smallest edges at a corner that is added to the error from a comparison of
/// meshes: the errors for which edges are chosen are about four times those found on regular polygons.
const LEFT: f64 = 0.25;

/// A corner where two sides meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// The interior angle of the sheet, in radians from 0 to 2π.
    pub(crate) angle: f64,
    /// The edge conditions of the side that ends at the corner and of the side that starts there.
    pub(crate) edges: [Edge; 2],
    /// Jump of the rim's curvature at the corner, in 1/m, if the sides meet at a straight angle; else 0.
    pub(crate) jump: f64,
}

/// The corners of an outline, at the start of each side, in the order of [`Mesh::sides`](super::Mesh::sides).
///
/// # Errors
/// [`PhysicsError::Outline`] for an invalid outline.
pub(crate) fn corners(outline: &Outline) -> Result<Vec<Corner>, PhysicsError> {
    let rims = Rims::new(outline)?;
    let corner = |i: usize| {
        let ((before, first), (after, second)) = (rims.sides[rims.previous(i)], rims.sides[i]);
        let continued = (rims.angles[i] - PI).abs() < SMOOTH;
        let jump = if continued { (after.curvature(0.0) - before.curvature(1.0)).abs() } else { 0.0 };
        let jump = if jump.is_finite() { jump } else { 0.0 };
        Corner { angle: rims.angles[i], edges: [first, second], jump }
    };
    Ok((0..rims.sides.len()).map(corner).collect())
}

/// The smallest edge at a corner, relative to the edge length elsewhere (`size`, in metres), for which the
/// elements' error in the singular part of the solution changes no eigenvalue by more than the relative
/// `accuracy`; 1 if no smaller edge is needed, at least 1e-9.
///
/// If the solution is singular as r^ν, the energy that elements of size r miss is as (r/size)^(2p), p = ν - 1 with bending and ν
/// without.
pub(crate) fn smallest_edge(corner: &Corner, size: f64, bending: bool, accuracy: f64) -> f64 {
    Singularity::of(corner, size, bending, accuracy).map_or(1.0, |s| s.smallest_edge(accuracy))
}

/// The number of corners where the singular part of the solution would change eigenvalues by more than the
/// relative `accuracy` if edges had the same length `size` (m) there as elsewhere.
pub(crate) fn singular(corners: &[Corner], size: f64, bending: bool, accuracy: f64) -> usize {
    corners.iter().filter(|corner| Singularity::of(corner, size, bending, accuracy).is_some()).count()
}

/// The growth of edges per distance from corners with which the rings of triangles around all of them together change eigenvalues by no
/// more than the relative `accuracy`, at most [`GROWTH`]. `size` is the edge length elsewhere (m), `each` the accuracy for which each
/// corner is refined.
pub(crate) fn growth(corners: &[Corner], size: f64, bending: bool, each: f64, accuracy: f64) -> f64 {
    let refined = corners.iter().filter_map(|corner| Singularity::of(corner, size, bending, each));
    let rings: f64 = refined.map(Singularity::rings).sum();
    if rings > accuracy { GROWTH * (accuracy / rings).powf(0.125) } else { GROWTH }
}

/// The relative error of eigenvalues, due to singular parts at corners, that a comparison of two meshes
/// does not show, since both miss nearly equal parts: where the smallest edges are at their least, or slow
/// powers are not resolved at all; what rings of triangles around a corner miss, each longer by `growth`
/// per distance than the ring inside; and, since a short side may have equally few edges on both meshes, a
/// share of the remaining error. `size` is the edge length elsewhere (m), `accuracy` the one for which
/// corners are refined.
pub(crate) fn unresolved(corners: &[Corner], size: f64, bending: bool, accuracy: f64, growth: f64) -> f64 {
    let of = |corner: &Corner| {
        // A singular part that needs no smaller edge may still be one of many.
        let all = accuracy.min(FAINT);
        let Some(s) = Singularity::of(corner, size, bending, all) else { return 0.0 };
        let share = s.smallest_edge(accuracy);
        let hidden = share <= FLOOR || (share >= 1.0 && s.power < SLOW);
        let missed = s.strength * missed(s.power);
        let rings = if share < 1.0 { s.rings() * (growth / GROWTH).powi(8) } else { 0.0 };
        let core = share.powf(2.0 * s.power);
        let left = match hidden {
            true => 1.0,
            false if share < 1.0 => LEFT,
            false => 0.0,
        };
        rings + missed * left * core
    };
    corners.iter().map(of).sum()
}

/// The singular part of a solution at a corner.
#[derive(Clone, Copy, Debug)]
struct Singularity {
    /// The power p by which the energy within a radius r falls: as r^(2p).
    power: f64,
    /// The coefficient of the singular part, relative to that of a right-angled re-entrant corner, at
    /// most 1.
    strength: f64,
}

impl Singularity {
    /// The strongest singular part that may change an eigenvalue by more than the relative `accuracy`, if
    /// edges around the corner have the length `size` (m).
    fn of(corner: &Corner, size: f64, bending: bool, accuracy: f64) -> Option<Self> {
        Self::of_angle(corner.angle, corner.edges, bending, accuracy)
            .or_else(|| Self::of_jump(corner, size, bending))
            .filter(|s| s.strength * missed(s.power) > accuracy)
    }

    /// The singular part where the curvature of a rim jumps. The moment or the slope across the rim, to
    /// which curvature contributes, jumps as well: on a supported or free rim the second derivatives of the
    /// deflection, on a clamped rim and on membranes derivatives one order higher.
    fn of_jump(corner: &Corner, size: f64, bending: bool) -> Option<Self> {
        let smooth = !bending || corner.edges == [Edge::Clamped; 2];
        let strength = (corner.jump * size).powi(2).min(1.0);
        (strength > 0.0).then_some(Self { power: if smooth { 2.0 } else { 1.0 }, strength })
    }

    /// The singular part at a corner with a given interior angle.
    fn of_angle(angle: f64, edges: [Edge; 2], bending: bool, accuracy: f64) -> Option<Self> {
        // Between equal edge conditions the singular part vanishes as the angle approaches a straight one: its energy as the angle
        // squared, but between supported edges with bending as the angle, since all corners of a polygon together keep it from the
        // curve that it approaches. At a corner of a fixed membrane smooth elements have no slope at all, however near it is to straight.
        let alike =
            edges[0].moves() == edges[1].moves() && (edges[0] == edges[1] || !bending || edges[0].moves());
        let bend = (angle - PI).abs().min(1.0);
        let fixed = !bending && !edges[0].moves() && bend > SMOOTH;
        let strength = match (alike, bending && edges[0] == Edge::Supported) {
            (true, true) => bend,
            (true, false) if !fixed => bend * bend,
            _ => 1.0,
        };
        let most = ROUGH + (LOOSE * strength / accuracy).ln() / DECAY;
        if most.is_nan() || most <= 0.0 {
            return None;
        }
        let power = if bending { exponent(angle, edges, most) } else { membrane(angle, edges, most) };
        power.is_finite().then_some(Self { power, strength })
    }

    /// The share of an eigenvalue that rings of triangles miss whose size grows by [`GROWTH`] per distance.
    fn rings(self) -> f64 {
        // Near a whole power the solution is nearly a polynomial, which elements hold.
        self.strength * missed(self.power) * GRADED * (PI * self.power).sin().powi(2)
    }

    /// The smallest edge for a given accuracy, see [`smallest_edge`].
    fn smallest_edge(self, accuracy: f64) -> f64 {
        (accuracy / (self.strength * missed(self.power))).powf(0.5 / self.power).clamp(FLOOR, 1.0)
    }
}

/// The relative error of an eigenvalue if elements at a corner are as large as elsewhere, as a function of the power p. Measured
/// with Argyris's elements, 1/10 of a wavelength long, on an L-shaped membrane (p = 2/3: 0.10), clamped (0.54: 0.14) and
/// supported (1/3: 0.17) L-shaped plates, a cantilever (1.07: 7e-4) and a free square (1.76: 6e-6); rounded up, more for higher
/// powers, since waves may be shorter.
fn missed(power: f64) -> f64 {
    LOOSE * (-DECAY * (power - ROUGH).max(0.0)).exp()
}

/// The least exponent ν of r^ν at the corner of a membrane that is not a whole number: kπ/α between equal
/// edges, (k - ½)π/α between a fixed and a free edge. Infinite if there is none below `most`.
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

    fn smallest_edge(angle: f64, edges: [Edge; 2], bending: bool, accuracy: f64) -> f64 {
        super::smallest_edge(&Corner { angle, edges, jump: 0.0 }, 1.0, bending, accuracy)
    }

    #[test]
    fn what_is_smooth_is_not_refined() {
        for accuracy in [1e-3, 1e-6] {
            for bending in [true, false] {
                assert_eq!(smallest_edge(FRAC_PI_2, [Supported; 2], bending, accuracy), 1.0);
                for edge in [Clamped, Supported, Free] {
                    assert_eq!(smallest_edge(PI, [edge; 2], bending, accuracy), 1.0);
                    assert_eq!(smallest_edge(PI - 0.5 * SMOOTH, [edge; 2], false, accuracy), 1.0);
                }
            }
        }
        assert_eq!(smallest_edge(FRAC_PI_2, [Free; 2], true, 1e-3), 1.0);
        assert!(smallest_edge(PI - 0.01, [Free; 2], false, 1e-6) > 0.5);
        // Smooth elements have no slope at such a corner.
        assert!(smallest_edge(PI - 0.01, [Clamped; 2], false, 1e-6) < 0.1);
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

    #[test]
    fn jumps_of_curvature_are_corners_too() {
        let at = |edge, jump| {
            super::smallest_edge(&Corner { angle: PI, edges: [edge; 2], jump }, 0.01, true, 1e-6)
        };
        assert_eq!(at(Supported, 0.0), 1.0);
        assert!(at(Supported, 20.0) < 0.1 && at(Free, 20.0) < 0.1);
        assert!(at(Clamped, 20.0) > at(Supported, 20.0) && at(Supported, 1.0) > at(Supported, 20.0));
    }

    #[test]
    fn what_no_mesh_resolves_is_told() {
        let of = |count: u32, accuracy: f64| {
            let corner = Corner { angle: PI - TAU / f64::from(count), edges: [Supported; 2], jump: 0.0 };
            unresolved(&vec![corner; count as usize], 0.01, true, accuracy, GROWTH)
        };
        // A supported circle's first frequency is a sixth below that of the polygons that approach it.
        assert!(of(48, 1e-3) > 0.1 && of(1000, 1e-3) > 0.1 && of(24, 1e-3) > 1e-2);
        assert!(of(6, 1e-4) < 4e-4 && of(4, 1e-3) == 0.0);
        let ell = [Corner { angle: 1.5 * PI, edges: [Supported; 2], jump: 0.0 }];
        let [coarse, fine] = [GROWTH, 0.5 * GROWTH].map(|growth| unresolved(&ell, 0.01, true, 1e-6, growth));
        assert!(coarse > 1e-5 && fine < 5e-7, "{coarse:e} {fine:e}");
    }
}
