//! The error of frequencies estimated from three meshes, each finer than the mesh before, by the rate at
//! which they converge.

use super::sizing::PACE;

/// The frequencies computed on one mesh.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Mean edge length of the mesh, in metres.
    pub(super) edge: f64,
    /// ω² of the modes, ascending, in 1/s².
    pub(super) squares: Vec<f64>,
    /// Share of bending in the elastic energy of each mode.
    pub(super) shares: Vec<f64>,
}

/// Safety factor on the estimated error: differences of two unstructured meshes vary by a factor of about 2
/// from one pair of meshes to another. At 3, one estimate in a hundred would be below the true error.
const SAFETY: f64 = 4.0;
/// Number of modes on each side of a mode whose differences are considered together with its own, since a
/// single difference may be small by chance. Doubled, a few modes at the top would hide the rate of many
/// modes below them.
const REACH: usize = 2;
/// Least and greatest order of convergence in the edge length that is accepted as measured. The greatest is
/// the order for which meshes are made everywhere: where smooth parts of the error fall faster, they hide
/// what is left of the others.
const ORDERS: [f64; 2] = [1.5, PACE];
/// Order of convergence assumed if it could not be measured: with it, the remaining error is about as large
/// as the last difference, if edges are 1.3 times shorter.
const ASSUMED: f64 = 2.6;
/// Relative rounding error of frequencies in the solution of the eigenvalue problem.
const ROUNDING: f64 = 2e-9;

/// Least ratio of the mean edge lengths of two meshes that are compared: narrow rims may give similar
/// meshes for different plans. Nearer to 1, their difference says nothing about either error.
const APART: f64 = 1.12;

/// An upper bound of the relative error of any frequency on the last mesh, from three meshes each clearly
/// finer than the mesh before. Infinite unless there are two meshes with about equal numbers of modes.
///
/// Where edges get shorter by a factor a and then by b, an error C h^q leaves differences of the ratio (a^q - 1)/(1 - b^-q), from
/// which q follows (Richardson), and the error d/(b^q - 1) with d the last difference. That of the difference before, taken to fall at
/// [`PACE`], is a lower limit, so that no chance agreement of two meshes is taken for accuracy.
pub(super) fn error(levels: &[Level]) -> f64 {
    let worst = |errors: Vec<f64>| errors.into_iter().fold(0.0, f64::max) + ROUNDING;
    remaining(levels, differences).map_or(f64::INFINITY, worst)
}

/// Bounds of the relative errors of the frequencies on the last mesh, one by one: no mode has less than any below it, since what is left
/// grows with the wavenumber, but at corners. `None` as [`error`] is infinite.
pub(super) fn of_frequencies(levels: &[Level]) -> Option<Vec<f64>> {
    let mut most = 0.0_f64;
    let grown = |error: f64| {
        most = most.max(error);
        most + ROUNDING
    };
    Some(remaining(levels, differences)?.into_iter().map(grown).collect())
}

/// Bounds of the relative errors of the shares of bending on the last mesh, one by one. `None` as [`error`] is infinite.
pub(super) fn of_shares(levels: &[Level]) -> Option<Vec<f64>> {
    let apart = |coarse: &Level, fine: &Level| {
        let differ = |(a, b): (&f64, &f64)| if *b > 0.0 { (a / b - 1.0).abs() } else { 0.0 };
        let all = coarse.shares.iter().zip(&fine.shares);
        comparable(coarse, fine).then(|| all.map(differ).collect::<Vec<f64>>())
    };
    Some(remaining(levels, apart)?.into_iter().map(|error| error + ROUNDING).collect())
}

/// What is left on the last mesh of differences between meshes, mode by mode, up to the end of the shorter of the last two.
fn remaining(levels: &[Level], differences: impl Fn(&Level, &Level) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
    let coarser = |than: &Level| levels.iter().rev().find(|level| level.edge > APART * than.edge);
    let fine = levels.last()?;
    let middle = coarser(fine)?;
    let last = differences(middle, fine)?;
    let coarse = coarser(middle);
    let before = coarse.and_then(|coarse| differences(coarse, middle)).unwrap_or_default();
    let (a, b) = (coarse.map_or(1.0, |coarse| coarse.edge / middle.edge), middle.edge / fine.edge);
    let of = |j: usize| {
        let d = around(&last, j);
        if before.is_empty() {
            return d / (b.powf(ASSUMED) - 1.0);
        }
        let c = around(&before, j);
        let measured = d / (b.powf(rate(c / d, [a, b])) - 1.0);
        measured.max(c / ((a.powf(PACE) - 1.0) * b.powf(PACE)))
    };
    Some((0..last.len()).map(|j| SAFETY * of(j)).collect())
}

/// Share of the requested accuracy that the error on the third mesh is planned to have, if the error falls
/// as the power [`PACE`] of the edge length: it falls faster on most sheets, and not at all on those whose
/// coarser meshes are still too coarse.
const PLANNED: f64 = 0.6;
/// Least and greatest factor by which edges of the third mesh are shorter than those of the second. Less,
/// and their difference says nothing about either error; more, and the third mesh costs more than a fourth
/// would.
const THIRD: [f64; 2] = [1.25, 1.6];

/// The factor by which edges of a third mesh are to be shorter than those of the second of two meshes, so
/// that the bound of its error is `accuracy`.
pub(super) fn finer(levels: &[Level], accuracy: f64) -> f64 {
    let [least, most] = THIRD;
    let [coarse, fine] = levels else { return least };
    let Some(differences) = differences(coarse, fine) else { return most };
    let worst = differences.into_iter().fold(0.0, f64::max);
    let left = SAFETY * worst / ((coarse.edge / fine.edge).powf(PACE) - 1.0);
    (left / (PLANNED * accuracy)).powf(1.0 / PACE).clamp(least, most)
}

/// The order of convergence q, within [`ORDERS`], for which two successive differences have the given
/// ratio; a and b are the factors by which edges got shorter.
fn rate(ratio: f64, [a, b]: [f64; 2]) -> f64 {
    let of = |q: f64| (a.powf(q) - 1.0) / (1.0 - b.powf(-q));
    let [mut low, mut high] = ORDERS;
    if ratio.is_nan() || ratio >= of(high) {
        return high;
    }
    // The ratio rises with the order.
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if of(middle) < ratio { low = middle } else { high = middle }
    }
    low
}

/// The relative differences of the frequencies on two meshes, up to the end of the shorter list; `None` if they cannot be compared.
fn differences(coarse: &Level, fine: &Level) -> Option<Vec<f64>> {
    let differ = |(a, b): (&f64, &f64)| if *b > 0.0 { (0.5 * (a / b - 1.0)).abs() } else { 0.0 };
    comparable(coarse, fine).then(|| coarse.squares.iter().zip(&fine.squares).map(differ).collect())
}

/// Whether the modes on two meshes are the same ones: unless the finer mesh has more than a tenth plus two additional modes.
fn comparable(coarse: &Level, fine: &Level) -> bool {
    fine.squares.len() as f64 <= 1.1 * coarse.squares.len() as f64 + 2.0
}

/// The largest among the difference with index `j` and those of its neighbours; for an index beyond the
/// end, among the last ones.
fn around(differences: &[f64], j: usize) -> f64 {
    let j = j.min(differences.len().saturating_sub(1));
    let end = (j + REACH + 1).min(differences.len());
    differences[j.saturating_sub(REACH)..end].iter().copied().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Levels of frequencies whose relative errors are sums of powers of the edge length.
    fn levels(parts: &[(f64, f64)], finer: [f64; 2]) -> (Vec<Level>, f64) {
        let of = |h: f64| parts.iter().map(|(c, q)| c * h.powf(*q)).sum::<f64>();
        let lengths = [1.0, 1.0 / finer[0], 1.0 / (finer[0] * finer[1])];
        let level = |i: usize| Level {
            edge: lengths[i],
            squares: (1..30).map(|m| (f64::from(m) * (1.0 + of(lengths[i]))).powi(2)).collect(),
            shares: vec![0.3 * (1.0 - of(lengths[i])); 29],
        };
        ((0..3).map(level).collect(), of(lengths[2]))
    }

    #[test]
    fn any_mixture_of_rates_is_bounded() {
        for finer in [[1.3, 1.3], [1.3, 1.6], [1.6, 1.25]] {
            for fast in [0.0, 1e-4, 1e-3, 1e-2, 0.1] {
                for (slow, order) in [(1e-4, 3.0), (1e-4, 5.0), (1e-3, 6.0), (3e-3, 7.0)] {
                    let (levels, exact) = levels(&[(fast, 8.0), (slow, order)], finer);
                    let stated = error(&levels);
                    assert!(stated > exact, "{finer:?} {fast} {slow} {order}: {stated:e} {exact:e}");
                    assert!(stated < 20.0 * exact, "{finer:?} {fast} {slow} {order}: {stated:e} {exact:e}");
                    for each in [of_frequencies(&levels), of_shares(&levels)] {
                        let each = each.unwrap();
                        assert!(each.len() == 29 && each.iter().all(|e| *e > exact && *e < 25.0 * exact));
                    }
                }
            }
        }
    }

    #[test]
    fn chance_agreement_of_two_meshes_is_no_accuracy() {
        let (mut levels, exact) = levels(&[(1e-3, 7.0)], [1.3, 1.3]);
        // As if by chance.
        levels[1].squares = levels[2].squares.iter().map(|s| s * (1.0 + 1e-9)).collect();
        assert!(error(&levels) > 0.5 * exact);
        // Two meshes alone are taken to converge slowly.
        let two = error(&levels[..2]);
        assert!(two > exact, "{two:e} {exact:e}");
    }

    #[test]
    fn meshes_with_unlike_numbers_of_modes_bound_nothing() {
        let (mut levels, _) = levels(&[(1e-3, 7.0)], [1.3, 1.3]);
        levels[1].squares.truncate(20);
        assert!(error(&levels).is_infinite() && error(&levels[..1]).is_infinite());
    }

    #[test]
    fn rates_are_those_of_the_errors() {
        for q in [1.6, 2.5, 4.0, 5.9] {
            for [a, b] in [[1.3, 1.3], [1.3, 1.6], [1.6, 1.25]] {
                let h = |x: f64| x.powf(-q);
                let ratio = (1.0 - h(a)) / (h(a) - h(a * b));
                assert!((rate(ratio, [a, b]) - q).abs() < 1e-9);
            }
        }
        assert_eq!([1e9, f64::NAN].map(|ratio| rate(ratio, [1.3, 1.3])), [ORDERS[1]; 2]);
        assert!(rate(1e-9, [1.3, 1.3]) < ORDERS[0] + 1e-9);
    }
}
