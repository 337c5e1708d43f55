//! Imports run strictly downward: a crate depends only on crates of lower floors.

use crate::sources;
use std::path::Path;

/// The floor of each crate: imports go to lower numbers only.
const FLOORS: &[(&str, i8)] = &[
    ("unripple-linalg", -1),
    ("unripple-core", 0),
    ("unripple-dsp", 1),
    ("unripple-plates", 1),
    ("unripple-physics", 2),
    ("unripple-focus", 2),
    ("unripple-field", 2),
    ("unripple-player", 2),
    ("unripple-effects", 2),
    ("unripple-placement", 3),
    ("unripple-store", 3),
    ("unripple-exchange", 3),
    ("unripple-plot", 3),
    ("unripple-touch", 3),
    ("unripple-devices", 3),
    ("unripple-calibrate", 3),
    ("unripple", 4),
    ("unripple-live", 4),
    ("unripple-tasks", 5),
    ("unripple-paper", 6),
    ("unripple-session", 6),
    ("unripple-viewer", 7),
    ("unripple-web", 7),
    ("unripple-cli", 8),
    ("unripple-python", 9),
];

fn floor(name: &str) -> Option<i8> {
    FLOORS.iter().find(|(n, _)| *n == name).map(|(_, floor)| *floor)
}

/// Finds dependencies that do not run downward, and crates without a floor.
pub fn check(root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for manifest in sources::files(&root.join("crates"), &["Cargo.toml"]) {
        let text = std::fs::read_to_string(&manifest).unwrap_or_default();
        let table: toml::Table = match text.parse() {
            Ok(table) => table,
            Err(error) => {
                faults.push(format!("{}: {error}", manifest.display()));
                continue;
            }
        };
        let name =
            table.get("package").and_then(|p| p.get("name")).and_then(|n| n.as_str()).unwrap_or_default();
        faults.extend(breaches(name, table.get("dependencies").and_then(|d| d.as_table())));
    }
    faults
}

fn breaches(name: &str, dependencies: Option<&toml::Table>) -> Vec<String> {
    let Some(own) = floor(name) else {
        return vec![format!("crate `{name}` stands on no floor: add it to xtask/src/floors.rs")];
    };
    dependencies
        .into_iter()
        .flatten()
        .filter_map(|(other, _)| floor(other).map(|f| (other, f)))
        .filter(|(_, f)| *f >= own)
        .map(|(other, f)| format!("`{name}` (floor {own}) depends on `{other}` (floor {f})"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn upward_imports_are_seen() {
        let table: toml::Table = "unripple-cli = 1\nunripple-dsp = 1".parse().unwrap();
        assert_eq!(breaches("unripple-focus", Some(&table)).len(), 1);
        assert_eq!(breaches("unripple-nowhere", None).len(), 1);
    }
}
