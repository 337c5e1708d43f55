//! The guide to the surface file says what the reader does.

use crate::guide_common;

use guide_common::{blocks, rows};
use std::collections::BTreeSet;
use unripple_store::parse_surface;

const GUIDE: &str = include_str!("../../../../docs/surface-file.md");

#[test]
fn examples_load() {
    let examples = blocks(GUIDE, "```toml");
    assert_eq!(examples.len(), 8);
    for example in examples {
        if let Err(faults) = parse_surface(&example, "guide.toml") {
            panic!("{faults:#}");
        }
    }
}

#[test]
fn faults_read_as_printed() {
    let [bad, printed] = [blocks(GUIDE, "```toml faults").remove(0), blocks(GUIDE, "```text").remove(0)];
    let faults = parse_surface(&bad, "film.toml").unwrap_err();
    assert_eq!(format!("{faults:#}\n"), printed);
}

/// The example with a key set to not-a-number in the table that begins with line `header`, wherever the key was.
fn spoilt(example: &str, header: usize, key: &str) -> String {
    let lines = example.lines().enumerate().filter(|(_, l)| !l.starts_with(&format!("{key} =")));
    lines.map(|(i, l)| if i == header { format!("{l}\n{key} = nan\n") } else { format!("{l}\n") }).collect()
}

/// What the reader expects of a number of some table, tried in every table of that name of every example.
fn expected(table: &str, key: &str) -> Vec<String> {
    let mut texts = Vec::new();
    for example in blocks(GUIDE, "```toml") {
        if table == "Springs" {
            // The values that the examples have.
            let spoil = |text: String, value: &str| {
                text.replace(&format!("{key} = {value}"), &format!("{key} = nan"))
            };
            let text = ["0.5", "0.6", "3", "0.25"].into_iter().fold(example.clone(), spoil);
            texts.push(text.replace("tilt_n = 2.0", "tilt_n = nan"));
        }
        let headers = [format!("[{table}]"), format!("[[{table}]]")];
        let starts = example.lines().enumerate().filter(|(_, l)| headers.iter().any(|h| h == l));
        for (i, _) in starts {
            let text = spoilt(&example, i, key);
            texts.push(if key == "loss_factor" { text.replacen("decay_time_ms", "# ", 1) } else { text });
        }
    }
    let read = texts.iter().filter_map(|text| parse_surface(text, "guide.toml").err());
    let faults = read.flat_map(|faults| faults.faults().to_vec());
    faults.filter(|f| f.key.ends_with(&format!(".{key}")) && f.found == "nan").map(|f| f.expected).collect()
}

#[test]
fn ranges_are_those_of_the_reader() {
    let mut checked = 0;
    for (table, cells) in rows(GUIDE).into_iter().filter(|(_, cells)| cells.len() == 5) {
        let key = cells[0].trim_matches('`');
        if !cells[3].starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            continue;
        }
        let range = format!("a number from {}", cells[3]);
        let said = expected(table, key);
        assert!(said.iter().any(|said| said.starts_with(&range)), "{table}.{key}: {range} {said:?}");
        assert!(
            said.iter().any(|said| said.contains(&format!(" {}", cells[1]))) || cells[1].contains("drive"),
            "{table}.{key}: {said:?}"
        );
        checked += 1;
    }
    assert_eq!(checked, 57);
}

/// Unknown keys are answered with the list of known ones: the guide has exactly those.
#[test]
fn keys_are_those_of_the_reader() {
    let tables = [
        ("outline", true),
        ("hole", false),
        ("sheet", true),
        ("scatterer", false),
        ("lattice", false),
        ("drive", true),
        ("finger", true),
        ("actuator", false),
    ];
    // A key can be added only to a table that the example has.
    let has_all =
        |text: &String| tables.iter().all(|(t, single)| !single || text.contains(&format!("[{t}]\n")));
    let whole = blocks(GUIDE, "```toml").into_iter().find(has_all).unwrap();
    for (table, single) in tables {
        let text = if single {
            whole.replacen(&format!("[{table}]"), &format!("[{table}]\nzzz = 1"), 1)
        } else {
            // Of no known kind, so that the keys of all kinds are known.
            format!(
                "{whole}\n[[{table}]]\nzzz = 1\n{}",
                if table == "hole" { "" } else { "kind = \"zzz\"\n" }
            )
        };
        let faults = parse_surface(&text, "guide.toml").unwrap_err();
        let fault = faults.faults().iter().find(|f| f.key.ends_with(".zzz")).unwrap();
        let known: BTreeSet<&str> = fault.expected.trim_start_matches("one of ").split(", ").collect();
        let rows = rows(GUIDE);
        let written: BTreeSet<&str> =
            rows.iter().filter(|(t, _)| *t == table).map(|(_, cells)| cells[0].trim_matches('`')).collect();
        assert_eq!(known, written, "{table}");
    }
}

#[test]
fn names_of_materials() {
    for material in unripple_core::MATERIALS {
        for name in std::iter::once(&material.name).chain(material.aliases) {
            assert!(GUIDE.contains(name), "{name}");
        }
    }
    for builtin in unripple_store::BUILTINS {
        assert!(GUIDE.contains(builtin.name), "{}", builtin.name);
    }
}
