//! Values by names: channels, scales, and keys of surface files.

use super::numbers::FormError;
use crate::calibrate::InputScales;

/// Reads the channel of an actuator, sensor, probe or reference that has another name than its own: `NAME=CHANNEL`.
///
/// # Errors
/// [`FormError`] of a text without a name or without a channel.
///
/// ```
/// let (name, channel) = unripple_tasks::text_forms::wire("a1=system:playback_3")?;
/// assert_eq!((name.as_str(), channel.as_str()), ("a1", "system:playback_3"));
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn wire(text: &str) -> Result<(String, String), FormError> {
    let parts = text.split_once('=').filter(|(name, channel)| !name.is_empty() && !channel.is_empty());
    let (name, channel) = parts.ok_or_else(|| FormError::new(text, "NAME=CHANNEL", format!("`{text}`")))?;
    Ok((name.to_owned(), channel.to_owned()))
}

/// Reads the scales of inputs: `[NAME=]SCALE`, in m/s at full scale for the probe, in the sensor's unit for an actuator; without a name that of all
/// inputs. Of several for the same, the last counts.
///
/// # Errors
/// [`FormError`] of a scale that is 0 or no finite number.
///
/// ```
/// let scales = unripple_tasks::text_forms::input_scales(&["2", "probe=-0.5"])?;
/// assert_eq!((scales.all, scales.named["probe"]), (Some(2.0), -0.5));
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn input_scales(texts: &[impl AsRef<str>]) -> Result<InputScales, FormError> {
    let mut scales = InputScales::default();
    for text in texts {
        let text: &str = text.as_ref();
        let (name, number) = text.split_once('=').map_or((None, text), |(name, number)| (Some(name), number));
        let scale = number.trim().parse::<f64>().ok().filter(|scale| scale.is_finite() && *scale != 0.0);
        let expected = "a number other than 0, as in probe=0.5";
        let scale = scale.ok_or_else(|| FormError::new(text, expected, number))?;
        match name {
            Some(name) => drop(scales.named.insert(name.into(), scale)),
            None => scales.all = Some(scale),
        }
    }
    Ok(scales)
}

/// A key of a surface file and the text behind its `=`, neither with spaces around it; `None` without a key or without `=`.
///
/// ```
/// use unripple_tasks::text_forms::key_and_value;
///
/// assert_eq!(key_and_value("sheet.tension_n_per_m = 220"), Some(("sheet.tension_n_per_m", "220")));
/// assert_eq!(key_and_value("= 220"), None);
/// ```
pub fn key_and_value(text: &str) -> Option<(&str, &str)> {
    let (key, value) = text.split_once('=')?;
    let (key, value) = (key.trim(), value.trim());
    (!key.is_empty()).then_some((key, value))
}

/// Values of a key, separated by commas; a comma within brackets or quotes is part of a value.
///
/// ```
/// assert_eq!(unripple_tasks::text_forms::values("[12, 31],[40, 140]"), ["[12, 31]", "[40, 140]"]);
/// ```
pub fn values(text: &str) -> Vec<&str> {
    let (mut depth, mut quote) = (0, None);
    let parts = text.split(|c: char| {
        match (quote, c) {
            (Some(open), _) if open == c => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0 && quote.is_none()
    });
    parts.map(str::trim).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wire_has_two_ends() {
        for bad in ["a1", "a1=", "=system:playback_3"] {
            let said = wire(bad).unwrap_err().of("--wire");
            assert_eq!(said, format!("--wire {bad}: expected NAME=CHANNEL, found `{bad}`"));
        }
    }

    #[test]
    fn scales_are_numbers_other_than_0() {
        for (bad, found) in [("probe=0", "0"), ("probe=", ""), ("inf", "inf"), ("a1=x", "x")] {
            let said = input_scales(&[bad]).unwrap_err().of("--input-scale");
            let expected = "expected a number other than 0, as in probe=0.5";
            assert_eq!(said, format!("--input-scale {bad}: {expected}, found {found}"));
        }
    }

    #[test]
    fn values_are_separated_by_commas_of_their_own() {
        assert_eq!(values("200, 300,400"), ["200", "300", "400"]);
        assert_eq!(values("[12, 31],[40, 140]"), ["[12, 31]", "[40, 140]"]);
        assert_eq!(values("'glass, thick',steel"), ["'glass, thick'", "steel"]);
        assert_eq!(values(r#"{ a = "]" },2"#), [r#"{ a = "]" }"#, "2"]);
        assert_eq!(values(",0.01"), ["", "0.01"]);
        assert_eq!(values("BoPET"), ["BoPET"]);
    }
}
