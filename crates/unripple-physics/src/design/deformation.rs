//! Deformation of the sheet by a displacement: slope, strain, added tension.

use crate::Medium;
use std::f64::consts::{PI, TAU};
use unripple_core::{Sheet, Surface};

/// Amplitudes of a focus in the table, in metres; the last two are those of the paper. Other values would give other
/// rows of the table.
const AMPLITUDES: [f64; 3] = [10e-6, 40e-6, 200e-6];

/// Relative change of tension taken as the limit of linear theory: frequencies then shift by 5 %. With
/// twice this value, the limit of displacement grows by √2.
pub(super) const TENSION_CHANGE: f64 = 0.1;

/// Strains of the sheet at several amplitudes of displacement, and the limits of linear theory.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Deformation {
    /// Strain at yield or fracture, strength/E; `None` where the strength is unknown.
    pub yield_strain: Option<f64>,
    /// Strain of the sheet at rest due to its tension, (1 - ν) R/Eh.
    pub tension_strain: f64,
    /// Strains and slopes of plane waves, one row for each of several amplitudes.
    pub rows: Vec<Bend>,
    /// Amplitude at which the strain reaches yield, in metres; `None` where the strength is unknown or tension alone reaches it.
    pub yield_amplitude_m: Option<f64>,
    /// Limit of linear theory by thickness, in metres: beyond a displacement of one thickness, a plate stretches as much as it bends.
    pub linear_limit_thickness_m: f64,
    /// Limit of linear theory by tension, in metres: the displacement of a focus that changes the tension by a tenth; `None` without
    /// tension.
    ///
    /// A focus 2J_1(kr)/kr of height A has ∫(∇u)²dS = 2πA². In-plane waves spread the stretching over the sheet within a period,
    /// to a strain of πA²/2S in each direction, so that ΔR = Eh/(1 - ν) · πA²/2S.
    pub linear_limit_tension_m: Option<f64>,
}

/// Strains by a plane wave of the shortest wavelength at one amplitude: an upper bound for a focus of that
/// amplitude, whose curvature is a quarter of the wave's.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Bend {
    /// Amplitude A, in metres.
    pub amplitude_m: f64,
    /// Radius of curvature 1/Ak² at the crest of a plane wave, in metres.
    pub bending_radius_m: f64,
    /// Radius of curvature 4/Ak² at the top of a focus 2J_1(kr)/kr, in metres.
    pub focus_bending_radius_m: f64,
    /// Largest slope Ak, dimensionless.
    pub slope: f64,
    /// Strain on the faces of the sheet by bending, Ak² h/2.
    pub bending_strain: f64,
    /// Strain of the sheet's middle plane where the slope is largest, (Ak)²/2.
    pub stretching_strain: f64,
    /// Sum of the strains by tension, bending and stretching.
    pub strain: f64,
    /// Total strain relative to the strain at yield; `None` where the strength is unknown.
    pub share_of_yield: Option<f64>,
    /// Whether linear theory holds: the amplitude is below both limits of [`Deformation`].
    pub linear: bool,
}

/// Strains of a surface, and its limits of linear theory, at the shortest wavelength of its band.
pub fn deformation(surface: &Surface) -> Deformation {
    let sheet = &surface.sheet;
    let k = TAU / Medium::of(sheet).lambda_min(surface.emission.band[1]);
    let yield_strain = sheet.strength.map(|strength| strength / sheet.young);
    let tension_strain = (1.0 - sheet.poisson) * sheet.tension / (sheet.young * sheet.thickness);
    let limit = tension_limit(sheet, surface.outline.area());
    let bend = |amplitude: f64| {
        let (bending_strain, stretching_strain) = strains(sheet, k, amplitude);
        let strain = tension_strain + bending_strain + stretching_strain;
        Bend {
            amplitude_m: amplitude,
            bending_radius_m: 1.0 / (amplitude * k * k),
            focus_bending_radius_m: 4.0 / (amplitude * k * k),
            slope: amplitude * k,
            bending_strain,
            stretching_strain,
            strain,
            share_of_yield: yield_strain.map(|y| strain / y),
            linear: amplitude <= sheet.thickness && limit.is_none_or(|limit| amplitude <= limit),
        }
    };
    Deformation {
        yield_strain,
        tension_strain,
        rows: AMPLITUDES.map(bend).to_vec(),
        yield_amplitude_m: yield_strain.and_then(|y| yield_amplitude(sheet, k, y - tension_strain)),
        linear_limit_thickness_m: sheet.thickness,
        linear_limit_tension_m: limit,
    }
}

/// Strains Ak² h/2 by bending and (Ak)²/2 by stretching.
fn strains(sheet: &Sheet, k: f64, amplitude: f64) -> (f64, f64) {
    (amplitude * k * k * sheet.thickness / 2.0, (amplitude * k).powi(2) / 2.0)
}

/// The amplitude A at which the strains by bending and stretching sum to `strain` ε: the root of (Ak)² + (Ak) hk = 2ε.
fn yield_amplitude(sheet: &Sheet, k: f64, strain: f64) -> Option<f64> {
    let half = sheet.thickness * k / 2.0;
    (strain > 0.0).then(|| ((half * half + 2.0 * strain).sqrt() - half) / k)
}

fn tension_limit(sheet: &Sheet, area: f64) -> Option<f64> {
    let stretch = sheet.young * sheet.thickness / (1.0 - sheet.poisson);
    (sheet.tension > 0.0).then(|| (TENSION_CHANGE * sheet.tension * 2.0 * area / (PI * stretch)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::papers_surface;

    #[test]
    fn yields_where_it_says() {
        let surface = papers_surface();
        let d = deformation(&surface);
        let k = TAU / Medium::of(&surface.sheet).lambda_min(3000.0);
        let (bending, stretching) = strains(&surface.sheet, k, d.yield_amplitude_m.unwrap());
        let total = d.tension_strain + bending + stretching;
        assert!((total / d.yield_strain.unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn two_hundred_micrometres_are_past_linear_theory() {
        let d = deformation(&papers_surface());
        assert_eq!(d.rows.iter().map(|r| r.linear).collect::<Vec<_>>(), [true, true, false]);
        assert!(d.rows.iter().all(|r| r.share_of_yield.unwrap() < 1.0));
    }

    #[test]
    fn a_focus_stretches_by_its_slope() {
        // ∫(∇u)²dS of u = 2J_1(kr)/kr by quadrature against 2π.
        let (steps, end) = (200_000, 3000.0);
        let width = end / f64::from(steps);
        let integral: f64 = (0..steps)
            .map(|i| (f64::from(i) + 0.5) * width)
            .map(|x| {
                // d/dx 2J_1(x)/x = -2J_2(x)/x, with J_2 by its asymptote where it holds.
                let j2 = if x < 30.0 {
                    unripple_dsp::bessel_j(2, x)
                } else {
                    let (c, s) = ((x - 1.25 * PI).cos(), (x - 1.25 * PI).sin());
                    (2.0 / (PI * x)).sqrt() * (c - 15.0 / (8.0 * x) * s)
                };
                TAU * x * (2.0 * j2 / x).powi(2) * width
            })
            .sum();
        assert!((integral / TAU - 1.0).abs() < 1e-3, "{}", integral / TAU);
    }
}
