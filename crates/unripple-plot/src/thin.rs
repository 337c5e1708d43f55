//! Long curves reduced to what print can show: min-max decimation.

/// Width of a column within which only extremes are kept, in points: one dot at 300 dots an inch.
const COLUMN: f64 = 0.24;

/// A curve running rightwards with many points to a column keeps each column's first, extreme and last points; any other is unchanged.
pub(crate) fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let columns = ((last[0] - first[0]) / COLUMN).max(1.0);
    let rightwards = points.windows(2).all(|pair| pair[1][0] >= pair[0][0]);
    if !rightwards || (points.len() as f64) < 5.0 * columns {
        return points.to_vec();
    }
    let column = |point: &[f64; 2]| ((point[0] - first[0]) / COLUMN).floor();
    points.chunk_by(|a, b| column(a) == column(b)).flat_map(extremes).collect()
}

/// First, lowest, highest and last points of a column, in the order in which the curve runs through them.
fn extremes(column: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let by_height = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
    let lowest = (0..column.len()).min_by(by_height).unwrap_or(0);
    let highest = (0..column.len()).max_by(by_height).unwrap_or(0);
    let mut kept = vec![0, lowest, highest, column.len() - 1];
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| column[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_survive_and_short_curves_are_untouched() {
        let curve: Vec<[f64; 2]> =
            (0..200_000).map(|i| [f64::from(i) * 1e-3, (f64::from(i) * 0.7).sin()]).collect();
        let mut spiked = curve.clone();
        spiked[123_456][1] = 40.0;
        let thin = thinned(&spiked);
        assert!(thin.len() < 10_000, "{}", thin.len());
        assert!(
            thin.contains(&spiked[123_456]) && thin.contains(&spiked[0]) && thin.contains(&spiked[199_999])
        );
        let sparse: Vec<[f64; 2]> = curve.iter().step_by(900).copied().collect();
        assert_eq!(thinned(&sparse), sparse);
        assert!(thinned(&[]).is_empty());
    }
}
