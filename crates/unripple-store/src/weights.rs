//! Tables of weights at points of a surface, as CSV: a map of how much each part of it counts.

use crate::StoreError;
use crate::file::read_text;
use std::path::Path;
use unripple_core::Point;

/// The first line of a table.
const COLUMNS: [&str; 3] = ["x_mm", "y_mm", "weight"];

/// Reads a table of weights: a line `x_mm,y_mm,weight`, then one for each point. Empty lines, and lines that begin with `#`, are passed
/// over. Places are given in m, with their weights, which are pure numbers.
///
/// # Errors
/// [`StoreError::Read`]; [`StoreError::Content`] of other columns, of what is no finite number, of a weight below 0, of a table without a
/// point, and of a file over 1 MiB.
///
/// ```
/// use unripple_core::Point;
///
/// let path = std::env::temp_dir().join(format!("unripple-doc-weights-{}.csv", std::process::id()));
/// std::fs::write(&path, "x_mm,y_mm,weight\n75,75,3\n10, 10, 0.5\n").unwrap();
/// let weights = unripple_store::read_weights(&path)?;
/// assert_eq!(weights, [(Point::new(0.075, 0.075), 3.0), (Point::new(0.01, 0.01), 0.5)]);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn read_weights(path: impl AsRef<Path>) -> Result<Vec<(Point, f64)>, StoreError> {
    let path = path.as_ref();
    parsed(&read_text(path)?, &path.display().to_string())
}

/// The rows of a table; `name` is that of its file, for messages.
fn parsed(text: &str, name: &str) -> Result<Vec<(Point, f64)>, StoreError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = (1..).zip(text.lines().map(str::trim));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let (_, first) = lines.next().unwrap_or_default();
    if !first.split(',').map(str::trim).eq(COLUMNS) {
        let expected = format!("a first line `{}`", COLUMNS.join(","));
        return Err(StoreError::content(name, expected, format!("`{first}`")));
    }
    let rows = lines.map(|(number, line)| row(line).ok_or_else(|| fault(name, number, line)));
    let rows = rows.collect::<Result<Vec<_>, _>>()?;
    match rows.iter().any(|(_, weight)| *weight > 0.0) {
        true => Ok(rows),
        false => Err(StoreError::content(name, "at least one point with a weight above 0", "none")),
    }
}

/// The place (m) and the weight of a line.
fn row(line: &str) -> Option<(Point, f64)> {
    let mut numbers = line.split(',').map(|part| part.trim().parse::<f64>().ok().filter(|x| x.is_finite()));
    let (x, y, weight) = (numbers.next()??, numbers.next()??, numbers.next()??);
    (numbers.next().is_none() && weight >= 0.0).then(|| (Point::new(x / 1e3, y / 1e3), weight))
}

fn fault(name: &str, number: usize, line: &str) -> StoreError {
    let expected = format!("two places in mm and a weight from 0 in line {number}");
    StoreError::content(name, expected, format!("`{line}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spaces_comments_and_line_endings_do_not_matter() {
        let text = "\u{feff}# a screen\r\n\r\nx_mm, y_mm, weight\r\n 1, 2 ,0\r\n# more\r\n3,4,1e1\r\n";
        let read = parsed(text, "map.csv").unwrap();
        assert_eq!(read, [(Point::new(1e-3, 2e-3), 0.0), (Point::new(3e-3, 4e-3), 10.0)]);
    }

    #[test]
    fn faults_are_told_with_their_line() {
        let head = "x_mm,y_mm,weight\n";
        for (text, said) in [
            (String::new(), "map.csv: expected a first line `x_mm,y_mm,weight`, found ``"),
            ("1,2,3\n".into(), "map.csv: expected a first line `x_mm,y_mm,weight`, found `1,2,3`"),
            (head.to_owned(), "map.csv: expected at least one point with a weight above 0, found none"),
            (
                format!("{head}1,2,0\n"),
                "map.csv: expected at least one point with a weight above 0, found none",
            ),
            (
                format!("{head}1,2,3\n1,2\n"),
                "map.csv: expected two places in mm and a weight from 0 in line 3, found `1,2`",
            ),
        ] {
            assert_eq!(parsed(&text, "map.csv").unwrap_err().to_string(), said);
        }
        for bad in ["1,2,-1", "1,2,inf", "1,x,1", "1,2,3,4", "1,,3"] {
            assert!(parsed(&format!("{head}{bad}\n"), "map.csv").is_err(), "{bad}");
        }
    }
}
