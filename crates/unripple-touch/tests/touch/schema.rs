//! The schema and the reader agree, by a small validator of the keywords that the schema uses.

use serde_json::{Value, json};
use unripple_touch::{Message, SCHEMA};

/// Whether a value holds to a schema; fails on keywords it does not know.
fn valid(schema: &Value, value: &Value) -> bool {
    schema.as_object().unwrap().iter().all(|(keyword, rule)| match keyword.as_str() {
        "$schema" | "$id" | "title" | "description" => true,
        "oneOf" => rule.as_array().unwrap().iter().filter(|one| valid(one, value)).count() == 1,
        "type" => match rule.as_str().unwrap() {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "number" => value.is_number(),
            "integer" => value.is_u64() || value.is_i64(),
            other => panic!("{other}"),
        },
        "const" => value == rule,
        "enum" => rule.as_array().unwrap().contains(value),
        "properties" => {
            rule.as_object().unwrap().iter().all(|(key, rule)| value.get(key).is_none_or(|v| valid(rule, v)))
        }
        "required" => rule.as_array().unwrap().iter().all(|key| value.get(key.as_str().unwrap()).is_some()),
        "dependentRequired" => rule.as_object().unwrap().iter().all(|(key, needed)| {
            value.get(key).is_none()
                || needed.as_array().unwrap().iter().all(|k| value.get(k.as_str().unwrap()).is_some())
        }),
        "additionalProperties" => {
            assert_eq!(rule, &json!(false));
            let known = schema["properties"].as_object().unwrap();
            value.as_object().is_none_or(|object| object.keys().all(|key| known.contains_key(key)))
        }
        "items" => value.as_array().is_none_or(|items| items.iter().all(|item| valid(rule, item))),
        "minItems" => value.as_array().is_none_or(|items| items.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => value.as_array().is_none_or(|items| items.len() as u64 <= rule.as_u64().unwrap()),
        "minLength" => {
            value.as_str().is_none_or(|text| text.chars().count() as u64 >= rule.as_u64().unwrap())
        }
        "maxLength" => {
            value.as_str().is_none_or(|text| text.chars().count() as u64 <= rule.as_u64().unwrap())
        }
        "minimum" => value.as_f64().is_none_or(|x| x >= rule.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|x| x <= rule.as_f64().unwrap()),
        other => panic!("unknown keyword {other}"),
    })
}

fn schema() -> Value {
    serde_json::from_str(SCHEMA).unwrap()
}

#[test]
fn good_messages_hold_to_the_schema() {
    for good in [
        json!({"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"force_n":0.3}),
        json!({"v":1,"type":"touch","finger":4294967295u32,"phase":"move","at_mm":[62.5,-90.25]}),
        json!({"v":1,"type":"touch","finger":0,"phase":"up"}),
        json!({"v":1,"type":"touch","finger":0,"phase":"up","at_mm":[0,0],"force_n":0}),
        json!({"v":1,"type":"clear"}),
        json!({"v":1,"type":"effect","name":"click"}),
        json!({"v":1,"type":"gain","db":-6.5}),
        json!({"v":1,"type":"hello"}),
    ] {
        assert!(valid(&schema(), &good), "{good}");
        assert!(Message::read(&good.to_string()).is_ok(), "{good}");
    }
    // What only the server says.
    assert!(valid(&schema(), &json!({"v":1,"type":"error","what":"expected version 1, found 2"})));
    let hello = json!({"v":1,"type":"hello","server":"unripple","version":"0.1.0","size_mm":[150.0,100.0]});
    assert!(valid(&schema(), &hello));
}

#[test]
fn whatever_the_schema_refuses_the_reader_refuses() {
    let whole = [
        json!({"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"force_n":0.3}),
        json!({"v":1,"type":"clear"}),
        json!({"v":1,"type":"effect","name":"click"}),
        json!({"v":1,"type":"gain","db":-6}),
    ];
    let values = [
        json!(null),
        json!(-1),
        json!(1),
        json!(2),
        json!(1.5),
        json!(1e6),
        json!("x"),
        json!(""),
        json!("up"),
        json!([]),
        json!([1]),
        json!([1, 2]),
        json!([1, 2, 3]),
        json!(["1", 2]),
        json!({}),
        json!(true),
        json!(4294967296u64),
    ];
    let (mut refused, mut taken) = (0, 0);
    for message in &whole {
        for key in message.as_object().unwrap().keys().chain([&"more".to_owned()]) {
            let mut removed = message.clone();
            removed.as_object_mut().unwrap().remove(key);
            let changed = values.iter().map(|value| {
                let mut changed = message.clone();
                changed[key] = value.clone();
                changed
            });
            for other in changed.chain([removed]) {
                let good = valid(&schema(), &other);
                // The range of a force is the reader's to check when the finger is put.
                if key != "force_n" {
                    assert_eq!(Message::read(&other.to_string()).is_ok(), good, "{other}");
                }
                if good { taken += 1 } else { refused += 1 }
            }
        }
    }
    assert!(refused > 100 && taken > 10, "{refused} {taken}");
}

#[test]
fn the_guide_s_examples_are_what_they_say() {
    let guide = include_str!("../../../../docs/touch.md");
    let blocks: Vec<&str> =
        guide.split("```json\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    let [said, answered, recorded] = blocks[..] else { panic!("{} blocks", blocks.len()) };
    for line in said.lines() {
        assert!(Message::read(line).is_ok(), "{line}");
    }
    for line in said.lines().chain(answered.lines()) {
        assert!(valid(&schema(), &serde_json::from_str(line).unwrap()), "{line}");
    }
    assert_eq!(unripple_touch::Recording::read(recorded).unwrap().len(), 5);
}
