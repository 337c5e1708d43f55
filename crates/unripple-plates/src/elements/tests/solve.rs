//! Eigenvalues of small problems, dense.

use crate::elements::{Forms, Space};
use crate::fabric::Fabric;
use unripple_core::*;
use unripple_linalg::{Cholesky, Mat, Scale, exact_symmetric, solve_lower, solve_upper_alone};

/// A sheet of unit mass per area with a bending stiffness and a tension on a square outline of some size.
pub(super) fn surface(size: f64, bending: f64, tension: f64, poisson: f64) -> Surface {
    let thickness = 1e-3;
    let sheet = Sheet {
        material: "test".into(),
        young: bending * 12.0 * (1.0 - poisson * poisson) / f64::powi(thickness, 3),
        density: 1.0 / thickness,
        poisson,
        strength: None,
        thickness,
        tension,
        decay: Decay::Time(1.0),
        air: Air::None,
        uneven: Uneven::default(),
    };
    Surface {
        name: "test".into(),
        outline: Outline::new(Shape::Rectangle { width: size, height: size }),
        sheet,
        emission: Emission { band: [0.0, 1.0], rate: 2.0, limit: 1.0, rms_limit: None },
        finger: Finger::default(),
        accuracy: None,
        actuators: vec![],
    }
}

/// The fabric of such a sheet.
pub(super) fn fabric(bending: f64, tension: f64, poisson: f64) -> Fabric {
    Fabric::of(&surface(1.0, bending, tension, poisson)).unwrap()
}

/// The lowest ω² and mass-normalised vectors, with a shift that makes the stiffness definite.
pub(super) fn modes(forms: &Forms, shift: f64) -> (Vec<f64>, Mat<f64>) {
    let mass = forms.mass.to_dense();
    let n = mass.nrows();
    let stiff = forms.stiffness.to_dense() + Scale(shift) * &mass;
    let factor = Cholesky::new(stiff.as_ref()).unwrap();
    let lower = factor.lower();
    let mut left = mass.clone();
    solve_lower(lower, left.as_mut());
    let mut both = left.transpose().to_owned();
    solve_lower(lower, both.as_mut());
    let (values, mut vectors) = exact_symmetric(both.as_ref()).unwrap();
    solve_upper_alone(lower.transpose(), vectors.as_mut());
    let squares: Vec<f64> = values.iter().rev().map(|v| 1.0 / v - shift).collect();
    let shapes = Mat::from_fn(n, n, |i, m| vectors[(i, n - 1 - m)] / values[n - 1 - m].sqrt());
    (squares, shapes)
}

/// The lowest ω of a sheet on a space.
pub(super) fn omegas(space: &Space, fabric: &Fabric, shift: f64, count: usize) -> Vec<f64> {
    let (squares, _) = modes(&space.assemble(fabric), shift);
    squares.iter().take(count).map(|s| s.max(0.0).sqrt()).collect()
}
