//! What a loss factor does to decay rates beyond the first order: modes that damping couples.

use super::eigen::product;
use unripple_core::Edge;
use unripple_linalg::{Mat, MatRef, Par};

/// Share 1 - s of a mode's energy that is not bending, times this, bounds the part of its [`second`] that is due to modes far above,
/// where tension holds a uniform sheet at clamped and supported sides: in a boundary layer the energy is as √D, of which (1 + jη)^½ leaves
/// η²/8. With half this value, nothing would be left for wide layers.
const LAYERED: f64 = 0.25;

/// The same wherever stiff parts may move almost without bending (on springs, with free sides, under discs): for an energy D/(D + t), the
/// part is D²/(D + t)², at most 1.
const STIFF: f64 = 1.0;

/// The share of what is not bending by which modes far above count in [`second`], from the conditions at all sides.
pub(crate) fn far(edges: &[Edge], uniform: bool) -> f64 {
    if uniform && !edges.iter().any(|edge| edge.moves()) { LAYERED } else { STIFF }
}

/// Bounds of the relative errors of the decay rates η s ω/2 that a loss factor η causes, divided by η², to second order.
///
/// With a bending stiffness D (1 + jη), the ω² of a mode becomes an eigenvalue of Λ + jηB, where Λ holds the squares ω_m² of the modes
/// without loss and B their bending energies. With b_mn = B_mn/(ω_m ω_n), s = b_mm and v_n = b_mn ω_n²/(ω_m² - ω_n²) it is
/// ω_m² (1 + jηs - η² Σ b_mn v_n - jη³ (vᵀbv - s Σ v_n² ω_m²/ω_n²)), so that σ/(η s ω/2) is
/// 1 + η² (½ Σ b_mn v_n - vᵀbv/s + Σ v_n² ω_m²/ω_n² - s²/8). `squares` are ascending, `bending` is B, both in 1/s². Modes above those given
/// are taken to couple as much as those equally far below, and those farther by the share `far` of what is not bending. No v_n counts more
/// than `most`: with 1/η, modes so close that the loss mixes them have at most exchanged their rates.
pub(crate) fn second(squares: &[f64], bending: MatRef<f64>, far: f64, most: f64) -> Vec<f64> {
    let count = squares.len();
    if count == 0 {
        return Vec::new();
    }
    let scaled = |i: usize, j: usize| {
        let product = (squares[i] * squares[j]).sqrt();
        if product > 0.0 { bending[(i, j)] / product } else { 0.0 }
    };
    let shares = Mat::from_fn(count, count, scaled);
    let follows = Mat::from_fn(count, count, |n, m| match n == m || squares[n] == squares[m] {
        // Modes of exactly equal frequency are of different symmetry.
        true => 0.0,
        false => (shares[(n, m)] * squares[n] / (squares[m] - squares[n])).clamp(-most, most),
    });
    let moved = product(shares.as_ref(), follows.as_ref(), Par::Seq);
    let last = squares.last().copied().unwrap_or_default();
    (0..count).map(|m| of_mode(m, (squares, last), [&shares, &follows, &moved], far)).collect()
}

/// The bound of one mode, from b, the v of all modes in columns, and b times these.
fn of_mode(
    m: usize,
    (squares, last): (&[f64], f64),
    [shares, follows, moved]: [&Mat<f64>; 3],
    far: f64,
) -> f64 {
    let (square, share) = (squares[m], shares[(m, m)].clamp(0.0, 1.0));
    if share <= 0.0 || square <= 0.0 {
        return 0.0;
    }
    let (mut known, mut mirrored) = (-share * share / 8.0, 0.0);
    for (n, other) in squares.iter().enumerate().filter(|(n, other)| *n != m && **other > 0.0) {
        let (b, v) = (shares[(n, m)], follows[(n, m)]);
        known += 0.5 * b * v - v * moved[(n, m)] / share + v * v * square / other;
        let image = 2.0 * square - other;
        if *other < square && image > last {
            // As far above as this one is below.
            let v = v.abs() * image / other;
            mirrored += v * v / share + 0.5 * (b * v).abs();
        }
    }
    known.abs() + mirrored + far * (1.0 - share)
}

/// The bound of [`second`] for modes that a loss does not couple, from their shares of bending.
pub(crate) fn uncoupled(shares: &[f64]) -> Vec<f64> {
    shares.iter().map(|share| share * share / 8.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_linalg::c64;

    /// σ over η s ω/2, less 1, of both modes of two that a loss couples: the roots of a quadratic equation.
    fn exact([low, high]: [f64; 2], b: [f64; 3], eta: f64) -> [f64; 2] {
        let j = |x: f64| c64::new(0.0, eta * x);
        let (first, second) = (c64::new(low, 0.0) + j(b[0] * low), c64::new(high, 0.0) + j(b[2] * high));
        let between = j(b[1] * (low * high).sqrt());
        let (half, apart) = ((first + second) * 0.5, (first - second) * 0.5);
        let root = (apart * apart + between * between).sqrt();
        let root = if root.re < 0.0 { -root } else { root };
        let rate =
            |square: c64, share: f64, own: f64| square.sqrt().im / (0.5 * eta * share * own.sqrt()) - 1.0;
        [rate(half - root, b[0], low), rate(half + root, b[2], high)]
    }

    #[test]
    fn two_coupled_modes_are_bounded_closely() {
        let eta = 0.01;
        for (squares, b) in
            [([1.0, 1.5], [0.3, 0.2, 0.4]), ([1.0, 1.1], [0.2, 0.1, 0.5]), ([1.0, 4.0], [0.1, 0.0, 0.2])]
        {
            let energy = |i: usize, j: usize| {
                let size: f64 = squares[i] * squares[j];
                b[i + j] * size.sqrt()
            };
            let found = second(&squares, Mat::from_fn(2, 2, energy).as_ref(), 0.0, f64::INFINITY);
            for (m, exact) in exact(squares, b, eta).into_iter().enumerate() {
                let bound = eta * eta * found[m];
                assert!(exact.abs() < 1.02 * bound, "{squares:?} {m}: {exact:e} {bound:e}");
                // The upper mode may have others above it.
                let most = if m == 0 { 1.05 } else { 30.0 };
                assert!(bound < most * exact.abs(), "{squares:?} {m}: {exact:e} {bound:e}");
            }
        }
    }

    #[test]
    fn a_loss_that_couples_nothing_leaves_an_eighth() {
        let eta = 0.05;
        let bound = eta * eta * uncoupled(&[1.0])[0];
        let exact = 1.0 - c64::new(1.0, eta).sqrt().im / (0.5 * eta);
        assert!(exact > 0.0 && exact < bound && bound < 1.01 * exact, "{exact:e} {bound:e}");
    }
}
