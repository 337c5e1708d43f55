//! Number of modes of a sheet by Weyl's law, with a boundary term that depends on the edge conditions.

use crate::Medium;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use unripple_core::{Edge, Surface};
use unripple_linalg::c64;

/// Number of angles of incidence over which the boundary term is averaged, by the midpoint rule. With twice
/// this value, its error is a quarter; with 64, its relative error is 1e-4.
const ANGLES: usize = 64;

/// Relative step of the derivative of the count with respect to the wavenumber. Larger, curvature would
/// enter; smaller, rounding.
const STEP: f64 = 1e-4;

/// Weyl's law with two terms for a sheet: N(k) = S k²/4π + Σ L b(k)/π over the edges of length L.
///
/// The term of an edge follows from how it reflects plane waves: where a wave of wavenumber k and angle of incidence θ is reflected as
/// cos(k x cos θ + α), b = k ∫_0^{π/2} (1/4 + α/π) cos θ dθ (Vasil'ev, *Funct. Anal. Appl.* 21, 14, 1987, for plates). A supported edge has
/// α = -π/2, hence -Lk/4π as for a membrane. The evanescent wave at a clamped edge adds arctan(cos θ k/κ) to that, with
/// κ² = k²(1 + sin²θ) + T/D: without tension T the term is 1.763 times as large. Waves that run along a free edge of a plate (0.1 % of its
/// term) are left out.
#[derive(Clone, Debug)]
pub(super) struct Weyl {
    area: f64,
    /// Total length (m) of the edges with each edge condition, including the edges of holes.
    edges: Vec<(f64, Edge)>,
    sheet: Reflecting,
}

/// Properties of a sheet on which the reflection of waves at its edges depends: tension (N/m), bending stiffness (N·m), Poisson ratio.
#[derive(Clone, Copy, Debug)]
struct Reflecting {
    tension: f64,
    bending: f64,
    poisson: f64,
}

/// Number of modes below a frequency (Hz) that Weyl's law predicts, at least one.
pub fn expected_modes(surface: &Surface, hz: f64) -> f64 {
    Weyl::of(surface).below(Medium::of(&surface.sheet).wavenumber(TAU * hz)).max(1.0)
}

impl Weyl {
    /// Weyl's law for a surface, without the actuators and fingers on it.
    pub fn of(surface: &Surface) -> Self {
        let medium = Medium::of(&surface.sheet);
        let mut edges: Vec<(f64, Edge)> = Vec::new();
        for (side, edge) in surface.outline.loops().into_iter().flat_map(|rim| rim.sides) {
            match edges.iter_mut().find(|(_, known)| *known == edge) {
                Some((length, _)) => *length += side.length(),
                None => edges.push((side.length(), edge)),
            }
        }
        Self {
            area: surface.outline.area(),
            edges,
            sheet: Reflecting {
                tension: medium.tension,
                bending: medium.bending_stiffness,
                poisson: surface.sheet.poisson,
            },
        }
    }

    /// Number of modes below the wavenumber `k` (rad/m); it may be negative where few wavelengths fit on
    /// the sheet.
    pub fn below(&self, k: f64) -> f64 {
        let rim: f64 = self.edges.iter().map(|(length, edge)| length * self.sheet.term(*edge, k) / PI).sum();
        self.area * k * k / (4.0 * PI) + rim
    }

    /// Modes per unit wavenumber dN/dk, in metres, at the wavenumber `k` (rad/m).
    pub fn per_wavenumber(&self, k: f64) -> f64 {
        (self.below(k * (1.0 + STEP)) - self.below(k * (1.0 - STEP))) / (2.0 * STEP * k)
    }

    /// The wavenumber, in rad/m, below which the law counts exactly one mode.
    pub fn first_wavenumber(&self) -> f64 {
        // Where the term of the area alone counts one mode; the rim moves it by less than a factor of 2^10 either way.
        let start = (4.0 * PI / self.area).sqrt();
        let mut high = start;
        while self.below(high) < 1.0 && high < 1024.0 * start {
            high *= 2.0;
        }
        let mut low = 0.0;
        // Down to the last bit.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.below(middle) < 1.0 { low = middle } else { high = middle }
        }
        high
    }
}

impl Reflecting {
    /// Boundary term of an edge per length, k ∫ (1/4 + α/π) cos θ dθ, in rad/m.
    fn term(&self, edge: Edge, k: f64) -> f64 {
        let step = FRAC_PI_2 / ANGLES as f64;
        let angles = (0..ANGLES).map(|i| (i as f64 + 0.5) * step);
        k * step * angles.map(|theta| (0.25 + self.phase(edge, k, theta) / PI) * theta.cos()).sum::<f64>()
    }

    /// The phase α of a wave of wavenumber `k` (rad/m) that an edge reflects at the angle of incidence `theta`.
    fn phase(&self, edge: Edge, k: f64, theta: f64) -> f64 {
        let (normal, along) = (k * theta.cos(), k * theta.sin());
        if self.bending <= 0.0 {
            return match edge {
                Edge::Clamped | Edge::Supported => -FRAC_PI_2,
                Edge::Free => 0.0,
                Edge::Elastic { lift, .. } => -(lift / (self.tension * normal)).atan(),
            };
        }
        let evanescent = (k * k + along * along + self.tension / self.bending).sqrt();
        match edge {
            Edge::Supported => -FRAC_PI_2,
            Edge::Clamped => -FRAC_PI_2 - (normal / evanescent).atan(),
            Edge::Free => self.free(normal, along, evanescent),
            Edge::Elastic { lift, tilt } => {
                let z = |lift: f64, tilt: f64| self.coupling(lift, tilt, normal, along, evanescent);
                // From a free edge on, each spring in turn: straight lines in the complex plane, along which the phase turns by less than π.
                let [free, lifted, held] = [z(0.0, 0.0), z(lift, 0.0), z(lift, tilt)];
                self.free(normal, along, evanescent) - (lifted / free).arg() - (held / lifted).arg()
            }
        }
    }

    /// Phase α of a wave reflected at a free edge, where neither bending moment nor Kirchhoff's shear force
    /// acts.
    fn free(&self, normal: f64, along: f64, evanescent: f64) -> f64 {
        let [n2, a2, e2] = [normal, along, evanescent].map(|q| q * q);
        let (nu, tau) = (self.poisson, self.tension / self.bending);
        let travelling = normal * (n2 + (2.0 - nu) * a2 + tau) * (e2 - nu * a2);
        let decaying = evanescent * (e2 - (2.0 - nu) * a2 - tau) * (n2 + nu * a2);
        (decaying / travelling).atan()
    }

    /// Determinant of the two conditions at an elastic edge, for the reflected and the evanescent wave: moment D(w'' - ν ξ² w) = tilt w' and
    /// shear force D(w''' - (2 - ν) ξ² w') - T w' = -lift w, inwards from the edge, with ξ the wavenumber along it.
    fn coupling(&self, lift: f64, tilt: f64, normal: f64, along: f64, evanescent: f64) -> c64 {
        let (bending, nu, square) = (self.bending, self.poisson, along * along);
        let moment = |q: c64| (q * q - nu * square) * bending - q * tilt;
        let shear = |q: c64| (q * q * q - q * ((2.0 - nu) * square)) * bending - q * self.tension + lift;
        let (wave, decay) = (c64::new(0.0, normal), c64::new(-evanescent, 0.0));
        moment(wave) * shear(decay) - shear(wave) * moment(decay)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLATE: Reflecting = Reflecting { tension: 0.0, bending: 3.0, poisson: 0.3 };

    /// The term over that of a membrane's fixed edge, -k/4.
    fn ratio(sheet: Reflecting, edge: Edge, k: f64) -> f64 {
        sheet.term(edge, k) / (-0.25 * k)
    }

    #[test]
    fn edges_have_their_known_terms() {
        // 1 + Γ(3/4)/(√π Γ(5/4)), Vasil'ev 1987.
        let clamped = 1.0 + 1.225_416_702 / (PI.sqrt() * 0.906_402_477);
        assert!((ratio(PLATE, Edge::Clamped, 40.0) / clamped - 1.0).abs() < 1e-3);
        assert!((ratio(PLATE, Edge::Supported, 40.0) - 1.0).abs() < 1e-3);
        // Under much tension a clamped edge is that of a membrane, and a free one its opposite.
        let taut = Reflecting { tension: 1e9, ..PLATE };
        assert!((ratio(taut, Edge::Clamped, 40.0) - 1.0).abs() < 0.01);
        assert!((ratio(taut, Edge::Free, 40.0) + 1.0).abs() < 0.01);
    }

    #[test]
    fn springs_lead_from_a_free_edge_to_a_clamped_one() {
        for sheet in [PLATE, Reflecting { tension: 4e3, ..PLATE }] {
            let of = |lift: f64, tilt: f64| ratio(sheet, Edge::Elastic { lift, tilt }, 40.0);
            let close = |found: f64, edge: Edge| (found - ratio(sheet, edge, 40.0)).abs() < 1e-3;
            assert!(close(of(1e-6, 1e-9), Edge::Free));
            assert!(close(of(1e15, 1e-9), Edge::Supported), "{}", of(1e15, 1e-9));
            assert!(close(of(1e15, 1e12), Edge::Clamped), "{}", of(1e15, 1e12));
            let softer: Vec<f64> = (0..12).map(|i| of(10f64.powi(i), 0.0)).collect();
            assert!(softer.is_sorted(), "{softer:?}");
        }
    }
}
