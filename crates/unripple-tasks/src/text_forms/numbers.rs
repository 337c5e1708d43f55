//! Numbers as they are typed, alone or separated by commas, and what is wrong with a text.

use std::fmt;

/// What is wrong with a text, or with a number that stands for itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormError {
    /// The text that is at fault; `None` for a number that stands for itself.
    pub text: Option<String>,
    /// The quantity in it that is at fault, if the text is otherwise in its form.
    pub quantity: Option<&'static str>,
    /// Description of the form or the numbers that are accepted.
    pub expected: String,
    /// What was found instead.
    pub found: String,
}

impl fmt::Display for FormError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(text) = &self.text {
            write!(f, "{text}: ")?;
        }
        if let Some(quantity) = self.quantity {
            write!(f, "{quantity}: ")?;
        }
        write!(f, "expected {}, found {}", self.expected, self.found)
    }
}

impl std::error::Error for FormError {}

impl FormError {
    /// The message with the name of the option or argument that the text was typed for.
    pub fn of(&self, name: &str) -> String {
        match self.text {
            Some(_) => format!("{name} {self}"),
            None => format!("{name}: {self}"),
        }
    }

    pub(super) fn new(text: &str, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self { text: Some(text.into()), quantity: None, expected: expected.into(), found: found.into() }
    }

    /// The error of a text that stands behind another one.
    pub(super) fn behind(self, before: &str) -> Self {
        let text = self.text.map_or_else(|| before.to_owned(), |text| format!("{before} {text}"));
        Self { text: Some(text), ..self }
    }

    /// The error of a number, as that of a quantity in a text.
    pub(super) fn within(self, text: &str, quantity: &'static str) -> Self {
        Self { text: Some(text.into()), quantity: Some(quantity), ..self }
    }
}

/// Reads `least` to `most` finite numbers separated by commas, in whatever unit `form` names for errors.
///
/// # Errors
/// [`FormError`] of another count, or of what is no finite number.
///
/// ```
/// use unripple_tasks::text_forms::numbers;
///
/// assert_eq!(numbers("6, 12", "LEAST,MOST in mm", 2, 2)?, [6.0, 12.0]);
/// let error = numbers("6,inf", "LEAST,MOST in mm", 2, 2).unwrap_err();
/// assert_eq!(error.to_string(), "6,inf: expected LEAST,MOST in mm, found `inf`");
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn numbers(text: &str, form: &str, least: usize, most: usize) -> Result<Vec<f64>, FormError> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    if !(least..=most).contains(&parts.len()) {
        return Err(FormError::new(text, form, format!("{} numbers", parts.len())));
    }
    parts
        .iter()
        .map(|part| match part.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(FormError::new(text, form, format!("`{part}`"))),
        })
        .collect()
}

/// Returns `value` if it is finite and above 0; the error names its `unit`.
///
/// # Errors
/// [`FormError`] of any other number.
///
/// ```
/// use unripple_tasks::text_forms::above_zero;
///
/// assert_eq!(above_zero(-3.0, "ms").unwrap_err().of("--window-ms"), "--window-ms: expected a number above 0 ms, found -3");
/// ```
pub fn above_zero(value: f64, unit: &str) -> Result<f64, FormError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    let (expected, found) = (format!("a number above 0 {unit}"), value.to_string());
    Err(FormError { text: None, quantity: None, expected, found })
}

/// Reads the start and the end of a time, `FROM,TO` in ms; gives them in s.
///
/// # Errors
/// [`FormError`] of another form, of a start before 0, and of an end that is not after the start.
///
/// ```
/// use unripple_tasks::text_forms::interval;
///
/// assert_eq!(interval("0,30")?, [0.0, 0.03]);
/// assert!(interval("30,0").is_err());
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn interval(text: &str) -> Result<[f64; 2], FormError> {
    let ms = numbers(text, "FROM,TO in ms", 2, 2)?;
    match ms[0] >= 0.0 && ms[1] > ms[0] {
        true => Ok([ms[0] / 1e3, ms[1] / 1e3]),
        false => Err(FormError::new(text, "0 <= FROM < TO", "otherwise")),
    }
}

/// Reads a band of frequencies, `LOW,HIGH`, in Hz.
///
/// # Errors
/// [`FormError`] of anything but two numbers.
///
/// ```
/// use unripple_tasks::text_forms::band;
///
/// assert_eq!(band("20,2000")?, [20.0, 2000.0]);
/// assert!(band("20").is_err());
/// # Ok::<(), unripple_tasks::text_forms::FormError>(())
/// ```
pub fn band(text: &str) -> Result<[f64; 2], FormError> {
    let hz = numbers(text, "LOW,HIGH in Hz", 2, 2)?;
    Ok([hz[0], hz[1]])
}
