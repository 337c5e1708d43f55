//! The window that is taken where nobody asks for one: the same for every command, and said.

use crate::common;

use common::{Scratch, json, number, refused};

/// A small film whose coils damp it: more oscillations are known of it than it has modes in its band.
const COILS: &str = "format = 1\nname = \"Coils\"\n[outline]\nrectangle_mm = [120, 90]\n[sheet]\nmaterial = \"BoPET\"\n\
                     thickness_mm = 0.125\ntension_n_per_m = 200\nloss_factor = 0.02\n[drive]\nband_hz = [0, 1000]\n\
                     sample_rate_hz = 16000\n";

const COIL: &str = "kind = \"moving-magnet\"\nforce_constant_n_per_a = 1.0\nresistance_ohm = 8.0\ninductance_mh = 0.1\n\
                    moving_mass_mg = 60\ncontact_radius_mm = 2.0\ndriven_by = \"voltage\"\n";

/// A plate whose losses are those of its material.
const PLATE: &str = "format = 1\nname = \"Plate\"\n[outline]\nrectangle_mm = [140, 70]\nedge = \"supported\"\n[sheet]\n\
                     material = \"soda-lime glass\"\nthickness_mm = 0.7\ntension_n_per_m = 0\nloss_factor = 0.005\n[drive]\n\
                     band_hz = [0, 6000]\nsample_rate_hz = 32000\n";

fn file(scratch: &Scratch, name: &str, head: &str, kind: &str) -> String {
    let places = [[12, 31], [104, 20], [40, 61]];
    let actuators = places.map(|[x, y]| format!("[[actuator]]\nat_mm = [{x}, {y}]\n{kind}"));
    scratch.file(name, format!("{head}{}", actuators.concat()))
}

#[test]
fn every_command_takes_the_same() {
    let scratch = Scratch::new("window");
    for (name, head, kind) in [("coils.toml", COILS, COIL), ("plate.toml", PLATE, "")] {
        let file = file(&scratch, name, head, kind);
        let out = scratch.join(&format!("out-{name}"));
        let design = json(&["design", &file]);
        let window = number(&design, "/window_recommended_s");
        assert!((0.5e-3..0.5).contains(&window), "{name}: {window}");
        let focused = json(&["focus", &file, "--at", "62,40", "--peak-um", "1", "-o", &out]);
        assert_eq!(number(&focused, "/window_s"), window, "{name}");
        let notes = focused["notes"].to_string();
        assert!(notes.contains("nine tenths of the largest contrast"), "{notes}");
        let compared = json(&["compare", &file, "--at", "62,40"]);
        assert_eq!(number(&compared, "/window_s"), window, "{name}");
        assert!(compared["window_why"].to_string().contains("largest contrast"));
        let library = scratch.join(&format!("library-{name}"));
        let stored = json(&["respond", &file, "--grid-mm", "30", "-o", &library]);
        let samples = (2.0 * window * number(&stored, "/sample_rate_hz")).round() + 1.0;
        assert_eq!(number(&stored, "/samples"), samples, "{name}");
    }
}

#[test]
fn a_default_window_that_will_not_do_names_the_option() {
    let scratch = Scratch::new("window-none");
    let (file, library) = (file(&scratch, "plate.toml", PLATE, ""), scratch.join("library"));
    // Rounded to samples, these responses last a little less than one period of the band's top.
    json(&["respond", &file, "--grid-mm", "30", "--length-ms", "0.17", "-o", &library]);
    let text = refused(&["focus", &library, "--at", "60,30", "-o", &scratch.join("out")], 1);
    assert!(text.contains("--window-ms"), "{text}");
}
