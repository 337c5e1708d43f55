//! Assignment of measured frequencies to computed modes by dynamic programming.
//!
//! Frequencies without shapes carry no label: of two that lie close together, the lower one is best assigned to the lower mode at hand,
//! whichever that is. The best assignment therefore keeps the order, and a pair of modes that swaps when parameters change is followed by
//! assigning anew.

/// Price of a mode below the highest measured frequency that was not heard, as a squared residual over its deviation: -2 ln of the odds
/// that one mode in five is missed.
pub(super) const MISSED: f64 = 3.0;

/// Price of a measured frequency that is no mode: beyond four deviations from every mode, something else is more likely.
pub(super) const SPURIOUS: f64 = 16.0;

/// An assignment of measured frequencies to modes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Matching {
    /// Pairs of indices, ascending: of a measured frequency and of the mode that it is.
    pub pairs: Vec<(usize, usize)>,
    /// Sum of the squared residuals over their deviation, and of the prices of what is left over.
    pub cost: f64,
}

/// The least expensive assignment of measured to computed frequencies, both as logarithms and ascending, where the logarithm of a measured
/// one has the standard deviation `deviation`. Modes above the last one that is assigned cost nothing: nobody listened there.
pub(super) fn matched(measured: &[f64], computed: &[f64], deviation: f64) -> Matching {
    let (rows, columns) = (measured.len(), computed.len());
    let square = |i: usize, j: usize| ((measured[i] - computed[j]) / deviation).powi(2);
    let at = |i: usize, j: usize| i * (columns + 1) + j;
    let mut least = vec![f64::INFINITY; (rows + 1) * (columns + 1)];
    for i in 0..=rows {
        for j in 0..=columns {
            let mut best = if i + j == 0 { 0.0 } else { f64::INFINITY };
            if i > 0 && j > 0 {
                best = least[at(i - 1, j - 1)] + square(i - 1, j - 1);
            }
            if i > 0 {
                best = best.min(least[at(i - 1, j)] + SPURIOUS);
            }
            if j > 0 {
                best = best.min(least[at(i, j - 1)] + MISSED);
            }
            least[at(i, j)] = best;
        }
    }
    let end = (0..=columns).reduce(|a, b| if least[at(rows, b)] < least[at(rows, a)] { b } else { a });
    let mut j = end.unwrap_or(0);
    let cost = least[at(rows, j)];
    let (mut i, mut pairs) = (rows, Vec::new());
    // Back along the choices made; each is repeated with the same arithmetic, so that equality is exact.
    while i > 0 || j > 0 {
        let here = least[at(i, j)];
        if i > 0 && j > 0 && here == least[at(i - 1, j - 1)] + square(i - 1, j - 1) {
            (i, j) = (i - 1, j - 1);
            pairs.push((i, j));
        } else if j > 0 && here == least[at(i, j - 1)] + MISSED {
            j -= 1;
        } else if i > 0 {
            i -= 1;
        } else {
            j -= 1;
        }
    }
    pairs.reverse();
    Matching { pairs, cost }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logs(hz: &[f64]) -> Vec<f64> {
        hz.iter().map(|hz| hz.ln()).collect()
    }

    #[test]
    fn a_missed_mode_and_a_spurious_frequency_are_left_over() {
        let computed = logs(&[100.0, 150.0, 200.0, 260.0, 300.0]);
        let measured = logs(&[100.5, 175.0, 199.0, 262.0]);
        let found = matched(&measured, &computed, 0.01);
        assert_eq!(found.pairs, [(0, 0), (2, 2), (3, 3)]);
        let squares: f64 = [(0, 0), (2, 2), (3, 3)]
            .iter()
            .map(|(i, j): &(usize, usize)| ((measured[*i] - computed[*j]) / 0.01).powi(2))
            .sum();
        assert!((found.cost - squares - MISSED - SPURIOUS).abs() < 1e-9);
    }

    #[test]
    fn no_other_assignment_is_cheaper() {
        // All assignments of three frequencies to four modes that keep the order, or leave some over.
        let (measured, computed) = (logs(&[100.0, 103.0, 120.0]), logs(&[98.0, 102.0, 104.0, 119.0]));
        let mut least = f64::INFINITY;
        for code in 0..5_usize.pow(3) {
            let of: Vec<usize> = (0..3).map(|i| code / 5_usize.pow(i) % 5).collect();
            let used: Vec<usize> = of.iter().copied().filter(|j| *j < 4).collect();
            if used.windows(2).any(|two| two[1] <= two[0]) {
                continue;
            }
            let square = |i: usize, j: usize| ((measured[i] - computed[j]) / 0.01_f64).powi(2);
            let fitted: f64 =
                of.iter().enumerate().filter(|(_, j)| **j < 4).map(|(i, j)| square(i, *j)).sum();
            let missed = used.last().map_or(0, |last| last + 1 - used.len());
            least = least.min(fitted + MISSED * missed as f64 + SPURIOUS * (3 - used.len()) as f64);
        }
        assert!((matched(&measured, &computed, 0.01).cost - least).abs() < 1e-9);
    }

    #[test]
    fn nothing_is_matched_with_nothing() {
        assert_eq!(matched(&[], &logs(&[100.0]), 0.01), Matching::default());
        assert_eq!(matched(&logs(&[100.0]), &[], 0.01), Matching { pairs: vec![], cost: SPURIOUS });
    }
}
