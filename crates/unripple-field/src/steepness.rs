//! Slopes and curvature of the surface, by finite differences.

use crate::{Maps, Snapshot};
use serde::Serialize;

/// Largest slope and curvature of the deflected surface, from displacements alone: they decide whether linear theory
/// holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Steepness {
    /// Largest slope |∇u|, dimensionless.
    pub slope: f64,
    /// Mean square of the slope |∇u| over the surface, dimensionless.
    pub mean_square_slope: f64,
    /// Largest curvature in any direction, in 1/m.
    pub curvature: f64,
}

/// First derivative from five samples, central differences of fourth order (per step): Fornberg, *Math.
/// Comp.* 51, 699 (1988), table 1.
const FIRST: [f64; 5] = [1.0 / 12.0, -8.0 / 12.0, 0.0, 8.0 / 12.0, -1.0 / 12.0];
/// Second derivative from five samples, central differences of fourth order (per step²), from the same
/// table.
const SECOND: [f64; 5] = [-1.0 / 12.0, 16.0 / 12.0, -30.0 / 12.0, 16.0 / 12.0, -1.0 / 12.0];

impl Steepness {
    /// Slope, mean square slope and curvature, each the largest over the snapshots in which the displacement of a target peaks. They are
    /// computed by finite differences on the grid, with an error of about 1 % at a wavelength of eight cells. `None` for sampled
    /// responses, which have no grid. Cells whose stencil of 5 x 5 cells reaches beyond the edge are left out.
    pub fn of(maps: &Maps) -> Option<Self> {
        let each = maps.at_displacement_peak.iter().map(|snapshot| one(maps, snapshot));
        let worst = |a: Self, b: Self| Self {
            slope: a.slope.max(b.slope),
            mean_square_slope: a.mean_square_slope.max(b.mean_square_slope),
            curvature: a.curvature.max(b.curvature),
        };
        each.collect::<Option<Vec<Self>>>().map(|all| all.into_iter().fold(Self::default(), worst))
    }
}

/// Slope and curvature of one snapshot; `None` without a grid.
fn one(maps: &Maps, snapshot: &Snapshot) -> Option<Steepness> {
    let grid = maps.grid.as_ref()?;
    let cells = grid.spread(&snapshot.displacement);
    let mut found = Steepness::default();
    let (mut squares, mut count) = (0.0, 0usize);
    for cell in &grid.inside {
        let (column, row) = (cell % grid.columns, cell / grid.columns);
        if column < 2 || row < 2 || column + 2 >= grid.columns || row + 2 >= grid.rows {
            continue;
        }
        let at = |dx: usize, dy: usize| cells[(row + dy - 2) * grid.columns + column + dx - 2];
        let along = |w: &[f64; 5], f: &dyn Fn(usize) -> f64| (0..5).map(|i| w[i] * f(i)).sum::<f64>();
        let ux = along(&FIRST, &|i| at(i, 2)) / grid.width;
        let uy = along(&FIRST, &|i| at(2, i)) / grid.height;
        let uxx = along(&SECOND, &|i| at(i, 2)) / grid.width.powi(2);
        let uyy = along(&SECOND, &|i| at(2, i)) / grid.height.powi(2);
        let uxy = along(&FIRST, &|j| along(&FIRST, &|i| at(i, j))) / (grid.width * grid.height);
        let square = ux * ux + uy * uy;
        // Places outside the outline are NaN, and whatever needs them is left out.
        let bend = 0.5 * (uxx + uyy).abs() + (0.25 * (uxx - uyy).powi(2) + uxy * uxy).sqrt();
        if square.is_finite() && bend.is_finite() {
            found.slope = found.slope.max(square.sqrt());
            found.curvature = found.curvature.max(bend);
            squares += square;
            count += 1;
        }
    }
    found.mean_square_slope = squares / count.max(1) as f64;
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Grid;
    use unripple_core::{Conditions, Outline, Shape};

    #[test]
    fn a_standing_wave_is_as_steep_as_its_formula() {
        let outline = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 0.0125, outline };
        let grid = Grid::new(&conditions, 8.0).unwrap();
        let (amplitude, k) = (50e-6, std::f64::consts::TAU / 0.0125);
        // Along a diagonal, so that the twist counts.
        let wave = |x: f64, y: f64| amplitude * ((0.6 * x + 0.8 * y) * k).sin();
        let displacement: Vec<f32> = grid.points().iter().map(|p| wave(p.x, p.y) as f32).collect();
        let snapshot = Snapshot { instant: 0.0, velocity: displacement.clone(), displacement };
        let maps = Maps { grid: Some(grid), at_displacement_peak: vec![snapshot], ..Maps::default() };
        let found = Steepness::of(&maps).unwrap();
        assert!((found.slope / (amplitude * k) - 1.0).abs() < 0.02, "{found:?}");
        assert!((found.curvature / (amplitude * k * k) - 1.0).abs() < 0.02, "{found:?}");
        assert!((found.mean_square_slope / (0.5 * (amplitude * k).powi(2)) - 1.0).abs() < 0.03, "{found:?}");
    }

    #[test]
    fn a_library_has_none() {
        assert_eq!(Steepness::of(&Maps { at_displacement_peak: vec![snapshot()], ..Maps::default() }), None);
    }

    fn snapshot() -> Snapshot {
        Snapshot { instant: 0.0, velocity: Vec::new(), displacement: Vec::new() }
    }
}
