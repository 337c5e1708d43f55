//! The doctor's exit status: 1 where a check failed, with the whole report all the same.

mod common;

use common::run;

#[test]
fn a_failed_check_is_exit_1_after_the_report() {
    let arguments = ["doctor", "hudin-2012", "--device", "jack", "--jack-server", "nowhere", "--tuio", "0"];
    let output = run(&[&arguments[..], &["--json"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let lost: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let why = lost["why_you_may_feel_nothing"][0].as_str().unwrap();
    assert!(why.starts_with("device: ") && why.contains("→"), "{why}");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("error: ") && errors.contains("failed: device"), "{errors}");

    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("FAILED") && text.contains("why you may feel nothing"), "{text}");
}
