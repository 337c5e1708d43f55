//! Natural frequencies as they are typed, with decay times or quality factors.

use super::FormError;
use std::f64::consts::PI;

/// The form of a list of frequencies.
const FORM: &str = "HZ[:MS] or HZ:Q with a quality factor, as in 73.2,148:35,376:Q120";

/// Reads natural frequencies separated by commas, each in Hz, perhaps with a colon and its decay time in ms, or with a colon, a `Q` and its
/// quality factor. Gives pairs of a frequency in Hz and a decay time in s.
///
/// # Errors
/// [`FormError`] of another form, and of a number that is not above 0.
///
/// ```
/// use unripple_tasks::text_forms::frequencies;
///
/// let found = frequencies("73.2, 148:35, 100:Q314.159265358979")?;
/// assert_eq!(found[..2], [(73.2, None), (148.0, Some(0.035))]);
/// // Q = πfτ.
/// assert!((found[2].1.unwrap() - 1.0).abs() < 1e-12);
/// assert!(frequencies("73.2,a").is_err() && frequencies("-3").is_err() && frequencies("100:Q0").is_err());
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn frequencies(text: &str) -> Result<Vec<(f64, Option<f64>)>, FormError> {
    text.split(',').map(|part| one(text, part.trim())).collect()
}

fn one(text: &str, part: &str) -> Result<(f64, Option<f64>), FormError> {
    let number = |typed: &str| match typed.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err(FormError::new(text, FORM, format!("`{part}`"))),
    };
    let Some((hz, time)) = part.split_once(':') else { return Ok((number(part)?, None)) };
    let hz = number(hz)?;
    let time = match time.trim().strip_prefix(['Q', 'q']) {
        Some(factor) => number(factor)? / (PI * hz),
        None => number(time)? / 1e3,
    };
    Ok((hz, Some(time)))
}
