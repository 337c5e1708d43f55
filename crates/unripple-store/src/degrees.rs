//! Angles: degrees in files, radians inside. Products are made on decimal digits and rounded once, so that every angle
//! has a text that gives it back exactly; a product of two `f64` would miss a tenth of them.

use crate::decimal;

/// π/180 as digits of a whole number, and the power of ten that goes with it.
const RADIANS: (&str, i64) = ("17453292519943295769236907684886127134428719", -45);
/// 180/π, in the same form.
const DEGREES: (&str, i64) = ("5729577951308232087679815481410517033240547", -41);
/// Largest number of digits of a text that are looked at: 17 are enough to tell neighbouring `f64` apart.
const MOST_DIGITS: usize = 60;

/// The angle in radians nearest to `text` in degrees, a decimal number as Rust parses it; `None` if it is not one.
pub(crate) fn radians(text: &str) -> Option<f64> {
    let plain: f64 = text.parse().ok()?;
    if !plain.is_finite() || plain == 0.0 {
        return Some(plain);
    }
    product(text, RADIANS)?.parse().ok()
}

/// The shortest decimal text in degrees that [`radians`] turns back into `value`, which must be finite.
pub(crate) fn text(value: f64) -> String {
    let about = value.to_degrees();
    let short = (0..17).map(|digits| format!("{about:.digits$e}"));
    let exact = product(&format!("{value:.40e}"), DEGREES).and_then(|long| shortened(&long));
    let fits = |text: &String| radians(text) == Some(value);
    decimal::plain(&short.chain(exact).find(fits).unwrap_or_else(|| format!("{about:e}")))
}

/// A decimal number times a constant, in scientific notation.
fn product(text: &str, (factor, power): (&str, i64)) -> Option<String> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let exponent: i64 = exponent.parse().ok()?;
    let (sign, mantissa) = match mantissa.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", mantissa.trim_start_matches('+')),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let all = format!("{whole}{part}");
    let digits = all.trim_start_matches('0');
    let kept = &digits[..digits.len().min(MOST_DIGITS)];
    let exponent =
        exponent + power + i64::try_from(digits.len() - kept.len()).ok()? - i64::try_from(part.len()).ok()?;
    Some(format!("{sign}{}e{exponent}", times(kept, factor)))
}

/// The product of two whole numbers in decimal digits.
fn times(a: &str, b: &str) -> String {
    let mut sums = vec![0_u32; a.len() + b.len()];
    for (i, x) in a.bytes().rev().enumerate() {
        for (j, y) in b.bytes().rev().enumerate() {
            sums[i + j] += u32::from(x - b'0') * u32::from(y - b'0');
        }
    }
    let mut carry = 0;
    let mut digits: Vec<char> = Vec::new();
    for sum in sums {
        carry += sum;
        digits.push(char::from_digit(carry % 10, 10).unwrap_or('0'));
        carry /= 10;
    }
    digits.iter().rev().collect()
}

/// A number `digits e exponent` in scientific notation with at most 24 digits.
fn shortened(long: &str) -> Option<String> {
    let (digits, exponent) = long.split_once('e')?;
    let (sign, digits) = match digits.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", digits),
    };
    let digits = digits.trim_start_matches('0');
    let (first, rest) = digits.split_at_checked(1)?;
    let exponent: i64 = exponent.parse::<i64>().ok()? + i64::try_from(rest.len()).ok()?;
    Some(format!("{sign}{first}.{}e{exponent}", &rest[..rest.len().min(23)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    #[test]
    fn reads_and_writes_round_angles() {
        for (degrees, value) in
            [("90", FRAC_PI_2), ("180", PI), ("-90", -FRAC_PI_2), ("360", TAU), ("0", 0.0)]
        {
            assert_eq!(radians(degrees), Some(value));
            assert_eq!(text(value), degrees);
        }
        assert_eq!(text(radians("30").unwrap()), "30");
        assert_eq!(text(radians("-12.25").unwrap()), "-12.25");
        assert_eq!(radians("1.5e1"), radians("15"));
        assert_eq!(radians("abc"), None);
        assert!(radians("nan").unwrap().is_nan());
        assert_eq!(radians("1e99999999999999999999"), Some(f64::INFINITY));
    }

    proptest! {
        #[test]
        fn agrees_with_a_plain_product(degrees in -1e4..1e4_f64) {
            let read = radians(&format!("{degrees}")).unwrap();
            prop_assert!((read - degrees.to_radians()).abs() <= 2.0 * f64::EPSILON * read.abs());
        }

        #[test]
        fn comes_back_exactly(value in -20.0..20.0_f64, small in 1e-12..1.0_f64) {
            prop_assert_eq!(radians(&text(value)), Some(value));
            prop_assert_eq!(radians(&text(value * small)), Some(value * small));
        }
    }
}
