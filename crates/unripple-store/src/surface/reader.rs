//! A TOML file read with its places, all faults gathered.

use super::range::Limits;
use crate::decimal;
use crate::fault::{Fault, MOST_FAULTS};
use crate::names::nearest;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// Longest piece of a file quoted in a message, in characters. Longer ones are cut, so that a message stays a line.
const LONGEST_QUOTE: usize = 40;

/// Longest line of text in a file, such as a name, in bytes: reports and messages repeat names in full.
pub(crate) const LONGEST_LINE: usize = 200;

/// The faults found so far in one text.
pub(crate) struct Faults<'t> {
    text: &'t str,
    list: Vec<Fault>,
}

impl<'t> Faults<'t> {
    /// No faults yet in this text.
    pub fn new(text: &'t str) -> Self {
        Self { text, list: Vec::new() }
    }

    /// Adds a fault; its line and column are found from the span at the end.
    pub fn add(
        &mut self,
        key: &str,
        span: Range<usize>,
        found: impl Into<String>,
        expected: impl Into<String>,
        nearest: Option<String>,
    ) {
        let (found, expected) = (found.into(), expected.into());
        self.list.push(Fault { key: key.into(), line: 0, column: 0, found, expected, nearest, span });
    }

    /// Whether further faults will only be counted, so that a costly suggestion would not be read.
    pub fn are_plenty(&self) -> bool {
        self.list.len() >= MOST_FAULTS
    }

    /// The faults that were found, in the order found.
    pub fn into_list(self) -> Vec<Fault> {
        self.list
    }

    fn quote(&self, span: &Range<usize>) -> String {
        clip(self.text.get(span.clone()).unwrap_or(""))
    }
}

/// A piece of a file short enough for a message, on one line.
pub(crate) fn clip(text: &str) -> String {
    let line: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST_QUOTE) {
        Some((at, _)) => format!("{}…", &line[..at]),
        None => line,
    }
}

/// A value of the file, with its key path and place.
#[derive(Clone)]
pub(crate) struct Entry<'a> {
    /// Path of its key, as `actuator[3].at_mm`.
    pub key: String,
    /// Range of the bytes of the file that the value takes up.
    pub span: Range<usize>,
    value: &'a DeValue<'a>,
}

impl<'a> Entry<'a> {
    fn new(key: String, value: &'a Spanned<DeValue<'a>>) -> Self {
        Self { key, span: value.span(), value: value.get_ref() }
    }

    /// Adds a fault that quotes what the file says here.
    pub fn refuse(&self, expected: impl Into<String>, nearest: Option<String>, faults: &mut Faults) {
        let found = match self.value {
            DeValue::Table(_) => "a table".into(),
            DeValue::Array(list) if list.len() > 4 => format!("a list of {}", list.len()),
            _ => faults.quote(&self.span),
        };
        faults.add(&self.key, self.span.clone(), found, expected, nearest);
    }

    /// The value as a number within limits, converted to SI units; otherwise a fault.
    pub fn number(&self, limits: &Limits, faults: &mut Faults) -> Option<f64> {
        let text = match self.value {
            DeValue::Float(float) => Some(float.as_str().to_owned()),
            DeValue::Integer(integer) if integer.radix() == 10 => Some(integer.as_str().to_owned()),
            DeValue::Integer(integer) => {
                i128::from_str_radix(integer.as_str(), integer.radix()).map(|i| i.to_string()).ok()
            }
            _ => None,
        };
        let read = text.and_then(|t| limits.si(&t).zip(decimal::scaled(&t, 0)));
        let Some((value, written)) = read else {
            self.refuse(limits.expected(), None, faults);
            return None;
        };
        if limits.allow(written) && value.is_finite() {
            return Some(value);
        }
        self.refuse(limits.expected(), limits.nearest(written), faults);
        None
    }

    /// The value as a whole number from `least` to `most`; otherwise a fault.
    pub fn count(&self, least: usize, most: usize, faults: &mut Faults) -> Option<usize> {
        let DeValue::Integer(integer) = self.value else {
            self.refuse(format!("a whole number from {least} to {most}"), None, faults);
            return None;
        };
        let value = i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX);
        if let Ok(count) = usize::try_from(value)
            && (least..=most).contains(&count)
        {
            return Some(count);
        }
        let nearest = if value < least as i128 { least } else { most };
        self.refuse(format!("a whole number from {least} to {most}"), Some(nearest.to_string()), faults);
        None
    }

    /// The value as one line of text that is not blank; otherwise a fault.
    pub fn line(&self, expected: &str, faults: &mut Faults) -> Option<String> {
        let text = self.value.as_str().map(str::trim);
        let fits = |t: &&str| !t.is_empty() && t.len() <= LONGEST_LINE && !t.chars().any(char::is_control);
        let line = text.filter(fits).map(str::to_owned);
        if line.is_none() {
            self.refuse(format!("{expected}, as one line of text in quotes"), None, faults);
        }
        line
    }

    /// The choice that the value names; otherwise a fault.
    pub fn choice<T: Copy>(&self, choices: &[(&'static str, T)], faults: &mut Faults) -> Option<T> {
        let found = self.value.as_str();
        let chosen = choices.iter().find(|(name, _)| Some(*name) == found).map(|(_, value)| *value);
        if chosen.is_none() {
            let names: Vec<String> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            let near = found.and_then(|f| nearest(f, choices.iter().map(|(name, _)| *name)));
            self.refuse(names.join(" or "), near.map(|name| format!("\"{name}\"")), faults);
        }
        chosen
    }

    /// The items, if it is a list; no fault if it is not.
    pub fn items(&self) -> Option<Vec<Entry<'a>>> {
        let DeValue::Array(list) = self.value else { return None };
        Some(list.iter().enumerate().map(|(i, v)| Entry::new(format!("{}[{i}]", self.key), v)).collect())
    }

    /// The value as a list of exactly `N` numbers within the same limits, in SI units; otherwise a fault.
    pub fn numbers<const N: usize>(
        &self,
        limits: &Limits,
        shape: &str,
        faults: &mut Faults,
    ) -> Option<[f64; N]> {
        let Some(items) = self.items().filter(|items| items.len() == N) else {
            self.refuse(shape, None, faults);
            return None;
        };
        let read: Vec<Option<f64>> = items.iter().map(|item| item.number(limits, faults)).collect();
        read.into_iter().collect::<Option<Vec<f64>>>()?.try_into().ok()
    }

    /// The value as TOML has it.
    pub fn raw(&self) -> &'a DeValue<'a> {
        self.value
    }

    /// Whether the value is a number.
    pub fn is_number(&self) -> bool {
        matches!(self.value, DeValue::Integer(_) | DeValue::Float(_))
    }

    /// Whether the value is a text.
    pub fn is_text(&self) -> bool {
        matches!(self.value, DeValue::String(_))
    }

    /// Whether the value is a table.
    pub fn is_table(&self) -> bool {
        matches!(self.value, DeValue::Table(_))
    }

    /// Whether the value is this whole number, written in decimal digits.
    pub fn is(&self, integer: i64) -> bool {
        matches!(self.value, DeValue::Integer(i) if i.as_str().parse() == Ok(integer) && i.radix() == 10)
    }

    /// The value as a table, or a fault if it is none.
    pub fn section(&self, faults: &mut Faults) -> Option<Section<'a>> {
        match self.value {
            DeValue::Table(table) => {
                Some(Section { key: self.key.clone(), span: self.span.clone(), table, defaults: None })
            }
            _ => {
                self.refuse(format!("a table, [{}]", self.key), None, faults);
                None
            }
        }
    }
}

/// A table of the file, with its key path and place.
pub(crate) struct Section<'a> {
    /// Path of the table's key; empty for the whole file.
    pub key: String,
    /// The bytes of the file that the table's header takes up.
    pub span: Range<usize>,
    table: &'a DeTable<'a>,
    /// Another table, for the keys that this one does not have.
    defaults: Option<&'a Section<'a>>,
}

impl<'a> Section<'a> {
    /// The whole document as a table.
    pub fn root(document: &'a DeTable<'a>) -> Self {
        Self { key: String::new(), span: 0..0, table: document, defaults: None }
    }

    /// This table, with another table that supplies the keys missing from this one.
    /// [`check_keys`](Self::check_keys) looks at this one alone.
    pub fn with_defaults(self, defaults: Option<&'a Section<'a>>) -> Self {
        Self { defaults, ..self }
    }

    fn path(&self, key: &str) -> String {
        if self.key.is_empty() { key.into() } else { format!("{}.{key}", self.key) }
    }

    /// Refuses every key that is not known here; `elsewhere` may say where a key belongs instead.
    pub fn check_keys(
        &self,
        known: &[&str],
        elsewhere: impl Fn(&str) -> Option<String>,
        faults: &mut Faults,
    ) {
        for (key, _) in self.table {
            let name: &str = key.get_ref();
            if known.contains(&name) {
                continue;
            }
            let expected = elsewhere(name).unwrap_or_else(|| format!("one of {}", known.join(", ")));
            let near = nearest(name, known.iter().copied()).map(str::to_owned);
            let found = format!("an unknown key `{}`", clip(name));
            faults.add(&clip(&self.path(name)), key.span(), found, expected, near);
        }
    }

    /// All keys of the table itself: their names, the bytes that these take up, and their values.
    pub fn entries(&self) -> Vec<(String, Range<usize>, Entry<'a>)> {
        let one = |(key, value): (&'a Spanned<DeString<'a>>, &'a Spanned<DeValue<'a>>)| {
            let name: &str = key.get_ref();
            (name.to_owned(), key.span(), Entry::new(self.path(name), value))
        };
        self.table.iter().map(one).collect()
    }

    /// The value of a key, if the key is here or among the defaults.
    pub fn get(&self, key: &str) -> Option<Entry<'a>> {
        let own = self.table.get(key).map(|value| Entry::new(self.path(key), value));
        own.or_else(|| self.defaults?.get(key))
    }

    /// Whether the table itself contains a key, whether or not the defaults do.
    pub fn gives(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// The value of a key; a fault if the key is missing.
    pub fn require(&self, key: &str, expected: &str, faults: &mut Faults) -> Option<Entry<'a>> {
        let entry = self.get(key);
        if entry.is_none() {
            faults.add(&self.path(key), self.span.clone(), "no such key", expected, None);
        }
        entry
    }

    /// The number under a key, in SI units; a fault if the key is missing.
    pub fn number(&self, key: &str, limits: &Limits, faults: &mut Faults) -> Option<f64> {
        self.require(key, &limits.expected(), faults)?.number(limits, faults)
    }

    /// The number under a key, or the default if the key is missing, both in SI units.
    pub fn number_or(&self, key: &str, default: f64, limits: &Limits, faults: &mut Faults) -> Option<f64> {
        match self.get(key) {
            Some(entry) => entry.number(limits, faults),
            None => Some(default),
        }
    }

    /// The choice that the value of a key names, or the default if the key is missing.
    pub fn choice_or<T: Copy>(
        &self,
        key: &str,
        default: T,
        choices: &[(&'static str, T)],
        faults: &mut Faults,
    ) -> Option<T> {
        match self.get(key) {
            Some(entry) => entry.choice(choices, faults),
            None => Some(default),
        }
    }
}
