//! One design of a plan, and the request that its values make.

use super::pairs::Pairs;
use super::values;
use crate::TaskError;
use crate::record::of_bytes;
use serde_json::{Map, Number, Value, json};
use std::collections::BTreeMap;
use unripple_store::{PlanFile, Varied};

/// Largest whole number that is written without a fraction: all up to it are numbers of 64 bits with one.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// One design of a plan: its values, and a hash of all that its figures follow from.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Index of the design, counted from 0.
    pub index: usize,
    /// Values by the names `surface:KEY` and `ask:FIELD`, in the order of the plan.
    pub values: Pairs,
    /// SHA-256, in hexadecimal digits, of task, surface, request, values, and the files that these name.
    pub hash: String,
    own: Vec<(Varied, Value)>,
}

impl Design {
    /// The design with an index, from its values; `surface` is the hash of the surface as the plan names it, `files` has those of other
    /// files by their names.
    pub(super) fn of(
        plan: &PlanFile,
        surface: &str,
        files: Map<String, Value>,
        index: usize,
        own: Vec<(Varied, Value)>,
    ) -> Self {
        let values = values::named(&own);
        let ask: Map<String, Value> = plan.ask.clone().into_iter().collect();
        let named: Map<String, Value> = values.0.iter().cloned().collect();
        let mut all = json!({ "task": plan.task, "surface": surface, "ask": ask, "values": named });
        if !files.is_empty() {
            all["files"] = files.into();
        }
        Self { index, values, hash: of_bytes(canonical(&all).as_bytes()), own }
    }

    /// The request of the design, without its surface.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a field that the values cannot be put under.
    pub(super) fn fields(&self, plan: &PlanFile) -> Result<Value, TaskError> {
        let mut ask = Value::Object(plan.ask.clone().into_iter().collect());
        for (varied, value) in &self.own {
            if let Varied::Ask(path) = varied {
                put(&mut ask, path, value.clone())?;
            }
        }
        Ok(ask)
    }

    /// Keys of the surface file that the design sets, with their values as the file would write them.
    pub(super) fn keys(&self) -> Vec<(String, String)> {
        let key = |(varied, value): &(Varied, Value)| match varied {
            Varied::Surface(key) => Some((key.clone(), written(value))),
            Varied::Ask(_) => None,
        };
        self.own.iter().filter_map(key).collect()
    }
}

/// Puts a value into a request, at a path of keys and of indices of lists; tables that are not there are made.
fn put(ask: &mut Value, path: &str, value: Value) -> Result<(), TaskError> {
    let mut here = ask;
    for step in path.split('.') {
        here = match here {
            Value::Array(list) => {
                let count = list.len();
                let at = step.parse::<usize>().ok().and_then(|at| list.get_mut(at));
                at.ok_or_else(|| {
                    let expected = format!("expected an index below {count} in a list");
                    TaskError::Input(format!("ask:{path}: {expected}, found `{step}`"))
                })?
            }
            other => {
                // A text or a number stood for another form of the same field.
                if !other.is_object() {
                    *other = Value::Object(Map::new());
                }
                &mut other[step]
            }
        };
    }
    *here = value;
    Ok(())
}

/// A value as a surface file writes it.
pub(crate) fn written(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("[{}]", list.iter().map(written).collect::<Vec<_>>().join(", ")),
        Value::Object(map) => {
            let items =
                map.iter().map(|(key, value)| format!("{} = {}", Value::from(&**key), written(value)));
            format!("{{ {} }}", items.collect::<Vec<_>>().join(", "))
        }
        // Escapes of JSON are those of TOML.
        other => other.to_string(),
    }
}

/// JSON text that is the same for equal values: keys in order, no spaces, whole numbers without a fraction.
pub(crate) fn canonical(value: &Value) -> String {
    match value {
        Value::Object(map) => {
            let sorted: BTreeMap<&String, &Value> = map.iter().collect();
            let items = sorted
                .iter()
                .map(|(key, value)| format!("{}:{}", Value::from(key.as_str()), canonical(value)));
            format!("{{{}}}", items.collect::<Vec<_>>().join(","))
        }
        Value::Array(list) => format!("[{}]", list.iter().map(canonical).collect::<Vec<_>>().join(",")),
        Value::Number(number) => whole(number).map_or_else(|| number.to_string(), |whole| whole.to_string()),
        other => other.to_string(),
    }
}

/// A whole number that has a fraction of 0, as those of ranges do; `None` for any other number.
fn whole(number: &Number) -> Option<i64> {
    let value = number.as_f64().filter(|value| number.is_f64() && value.fract() == 0.0)?;
    (value.abs() <= LARGEST_WHOLE).then_some(value as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_put_where_their_paths_lead() {
        let mut ask = json!({ "points": [{ "at_m": [0.1, 0.2] }], "level": "limit" });
        put(&mut ask, "points.0.at_m.1", 0.3.into()).unwrap();
        put(&mut ask, "level.peak_m", 1e-6.into()).unwrap();
        put(&mut ask, "window_s", 0.02.into()).unwrap();
        let expected =
            json!({ "points": [{ "at_m": [0.1, 0.3] }], "level": { "peak_m": 1e-6 }, "window_s": 0.02 });
        assert_eq!(ask, expected);
        let refused = put(&mut ask, "points.1.at_m", json!([0.1, 0.1])).unwrap_err();
        assert_eq!(refused.to_string(), "ask:points.1.at_m: expected an index below 1 in a list, found `1`");
    }

    #[test]
    fn values_are_written_as_a_surface_file_has_them() {
        let texts =
            [json!(200), json!(0.5), json!("a \"b\""), json!([1, "x"]), json!({ "mm": 2 }), json!(true)];
        let written: Vec<String> = texts.iter().map(written).collect();
        assert_eq!(written, ["200", "0.5", r#""a \"b\"""#, r#"[1, "x"]"#, r#"{ "mm" = 2 }"#, "true"]);
    }

    #[test]
    fn equal_values_have_one_text() {
        let text = canonical(&json!({ "b": [1.5, null], "a": { "d": "x", "c": 2 } }));
        assert_eq!(text, r#"{"a":{"c":2,"d":"x"},"b":[1.5,null]}"#);
        let numbers = json!([150, 150.0, -3.0, 0.1, 1e300, u64::MAX]);
        assert_eq!(canonical(&numbers), "[150,150,-3,0.1,1e+300,18446744073709551615]");
    }
}
