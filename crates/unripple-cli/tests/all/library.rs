//! Responses from the model as a library, and a focus made from it.

use crate::common;

use common::{Scratch, json, number, refused};

#[test]
fn a_focus_from_the_models_library_is_a_focus_on_the_surface() {
    let scratch = Scratch::new("library");
    let (library, out) = (scratch.join("lib"), scratch.join("out"));
    let respond = ["respond", "hudin-2012", "--grid-mm", "7.5", "--length-ms", "60", "-o", &library];
    let made = json(&respond);
    assert_eq!((number(&made, "/points"), number(&made, "/samples")), (361.0, 2881.0));
    assert_eq!(number(&json(&respond), "/points_found_done"), 361.0);

    // (60, 90) is a point of the grid: its drive is the surface's own.
    let window = ["--window-ms", "30", "-o", &out];
    let at = |place: &'static str| [&["--at", place][..], &window[..]].concat();
    let own = json(&[&["focus", "hudin-2012"], &at("60,90")[..]].concat());
    let stored = json(&[&["focus", &library, "--on", "hudin-2012"], &at("60,90")[..]].concat());
    for key in ["peak_velocity_m_s", "contrast", "displacement_contrast", "felt_contrast_db"] {
        let path = format!("/targets/0/{key}");
        let (a, b) = (number(&own, &path), number(&stored, &path));
        assert!((a / b - 1.0).abs() < 1e-4, "{key}: {a} {b}");
    }

    between_points(&library, &out, number(&own, "/targets/0/contrast"));

    // A damaged chunk is named and left out; options that need modes are refused.
    std::fs::write(scratch.path().join("lib/responses/c.17.0.0"), "x").unwrap();
    let lame = json(&[&["focus", &library], &at("62,90")[..]].concat());
    assert!(lame["notes"].to_string().contains("c.17.0.0"), "{}", lame["notes"]);
    let refusal = refused(&[&["focus", &library, "--method", "felt"], &at("62,90")[..]].concat(), 2);
    assert!(refusal.contains("found a library"), "{refusal}");
    let other = ["respond", "hudin-2012", "--grid-mm", "7.5", "--length-ms", "50", "-o", &library];
    assert!(refused(&other, 1).contains("samples: 2881 instead of 2401"));
    assert!(refused(&["respond", "hudin-2012", "--grid-mm", "0", "-o", &out], 2).contains("--grid-mm"));
}

/// A target between the points, as the kernel has it and as the nearest point does.
fn between_points(library: &str, out: &str, own: f64) {
    let drive = format!("{out}/drive.wav");
    let both = |way: &str| {
        let focus = ["focus", library, "--method", "concentrate", "--window-ms", "30", "-o", out];
        let field = ["field", library, "--drive", &drive, "--at-ms", "30"];
        let place = ["--at", "62,90", "--between", way];
        [&focus[..], &field[..]].map(|command| json(&[command, &place].concat()))
    };
    for (way, said) in [("kernel", "interpolated (kernel)"), ("nearest", "2.00 mm away")] {
        let [focus, field] = both(way);
        assert_eq!(focus["taken_on"], "library");
        assert!(focus["judged_on"].as_str().unwrap().contains("361 points"));
        assert!(focus["notes"].to_string().contains(said), "{}", focus["notes"]);
        assert!(number(&focus, "/targets/0/contrast") > 2.0 * own);
        for key in ["peak_velocity_m_s", "contrast", "background_contrast", "displacement_worst_spot"] {
            let path = format!("/targets/0/{key}");
            assert!((number(&focus, &path) / number(&field, &path) - 1.0).abs() < 1e-6, "{key}");
        }
    }
}
