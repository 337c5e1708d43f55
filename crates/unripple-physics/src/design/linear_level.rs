//! The largest level of a field that linear theory allows, with a margin.

use super::Linearity;
use super::deformation::TENSION_CHANGE;
use unripple_core::Surface;

/// Share of each bound of linear theory that is used, to leave a margin: half the thickness is well within
/// linear theory. With twice this value, fields may reach the bounds themselves.
const SHARE: f64 = 0.5;

/// The limit of linear theory that a field reaches first as it grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LinearBound {
    /// The displacement reaches the sheet's thickness.
    Thickness,
    /// The tension added by the slopes of the field reaches a tenth of the sheet's tension.
    Tension,
    /// The strain reaches the strain at yield.
    Yield,
}

/// The largest level of a field that linear theory allows, with the bound that limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearLevel {
    /// Factor by which the field is to be multiplied to reach the largest level.
    pub factor: f64,
    /// The bound that the field reaches first as it grows.
    pub bound: LinearBound,
}

impl LinearLevel {
    /// The level at which a field reaches half of its first bound: a displacement of half the thickness, a
    /// change of tension of a twentieth, or a strain half way from rest to yield. `found` describes the
    /// field at its present level. `None` if no bound is known or if the field is zero.
    ///
    /// ```
    /// use unripple_physics::design::{LinearBound, LinearLevel, linearity, papers_surface};
    ///
    /// let film = papers_surface();
    /// let level = LinearLevel::of(&film, &linearity(&film, 1e-3, 0.4, 1e-3, 200.0)).unwrap();
    /// assert_eq!(level.bound, LinearBound::Thickness);
    /// assert!((level.factor * 1e-3 / 62.5e-6 - 1.0).abs() < 1e-12);
    /// ```
    pub fn of(surface: &Surface, found: &Linearity) -> Option<Self> {
        let bounds = [
            (LinearBound::Thickness, Some(SHARE / found.displacement_over_thickness)),
            (
                LinearBound::Tension,
                found.tension_change.map(|change| (SHARE * TENSION_CHANGE / change).sqrt()),
            ),
            (LinearBound::Yield, to_yield(surface, found)),
        ];
        let known = bounds.into_iter().filter_map(|(bound, factor)| Some(Self { factor: factor?, bound }));
        known.filter(|l| l.factor.is_finite() && l.factor > 0.0).min_by(|a, b| a.factor.total_cmp(&b.factor))
    }
}

/// The factor on the field at which bending strain (which grows in proportion) and stretching strain (which
/// grows as the square) together use half of the strain between tension alone and yield; `None` where the
/// strength is unknown or tension alone reaches yield.
fn to_yield(surface: &Surface, found: &Linearity) -> Option<f64> {
    let sheet = &surface.sheet;
    let at_yield = sheet.strength? / sheet.young;
    let moved = found.bending_strain + found.stretching_strain;
    let left = SHARE * (at_yield - (found.share_of_yield? * at_yield - moved));
    let (bend, stretch) = (found.bending_strain, found.stretching_strain);
    // The positive root of stretch·s² + bend·s = left, in the form that bears stretch = 0.
    (left > 0.0).then(|| 2.0 * left / (bend + (bend * bend + 4.0 * stretch * left).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{linearity, papers_surface};

    /// Displacement, slope, mean square slope and curvature, times a factor.
    fn scaled(surface: &Surface, [u, slope, square, bent]: [f64; 4], s: f64) -> Linearity {
        linearity(surface, s * u, s * slope, s * s * square, s * bent)
    }

    #[test]
    fn at_the_level_half_of_one_bound_is_used_and_less_of_the_others() {
        let mut surface = papers_surface();
        let fields = [
            (LinearBound::Thickness, [1e-3, 0.1, 1e-4, 10.0]),
            (LinearBound::Tension, [1e-4, 0.1, 1e-2, 10.0]),
            (LinearBound::Yield, [1e-5, 0.3, 1e-6, 1e3]),
        ];
        for (bound, field) in fields {
            let level = LinearLevel::of(&surface, &scaled(&surface, field, 1.0)).unwrap();
            assert_eq!(level.bound, bound);
            let there = scaled(&surface, field, level.factor);
            assert!(there.holds);
            let rest = scaled(&surface, [0.0; 4], 1.0).share_of_yield.unwrap();
            let used = [
                there.displacement_over_thickness,
                there.tension_change.unwrap() / TENSION_CHANGE,
                (there.share_of_yield.unwrap() - rest) / (1.0 - rest),
            ];
            let most = used.into_iter().fold(0.0, f64::max);
            assert!((most - 0.5).abs() < 1e-9 && (used[bound as usize] - most).abs() < 1e-12, "{used:?}");
        }
        // A plate without tension, of unknown strength: its thickness alone is known.
        (surface.sheet.tension, surface.sheet.strength) = (0.0, None);
        let level = LinearLevel::of(&surface, &scaled(&surface, [1e-4, 0.1, 1e-2, 10.0], 1.0)).unwrap();
        assert_eq!(
            (level.bound, level.factor),
            (LinearBound::Thickness, 0.5 * surface.sheet.thickness / 1e-4)
        );
    }

    #[test]
    fn nothing_known_and_nothing_moved_give_no_level() {
        let mut surface = papers_surface();
        assert_eq!(LinearLevel::of(&surface, &scaled(&surface, [0.0; 4], 1.0)), None);
        surface.sheet.thickness = 0.0;
        (surface.sheet.tension, surface.sheet.strength) = (0.0, None);
        assert_eq!(LinearLevel::of(&surface, &scaled(&surface, [1e-3, 0.1, 1e-2, 10.0], 1.0)), None);
    }
}
