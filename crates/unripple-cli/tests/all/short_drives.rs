//! Drives and responses too short to carry a wave are refused before anything is written, with the option to change.

use crate::common;

use common::{Scratch, refused, run};

/// The film's band ends at 3000 Hz, a period of which is a third of a millisecond: 16 samples.
#[test]
fn what_is_shorter_than_a_period_of_the_bands_top_is_refused() {
    let scratch = Scratch::new("short");
    let out = scratch.join("out");
    let stroke = ["--path=line:40,40,60,40", "--speed-mm-s=100"];
    for (what, option) in [
        (&["focus", "hudin-2012", "--at=62,90", "--window-ms=0.02", "-o", &out][..], "--window-ms"),
        (&["focus", "hudin-2012", "--at=62,90", "--window-ms=0.33", "-o", &out], "--window-ms"),
        (&["focus", "hudin-2012", stroke[0], stroke[1], "--window-ms=0.02", "-o", &out], "--window-ms"),
        (&["compare", "hudin-2012", "--at=62,90", "--window-ms=0.02", "-o", &out], "--window-ms"),
        (&["place", "hudin-2012", "--rim-mm=6,12", "--window-ms=0.02", "-o", &out], "--window-ms"),
        (&["respond", "hudin-2012", "--grid-mm=30", "--length-ms=0.001", "-o", &out], "--length-ms"),
        (&["respond", "hudin-2012", "--grid-mm=30", "--length-ms=0.04", "-o", &out], "--length-ms"),
    ] {
        let errors = refused(what, 1);
        assert!(errors.contains(option) && errors.contains("at least 0.3333 ms"), "{what:?}: {errors}");
        assert!(errors.contains("3000 Hz"), "{what:?}: {errors}");
        assert!(scratch.names().is_empty(), "{what:?}: {:?}", scratch.names());
    }
}

#[test]
fn a_waveform_is_as_short_as_its_drive_is() {
    let scratch = Scratch::new("short-waveform");
    let out = scratch.join("out");
    let click = |window| ["focus", "hudin-2012", "--waveform=62,90,click:0.05", window, "-o", &out].to_vec();
    let errors = refused(&click("--window-ms=0.02"), 1);
    assert!(errors.contains("--window-ms") && errors.contains("at least 0.3333 ms"), "{errors}");
    assert!(scratch.names().is_empty());
}

#[test]
fn a_period_is_enough() {
    let scratch = Scratch::new("short-enough");
    let out = scratch.join("out");
    let output = run(&["respond", "hudin-2012", "--grid-mm=30", "--length-ms=0.34", "-o", &out]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
