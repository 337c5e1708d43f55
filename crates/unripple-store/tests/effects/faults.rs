//! Faults of files of effects, and what is said of them.

use unripple_store::parse_effects;

/// The faults of one effect of a kind with some lines of text, as key, what was expected and the nearest.
fn faults(lines: &str) -> Vec<(String, String, Option<String>)> {
    let text = format!("format = 1\n[[effect]]\n{lines}\n");
    let faults = parse_effects(&text, "f.toml").err().map(|f| f.faults().to_vec()).unwrap_or_default();
    faults.into_iter().map(|f| (f.key, f.expected, f.nearest)).collect()
}

/// Asserts that there is one fault, of a key, that says something.
fn one(lines: &str, key: &str, says: &str) {
    let found = faults(lines);
    assert_eq!(found.len(), 1, "{lines}: {found:?}");
    assert!(found[0].0 == key && found[0].1.contains(says), "{lines}: {found:?}");
}

#[test]
fn all_at_once_with_their_place() {
    let text = "format = 1\nabuot = \"x\"\n\n[[effect]]\nkind = \"texture\"\nevery_mm = 0\nrate_hz = 3\n\n[[effect]]\nkind = \"hmu\"\n";
    let faults = parse_effects(text, "bad.toml").unwrap_err();
    let expected = [
        "bad.toml:2:1: abuot: expected one of format, name, about, effect, found an unknown key `abuot` (nearest: about)",
        "bad.toml:6:12: effect[0].every_mm: expected a number from 0.1 to 1000 mm, found 0 (nearest: 0.1)",
        "bad.toml:7:1: effect[0].rate_hz: expected this key only where kind = \"pulse-train\" or kind = \"shape\", found an unknown key `rate_hz`",
        "bad.toml:10:8: effect[1].kind: expected \"button\" or \"texture\" or \"edge\" or \"notch\" or \"pulse-train\" or \"shape\" or \"hum\" or \"score\", found \"hmu\" (nearest: \"hum\")",
    ];
    let shown = format!("{faults:#}");
    for (line, expected) in shown.lines().skip(1).zip(expected) {
        assert!(line.starts_with(expected), "{line}\n{expected}");
    }
    assert_eq!(faults.faults().len(), expected.len(), "{shown}");
}

#[test]
fn each_in_its_words() {
    one("kind = \"button\"\ngain = 0.5\nfelt_db = 3", "effect[0].felt_db", "only one of gain and felt_db");
    one("kind = \"button\"\ngain = 1.5", "effect[0].gain", "a number from 0 to 1");
    one("kind = 3", "effect[0].kind", "\"button\" or");
    one("name = \"x\"", "effect[0].kind", "\"button\" or");
    one("kind = \"edge\"", "effect[0]", "line_mm, or a region");
    one("kind = \"edge\"\nline_mm = [[1, 1], [1, 1]]", "effect[0].line_mm", "0.1 mm apart");
    one("kind = \"edge\"\nline_mm = [[1, 1], [1]]", "effect[0].line_mm[1]", "[x, y] in mm");
    one("kind = \"notch\"\nevery_mm = 5\nhysteresis = 0.5", "effect[0].hysteresis", "0 to 0.45");
    one("kind = \"pulse-train\"\nrate_hz = 5\ncount = 1.5", "effect[0].count", "a whole number");
    one(
        "kind = \"pulse-train\"\nrate_hz = 5\nenvelope = [[5, 1], [4, 0]]",
        "effect[0].envelope[1]",
        "no earlier",
    );
    one("kind = \"shape\"\nspeed_mm_per_s = 50", "effect[0]", "exactly one of polygon_mm and path_mm");
    let triangle = "kind = \"shape\"\npolygon_mm = [[0, 0], [9, 0], [0, 9]]";
    one(triangle, "effect[0]", "exactly one of speed_mm_per_s and spacing_mm");
    one(&format!("{triangle}\nspacing_mm = 0.1"), "effect[0].polygon_mm", "expected 2 to 256");
    one("kind = \"hum\"\nfrequency_hz = 5000", "effect[0].frequency_hz", "1 to 1000 Hz");
    one(
        "kind = \"hum\"\nfrequency_hz = \"a\"\namplitude = [[0, 1]]",
        "effect[0].frequency_hz",
        "or rows [[ms, Hz]",
    );
    one("kind = \"hum\"\nfrequency_hz = 50\namplitude = [[0, 1]]", "effect[0].amplitude", "duration");
    one("kind = \"hum\"\nfrequency_hz = 50\nplay = \"once\"", "effect[0].play", "beside amplitude");
    one("kind = \"score\"", "effect[0].event", "[[effect.event]]");
    let event = "kind = \"score\"\nperiod_ms = 50\n[[effect.event]]\nat_ms = 70";
    one(event, "effect[0].period_ms", "no shorter");
    let found = faults(&event.replace("period_ms = 50", "").replace("at_ms", "at_s"));
    assert_eq!(found[1].2.as_deref(), Some("at_ms"), "{found:?}");
    one(
        "kind = \"score\"\n[[effect.event]]\nat_ms = 0\nfrequency_hz = 50",
        "effect[0].event[0].frequency_hz",
        "amplitude",
    );
    let region = |table: &str| format!("kind = \"button\"\nregion = {{ {table} }}");
    one(&region(""), "effect[0].region", "exactly one of");
    one(&region("circle_mm = 5"), "effect[0].region.centre_mm", "[x, y] in mm");
    one(
        &region("circle_mm = 5, centre_mm = [1, 2], at_mm = [1, 2]"),
        "effect[0].region.at_mm",
        "beside rectangle_mm",
    );
    one(&region("polygon_mm = [[0, 0], [1, 1]]"), "effect[0].region.polygon_mm", "3 to 1024 corners");
    one(
        "kind = \"button\"\nname = \"a\"\n[[effect]]\nkind = \"button\"\nname = \"a\"",
        "effect[1].name",
        "a unique name",
    );
}

#[test]
fn the_whole_set_is_bounded() {
    let hum = "[[effect]]\nkind = \"hum\"\namplitude = [[0, 1], [70000, 0]]\nfrequency_hz = 50\n";
    let faults = parse_effects(&format!("format = 1\n{hum}{hum}"), "long.toml").unwrap_err();
    assert!(faults.to_string().contains("1 fault"), "{faults:#}");
    assert!(
        format!("{faults:#}")
            .contains("waveforms of a set, in seconds: expected a number from 0 to 120, found 140")
    );
    let many = format!("format = 1\n{}", "[[effect]]\nkind = \"button\"\n".repeat(65));
    assert!(parse_effects(&many, "many.toml").is_err());
    assert!(parse_effects(&" ".repeat(2 << 20), "large.toml").is_err());
}
