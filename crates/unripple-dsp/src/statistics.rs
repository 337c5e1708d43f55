//! Means and medians.

/// Mean square of some values, in their unit squared; 0 if there are none.
pub fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64
}

/// Root mean square of some values, in their unit; 0 if there are none.
pub fn rms(values: &[f64]) -> f64 {
    mean_square(values).sqrt()
}

/// The median of some values, in their unit; `None` if there are none. For an even number of values it is the greater of the two
/// in the middle (not their mean).
///
/// ```
/// assert_eq!(unripple_dsp::median([3.0, 1.0, 2.0, 5.0]), Some(3.0));
/// ```
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}
