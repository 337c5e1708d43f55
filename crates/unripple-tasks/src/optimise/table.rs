//! The table of a search: all designs as comma-separated values (RFC 4180), generation by generation.

use super::told::Told;
use crate::TaskError;
use crate::sweep::{field, text};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;
use unripple_store::{SearchFile, write_durably};

/// Writes the table: a line for each design, in order, with its generation, values, hash and version, its figures, how far it is out of its
/// bounds where there are any, and the error of one that failed. What is unknown is an empty field.
///
/// # Errors
/// [`TaskError::Work`] if it cannot be written.
pub(super) fn write(
    path: &Path,
    search: &SearchFile,
    names: &[String],
    told: &[Told],
) -> Result<(), TaskError> {
    let figures = columns(told);
    let bounded = !search.constraints.is_empty();
    let own = ["index", "generation"].into_iter().chain(names.iter().map(String::as_str));
    let own = own.chain(["hash", "version"]).chain(figures.iter().map(String::as_str));
    let last = bounded.then_some("violation").into_iter().chain(["error"]);
    let heading: Vec<String> = own.chain(last).map(text).collect();
    let fill = |file: &mut dyn Write| {
        write!(file, "{}\r\n", heading.join(","))?;
        told.iter().try_for_each(|told| write!(file, "{}\r\n", line(told, names, &figures, bounded)))
    };
    Ok(write_durably(path, fill)?)
}

/// Number of designs in a table; 0 where there is none.
pub(super) fn rows(path: &Path) -> usize {
    let lines = fs::read_to_string(path).map_or(0, |text| text.matches("\r\n").count());
    lines.saturating_sub(1)
}

/// The figures that any design has, in the order in which they come first.
fn columns(told: &[Told]) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let all = told.iter().flat_map(|told| &told.row.figures.0).map(|(name, _)| name);
    all.filter(|name| seen.insert(*name)).cloned().collect()
}

/// The line of a design.
fn line(told: &Told, names: &[String], figures: &[String], bounded: bool) -> String {
    let row = &told.row;
    let mut fields = vec![told.index.to_string(), told.generation.to_string()];
    fields.extend(names.iter().map(|name| field(&told.value(name))));
    fields.extend([text(&row.hash), text(&row.version)]);
    fields.extend(figures.iter().map(|name| row.figures.get(name).map_or_else(String::new, field)));
    if bounded {
        let known = told.losses.is_some();
        fields.push(if known { field(&Value::from(told.violation)) } else { String::new() });
    }
    fields.push(told.error.as_deref().map_or_else(String::new, text));
    fields.join(",")
}
