//! What commands tell of their progress on standard error, where that is no terminal.

use crate::common;

use common::{Scratch, run};

/// Lines that `--verbose` gives, without their times.
fn told(arguments: &[&str]) -> Vec<String> {
    let output = run(&[arguments, &["--verbose"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stderr).unwrap();
    text.lines().filter_map(|line| line.split_once(" s  ").map(|(_, told)| told.to_owned())).collect()
}

#[test]
fn every_stage_of_a_focus_is_named_with_its_parts() {
    let scratch = Scratch::new("progress-focus");
    let out = scratch.join("out");
    let lines =
        told(&["focus", "stadium-film", "--set", "drive.band_hz=[0, 1000]", "--at", "90,50", "-o", &out]);
    for stage in
        ["responses", "window", "drive", "responses for evaluation", "level", "evaluation", "figures"]
    {
        assert!(lines.iter().any(|line| line == stage), "{stage}: {lines:#?}");
    }
    // The window is chosen from the same responses.
    let evaluated = "responses for evaluation: mesh 1 of 8 at most: ";
    for part in ["responses: mesh 2 of 8 at most: ", evaluated, "evaluation: "] {
        assert!(lines.iter().any(|line| line.starts_with(part)), "{part}: {lines:#?}");
    }
    assert!(
        lines.iter().any(|line| line.contains(" modes from ") && line.ends_with(" shifts")),
        "{lines:#?}"
    );
}
