//! Numbers rounded to significant digits.

/// A number rounded to `digits` significant digits; 0 and numbers that are not finite stay as they are.
pub(super) fn rounded(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    // In units of a power of ten, so that the digits are those of a decimal number.
    let unit = 10f64.powi(digits - 1 - value.abs().log10().floor() as i32);
    (value * unit).round() / unit
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn digits_are_those_of_a_decimal_number() {
        let shown = |value: f64, digits: i32| rounded(value, digits).to_string();
        assert_eq!(shown(0.010_606, 2), "0.011");
        assert_eq!(shown(114.8, 2), "110");
        assert_eq!(shown(60e-6 * 1e6, 3), "60");
        assert_eq!(shown(-5.806_451, 3), "-5.81");
        assert_eq!(shown(0.0, 2), "0");
        assert!(rounded(f64::NAN, 2).is_nan());
    }
}
