//! Figures of a report: its numbers and short texts, by JSON pointers.

use super::pairs::Pairs;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Keys at the top of a report that are no figures: how it was made, and remarks, which may be named one by one.
const NO_FIGURES: [&str; 6] = ["run", "program", "version", "command", "files", "notes"];

/// Keys of times by the clock and of numbers that depend on them, which differ from run to run.
const OF_THE_CLOCK: [&str; 8] =
    ["plan_s", "drive_s", "seconds", "fit_s", "computing_s", "making_s", "wall_s", "block_work_s"];

/// Longest list whose items are figures. Curves are longer; a place, a range or a few targets are not.
const LONGEST_LIST: usize = 16;

/// Longest text that is a figure, in bytes: names and short remarks, no sentences.
const LONGEST_TEXT: usize = 80;

/// Most figures of a design: lists in lists could have any number.
const MOST: usize = 2000;

/// Figures by their JSON pointers, and how many lists and texts are left out since they are long.
#[derive(Default)]
pub(super) struct Flat {
    /// Figures, in the order of their pointers or as they were chosen.
    pub figures: Pairs,
    /// Number of lists, texts and further figures that are left out.
    pub left_out: usize,
}

/// Whether a JSON pointer leads to a time by the clock.
pub(super) fn is_of_the_clock(pointer: &str) -> bool {
    pointer.split('/').any(|step| OF_THE_CLOCK.contains(&step))
}

/// The figures of a report under the `chosen` pointers, or all of them if none is chosen. A pointer that leads nowhere gives null.
pub(super) fn of(report: &Value, chosen: &[String]) -> Flat {
    let mut flat = Flat::default();
    if let (Value::Object(map), []) = (report, chosen) {
        for (key, value) in sorted(map) {
            if !NO_FIGURES.contains(&key.as_str()) {
                flat.add(&below("", key), value);
            }
        }
    }
    for pointer in chosen {
        match report.pointer(pointer) {
            Some(value @ (Value::Object(_) | Value::Array(_))) => flat.add(pointer, value),
            found => flat.figures.0.push((pointer.clone(), found.cloned().unwrap_or_default())),
        }
    }
    flat
}

impl Flat {
    /// Adds a value of the report, with all that is in it.
    fn add(&mut self, at: &str, value: &Value) {
        match value {
            Value::Object(map) => {
                for (key, inner) in sorted(map) {
                    self.add(&below(at, key), inner);
                }
            }
            Value::Array(list) if list.len() <= LONGEST_LIST => {
                for (i, inner) in list.iter().enumerate() {
                    self.add(&format!("{at}/{i}"), inner);
                }
            }
            Value::Array(_) => self.left_out += 1,
            Value::String(text) if text.len() > LONGEST_TEXT || text.contains('\n') => self.left_out += 1,
            _ if self.figures.0.len() >= MOST => self.left_out += 1,
            value => self.figures.0.push((at.to_owned(), value.clone())),
        }
    }
}

/// The keys of a table in order, without times by the clock.
fn sorted(map: &Map<String, Value>) -> BTreeMap<&String, &Value> {
    map.iter().filter(|(key, _)| !OF_THE_CLOCK.contains(&key.as_str())).collect()
}

/// The pointer to a key.
fn below(at: &str, key: &str) -> String {
    format!("{at}/{}", key.replace('~', "~0").replace('/', "~1"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn names(flat: &Flat) -> Vec<&str> {
        flat.figures.0.iter().map(|(name, _)| name.as_str()).collect()
    }

    #[test]
    fn numbers_and_short_texts_are_figures() {
        let report = json!({
            "run": { "date": "today" }, "version": "0.1.0", "surface": "film", "contrast": 21.5, "plan_s": 0.1,
            "curve": vec![0.0; 17], "why": "x".repeat(81), "targets": [{ "at_m": [0.1, 0.2], "peak": null, "a/b": true }],
        });
        let flat = of(&report, &[]);
        let expected = [
            "/contrast",
            "/surface",
            "/targets/0/at_m/0",
            "/targets/0/at_m/1",
            "/targets/0/a~1b",
            "/targets/0/peak",
        ];
        let mut found = names(&flat);
        found.sort_unstable();
        let mut sorted = expected.to_vec();
        sorted.sort_unstable();
        assert_eq!((found, flat.left_out), (sorted, 2));
        for (name, value) in &flat.figures.0 {
            assert_eq!(report.pointer(name), Some(value));
        }
    }

    #[test]
    fn chosen_figures_come_in_their_order() {
        let report = json!({ "a": 1, "b": { "c": [2, 3] }, "long": "x".repeat(100) });
        let chosen = ["/b", "/a", "/none", "/long"].map(str::to_owned);
        assert_eq!(names(&of(&report, &chosen)), ["/b/c/0", "/b/c/1", "/a", "/none", "/long"]);
    }

    #[test]
    fn times_by_the_clock_are_known() {
        assert!(is_of_the_clock("/methods/0/plan_s") && !is_of_the_clock("/window_s"));
    }
}
