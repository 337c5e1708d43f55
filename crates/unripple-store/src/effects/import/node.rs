//! JSON values with their places, for messages.

use crate::StoreError;
use crate::surface::reader::clip;
use serde_json::Value;

/// A value of a JSON file, and where it is.
pub(super) struct Node<'v> {
    value: &'v Value,
    file: &'v str,
    path: String,
}

impl<'v> Node<'v> {
    /// The root of a JSON document; `file` is the file's name in messages.
    pub fn root(value: &'v Value, file: &'v str) -> Self {
        Self { value, file, path: String::new() }
    }

    /// An error that says where in the file this value is, and quotes it.
    pub fn refuse(&self, expected: impl Into<String>) -> StoreError {
        let found = match self.value {
            Value::Object(_) => "an object".to_owned(),
            Value::Array(list) => format!("a list of {}", list.len()),
            other => clip(&other.to_string()),
        };
        self.error(expected, found)
    }

    fn error(&self, expected: impl Into<String>, found: impl Into<String>) -> StoreError {
        let place = match self.path.as_str() {
            "" => self.file.to_owned(),
            path => format!("{}: {path}", self.file),
        };
        StoreError::content(&place, expected, found)
    }

    fn child(&self, key: &str, value: &'v Value) -> Self {
        let path = if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) };
        Self { value, file: self.file, path }
    }

    /// The value of a key, if the key is there and its value is not null.
    pub fn get(&self, key: &str) -> Option<Self> {
        self.value.get(key).filter(|value| !value.is_null()).map(|value| self.child(key, value))
    }

    /// The value of a key; an error if the key is missing.
    pub fn require(&self, key: &str, expected: &str) -> Result<Self, StoreError> {
        self.get(key).ok_or_else(|| self.error(format!("`{key}`, {expected}"), "no such key"))
    }

    /// The items of the list under a key; an error if the key is missing.
    pub fn items(&self, key: &str) -> Result<Vec<Self>, StoreError> {
        let list = self.require(key, "a list")?;
        let Value::Array(items) = list.value else { return Err(list.refuse("a list")) };
        let item = |(i, value)| Self { value, file: self.file, path: format!("{}[{i}]", list.path) };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// The value as a number within limits; otherwise an error.
    pub fn number(&self, [least, greatest]: [f64; 2]) -> Result<f64, StoreError> {
        let number = self.value.as_f64().filter(|value| (least..=greatest).contains(value));
        number.ok_or_else(|| self.refuse(format!("a number from {least} to {greatest}")))
    }

    /// The number under a key; an error if the key is missing.
    pub fn number_of(&self, key: &str, range: [f64; 2]) -> Result<f64, StoreError> {
        self.require(key, &format!("a number from {} to {}", range[0], range[1]))?.number(range)
    }

    /// The number under a key, or the default if the key is missing.
    pub fn number_or(&self, key: &str, default: f64, range: [f64; 2]) -> Result<f64, StoreError> {
        self.get(key).map_or(Ok(default), |node| node.number(range))
    }

    /// The value as a text; an error if it is none.
    pub fn text(&self) -> Result<&'v str, StoreError> {
        self.value.as_str().ok_or_else(|| self.refuse("a text"))
    }

    /// The value as one of the known texts; otherwise an error.
    pub fn one_of(&self, known: &[&'static str]) -> Result<&'static str, StoreError> {
        let found = self.text()?;
        let expected = || format!("one of {}{}", known.join(", "), super::near(found, known));
        known.iter().copied().find(|name| *name == found).ok_or_else(|| self.refuse(expected()))
    }

    /// Refuses points of a curve whose times (s) are not in ascending order; each `[time, value]` was read from
    /// the item of the same index.
    pub fn ascending(items: &[Self], time: &str, points: &[(f64, f64)]) -> Result<(), StoreError> {
        match points.windows(2).position(|pair| pair[1].0 < pair[0].0) {
            None => Ok(()),
            Some(i) => {
                let expected = format!("`{time}` no earlier than {} before it", points[i].0);
                Err(items[i + 1].error(expected, format!("{}", points[i + 1].0)))
            }
        }
    }
}
