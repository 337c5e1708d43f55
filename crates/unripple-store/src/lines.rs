//! TOML as it is written: line by line, numbers in the file's own units.

use crate::decimal::text;
use std::fmt::Write;
use unripple_core::Point;

/// A file in the making.
#[derive(Default)]
pub(crate) struct Lines(String);

impl Lines {
    /// Begins a table, an empty line before it.
    pub fn table(&mut self, header: &str) {
        self.0.push('\n');
        self.0.push_str(header);
        self.0.push('\n');
    }

    /// Writes a key and its value, which is given as TOML text.
    pub fn line(&mut self, key: &str, value: &str) {
        // Writing to a string does not fail.
        let _ = writeln!(self.0, "{key} = {value}");
    }

    /// The whole file.
    pub fn into_text(self) -> String {
        self.0
    }
}

/// A text in quotation marks.
pub(crate) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// The quoted name of a value among those that have one.
pub(crate) fn named<T: PartialEq>(choices: &[(&str, T)], value: &T) -> String {
    let name = choices.iter().find(|(_, choice)| choice == value).map_or("", |(name, _)| name);
    quoted(name)
}

/// A TOML array of values already written.
pub(crate) fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

/// A place in mm.
pub(crate) fn point(p: &Point) -> String {
    list([p.x, p.y].into_iter().map(|v| text(v, 3)))
}
