//! Units of files to SI and back without a lost digit.

/// The number that `text` times ten to the `power` is nearest to: how a file's units become SI without rounding twice.
///
/// `text` is a decimal number as Rust parses it. `None` if it is not one.
pub(crate) fn scaled(text: &str, power: i32) -> Option<f64> {
    let Some(cut) = text.find(['e', 'E']) else {
        return if text.bytes().any(|b| b.is_ascii_digit()) {
            format!("{text}e{power}").parse().ok()
        } else {
            text.parse().ok()
        };
    };
    match text[cut + 1..].parse::<i32>() {
        Ok(exponent) => format!("{}e{}", &text[..cut], exponent.saturating_add(power)).parse().ok(),
        Err(_) => text.parse().ok(),
    }
}

/// The shortest decimal text that [`scaled`] with the opposite `power` turns back into `value`, which must be finite.
pub(crate) fn text(value: f64, power: i32) -> String {
    written(&format!("{value:e}"), power)
}

/// A number in scientific notation as people write it, zeros at its end left out.
pub(crate) fn plain(scientific: &str) -> String {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let mantissa =
        if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    written(&format!("{mantissa}e{exponent}"), 0)
}

/// A number in Rust's scientific notation, times ten to the `power`, as people write it.
fn written(plain: &str, power: i32) -> String {
    let (mantissa, exponent) = plain.split_once('e').unwrap_or((plain, "0"));
    let exponent = exponent.parse::<i32>().unwrap_or(0) + power;
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(rest) => ("-", rest.replace('.', "")),
        None => ("", mantissa.replace('.', "")),
    };
    if digits.bytes().all(|d| d == b'0') {
        return "0".into();
    }
    if !(-6..16).contains(&exponent) {
        let tail = if digits.len() > 1 { &digits[1..] } else { "0" };
        return format!("{sign}{}.{tail}e{exponent}", &digits[..1]);
    }
    let point = exponent + 1;
    if point <= 0 {
        return format!("{sign}0.{}{digits}", "0".repeat(point.unsigned_abs() as usize));
    }
    let point = point.unsigned_abs() as usize;
    match digits.len() {
        n if n <= point => format!("{sign}{digits}{}", "0".repeat(point - n)),
        _ => format!("{sign}{}.{}", &digits[..point], &digits[point..]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn reads_as_the_literal_in_si() {
        assert_eq!(scaled("0.125", -3), Some(0.125e-3));
        assert_eq!(scaled("0.1", -3), Some(0.1e-3));
        assert_eq!(scaled("1.5e2", -3), Some(0.15));
        assert_eq!(scaled("4", 9), Some(4e9));
        assert_eq!(scaled("-inf", -3), Some(f64::NEG_INFINITY));
        assert!(scaled("nan", 3).is_some_and(f64::is_nan));
        assert_eq!(scaled("1e99999999999", -3), Some(f64::INFINITY));
        assert_eq!(scaled("abc", 0), None);
    }

    #[test]
    fn writes_what_people_write() {
        assert_eq!(text(0.125e-3, 3), "0.125");
        assert_eq!(text(4e9, -9), "4");
        assert_eq!(text(0.012, 3), "12");
        assert_eq!(text(-48000.5, 0), "-48000.5");
        assert_eq!(text(0.0, 3), "0");
        assert_eq!(text(1e-20, 0), "1.0e-20");
    }

    proptest! {
        #[test]
        fn comes_back_exactly(value in proptest::num::f64::NORMAL, power in -9_i32..10) {
            // Away from the ends of the range, where the shifted text overflows or turns subnormal.
            prop_assume!((1e-200..1e200).contains(&value.abs()));
            prop_assert_eq!(scaled(&text(value, power), -power), Some(value));
        }
    }
}
