//! What a displacement does to the sheet: slope, strain, added tension.

use crate::Medium;
use std::f64::consts::{PI, TAU};
use unripple_core::{Sheet, Surface};

/// Amplitudes of a focus that are tabulated, in metres; the last two are the paper's. Others would be other
/// rows of the table.
const AMPLITUDES: [f64; 3] = [10e-6, 40e-6, 200e-6];

/// Change of tension, as a share of the tension, at which linear theory is said to end: modes then shift by 5
/// %. Doubled, the limit of displacement grows by √2.
pub(super) const TENSION_CHANGE: f64 = 0.1;

/// What a displacement does to the sheet.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Deformation {
    /// Strain at yield or fracture, strength/E; `None` where the strength is unknown.
    pub yield_strain: Option<f64>,
    /// Strain by the tension at rest, (1 - ν) R/Eh.
    pub tension_strain: f64,
    /// Strains and slopes, a row per amplitude.
    pub rows: Vec<Bend>,
    /// Amplitude at which the strain reaches yield, in metres.
    pub yield_amplitude_m: Option<f64>,
    /// Displacement equal to the sheet's thickness, beyond which a plate stretches as much as it bends, in metres.
    pub linear_limit_thickness_m: f64,
    /// Displacement of a focus that changes the tension by a tenth, in metres; `None` without tension.
    ///
    /// A focus 2J_1(kr)/kr of height A has ∫(∇u)²dS = 2πA², which lengthens the sheet on the whole by πA²/2S in each
    /// direction, as in-plane waves even it out within a period: ΔR = Eh/(1 - ν) · πA²/2S.
    pub linear_limit_tension_m: Option<f64>,
}

/// A wave of the shortest wavelength at one amplitude: a bound for a focus, whose crest is four times flatter.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Bend {
    /// Amplitude A, in metres.
    pub amplitude_m: f64,
    /// Radius of bending 1/Ak² at the crest of a plane wave, in metres.
    pub bending_radius_m: f64,
    /// Radius of bending 4/Ak² at the top of a focus 2J_1(kr)/kr, in metres.
    pub focus_bending_radius_m: f64,
    /// Steepest slope Ak, dimensionless.
    pub slope: f64,
    /// Strain on the faces by bending, Ak² h/2.
    pub bending_strain: f64,
    /// Strain of the middle plane where the slope is steepest, (Ak)²/2.
    pub stretching_strain: f64,
    /// Strain of tension, bending and stretching together.
    pub strain: f64,
    /// That strain over the strain at yield, as a share.
    pub share_of_yield: Option<f64>,
    /// Whether linear theory still holds: below both limits.
    pub linear: bool,
}

/// Strains and limits of a surface at the shortest wavelength of its band.
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

/// The amplitude whose bending and stretching add to a strain: the root of (Ak)² + (Ak) hk = 2ε.
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
