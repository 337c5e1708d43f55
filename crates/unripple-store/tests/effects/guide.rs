//! The guide to effects says what the reader does.

use crate::guide_common::{blocks, rows};
use crate::schema::{json, refused};
use serde_json::Value;
use std::collections::BTreeSet;
use unripple_store::{EFFECTS_SCHEMA, builtin_effects, parse_effects};

const GUIDE: &str = include_str!("../../../../docs/effects.md");

#[test]
fn examples_load() {
    let examples = blocks(GUIDE, "```toml");
    assert_eq!((examples.len(), examples[0].lines().count()), (2, 5));
    for example in examples {
        if let Err(faults) = parse_effects(&example, "guide.toml") {
            panic!("{faults:#}");
        }
        assert_eq!(refused(&json(&example)), None);
    }
}

#[test]
fn faults_read_as_printed() {
    let [bad, printed] =
        [blocks(GUIDE, "```toml faults").remove(0), blocks(GUIDE, "```text faults").remove(0)];
    let faults = parse_effects(&bad, "knobs.toml").unwrap_err();
    assert_eq!(format!("{faults:#}\n"), printed);
}

#[test]
fn keys_are_those_of_the_schema() {
    let schema: Value = serde_json::from_str(EFFECTS_SCHEMA).unwrap();
    let keys = |at: &str| -> BTreeSet<String> {
        schema.pointer(at).and_then(Value::as_object).unwrap().keys().cloned().collect()
    };
    let written = |section: &str| -> BTreeSet<String> {
        let of = |(name, cells): &(&str, Vec<&str>)| {
            (*name == section).then(|| cells[0].trim_matches('`').to_owned())
        };
        rows(GUIDE).iter().filter_map(of).collect()
    };
    let common = written("effect");
    for kind in ["button", "texture", "edge", "notch", "pulse-train", "shape", "hum", "score"] {
        let all: BTreeSet<String> = written(kind).union(&common).cloned().collect();
        assert_eq!(all, keys(&format!("/$defs/{kind}/properties")), "{kind}");
    }
    assert_eq!(written("effect.event"), keys("/$defs/event/properties"));
    let top: BTreeSet<String> = written("The file").into_iter().chain(["effect".to_owned()]).collect();
    assert_eq!(top, keys("/properties"));
}

/// What the reader expects of a number, when the guide states a range of it.
#[test]
fn ranges_are_those_of_the_reader() {
    let mut checked = 0;
    for (section, cells) in rows(GUIDE).into_iter().filter(|(_, cells)| cells.len() == 4) {
        let (key, legal) = (cells[0].trim_matches('`'), cells[2]);
        if !legal.starts_with(|c: char| c.is_ascii_digit() || c == '-')
            || legal.contains("corners")
            || legal.contains("tables")
        {
            continue;
        }
        let text = match section {
            "effect" => format!("[[effect]]\nkind = \"button\"\n{key} = nan\n"),
            "effect.event" => format!(
                "[[effect]]\nkind = \"score\"\n[[effect.event]]\n{key} = nan\namplitude = [[0, 1], [9, 0]]\n"
            ),
            kind => format!("[[effect]]\nkind = \"{kind}\"\n{key} = nan\npolygon_mm = [[0,0],[9,0],[0,9]]\n"),
        };
        let faults = parse_effects(&format!("format = 1\n{text}"), "range.toml").unwrap_err();
        let fault =
            faults.faults().iter().find(|f| f.key.ends_with(&format!(".{key}")) && f.found == "nan").unwrap();
        let range = legal.split(", or").next().unwrap_or(legal);
        let expected = format!("a number from {range}");
        assert!(fault.expected.starts_with(&expected), "{section}.{key}: {expected} {}", fault.expected);
        checked += 1;
    }
    assert_eq!(checked, 22);
}

#[test]
fn ready_ones_are_listed() {
    let listed: Vec<(String, &str)> = rows(GUIDE)
        .into_iter()
        .filter(|(section, _)| *section == "Ready-made effects")
        .map(|(_, cells)| (cells[0].trim_matches('`').to_owned(), cells[1]))
        .collect();
    let there: Vec<(String, &str)> = builtin_effects().iter().map(|b| (b.name.to_owned(), b.about)).collect();
    assert_eq!(listed, there);
}
