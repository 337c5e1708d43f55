//! Springs along the elastic sides of a rectangle, as a part of the energy in the Rayleigh-Ritz method.

use super::line::Line;
use unripple_core::Edge;
use unripple_linalg::Mat;

/// The springs at the two ends of one direction of a rectangle, acting on the basis functions along it.
#[derive(Clone, Debug)]
pub(crate) struct Springs {
    /// Twice the springs' energy over ρ_s, functions x functions, in 1/s².
    pub(crate) energy: Mat<f64>,
    /// Whether a spring resists displacement.
    pub(crate) lift: bool,
    /// Whether a spring resists rotation.
    pub(crate) tilt: bool,
}

impl Springs {
    /// The springs at the ends `low` (ξ = -1) and `high` (ξ = 1) of a line of length `side` (m), on a sheet of mass per area
    /// `areal_density` (kg/m²); `None` without springs.
    ///
    /// Twice their energy is ∮ lift u² + tilt (∂u/∂n)² ds. For products orthonormal on [-1, 1]² it is, over ρ_s and along one side,
    /// lift/ρ_s (2/side) f g + tilt/ρ_s (2/side)³ f' g' at the end, times the mass of the functions along the side.
    pub(crate) fn of(line: &Line, [low, high]: [Edge; 2], side: f64, areal_density: f64) -> Option<Self> {
        let ends: Vec<(f64, f64, f64)> = [(-1.0, low), (1.0, high)]
            .into_iter()
            .filter_map(|(xi, edge)| match edge {
                Edge::Elastic { lift, tilt } => Some((xi, lift, tilt)),
                _ => None,
            })
            .collect();
        if ends.is_empty() {
            return None;
        }
        let count = line.count();
        let mut energy = Mat::zeros(count, count);
        for (xi, lift, tilt) in &ends {
            let jets = line.derivatives_at(*xi);
            let displaced = lift / areal_density * (2.0 / side);
            let turned = tilt / areal_density * (2.0 / side).powi(3);
            for (j, g) in jets.iter().enumerate() {
                for (i, f) in jets.iter().enumerate() {
                    energy[(i, j)] += displaced * f[0] * g[0] + turned * f[1] * g[1];
                }
            }
        }
        // Between equal springs even and odd functions do not couple, but for rounding errors.
        if low == high {
            for j in 0..count {
                ((j + 1) % 2..count).step_by(2).for_each(|i| energy[(i, j)] = 0.0);
            }
        }
        let any = |stiffness: fn(&(f64, f64, f64)) -> f64| ends.iter().any(|end| stiffness(end) > 0.0);
        Some(Self { energy, lift: any(|end| end.1), tilt: any(|end| end.2) })
    }

    /// The sum of the squared frequencies (rad²/s²) of the springs alone, a bound of the largest.
    pub(crate) fn trace(&self) -> f64 {
        (0..self.energy.nrows()).map(|i| self.energy[(i, i)]).sum()
    }
}
