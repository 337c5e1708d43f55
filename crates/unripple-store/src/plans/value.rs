//! Values of plans: TOML as JSON.

use crate::names::nearest;
use crate::surface::range::Limits;
use crate::surface::reader::{Entry, Faults};
use serde_json::{Map, Number, Value};
use toml::de::DeValue;

/// Largest number of designs of a plan: if each takes a second, they take four months.
pub const MOST_DESIGNS: usize = 10_000_000;

/// Largest whole number that is taken as one: all up to it are numbers of 64 bits with a fraction.
pub(super) const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// The name among `known` that is nearest to one that is not, in quotes.
pub(super) fn near(found: &str, known: &[&str]) -> Option<String> {
    nearest(found, known.iter().copied()).map(|name| format!("\"{name}\""))
}

/// Any number that leaves room for differences and ratios.
pub(super) const ANY: Limits = Limits::new("", 0, -1e100, 1e100);

/// A value of the file as JSON; a fault where it is a date, a number that is not finite, or a whole number beyond 64 bits.
pub(super) fn json(entry: &Entry, faults: &mut Faults) -> Option<Value> {
    let found = match entry.raw() {
        DeValue::String(text) => Some(Value::from(&**text)),
        DeValue::Boolean(flag) => Some(Value::from(*flag)),
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(Value::from)
        }
        DeValue::Float(float) => float.as_str().parse().ok().and_then(number),
        DeValue::Array(_) => {
            let items: Vec<_> = entry.items()?.iter().map(|item| json(item, faults)).collect();
            return items.into_iter().collect::<Option<Vec<_>>>().map(Value::Array);
        }
        DeValue::Table(_) => {
            let entries = entry.section(faults)?.entries();
            let items: Vec<_> =
                entries.into_iter().map(|(name, _, item)| Some((name, json(&item, faults)?))).collect();
            return items.into_iter().collect::<Option<Map<_, _>>>().map(Value::Object);
        }
        DeValue::Datetime(_) => None,
    };
    if found.is_none() {
        entry.refuse("a finite number, a text, true or false, or a list or table of these", None, faults);
    }
    found
}

/// A number as JSON, `None` if it is not finite. A whole one has no fraction, so that `150` and `150.0` are one value: what takes a number
/// takes either, and what takes a count only the first.
fn number(value: f64) -> Option<Value> {
    match value.fract() == 0.0 && value.abs() <= LARGEST_WHOLE {
        true => Some(Value::from(value as i64)),
        false => Number::from_f64(value).map(Value::Number),
    }
}

/// A value that is true or false; otherwise a fault.
pub(super) fn flag(entry: Option<Entry>, faults: &mut Faults) -> Option<bool> {
    match entry {
        None => Some(false),
        Some(entry) => {
            let found = entry.raw().as_bool();
            if found.is_none() {
                entry.refuse("true or false", None, faults);
            }
            found
        }
    }
}
