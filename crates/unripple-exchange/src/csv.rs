//! Tables as CSV: cells between commas, semicolons or tabs, with the names of the columns in the first line.

use crate::error::shown;
use crate::{ExchangeError, Place};
use std::borrow::Cow;

/// Most columns of a table: as many as there are responses of a thousand points to a thousand actuators.
const MOST_COLUMNS: usize = 1 << 20;

/// A table of texts.
#[derive(Clone, Debug)]
pub struct Csv<'a> {
    /// Names of the columns, in the order of the file.
    pub names: Vec<String>,
    rows: &'a str,
    separator: char,
    /// Number of the first line of `rows`.
    first: usize,
    file: &'a str,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row<'a> {
    /// The line of the file, counted from 1.
    pub line: usize,
    /// The cells without blanks around them, one of each column.
    pub cells: Vec<Cow<'a, str>>,
}

/// A table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Names of the columns.
    pub names: Vec<String>,
    /// The numbers of each column, from the top.
    pub values: Vec<Vec<f64>>,
    /// The line of each row, counted from 1.
    pub lines: Vec<usize>,
}

impl<'a> Csv<'a> {
    /// Reads the names of a table's columns. Empty lines and lines that begin with `#` are left out.
    ///
    /// # Errors
    /// [`ExchangeError::Content`] of bytes that are not UTF-8, of a file without columns, and of a name that is empty or there twice.
    pub fn of(bytes: &'a [u8], file: &'a str) -> Result<Self, ExchangeError> {
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let at = Place::Byte(error.valid_up_to());
            ExchangeError::content(file, at, "text in UTF-8", "other bytes")
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (mut rest, mut line) = (text, 1);
        let head = loop {
            let Some((head, after)) = next_line(rest) else {
                let expected = "a table with the names of its columns in the first line";
                return Err(ExchangeError::content(file, Place::Whole, expected, "no line"));
            };
            rest = after;
            if !is_left_out(head) {
                break head;
            }
            line += 1;
        };
        let separator = [',', ';', '\t'].into_iter().max_by_key(|c| (head.matches(*c).count(), *c == ','));
        let separator = separator.unwrap_or(',');
        let names: Vec<String> = split(head, separator).into_iter().map(Cow::into_owned).collect();
        let refused = |expected: &str, found: String| {
            Err(ExchangeError::content(file, Place::Line(line), expected, found))
        };
        if names.len() > MOST_COLUMNS {
            return refused("at most 2^20 columns", names.len().to_string());
        }
        let mut known = std::collections::HashSet::new();
        if let Some(name) = names.iter().find(|name| name.is_empty() || !known.insert(name.as_str())) {
            return refused("a different name for each column", format!("`{name}`"));
        }
        Ok(Self { names, rows: rest, separator, first: line + 1, file })
    }

    /// Index of the column with a name; `None` if there is none.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The rows from the top, each with as many cells as there are columns, or the error of one that has more or fewer.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row<'a>, ExchangeError>> {
        let (mut rest, mut line) = (self.rows, self.first);
        let (separator, columns, file) = (self.separator, self.names.len(), self.file);
        std::iter::from_fn(move || {
            loop {
                let (text, after) = next_line(rest)?;
                rest = after;
                line += 1;
                if !is_left_out(text) {
                    return Some(row(text, separator, columns, line - 1, file));
                }
            }
        })
    }
}

/// Reads a table of numbers.
///
/// # Errors
/// As [`Csv::of`]; [`ExchangeError::Content`] of a row with too few or too many cells, and of a cell that is not a finite number.
pub fn read_columns(bytes: &[u8], file: &str) -> Result<Columns, ExchangeError> {
    let table = Csv::of(bytes, file)?;
    let mut values = vec![Vec::new(); table.names.len()];
    let mut lines = Vec::new();
    for row in table.rows() {
        let row = row?;
        lines.push(row.line);
        for ((cell, column), name) in row.cells.iter().zip(&mut values).zip(&table.names) {
            let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
            let refused = || {
                let expected = format!("a finite number in the column `{name}`");
                ExchangeError::content(file, Place::Line(row.line), expected, shown(cell.as_bytes()))
            };
            column.push(number.ok_or_else(refused)?);
        }
    }
    Ok(Columns { names: table.names, values, lines })
}

/// The first line of a text, and the rest.
fn next_line(text: &str) -> Option<(&str, &str)> {
    if text.is_empty() {
        return None;
    }
    Some(text.split_once('\n').unwrap_or((text, "")))
}

fn is_left_out(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

fn row<'a>(
    text: &'a str,
    separator: char,
    columns: usize,
    line: usize,
    file: &str,
) -> Result<Row<'a>, ExchangeError> {
    let cells = split(text, separator);
    if cells.len() == columns {
        return Ok(Row { line, cells });
    }
    let (expected, found) = (format!("{columns} cells"), cells.len().to_string());
    Err(ExchangeError::content(file, Place::Line(line), expected, found))
}

/// The cells of a line, without blanks around them. A cell in double quotes may hold separators, and a quote as two.
fn split(line: &str, separator: char) -> Vec<Cow<'_, str>> {
    let line = line.trim_end_matches('\r');
    if !line.contains('"') {
        return line.split(separator).map(|cell| Cow::Borrowed(cell.trim())).collect();
    }
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            _ if letter == separator && !quoted => {
                cells.push(Cow::Owned(cell.trim().to_owned()));
                cell.clear();
            }
            _ => cell.push(letter),
        }
    }
    cells.push(Cow::Owned(cell.trim().to_owned()));
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        read_columns(text.as_bytes(), "t.csv").unwrap_err().to_string()
    }

    #[test]
    fn tables_of_each_separator_are_read() {
        for text in
            ["a,b\n1,2\n3,4\n", "# made by hand\r\na;b\r\n1;2\r\n\r\n3;4", "\u{feff}a\tb\n1\t2\n3\t4\n"]
        {
            let table = read_columns(text.as_bytes(), "t.csv").unwrap();
            assert_eq!(table.names, ["a", "b"]);
            assert_eq!(table.values, [[1.0, 3.0], [2.0, 4.0]], "{text:?}");
        }
        let table = Csv::of(b"file,\"what, and why\"\n\"a \"\"b\"\"\", c \n", "t.csv").unwrap();
        assert_eq!(table.column("what, and why"), Some(1));
        assert_eq!(table.rows().next().unwrap().unwrap().cells, ["a \"b\"", "c"]);
    }

    #[test]
    fn faults_are_named_by_their_lines() {
        assert_eq!(refused("a,b\n1,2\n\n3\n"), "t.csv: line 4: expected 2 cells, found 1");
        assert!(
            refused("a,b\n1,NaN\n")
                .contains("line 2: expected a finite number in the column `b`, found `NaN`")
        );
        assert!(refused("a,a\n").contains("line 1: expected a different name"));
        assert!(refused("# nothing\n\n").contains("found no line"));
        let error = read_columns(b"a,b\n1,\xff\n", "t.csv").unwrap_err();
        assert!(error.to_string().contains("byte 6"), "{error}");
    }
}
