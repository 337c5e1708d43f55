//! Actuators and places of files, columns and nodes, from a table or from their names.

use super::bytes::bytes;
use super::measured::Who;
use super::pattern::Pattern;
use super::{Ask, Per, units};
use crate::TaskError;
use std::collections::BTreeMap;
use unripple::core::Point;
use unripple_exchange::{Csv, Row};

/// What a table or a name says of a response.
#[derive(Clone, Debug)]
pub(super) struct Label {
    /// The actuator by its names.
    pub who: Who,
    /// Place of the point in m, with what the request adds.
    pub at: Option<Point>,
    /// The channel, from 1, where a file has several.
    pub channel: Option<usize>,
    /// Where this is said, for messages.
    pub from: String,
}

impl Label {
    /// The place of the point in m.
    ///
    /// # Errors
    /// [`TaskError::Input`] if none is said of `name`.
    pub fn place(&self, name: &str) -> Result<Point, TaskError> {
        let none = || TaskError::Input(format!("{}: expected the place of `{name}`, found none", self.from));
        self.at.ok_or_else(none)
    }
}

/// Labels of files, columns and nodes by their names.
pub(super) struct Labels {
    table: BTreeMap<String, Vec<Label>>,
    pattern: Option<Pattern>,
    length: Option<f64>,
    offset: [f64; 2],
    /// Whether the request says that references are forces in newtons.
    newtons: bool,
    /// Whether the request says the unit of what was measured.
    unit: bool,
}

/// Names of the first column of a table.
const NAMES: [&str; 4] = ["file", "column", "node", "name"];

impl Labels {
    /// The labels that a request gives.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of a pattern or a unit of length that is not understood; [`TaskError::Input`] of a table with a fault, by its line.
    pub fn of(ask: &Ask) -> Result<Self, TaskError> {
        let length = ask.length_unit.as_deref().map(asked_length).transpose()?;
        let pattern = ask.pattern.as_deref().map(Pattern::of).transpose()?;
        let newtons = ask.per == Some(Per::Newton);
        let (offset, unit) = (ask.offset_m, ask.unit.is_some());
        let mut labels = Self { table: BTreeMap::new(), pattern, length, offset, newtons, unit };
        if let Some(path) = &ask.table {
            let bytes = bytes(path)?;
            labels.add(&bytes, &path.display().to_string())?;
        }
        Ok(labels)
    }

    /// Metres per unit of length, as the request says.
    pub fn length(&self) -> Option<f64> {
        self.length
    }

    /// Whether the request says that forces are in newtons.
    pub fn in_newtons(&self) -> bool {
        self.newtons
    }

    /// Whether the request says the unit of what was measured.
    pub fn have_unit(&self) -> bool {
        self.unit
    }

    /// A place in m, with what the request adds.
    pub fn moved(&self, x: f64, y: f64) -> Point {
        Point::new(x + self.offset[0], y + self.offset[1])
    }

    fn add(&mut self, bytes: &[u8], file: &str) -> Result<(), TaskError> {
        let table = Csv::of(bytes, file).map_err(TaskError::input)?;
        let Some(name) = NAMES.iter().find_map(|name| table.column(name)) else {
            let found = table.names.join(", ");
            return Err(TaskError::Input(format!(
                "{file}: expected a column with one of the names {}, found {found}",
                NAMES.join(", ")
            )));
        };
        for row in table.rows() {
            let row = row.map_err(TaskError::input)?;
            let label = self.label(&table.names, &row, file)?;
            let named = self.table.entry(row.cells[name].to_string()).or_default();
            if let Some(other) = named.iter().find(|other| other.channel == label.channel) {
                return Err(TaskError::Input(format!(
                    "{}: expected each name once, found `{}`, which is at {} too",
                    label.from, row.cells[name], other.from
                )));
            }
            named.push(label);
        }
        Ok(())
    }

    /// The label in a row of a table.
    fn label(&self, names: &[String], row: &Row<'_>, file: &str) -> Result<Label, TaskError> {
        let from = format!("{file}: line {}", row.line);
        let cells = names.iter().map(String::as_str).zip(row.cells.iter().map(|cell| &**cell));
        self.read(cells.filter(|(_, text)| !text.is_empty()), from)
    }

    /// The place in a row of a table, in m.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a row without one.
    pub fn place_in(&self, names: &[String], row: &Row<'_>, file: &str) -> Result<Point, TaskError> {
        let label = self.label(names, row, file)?;
        label.at.ok_or_else(|| refused(&label.from, "a place, as x_mm and y_mm or x_m and y_m", "none"))
    }

    /// A label from fields and their texts.
    fn read<'t>(
        &self,
        fields: impl Iterator<Item = (&'t str, &'t str)>,
        from: String,
    ) -> Result<Label, TaskError> {
        let mut label = Label { who: Who::default(), at: None, channel: None, from };
        let mut at = [None; 2];
        for (field, text) in fields {
            let (axis, unit) = match field {
                "actuator" => {
                    label.who.names.push(text.to_owned());
                    continue;
                }
                "channel" => {
                    let channel = text.parse::<usize>().ok().filter(|channel| *channel > 0);
                    label.channel =
                        Some(channel.ok_or_else(|| refused(&label.from, "a channel from 1 up", text))?);
                    continue;
                }
                "x_m" => (0, 1.0),
                "y_m" => (1, 1.0),
                "x_mm" => (0, 1e-3),
                "y_mm" => (1, 1e-3),
                "x" | "y" => (usize::from(field == "y"), self.needed_length(&label.from)?),
                _ => continue,
            };
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            let number = number.ok_or_else(|| refused(&label.from, &format!("a number as {field}"), text))?;
            at[axis] = Some(unit * number);
        }
        label.at = match at {
            [Some(x), Some(y)] => Some(self.moved(x, y)),
            [None, None] => None,
            _ => return Err(refused(&label.from, "x and y", "one of them")),
        };
        Ok(label)
    }

    /// Metres per unit of length, where a place has no unit of its own.
    ///
    /// # Errors
    /// [`TaskError::Ask`] if the request does not say it.
    pub fn needed_length(&self, from: &str) -> Result<f64, TaskError> {
        self.length.ok_or_else(|| {
            let found = format!("none, and {from} does not say it");
            TaskError::ask("length_unit", "the unit of the places: m, mm, cm or in", found)
        })
    }

    /// What a table says of a name, for each channel that it names, else what the name itself says by the pattern.
    ///
    /// # Errors
    /// [`TaskError::Ask`] if neither says it.
    pub fn named(&self, name: &str, from: &str) -> Result<Vec<Label>, TaskError> {
        if let Some(labels) = self.table.get(name) {
            return Ok(labels.clone());
        }
        if let Some(pattern) = &self.pattern {
            let Some(fields) = pattern.fields(name) else {
                let expected = "a pattern that all names are of";
                return Err(TaskError::ask("pattern", expected, format!("`{name}` ({from})")));
            };
            return Ok(vec![self.read(fields.into_iter(), format!("the name `{name}`"))?]);
        }
        let expected = "a table or a pattern that says actuator and place";
        Err(TaskError::ask("table, pattern", expected, format!("none for `{name}` ({from})")))
    }

    /// The place of a node by a table, in m; `None` if it says none.
    pub fn node(&self, label: i64) -> Option<Point> {
        self.table.get(&label.to_string()).and_then(|labels| labels.first()).and_then(|label| label.at)
    }
}

fn refused(from: &str, expected: &str, found: &str) -> TaskError {
    TaskError::Input(format!("{from}: expected {expected}, found `{found}`"))
}

fn asked_length(name: &str) -> Result<f64, TaskError> {
    units::length(name).ok_or_else(|| {
        TaskError::ask("length_unit", "a unit of length: m, cm, mm, um, nm, in or ft", format!("`{name}`"))
    })
}
