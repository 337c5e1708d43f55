//! Check of linear theory: whether the deflections of a field are small enough.

use super::deformation::TENSION_CHANGE;
use unripple_core::Surface;

/// How close the deflections of a field come to the limits of linear theory: displacement, strains and
/// added tension, estimated from the field.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Linearity {
    /// Largest displacement relative to the sheet's thickness; from about 1 on, the sheet stretches as much
    /// as it bends.
    pub displacement_over_thickness: f64,
    /// Largest slope |∇u|, dimensionless.
    pub slope: f64,
    /// Strain on the faces of the sheet by bending, curvature · h/2.
    pub bending_strain: f64,
    /// Strain of the sheet's middle plane where the slope is largest, slope²/2.
    pub stretching_strain: f64,
    /// Tension that the deflection adds, spread evenly over the sheet by in-plane waves: Eh/(1 - ν) · ⟨|∇u|²⟩/4, in N/m.
    pub tension_added_n_per_m: f64,
    /// The added tension relative to the sheet's tension; `None` without tension.
    pub tension_change: Option<f64>,
    /// Total strain by tension, bending and stretching relative to the strain at yield; `None` where the
    /// strength is unknown.
    pub share_of_yield: Option<f64>,
    /// Whether linear theory holds: displacement at most the thickness, tension changed by at most a tenth,
    /// strain below yield.
    pub holds: bool,
}

/// Checks whether linear theory holds for a field on a surface, given the field's largest displacement (m)
/// and slope, the mean square of its slope over the sheet, and its largest curvature (1/m).
///
/// A deflection u lengthens a line along x by the strain ½u_x². Its mean over the sheet, ⟨|∇u|²⟩/4 in each direction, adds to
/// the tension once in-plane waves, which are fifty times faster than bending waves on a film, have spread it.
///
/// ```
/// use unripple_physics::design::{linearity, papers_surface};
///
/// let film = papers_surface();
/// assert!(linearity(&film, 10e-6, 4e-3, 1e-7, 2.0).holds);
/// assert!(!linearity(&film, 200e-6, 80e-3, 1e-4, 40.0).holds);
/// ```
pub fn linearity(
    surface: &Surface,
    displacement: f64,
    slope: f64,
    mean_square_slope: f64,
    curvature: f64,
) -> Linearity {
    let sheet = &surface.sheet;
    let stretch = sheet.young * sheet.thickness / (1.0 - sheet.poisson);
    let tension_added = stretch * mean_square_slope / 4.0;
    let tension_change = (sheet.tension > 0.0).then(|| tension_added / sheet.tension);
    let at_rest = if stretch > 0.0 { sheet.tension / stretch } else { 0.0 };
    let (bending_strain, stretching_strain) = (curvature * sheet.thickness / 2.0, slope * slope / 2.0);
    let share_of_yield =
        sheet.strength.map(|s| (at_rest + bending_strain + stretching_strain) * sheet.young / s);
    let displacement_over_thickness = displacement / sheet.thickness;
    let holds = displacement_over_thickness <= 1.0
        && tension_change.is_none_or(|change| change <= TENSION_CHANGE)
        && share_of_yield.is_none_or(|share| share <= 1.0);
    Linearity {
        displacement_over_thickness,
        slope,
        bending_strain,
        stretching_strain,
        tension_added_n_per_m: tension_added,
        tension_change,
        share_of_yield,
        holds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{deformation, papers_surface};
    use std::f64::consts::PI;

    #[test]
    fn agrees_with_the_limits_told_beforehand() {
        // A focus 2J_1(kr)/kr of height A has ∫|∇u|² dS = 2πA²: at the limit that `design` states, a tenth.
        let film = papers_surface();
        let limit = deformation(&film).linear_limit_tension_m.unwrap();
        let mean_square = 2.0 * PI * limit * limit / film.outline.area();
        let found = linearity(&film, limit, 0.0, mean_square, 0.0);
        assert!((found.tension_change.unwrap() / TENSION_CHANGE - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_membrane_stretched_twice_as_steeply_adds_four_times_the_tension() {
        let film = papers_surface();
        let once = linearity(&film, 1e-6, 1e-3, 1e-6, 0.0).tension_added_n_per_m;
        let twice = linearity(&film, 2e-6, 2e-3, 4e-6, 0.0).tension_added_n_per_m;
        assert!((twice / once - 4.0).abs() < 1e-12);
    }
}
