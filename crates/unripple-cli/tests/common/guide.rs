//! Keys of reports, as docs/json.md defines them.

use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// The guide to JSON output.
const GUIDE: &str = include_str!("../../../../docs/json.md");

/// Keys whose values the guide leaves to others: options, and numbers of the paper's sections, whose keys name quantity and unit.
const ELSEWHERE: [&str; 3] = ["ask", "asked", "data"];

/// The guide's text before its first heading, which is about all commands, and its sections.
fn split() -> (&'static str, impl Iterator<Item = &'static str>) {
    let (top, rest) = GUIDE.split_once("\n## ").unwrap();
    (top, rest.split("\n## "))
}

/// What a section's heading names: commands, or `run`.
fn named(section: &'static str) -> Vec<&'static str> {
    section.lines().next().unwrap_or_default().split(", ").collect()
}

/// What stands in backticks in a text.
fn quoted(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.split('`').skip(1).step_by(2)
}

/// The guide's sections: what each heading names, and what stands in backticks below it.
pub fn sections() -> Vec<(Vec<&'static str>, BTreeSet<&'static str>)> {
    split().1.map(|section| (named(section), quoted(section).collect())).collect()
}

/// What stands in backticks at the guide's top, for all commands, and under the headings that name one of `commands`.
pub fn defined(commands: &[&str]) -> BTreeSet<&'static str> {
    let (top, sections) = split();
    let meant = sections.filter(|&section| named(section).iter().any(|command| commands.contains(command)));
    std::iter::once(top).chain(meant).flat_map(quoted).collect()
}

/// The headings under which the keys of a command's report are defined.
pub fn headings(command: &str) -> Vec<&str> {
    match command {
        "waveform" | "stroke" => vec!["focus"],
        // Its rows are those of a focus.
        "compare" => vec!["compare", "focus"],
        command => vec![command],
    }
}

/// Adds the paths of all keys that are not among those `defined`.
fn look(value: &Value, path: &str, defined: &BTreeSet<&str>, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => look_into(map, path, defined, found),
        Value::Array(list) => list.iter().for_each(|value| look(value, path, defined, found)),
        _ => {}
    }
}

fn look_into(map: &Map<String, Value>, path: &str, defined: &BTreeSet<&str>, found: &mut BTreeSet<String>) {
    for (key, value) in map {
        let path = format!("{path}/{key}");
        if !ELSEWHERE.contains(&key.as_str()) {
            look(value, &path, defined, found);
        }
        if !defined.contains(key.as_str()) {
            found.insert(path);
        }
    }
}

/// Paths of the keys of a report that the guide does not define under its command's heading.
pub fn undefined(report: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let Some(command) = report["run"]["command"].as_str() else { return found };
    let mut keys = report.as_object().cloned().unwrap_or_default();
    let run = keys.remove("run").unwrap_or_default();
    look_into(&keys, "", &defined(&headings(command)), &mut found);
    look(&run, "/run", &defined(&["run"]), &mut found);
    found
}
