//! One test per kind of bad surface file, with the message people read.

use crate::good::{GOOD, fault, faults, says};
use unripple_store::{BUILTINS, parse_surface};

#[test]
fn the_good_file_is_good() {
    assert_eq!(faults(GOOD), []);
}

#[test]
fn empty_file() {
    let list = faults("");
    let keys: Vec<&str> = list.iter().map(|f| f.key.as_str()).collect();
    assert_eq!(keys, ["format", "outline", "sheet", "drive", "actuator"]);
    assert!(list.iter().all(|f| (f.line, f.column) == (1, 1)));
    assert_eq!(list[0].to_string(), "format: expected format = 1 at the top, found no such key (nearest: 1)");
}

#[test]
fn formats() {
    assert_eq!(
        says("format = 1", ""),
        "1:1: format: expected format = 1 at the top, found no such key (nearest: 1)"
    );
    let other = "1:10: format: expected 1, the format this version reads, found 2 (nearest: 1)";
    assert_eq!(says("format = 1", "format = 2"), other);
    assert_eq!(faults(&GOOD.replace("format = 1", "format = 2\nfancy = 3")).len(), 1);
}

#[test]
fn toml_itself() {
    let list = faults("format = 1\nname = film\n");
    assert_eq!(list.len(), 1);
    assert_eq!((list[0].line, list[0].column), (2, 8));
    assert!(list[0].to_string().starts_with("expected a TOML file, found an error of TOML: "), "{}", list[0]);
    assert_eq!(faults("format = 1\nformat = 1\n")[0].found, "an error of TOML: duplicate key");
}

#[test]
fn unknown_keys_and_tables() {
    let typo = fault("thickness_mm = 0.125", "thickness_mm = 0.125\nthicknes_mm = 0.1");
    assert_eq!((typo.key.as_str(), typo.line, typo.column), ("sheet.thicknes_mm", 9, 1));
    assert_eq!(typo.found, "an unknown key `thicknes_mm`");
    assert_eq!(typo.nearest.as_deref(), Some("thickness_mm"));
    let list = faults(&GOOD.replace("[drive]", "[drvie]"));
    assert_eq!(list.len(), 2, "{list:#?}");
    assert_eq!(list[0].to_string(), "drive: expected a table [drive], found no such key");
    assert_eq!(list[1].nearest.as_deref(), Some("drive"));
    assert_eq!(fault("kind = ", "knid = \"force\"\nkind = ").key, "actuator[0].knid");
}

#[test]
fn wrong_types() {
    assert_eq!(
        says("thickness_mm = 0.125", "thickness_mm = \"thin\""),
        "8:16: sheet.thickness_mm: expected a number from 0.001 to 100 mm, found \"thin\""
    );
    assert_eq!(
        says("rectangle_mm = [150, 100]", "rectangle_mm = 150"),
        "4:16: outline.rectangle_mm: expected [width, height] in mm, found 150"
    );
    assert_eq!(
        says("name = \"film\"", "name = 3"),
        "2:8: name: expected a name, as one line of text in quotes, found 3"
    );
    assert_eq!(
        faults(&GOOD.replace("[[actuator]]", "[actuator]"))[0].expected,
        "a list of tables, each headed [[actuator]]"
    );
    assert_eq!(faults("format = 1\nsheet = 3")[3].to_string(), "sheet: expected a table, [sheet], found 3");
}

#[test]
fn numbers_out_of_range() {
    for bad in ["-0.125", "0", "0.0", "-1"] {
        let message = says("thickness_mm = 0.125", &format!("thickness_mm = {bad}"));
        let expected = format!(
            "8:16: sheet.thickness_mm: expected a number from 0.001 to 100 mm, found {bad} (nearest: 0.001)"
        );
        assert_eq!(message, expected);
    }
    let nan = fault("thickness_mm = 0.125", "thickness_mm = nan");
    assert_eq!((nan.found.as_str(), nan.nearest), ("nan", None));
    let infinite = fault("tension_n_per_m = 200", "tension_n_per_m = inf");
    assert_eq!((infinite.found.as_str(), infinite.nearest.as_deref()), ("inf", Some("1000000")));
    for (line, nearest) in [
        ("density_kg_m3 = 1.4e6", "30000"),
        ("poisson_ratio = 0.5", "0.4999"),
        ("poisson_ratio = -1", "-0.9999"),
        ("young_gpa = -4", "0"),
        ("young_gpa = 4e9", "2000"),
        ("strength_mpa = 0", "0.01"),
    ] {
        let fault = fault("air =", &format!("{line}\nair ="));
        assert_eq!(fault.nearest.as_deref(), Some(nearest), "{line}");
        assert_eq!(fault.line, 11);
    }
    assert_eq!(fault("70", "0").key, "sheet.decay_time_ms");
    assert_eq!(fault("48000", "1e400").nearest.as_deref(), Some("10000000"));
    assert_eq!(fault("[12, 31]", "[12, nan]").key, "actuator[0].at_mm[1]");
}

#[test]
fn materials() {
    assert_eq!(fault("\"BoPET\"", "\"BoPTE\"").nearest.as_deref(), Some("\"BoPET\""));
    let list = faults(&GOOD.replace("\"BoPET\"", "3\nyoung_gpa = -1"));
    assert_eq!(
        (list.len(), list[0].key.as_str(), list[1].key.as_str()),
        (2, "sheet.material", "sheet.young_gpa")
    );
    let list = faults(&GOOD.replace("material = \"BoPET\"", ""));
    let keys: Vec<&str> = list.iter().map(|f| f.key.as_str()).collect();
    assert_eq!(keys, ["sheet.young_gpa", "sheet.density_kg_m3", "sheet.poisson_ratio"]);
    assert!(list.iter().all(|f| f.line == 6), "at the table's header");
}

#[test]
fn nothing_pulls_back() {
    assert_eq!(
        says("tension_n_per_m = 200", "tension_n_per_m = 0\nyoung_gpa = 0"),
        "9:19: sheet.tension_n_per_m: expected a positive tension_n_per_m or young_gpa: nothing else pulls the sheet back, found \
         neither tension nor stiffness"
    );
}

#[test]
fn decay() {
    assert_eq!(fault("decay_time_ms = 70", "").expected, "one of decay_time_ms, loss_factor");
    let both = fault("decay_time_ms = 70", "decay_time_ms = 70\nloss_factor = 0.01");
    assert_eq!((both.key.as_str(), both.line), ("sheet.loss_factor", 11));
    let table = says("decay_time_ms = 70", "decay_time_ms = [[100, 70], [90, 60]]");
    assert_eq!(
        table,
        "10:29: sheet.decay_time_ms[1]: expected frequencies that ascend, so more than 100 Hz here, found [90, 60]"
    );
    assert_eq!(fault("decay_time_ms = 70", "decay_time_ms = [[100, 70], [200]]").expected, "[Hz, ms]");
    assert_eq!(fault("decay_time_ms = 70", "decay_time_ms = []").found, "[]");
}

#[test]
fn bands() {
    assert_eq!(
        says("[0, 3000]", "[0, 30000]"),
        "13:11: drive.band_hz: expected a band below 24000 Hz, half the sample rate, found [0, 30000] \
         (nearest: [0, 23999])"
    );
    // Samples cannot tell a wave at half their rate from none.
    assert_eq!(
        says("[0, 3000]", "[0, 24000]"),
        "13:11: drive.band_hz: expected a band below 24000 Hz, half the sample rate, found [0, 24000] \
         (nearest: [0, 23999])"
    );
    assert_eq!(fault("[0, 3000]", "[23999.5, 24000]").nearest, None);
    assert_eq!(faults(&GOOD.replace("[0, 3000]", "[0, 23999.5]")), []);
    assert_eq!(fault("[0, 3000]", "[3000, 100]").nearest.as_deref(), Some("[100, 3000]"));
    assert_eq!(fault("[0, 3000]", "[3000, 3000]").nearest, None);
    assert_eq!(fault("[0, 3000]", "[0]").expected, "[lowest, highest] in Hz");
    assert_eq!(fault("band_hz = [0, 3000]\n", "").key, "drive.band_hz");
}

/// The header of a WAV file has a whole number of samples per second, and a number of bytes per second below 2^32.
#[test]
fn rates() {
    let rate = "sample_rate_hz = 48000";
    assert_eq!(
        says(rate, "sample_rate_hz = 44100.5"),
        "14:18: drive.sample_rate_hz: expected a whole number of Hz, since the header of a WAV file holds no other, found 44100.5 \
         (nearest: 44101)"
    );
    assert_eq!(faults(&GOOD.replace(rate, "sample_rate_hz = 44.1e3")), []);
    assert_eq!(fault(rate, "sample_rate_hz = 99.5").nearest.as_deref(), Some("100"));
    let array = |rate: &str| {
        let grid = GOOD.replace("at_mm = [12, 31]", "grid_mm = [[1, 1], [99, 99]]\ncount = [64, 64]");
        faults(&grid.replace("48000", rate))
    };
    assert_eq!(array("262143"), []);
    let list = array("262144");
    assert_eq!((list.len(), list[0].line, list[0].column), (1, 14, 18));
    assert_eq!(
        list[0].to_string(),
        "drive.sample_rate_hz: expected at most 262143 Hz with 4096 actuators, since a WAV file holds no more, found 262144 \
         (nearest: 262143)"
    );
}

#[test]
fn shapes_are_exactly_one() {
    let none = fault("rectangle_mm = [150, 100]\n", "");
    assert_eq!((none.key.as_str(), none.found.as_str(), none.line), ("outline", "none", 3));
    let two = fault("edge = \"clamped\"", "circle_mm = 70");
    assert_eq!(two.found, "outline.rectangle_mm and outline.circle_mm");
    assert_eq!(fault("rectangle_mm = [150, 100]", "svg = \"a.svg\"").key, "outline.svg");
}

#[test]
fn polygons() {
    let polygon = |vertices: &str| {
        let fault = fault("rectangle_mm = [150, 100]", &format!("polygon_mm = {vertices}"));
        format!("{}: expected {}, found {}", fault.key, fault.expected, fault.found)
    };
    for (vertices, message) in [
        ("[[0, 0], [100, 0]]", "expected at least 3 vertices, found 2 vertices"),
        (
            "[[0, 0], [100, 0], [50, 0]]",
            "expected a polygon that encloses something, found a polygon without area",
        ),
        (
            "[[0, 0], [0, 80], [100, 0]]",
            "expected vertices listed anticlockwise: reverse the list, found vertices listed clockwise",
        ),
        (
            "[[0, 0], [100, 0], [100, 90], [60, -0.0], [0, 80]]",
            "expected a polygon that does not meet itself, found sides 0 and 2 that cross or touch at [60, 0] mm",
        ),
        // A corner sharper, and a slot narrower, than triangles can follow.
        (
            "[[0, 0], [100, 0], [100, 60], [60, 60], [60, 0.3]]",
            "expected a polygon that does not meet itself, found sides 0 and 4 that cross or touch at [0, 0] mm",
        ),
        (
            "[[0, 0], [100, 0], [100, 60], [50.000004, 60], [50.000002, 10], [50, 60], [0, 60]]",
            "expected a polygon that does not meet itself, found sides 3 and 4 that cross or touch at [50.000002, 10] mm",
        ),
        (
            "[[10, 5], [100, 5], [100, 80]]",
            "expected a polygon whose bounding box starts at [0, 0]: take that much from every vertex, \
             found a polygon whose bounding box starts at [10, 5] mm",
        ),
        (
            "[[0, 0], [100, 0], [90, 80], [0, 0]]",
            "expected different vertices: the last side back to the first vertex is drawn by itself, \
             found vertices 3 and 0 in the same place",
        ),
    ] {
        assert_eq!(polygon(vertices), format!("outline.polygon_mm: {message}"));
    }
    assert_eq!(
        polygon("[[0, 0], [1, 2, 3], [1, 1]]"),
        "outline.polygon_mm[1]: expected [x, y] in mm, found [1, 2, 3]"
    );
    let many = format!("[{}]", "[1, 2], ".repeat(5000));
    assert_eq!(polygon(&many), "outline.polygon_mm: expected at most 4096 vertices, found a list of 5000");
}

#[test]
fn edges() {
    assert_eq!(
        says("\"clamped\"", "\"clampd\""),
        "5:8: outline.edge: expected \"clamped\" or \"supported\" or \"free\", found \"clampd\" \
         (nearest: \"clamped\")"
    );
    assert_eq!(
        fault("edge = \"clamped\"", "edge = [\"free\", \"free\"]").expected,
        "one word, or a list of 4, one per side from the bottom, anticlockwise"
    );
    assert_eq!(
        fault("edge = \"clamped\"", "edge = [\"free\", \"soft\", \"free\", \"free\"]").key,
        "outline.edge[1]"
    );
}

#[test]
fn actuators_outside() {
    assert_eq!(
        says("[12, 31]", "[160, 31]"),
        "17:9: actuator[0].at_mm: expected a point inside the outline, which spans 150.0000 x 100.0000 mm and is \
         10.000 mm away, found [160, 31] (nearest: [150, 31])"
    );
    for outline in ["circle_mm = 70", "stadium_mm = [60, 40]", "polygon_mm = [[0,0],[120,0],[90,80]]"] {
        let text = GOOD.replace("rectangle_mm = [150, 100]", outline).replace("[12, 31]", "[3.123456, 99]");
        let list = faults(&text);
        assert_eq!(list.len(), 1, "{outline}: {list:#?}");
        let nearest = list[0].nearest.clone().unwrap();
        assert_eq!(faults(&text.replace("[3.123456, 99]", &nearest)), [], "{outline}: {nearest} is legal");
    }
}

#[test]
fn actuator_counts() {
    let start = GOOD.find("[[actuator]]").unwrap();
    let list = faults(&GOOD[..start]);
    assert_eq!(list.len(), 1);
    let expected = "actuator: expected 1 to 4096 tables headed [[actuator]], found no actuators";
    assert_eq!(list[0].to_string(), expected);
    let many = format!("{}{}", &GOOD[..start], "[[actuator]]\nat_mm = [1, 2]\n".repeat(10_000));
    let list = faults(&many);
    assert_eq!(list.len(), 1);
    assert_eq!((list[0].found.as_str(), list[0].nearest.as_deref()), ("10000 actuators", Some("4096")));
    let most = format!("{}{}", &GOOD[..start], "[[actuator]]\nat_mm = [1, 2]\n".repeat(4096));
    assert_eq!(faults(&most), []);
}

#[test]
fn actuator_names() {
    let twice = faults(&format!("{GOOD}[[actuator]]\nname = \"left\"\nat_mm = [20, 20]\n"));
    assert_eq!(
        twice[0].to_string(),
        "actuator[1].name: expected a unique name, found \"left\", which is also the name of actuator[0]"
    );
    let default = faults(&format!("{}[[actuator]]\nat_mm = [20, 20]\n", GOOD.replace("\"left\"", "\"a2\"")));
    assert_eq!(default[0].key, "actuator[1].name");
    assert_eq!(fault("\"left\"", "\"  \"").found, "\" \"");
}

#[test]
fn actuator_kinds() {
    assert_eq!(fault("\"force\"", "\"moving_magnet\"").nearest.as_deref(), Some("\"moving-magnet\""));
    let key = fault("kind = \"force\"", "kind = \"force\"\nresistance_ohm = 6.2");
    assert_eq!(key.expected, "this key only where kind = \"moving-magnet\" or \"exciter\"");
    let list = faults(&GOOD.replace("\"force\"", "\"moving-magnet\"\nresistance_ohm = 0"));
    let keys: Vec<&str> = list.iter().map(|f| f.key.as_str()).collect();
    assert_eq!(keys, ["actuator[0].force_constant_n_per_a", "actuator[0].resistance_ohm"]);
}

#[test]
fn all_faults_at_once_in_the_order_of_the_file() {
    let text = GOOD
        .replace("name = \"film\"", "nmae = \"film\"")
        .replace("0.125", "-0.125")
        .replace("\"none\"", "\"some\"")
        .replace("3000", "30000")
        .replace("[12, 31]", "[12, 310]");
    let list = faults(&text);
    let lines: Vec<usize> = list.iter().map(|f| f.line).collect();
    assert_eq!(lines, [2, 8, 11, 13, 17], "{list:#?}");
}

#[test]
fn a_hundred_faults_are_enough() {
    let text = format!("{GOOD}{}", "[[actuator]]\nat_mm = [1000, 2]\n".repeat(300));
    let faults = parse_surface(&text, "film.toml").unwrap_err();
    assert_eq!((faults.faults().len(), faults.omitted()), (100, 200));
    assert!(faults.to_string().starts_with("300 faults"));
    assert!(format!("{faults:#}").ends_with("\nand 200 more"));
}

#[test]
fn huge_files() {
    let text = format!("{GOOD}#{}", "x".repeat(1 << 20));
    assert_eq!(
        faults(&text)[0].to_string(),
        "expected a file of at most 1048576 bytes, found more than that"
    );
}

#[test]
fn shown_with_file_line_and_caret() {
    let faults = parse_surface(&GOOD.replace("0.125", "-0.125"), "film.toml").unwrap_err();
    let mut shown = String::new();
    let handler = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::unicode_nocolor());
    handler.render_report(&mut shown, &faults).unwrap();
    for part in ["film.toml:8:16", "thickness_mm = -0.125", "nearest: 0.001", "expected a number from 0.001"]
    {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
    for text in ["", "\u{feff}", "format = 1\r\nname = [\r\n", "a = \"é\" é"] {
        let faults = parse_surface(text, "odd.toml").unwrap_err();
        handler.render_report(&mut shown, &faults).unwrap();
        assert!(shown.contains("odd.toml:"), "{shown}");
    }
}

#[test]
fn as_json() {
    let faults = parse_surface(&GOOD.replace("\"force\"", "\"forse\""), "film.toml").unwrap_err();
    assert_eq!(
        serde_json::to_value(&faults).unwrap(),
        serde_json::json!({
            "file": "film.toml",
            "faults": [{
                "key": "actuator[0].kind", "line": 18, "column": 8, "found": "\"forse\"",
                "expected": "\"force\" or \"moving-magnet\" or \"exciter\" or \"piezo\"", "nearest": "\"force\"",
            }],
            "omitted": 0,
        })
    );
}

#[test]
fn every_key_of_every_builtin_matters() {
    for builtin in BUILTINS {
        for (i, line) in builtin.text.lines().enumerate().filter(|(_, l)| l.contains(" = ")) {
            if line.starts_with('#') {
                continue;
            }
            let typo: Vec<String> = builtin
                .text
                .lines()
                .enumerate()
                .map(|(j, l)| if i == j { format!("zz_{l}") } else { l.into() })
                .collect();
            let list = faults(&typo.join("\n"));
            assert!(list.iter().any(|f| f.line == i + 1 && f.column == 1), "{line}: {list:#?}");
        }
    }
}
