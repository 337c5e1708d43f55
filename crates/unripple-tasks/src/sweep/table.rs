//! The table of a sweep: all rows as comma-separated values (RFC 4180).

use super::Row;
use super::folder::Folder;
use super::tally::Tally;
use crate::TaskError;
use serde_json::Value;
use std::io::{self, Write};
use unripple_store::write_durably;

/// Name of the table in the folder.
pub(crate) const TABLE: &str = "table.csv";

/// Writes the table: a line for each design, in order, with its values, hash and version, its figures, and the error of one that failed. What
/// is unknown is an empty field.
///
/// # Errors
/// [`TaskError::Work`] if it cannot be written, or a shard cannot be read.
pub(super) fn write(folder: &Folder, tally: &Tally) -> Result<(), TaskError> {
    let labels: Vec<String> = folder.plan.file().designs.varied().iter().map(ToString::to_string).collect();
    let own = ["index"].into_iter().chain(labels.iter().map(String::as_str)).chain(["hash", "version"]);
    let figures = tally.columns.iter().map(String::as_str);
    let heading: Vec<String> = own.chain(figures).chain(["error"]).map(text).collect();
    let fill = |file: &mut dyn Write| {
        write!(file, "{}\r\n", heading.join(","))?;
        let each = folder
            .each(&mut |row| write!(file, "{}\r\n", line(&row, &labels, tally)).map_err(TaskError::work));
        each.map_err(|error| io::Error::other(error.to_string()))
    };
    Ok(write_durably(folder.file(TABLE), fill)?)
}

/// The line of a row.
fn line(row: &Row, labels: &[String], tally: &Tally) -> String {
    let mut fields = vec![row.index.to_string()];
    fields.extend(labels.iter().map(|label| row.values.get(label).map_or_else(String::new, field)));
    fields.extend([text(&row.hash), text(&row.version)]);
    let mut figures = vec![String::new(); tally.columns.len()];
    for (name, value) in &row.figures.0 {
        if let Some(place) = tally.place_of(name) {
            figures[place] = field(value);
        }
    }
    fields.extend(figures);
    fields.push(row.error.as_deref().map_or_else(String::new, text));
    fields.join(",")
}

/// A field that holds a value.
pub(crate) fn field(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(found) => text(found),
        other => text(&other.to_string()),
    }
}

/// A field that holds text; quoted where it has to be.
pub(crate) fn text(text: &str) -> String {
    match text.contains([',', '"', '\r', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn fields_are_quoted_where_they_must_be() {
        assert_eq!(field(&json!([1, 2])), "\"[1,2]\"");
        assert_eq!(field(&json!("a \"b\"\nc")), "\"a \"\"b\"\"\nc\"");
        assert_eq!(
            (field(&json!(0.1)), field(&json!(1e-9)), field(&Value::Null)),
            ("0.1".into(), "1e-9".into(), String::new())
        );
    }
}
