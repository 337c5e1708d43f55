//! The schema of reports has the keys of the guide and the names of the program, and refuses what is no report. All tests hold the reports
//! that they take to it: `common::run`.

use crate::common;

use common::guide::{defined, headings, sections};
use common::json;
use common::schema::{faults, schema};
use serde_json::{Value, json as value};
use std::collections::BTreeSet;
use unripple::focus::Method;

/// Words in backticks that are no keys of the section that they stand in, beside names of commands: values, the record itself, the command
/// whose reports are those of others, and a key of options.
const NO_KEYS: [&str; 5] = ["false", "null", "rerun", "run", "toml"];

/// Keys of objects, and names that values may be, in a part of the schema.
#[derive(Default)]
struct Names {
    keys: BTreeSet<&'static str>,
    values: BTreeSet<&'static str>,
}

impl Names {
    /// Those of the definition of a command's report, or of another definition.
    fn of(definition: &str) -> Self {
        let mut names = Self::default();
        names.add(&schema()["$defs"][definition]);
        names
    }

    /// Adds those of a part of the schema, but not those below `run`, which is the same in all reports.
    fn add(&mut self, part: &'static Value) {
        if !part.is_object() {
            return;
        }
        if let Some(pointer) = part["$ref"].as_str() {
            self.add(schema().pointer(&pointer[1..]).unwrap_or_else(|| panic!("{pointer}")));
        }
        for (key, rule) in part["properties"].as_object().into_iter().flatten() {
            // A key that is refused is none of this report's.
            if rule != false {
                self.keys.insert(key);
            }
            if key != "run" {
                self.add(rule);
            }
        }
        for keyword in ["items", "if", "then", "else"] {
            self.add(&part[keyword]);
        }
        for keyword in ["anyOf", "oneOf"] {
            part[keyword].as_array().into_iter().flatten().for_each(|part| self.add(part));
        }
        let names = part["enum"].as_array().into_iter().flatten().chain([&part["const"]]);
        self.values.extend(names.filter_map(Value::as_str));
    }
}

/// The commands that a report may be of.
fn commands() -> Vec<&'static str> {
    let command = &schema()["$defs"]["run"]["properties"]["command"];
    command["enum"].as_array().unwrap().iter().map(|command| command.as_str().unwrap()).collect()
}

#[test]
fn the_guide_defines_the_keys_of_the_schema() {
    for part in commands().into_iter().chain(["run"]) {
        let (keys, defined) = (Names::of(part).keys, defined(&headings(part)));
        let undefined: Vec<&&str> = keys.difference(&defined).collect();
        assert!(!keys.is_empty() && undefined.is_empty(), "{part}: {undefined:?}");
    }
}

#[test]
fn the_schema_has_the_keys_of_the_guide() {
    for (heading, quoted) in sections() {
        let parts = commands().into_iter().chain(["run"]);
        let parts: Vec<Names> =
            parts.filter(|part| headings(part).iter().any(|h| heading.contains(h))).map(Names::of).collect();
        assert!(!parts.is_empty(), "{heading:?}");
        let known = |word: &str| {
            parts.iter().any(|part| part.keys.contains(word) || part.values.contains(word))
                || commands().contains(&word)
                || NO_KEYS.contains(&word)
        };
        let is_key = |word: &&str| {
            !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        };
        let unknown: Vec<&str> = quoted.into_iter().filter(is_key).filter(|word| !known(word)).collect();
        assert!(unknown.is_empty(), "under {heading:?} in docs/json.md, not in the schema: {unknown:?}");
    }
}

#[test]
fn the_schema_has_a_report_of_each_command() {
    let branches = schema()["allOf"].as_array().unwrap();
    let of = |branch: &'static Value| {
        let command = branch["if"]["properties"]["run"]["properties"]["command"]["const"].as_str();
        (command.unwrap(), branch["then"]["$ref"].as_str().unwrap())
    };
    let branches: Vec<(&str, &str)> = branches.iter().map(of).collect();
    assert_eq!(branches.iter().map(|(command, _)| *command).collect::<Vec<_>>(), commands());
    for (command, definition) in branches {
        assert_eq!(definition, format!("#/$defs/{command}"));
    }
}

#[test]
fn methods_are_those_of_the_program() {
    let names = schema()["$defs"]["method"]["enum"].as_array().unwrap();
    assert_eq!(names.iter().filter_map(Value::as_str).collect::<Vec<_>>(), Method::ALL.map(Method::name));
}

#[test]
fn what_is_no_report_is_refused() {
    let report = json(&["modes", "hudin-2012", "--max-hz", "300"]);
    assert_eq!(faults(&report), [""; 0]);
    let changed = |pointer: &str, to: Value| {
        let mut report = report.clone();
        *report.pointer_mut(pointer).unwrap() = to;
        faults(&report)
    };
    for (pointer, to) in [
        ("/count", value!(2.5)),
        ("/count", value!(-1)),
        ("/max_hz", Value::Null),
        ("/frequencies_hz", value!(300.0)),
        ("/frequencies_hz/0", value!("164 Hz")),
        ("/surface", value!(["hudin-2012"])),
        ("/run", Value::Null),
        ("/run/schema", value!("report-2")),
        ("/run/command", value!("focus")),
        ("/run/command", value!("mode")),
        ("/run/date", value!("today")),
        ("/run/surfaces/0", value!({ "name": "hudin-2012" })),
    ] {
        assert!(!changed(pointer, to.clone()).is_empty(), "{pointer}: {to}");
    }
    assert!(changed("/decay_times_s/0", Value::Null).is_empty());
    assert!(changed("/run/ask", value!({ "anything": 1 })).is_empty());
    for key in report.as_object().unwrap().keys() {
        let mut less = report.clone();
        less.as_object_mut().unwrap().remove(key);
        assert!(!faults(&less).is_empty(), "without {key}");
    }
    for place in ["", "/run", "/run/surfaces/0"] {
        let mut more = report.clone();
        let object = more.pointer_mut(place).and_then(Value::as_object_mut).unwrap();
        object.insert("more".into(), value!(1));
        assert!(!faults(&more).is_empty(), "more in `{place}`");
    }
}
