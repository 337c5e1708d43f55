//! The schema accepts what the reader accepts, and knows the same keys.

use serde_json::Value;
use std::collections::BTreeSet;
use unripple_store::{EFFECTS_SCHEMA, builtin_effects, parse_effects};

/// A file as the schema sees it.
pub fn json(text: &str) -> Value {
    toml::from_str(text).expect("TOML")
}

/// The first thing in a file that the schema does not allow, by a walk of the keywords that it uses.
pub fn refused(value: &Value) -> Option<String> {
    let root: Value = serde_json::from_str(EFFECTS_SCHEMA).expect("JSON");
    walk(&root, &root, value, "").err()
}

fn walk(root: &Value, schema: &Value, value: &Value, at: &str) -> Result<(), String> {
    let holds = |one: &Value| walk(root, one, value, at).is_ok();
    for (keyword, rule) in schema.as_object().expect("an object") {
        let rules = || rule.as_array().expect("a list").iter();
        let is_legal = match keyword.as_str() {
            "$schema" | "title" | "description" | "$defs" => true,
            "$ref" => {
                let path = rule.as_str().and_then(|path| path.strip_prefix('#')).expect("a reference");
                walk(root, root.pointer(path).expect("a definition"), value, at)?;
                true
            }
            "items" => {
                for (i, item) in value.as_array().into_iter().flatten().enumerate() {
                    walk(root, rule, item, &format!("{at}[{i}]"))?;
                }
                true
            }
            "properties" => {
                for (key, item) in value.as_object().into_iter().flatten() {
                    rule.get(key).map_or(Ok(()), |one| walk(root, one, item, &format!("{at}.{key}")))?;
                }
                true
            }
            "oneOf" => rules().filter(|one| holds(one)).count() == 1,
            "anyOf" => rules().any(holds),
            "allOf" => rules().all(holds),
            "not" => !holds(rule),
            _ => by_itself(keyword, rule, value) && keys(keyword, rule, schema, value),
        };
        if !is_legal {
            return Err(format!("{at}: {keyword}"));
        }
    }
    Ok(())
}

/// Keywords about keys of an object; the others hold.
fn keys(keyword: &str, rule: &Value, schema: &Value, value: &Value) -> bool {
    let Some(object) = value.as_object() else { return true };
    let required = |keys: &Value| {
        let keys = keys.as_array().expect("a list");
        keys.iter().all(|key| object.contains_key(key.as_str().expect("a key")))
    };
    match keyword {
        "required" => required(rule),
        "dependentRequired" => {
            let rules = rule.as_object().expect("an object");
            rules.iter().all(|(key, keys)| !object.contains_key(key) || required(keys))
        }
        "additionalProperties" => {
            assert_eq!(rule, &Value::Bool(false));
            let known = schema.get("properties").and_then(Value::as_object).expect("properties");
            object.keys().all(|key| known.contains_key(key))
        }
        _ => true,
    }
}

/// Keywords about a value by itself; those about keys hold.
fn by_itself(keyword: &str, rule: &Value, value: &Value) -> bool {
    let least = |found: Option<f64>| found.is_none_or(|found| found >= rule.as_f64().expect("a number"));
    let most = |found: Option<f64>| found.is_none_or(|found| found <= rule.as_f64().expect("a number"));
    let count = |of: Option<usize>| of.map(|count| count as f64);
    let (items, text) = (value.as_array().map(Vec::len), value.as_str().map(|text| text.chars().count()));
    match keyword {
        "required" | "dependentRequired" | "additionalProperties" => true,
        "type" => match rule.as_str() {
            Some("object") => value.is_object(),
            Some("array") => value.is_array(),
            Some("string") => value.is_string(),
            Some("number") => value.is_number(),
            Some("integer") => value.as_f64().is_some_and(|v| v.fract() == 0.0),
            other => panic!("type {other:?}"),
        },
        "const" => value == rule,
        "enum" => rule.as_array().expect("a list").contains(value),
        "minimum" => least(value.as_f64()),
        "maximum" => most(value.as_f64()),
        "minLength" => least(count(text)),
        "maxLength" => most(count(text)),
        "minItems" => least(count(items)),
        "maxItems" => most(count(items)),
        other => panic!("the test does not know the keyword {other}"),
    }
}

#[test]
fn every_builtin_is_valid() {
    for builtin in builtin_effects() {
        assert_eq!(refused(&json(builtin.text)), None, "{}", builtin.name);
    }
}

/// One fault more in a good file, and both refuse it.
#[test]
fn schema_and_reader_refuse_alike() {
    let good = "format = 1\n[[effect]]\nkind = \"hum\"\nfrequency_hz = 50\namplitude = [[0, 1], [9, 0]]\nplay = \"once\"\n\
                region = { circle_mm = 5, centre_mm = [9, 9] }\ngain = 0.5\n";
    assert_eq!(refused(&json(good)), None);
    assert!(parse_effects(good, "good.toml").is_ok());
    let changes = [
        ("format = 1", "format = 2"),
        ("\"hum\"", "\"hmu\""),
        ("frequency_hz = 50", "frequency_hz = 0"),
        ("frequency_hz = 50", "frequency_hz = \"50\""),
        ("frequency_hz = 50", "pitch = 50"),
        ("[9, 0]", "[9, 0, 1]"),
        ("[9, 0]", "[9, 2]"),
        ("amplitude = [[0, 1], [9, 0]]", "amplitude = []"),
        ("amplitude = [[0, 1], [9, 0]]", ""),
        ("\"once\"", "\"twice\""),
        ("circle_mm = 5", "circle_mm = 0"),
        ("circle_mm = 5", "rectangle_mm = [5, 5]"),
        ("centre_mm = [9, 9]", ""),
        ("gain = 0.5", "gain = 0.5\nfelt_db = 3"),
        ("gain = 0.5", "gain = -0.5"),
        ("gain = 0.5", "name = \"\""),
        ("[[effect]]", "[effect]"),
        ("[[effect]]", "about = 3\n[[effect]]"),
    ];
    for (from, to) in changes {
        let bad = good.replacen(from, to, 1);
        if let Ok(value) = toml::from_str::<Value>(&bad) {
            let value = refused(&value);
            // A list that is too long reaches the schema as a value of another shape, as the rest does.
            assert!(value.is_some() || bad.contains("[9, 2]"), "schema accepts {to}");
        }
        assert!(parse_effects(&bad, "bad.toml").is_err(), "reader accepts {to}");
    }
}

/// Unknown keys are answered with the list of known ones: the schema has exactly those.
#[test]
fn keys_are_those_of_the_reader() {
    let schema: Value = serde_json::from_str(EFFECTS_SCHEMA).unwrap();
    for kind in ["button", "texture", "edge", "notch", "pulse-train", "shape", "hum", "score"] {
        let text = format!("format = 1\n[[effect]]\nkind = \"{kind}\"\nzzz = 1\n");
        let faults = parse_effects(&text, "keys.toml").unwrap_err();
        let fault = faults.faults().iter().find(|fault| fault.key == "effect[0].zzz").unwrap();
        let known: BTreeSet<&str> = fault.expected.trim_start_matches("one of ").split(", ").collect();
        let properties = schema["$defs"][kind]["properties"].as_object().unwrap();
        assert_eq!(known, properties.keys().map(String::as_str).collect::<BTreeSet<_>>(), "{kind}");
    }
}
