//! The guide to the surface file says what the reader does.

use unripple_store::parse_surface;

const GUIDE: &str = include_str!("../../../docs/surface-file.md");

/// Text of the fenced blocks that begin with this line.
fn blocks(fence: &str) -> Vec<String> {
    let mut blocks: Vec<String> = Vec::new();
    let mut inside = false;
    for line in GUIDE.lines() {
        if line.starts_with("```") {
            inside = !inside && line == fence;
            if inside {
                blocks.push(String::new());
            }
        } else if let (true, Some(block)) = (inside, blocks.last_mut()) {
            block.push_str(line);
            block.push('\n');
        }
    }
    blocks
}

/// Cells of every table row below each `## [table]` heading, with the table's name.
fn rows() -> Vec<(&'static str, Vec<&'static str>)> {
    let mut table = "";
    let mut rows = Vec::new();
    for line in GUIDE.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            table = heading.trim_matches(['[', ']']);
        } else if line.starts_with("| `") {
            rows.push((table, line.trim_matches('|').split('|').map(str::trim).collect()));
        }
    }
    rows
}

#[test]
fn examples_load() {
    let examples = blocks("```toml");
    assert_eq!(examples.len(), 2);
    for example in examples {
        if let Err(faults) = parse_surface(&example, "guide.toml") {
            panic!("{faults:#}");
        }
    }
}

#[test]
fn faults_read_as_printed() {
    let [bad, printed] = [blocks("```toml faults").remove(0), blocks("```text").remove(0)];
    let faults = parse_surface(&bad, "film.toml").unwrap_err();
    assert_eq!(format!("{faults:#}\n"), printed);
}

#[test]
fn ranges_are_those_of_the_reader() {
    let whole = blocks("```toml").remove(1);
    let mut checked = 0;
    for (table, cells) in rows().into_iter().filter(|(_, cells)| cells.len() == 5) {
        let key = cells[0].trim_matches('`');
        if !cells[3].starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            continue;
        }
        let header = if table == "actuator" { "[[actuator]]".into() } else { format!("[{table}]") };
        let without: Vec<&str> = whole.lines().filter(|l| !l.starts_with(&format!("{key} ="))).collect();
        let text = without.join("\n").replacen(&header, &format!("{header}\n{key} = nan"), 1);
        let text = if key == "loss_factor" { text.replacen("decay_time_ms", "# ", 1) } else { text };
        let faults = parse_surface(&text, "guide.toml").unwrap_err();
        let fault = faults.faults().iter().find(|f| f.key.ends_with(key) && f.found == "nan");
        let fault = fault.unwrap_or_else(|| panic!("{key}: {faults:#}"));
        assert!(fault.expected.starts_with(&format!("a number from {}", cells[3])), "{key}: {fault}");
        assert!(
            fault.expected.contains(&format!(" {}", cells[1])) || cells[1].contains("drive"),
            "{key}: {fault}"
        );
        checked += 1;
    }
    assert_eq!(checked, 19);
}

/// Unknown keys are answered with the list of known ones: the guide has exactly those.
#[test]
fn keys_are_those_of_the_reader() {
    for (table, header) in [
        ("outline", "[outline]"),
        ("sheet", "[sheet]"),
        ("drive", "[drive]"),
        ("finger", "[finger]"),
        ("actuator", "[[actuator]]"),
    ] {
        let text = blocks("```toml").remove(1).replacen(header, &format!("{header}\nzzz = 1"), 1);
        let faults = parse_surface(&text, "guide.toml").unwrap_err();
        let fault = faults.faults().iter().find(|f| f.key.ends_with(".zzz")).unwrap();
        let mut known: Vec<&str> = fault.expected.trim_start_matches("one of ").split(", ").collect();
        let mut written: Vec<&str> = rows()
            .into_iter()
            .filter(|(t, _)| *t == table)
            .map(|(_, cells)| cells[0].trim_matches('`'))
            .collect();
        known.sort_unstable();
        written.sort_unstable();
        assert_eq!(known, written, "{header}");
    }
}

#[test]
fn names_of_materials() {
    for material in unripple_core::MATERIALS {
        assert!(GUIDE.contains(material.name), "{}", material.name);
    }
    for builtin in unripple_store::BUILTINS {
        assert!(GUIDE.contains(builtin.name), "{}", builtin.name);
    }
}
