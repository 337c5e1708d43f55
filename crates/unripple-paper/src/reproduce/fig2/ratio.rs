//! A ratio as text.

/// A ratio with one decimal, or a dash where there is none.
pub(super) fn ratio(value: Option<f64>) -> String {
    value.map_or("-".into(), |value| format!("{value:.1}"))
}
