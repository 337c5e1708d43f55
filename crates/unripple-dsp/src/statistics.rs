//! Means and medians.

/// Mean of the squares of some values, in their unit squared; 0 of nothing.
pub fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64
}

/// Root of the mean of the squares of some values, in their unit; 0 of nothing.
pub fn rms(values: &[f64]) -> f64 {
    mean_square(values).sqrt()
}

/// The median, one of the values: of an even number of them the greater of the two in the middle; `None` of nothing.
///
/// ```
/// assert_eq!(unripple_dsp::median([3.0, 1.0, 2.0, 5.0]), Some(3.0));
/// ```
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}
