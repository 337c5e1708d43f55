//! Abscissae, which must be even.

use super::spectrum::{DIGITS, OFF};
use crate::TaskError;

/// First value and distance of values at even distances.
///
/// # Errors
/// [`TaskError::Input`] of fewer than two, and of the first that is not where it should be; `place` names its place in the file.
pub(super) fn even(
    values: &[f64],
    what: &str,
    place: impl Fn(usize) -> String,
) -> Result<(f64, f64), TaskError> {
    let [first, .., last] = values else {
        return Err(TaskError::Input(format!(
            "`{what}`: expected two values or more, found {}",
            values.len()
        )));
    };
    let step = (last - first) / (values.len() - 1) as f64;
    if !step.is_finite() || step <= 0.0 {
        return Err(TaskError::Input(format!(
            "`{what}`: expected values that grow, found {first} to {last}"
        )));
    }
    for (n, value) in values.iter().enumerate() {
        let wanted = first + n as f64 * step;
        if (value - wanted).abs() > OFF * step + DIGITS * wanted.abs() {
            return Err(TaskError::Input(format!(
                "{}: expected an even abscissa, with {what} {wanted}, found {value}",
                place(n)
            )));
        }
    }
    Ok((*first, step))
}

#[cfg(test)]
mod tests {
    use super::even;

    #[test]
    fn only_even_values_are_taken() {
        let of =
            |values: &[f64]| even(values, "time_s", |n| format!("line {}", n + 2)).map_err(|e| e.to_string());
        assert_eq!(of(&[1.0, 1.5, 2.0]), Ok((1.0, 0.5)));
        assert!(of(&[0.0, 0.333333, 0.666667, 1.0]).is_ok());
        assert_eq!(
            of(&[0.0, 0.5, 1.5]),
            Err("line 3: expected an even abscissa, with time_s 0.75, found 0.5".to_owned())
        );
        assert!(of(&[0.0]).is_err() && of(&[1.0, 1.0]).is_err() && of(&[1.0, 0.0]).is_err());
    }
}
