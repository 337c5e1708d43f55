//! SI prefixes for axes.

/// The SI prefix for data with a given largest value: the factor to multiply the data by, and the unit with
/// its prefix. With them, the largest value becomes a number from 1 to 1000.
///
/// From pico to giga; a value of zero or one that is not finite keeps the unit as it is.
///
/// # Example
/// ```
/// assert_eq!(unripple_plot::prefixed(0.043, "m/s"), (1e3, "mm/s".to_owned()));
/// ```
pub fn prefixed(largest: f64, unit: &str) -> (f64, String) {
    const PREFIXES: [&str; 8] = ["p", "n", "µ", "m", "", "k", "M", "G"];
    if largest == 0.0 || !largest.is_finite() {
        return (1.0, unit.to_owned());
    }
    let thousands = ((largest.abs().log10() + 1e-12) / 3.0).floor().clamp(-4.0, 3.0) as i32;
    let multiplier = 10f64.powi(-3 * thousands);
    let prefix = PREFIXES.get((thousands + 4) as usize).copied().unwrap_or_default();
    (multiplier, format!("{prefix}{unit}"))
}

#[cfg(test)]
mod tests {
    use super::prefixed;

    #[test]
    fn prefixes_follow_the_decades() {
        for (largest, multiplier, unit) in [
            (1.0, 1.0, "N"),
            (999.0, 1.0, "N"),
            (1000.0, 1e-3, "kN"),
            (-2.5e-6, 1e6, "µN"),
            (1e-30, 1e12, "pN"),
            (0.0, 1.0, "N"),
            (f64::NAN, 1.0, "N"),
        ] {
            let (found, name) = prefixed(largest, "N");
            assert!((found / multiplier - 1.0).abs() < 1e-12, "{largest}");
            assert_eq!(name, unit);
        }
    }
}
