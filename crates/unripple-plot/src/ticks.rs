//! Values and labels of ticks.

/// Values of the ticks of a linear axis: multiples of 1, 2 or 5 times a power of ten, at most `most` of them, all
/// from `low` to `high`.
///
/// Empty if the ends are not finite or not in order, if they are less than 1e-300 apart, if `most` is 0, or if no multiple
/// of the step lies between the ends.
///
/// # Example
/// ```
/// assert_eq!(unripple_plot::nice_ticks(-0.3, 10.2, 6), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
/// ```
pub fn nice_ticks(low: f64, high: f64, most: usize) -> Vec<f64> {
    let Some(step) = nice_step(low, high, most) else {
        return Vec::new();
    };
    multiples(step, low, high)
}

/// The smallest of 1, 2 or 5 times a power of ten with at most `most` multiples from `low` to `high`.
fn nice_step(low: f64, high: f64, most: usize) -> Option<f64> {
    let span = high - low;
    if !(span.is_finite() && span >= CLOSEST) || most == 0 {
        return None;
    }
    let first = (span / most as f64).log10().floor() as i32 - 1;
    (first..first + 4)
        .flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(exponent)))
        .find(|&step| step > 0.0 && count(step, low, high) <= most as f64)
}

/// Least distance of the ends of an axis with ticks: far below, steps are denormal numbers or zero.
const CLOSEST: f64 = 1e-300;

fn count(step: f64, low: f64, high: f64) -> f64 {
    (high / step + SLACK).floor() - (low / step - SLACK).ceil() + 1.0
}

/// Share of a step by which rounding may move a tick past an end.
const SLACK: f64 = 1e-9;

fn multiples(step: f64, low: f64, high: f64) -> Vec<f64> {
    let first = (low / step - SLACK).ceil();
    let count = count(step, low, high).clamp(0.0, 1000.0) as usize;
    (0..count).map(|i| ((first + i as f64) * step).clamp(low, high)).collect()
}

/// Minor ticks of a linear axis: four or five to each step between the major ones.
pub(crate) fn linear_minor(major: &[f64], low: f64, high: f64) -> Vec<f64> {
    let [first, second, ..] = major else {
        return Vec::new();
    };
    let step = second - first;
    let digit = step / 10f64.powf((step * (1.0 + 1e-9)).log10().floor());
    let parts = if (1.5..3.0).contains(&digit) { 4.0 } else { 5.0 };
    let near = |v: f64| major.iter().any(|m| (m - v).abs() < 1e-3 * step);
    multiples(step / parts, low, high).into_iter().filter(|&v| !near(v)).collect()
}

/// Major and minor places on a logarithmic axis with at most `most` major ones; both ends must be positive.
pub(crate) fn logarithmic(low: f64, high: f64, most: usize) -> (Vec<f64>, Vec<f64>) {
    let inside = |v: &f64| (low * (1.0 - SLACK)..=high * (1.0 + SLACK)).contains(v);
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let of = |digits: &'static [f64]| {
        (first..=last)
            .flat_map(move |k| digits.iter().map(move |d| d * 10f64.powi(k)))
            .filter(inside)
            .collect::<Vec<f64>>()
    };
    let decades = of(&[1.0]);
    let fine = of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    let mut major = [of(&[1.0, 2.0, 5.0]), of(&[1.0, 3.0])]
        .into_iter()
        .find(|places| decades.len() < 3 && (2..=most.min(5)).contains(&places.len()))
        .unwrap_or_else(|| every(decades.clone(), most));
    if major.len() < 2 {
        major = nice_ticks(low, high, most.max(2)).into_iter().filter(|v| *v > 0.0).collect();
    }
    let spacing = major.len() < decades.len();
    let minor = if spacing { decades } else { fine };
    let minor = minor.into_iter().filter(|v| !major.iter().any(|m| (m / v - 1.0).abs() < 1e-6)).collect();
    (major, minor)
}

/// Every n-th place, so that at most `most` are left.
fn every(places: Vec<f64>, most: usize) -> Vec<f64> {
    let stride = places.len().div_ceil(most.max(1)).max(1);
    places.into_iter().step_by(stride).collect()
}

/// Labels of linear ticks with the decimals their step needs, and the power of a thousand taken out of all of them.
pub(crate) fn labels(places: &[f64]) -> (Vec<String>, Option<i32>) {
    let largest = places.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if largest == 0.0 {
        return (places.iter().map(|_| "0".to_owned()).collect(), None);
    }
    let exponent = (largest * (1.0 + SLACK)).log10().floor() as i32;
    let power = (!(-3..=4).contains(&exponent)).then(|| exponent.div_euclid(3) * 3);
    let scaled: Vec<f64> = places.iter().map(|v| v / 10f64.powi(power.unwrap_or(0))).collect();
    let step = scaled.windows(2).map(|w| (w[1] - w[0]).abs()).fold(f64::INFINITY, f64::min);
    let decimals = if step.is_finite() && step > 0.0 { decimals_of(step) } else { decimals_of(scaled[0]) };
    (scaled.iter().map(|v| fixed(*v, decimals)).collect(), power)
}

/// Decimals that write a value of few digits exactly, at most 9.
fn decimals_of(value: f64) -> usize {
    (0..9)
        .find(|&decimals| {
            let shifted = value.abs() * 10f64.powi(decimals);
            (shifted - shifted.round()).abs() <= 1e-6 * shifted
        })
        .unwrap_or(9) as usize
}

/// The largest of 1, 2 or 5 times a power of ten that is not above a positive value; 1 for any other.
pub(crate) fn round_below(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10f64.powi(value.log10().floor() as i32);
    let digit = [5.0, 2.0, 1.0].into_iter().find(|digit| digit * decade <= value).unwrap_or(1.0);
    digit * decade
}

/// A number with a true minus sign, and no sign on zero.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// A number as short as its first three digits allow, as for the label of a scale bar.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if !(-3..=4).contains(&exponent) {
        return in_powers(value);
    }
    let unit = 10f64.powi(exponent - 2);
    fixed((value / unit).round() * unit, decimals_of((value / unit).round() * unit))
}

/// Labels of logarithmic ticks: plain numbers near one, powers of ten otherwise.
pub(crate) fn log_labels(places: &[f64]) -> Vec<String> {
    let plain = places.iter().all(|v| (0.99e-2..=1.01e4).contains(v));
    places.iter().map(|&v| if plain { fixed(v, decimals_of(v)) } else { in_powers(v) }).collect()
}

/// A number as digits times a power of ten, the digits left out where they are 1.
fn in_powers(value: f64) -> String {
    let exponent = (value.abs() * (1.0 + 1e-9)).log10().floor() as i32;
    let digits = value / 10f64.powi(exponent);
    if (digits - 1.0).abs() < 1e-6 {
        return power_of_ten(exponent);
    }
    format!("{}·{}", fixed(digits, decimals_of(digits).min(2)), power_of_ten(exponent))
}

/// 10 with its exponent raised.
pub(crate) fn power_of_ten(exponent: i32) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ticks_are_nice_and_inside() {
        for (low, high) in
            [(0.0, 1.0), (-3.7, 12.9), (1e-9, 3e-9), (-1e6, 7e5), (99.7, 100.3), (0.03, 0.0301)]
        {
            for most in 2..12 {
                let ticks = nice_ticks(low, high, most);
                assert!(!ticks.is_empty() && ticks.len() <= most, "{low} {high} {most} {ticks:?}");
                assert!(ticks.iter().all(|t| (low..=high).contains(t)));
                for pair in ticks.windows(2) {
                    let step = pair[1] - pair[0];
                    let digit = step / 10f64.powf((step * 1.000_001).log10().floor());
                    assert!([1.0, 2.0, 5.0].iter().any(|d| (digit - d).abs() < 1e-4), "{step}");
                }
            }
        }
    }

    #[test]
    fn degenerate_ranges_have_no_ticks() {
        for (low, high) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (0.0, 5e-324)] {
            assert!(nice_ticks(low, high, 5).is_empty());
        }
        assert!(nice_ticks(0.0, 1.0, 0).is_empty());
    }

    #[test]
    fn minor_ticks_lie_between_major_ones() {
        let minor = linear_minor(&[0.0, 0.2, 0.4], 0.0, 0.5);
        let expected = [0.05, 0.1, 0.15, 0.25, 0.3, 0.35, 0.45, 0.5];
        assert_eq!(minor.len(), expected.len());
        assert!(minor.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{minor:?}");
    }

    #[test]
    fn logarithmic_ticks_suit_their_range() {
        let (major, minor) = logarithmic(0.5, 2e4, 8);
        assert_eq!(major, [1.0, 10.0, 100.0, 1e3, 1e4]);
        assert!(minor.contains(&2.0) && minor.contains(&9e3) && !minor.contains(&10.0));
        assert_eq!(logarithmic(4.0, 60.0, 8).0, [5.0, 10.0, 20.0, 50.0]);
        assert!(logarithmic(1e-12, 1e12, 6).0.len() <= 6);
        assert!(logarithmic(3.1, 3.4, 6).0.len() >= 2);
    }

    #[test]
    fn labels_are_short_and_signed_properly() {
        assert_eq!(labels(&[-0.5, 0.0, 0.5]), (vec!["−0.5".into(), "0.0".into(), "0.5".into()], None));
        assert_eq!(labels(&[0.0, 2e5, 4e5]), (vec!["0".into(), "200".into(), "400".into()], Some(3)));
        assert_eq!(labels(&[1e-7, 2e-7]).1, Some(-9));
        assert_eq!(log_labels(&[1.0, 10.0, 100.0]), ["1", "10", "100"]);
        assert_eq!(log_labels(&[1e-12, 1e5]), ["10⁻¹²", "10⁵"]);
        assert_eq!(power_of_ten(-1234567890), "10⁻¹²³⁴⁵⁶⁷⁸⁹⁰");
        for (value, below) in [(0.75, 0.5), (4.9, 2.0), (1.0, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(round_below(value), below);
        }
        assert_eq!(short(0.05), "0.05");
        assert_eq!(short(200.0), "200");
        assert_eq!(short(2e-6), "2·10⁻⁶");
    }
}
