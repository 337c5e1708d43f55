//! Fields of fixed width, as Fortran writes them.

use super::lines::{Line, Records};
use crate::ExchangeError;
use crate::error::shown;

/// The columns of a line from `start` on, at most `width`; fewer, or none, if the line is shorter.
pub(super) fn columns(line: &[u8], start: usize, width: usize) -> &[u8] {
    let end = (start + width).min(line.len());
    line.get(start..end).unwrap_or_default()
}

/// A text, without blanks around it; `NONE`, which stands for no text, is empty.
pub(super) fn text(line: &[u8], start: usize, width: usize) -> String {
    let text = String::from_utf8_lossy(columns(line, start, width)).trim().to_owned();
    if text.eq_ignore_ascii_case("none") { String::new() } else { text }
}

impl Records<'_> {
    /// An integer; blanks are 0.
    pub fn integer(
        &self,
        line: Line<'_>,
        start: usize,
        width: usize,
        what: &str,
    ) -> Result<i64, ExchangeError> {
        let field = columns(line.bytes, start, width).trim_ascii();
        if field.is_empty() {
            return Ok(0);
        }
        let read = std::str::from_utf8(field).ok().and_then(|field| field.parse().ok());
        read.ok_or_else(|| {
            let expected = format!("{what}, an integer, in columns {} to {}", start + 1, start + width);
            self.refused_at(line.number, expected, shown(field))
        })
    }

    /// A finite number; blanks are 0.
    pub fn number(
        &self,
        line: Line<'_>,
        start: usize,
        width: usize,
        what: &str,
    ) -> Result<f64, ExchangeError> {
        let field = columns(line.bytes, start, width).trim_ascii();
        if field.is_empty() {
            return Ok(0.0);
        }
        self.finite(line, field, what)
    }

    /// The finite number in a field.
    pub fn finite(&self, line: Line<'_>, field: &[u8], what: &str) -> Result<f64, ExchangeError> {
        parsed(field)
            .filter(|number| number.is_finite())
            .ok_or_else(|| self.refused_at(line.number, format!("{what}, a finite number"), shown(field)))
    }
}

/// A number as Fortran writes it: with E or D before the exponent, or with nothing before one of three digits.
fn parsed(field: &[u8]) -> Option<f64> {
    let field = std::str::from_utf8(field).ok()?;
    if let Ok(number) = field.parse() {
        return Some(number);
    }
    if field.contains(['d', 'D']) {
        return field.replace(['d', 'D'], "E").parse().ok();
    }
    let sign = field.rfind(['+', '-']).filter(|at| *at > 0)?;
    format!("{}E{}", &field[..sign], &field[sign..]).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_fortran_are_read() {
        for (field, number) in
            [("1.5", 1.5), ("-1.5E+01", -15.0), ("1.5D-01", 0.15), ("1.5-100", 1.5e-100), ("7", 7.0)]
        {
            assert_eq!(parsed(field.as_bytes()), Some(number), "{field}");
        }
        for field in ["", "-", "x", "1.5E", "--", "1 2"] {
            assert_eq!(parsed(field.as_bytes()), None, "{field}");
        }
    }

    #[test]
    fn columns_end_with_the_line() {
        assert_eq!(columns(b"abcdef", 2, 3), b"cde");
        assert_eq!(columns(b"abcdef", 4, 10), b"ef");
        assert_eq!(columns(b"abcdef", 9, 3), b"");
        assert_eq!((text(b" NONE ", 0, 6), text(b" m/s  ", 0, 6)), (String::new(), "m/s".to_owned()));
    }
}
