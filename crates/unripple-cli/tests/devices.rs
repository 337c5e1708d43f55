//! `devices` on the command line.

mod common;

use common::{json, run};

#[test]
fn the_virtual_surface_is_always_there() {
    let found = json(&["devices", "--server", "unripple-none"]);
    let devices = found["devices"].as_array().unwrap();
    assert_eq!(
        (devices[0]["device"].as_str(), devices[0]["available"].as_bool()),
        (Some("virtual"), Some(true))
    );
    assert_eq!(
        (devices[2]["device"].as_str(), devices[2]["available"].as_bool()),
        (Some("jack"), Some(false))
    );
    let text = String::from_utf8(run(&["devices"]).stdout).unwrap();
    assert!(text.starts_with("virtual"));
}
