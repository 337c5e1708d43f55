//! `devices` on the command line.

mod common;

use common::{json, refused, run};

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
    let card = devices.iter().filter(|device| device["device"] == "card");
    if cfg!(feature = "cards") {
        assert!(card.clone().all(|card| card["available"] == true && card["id"].is_string()));
    } else {
        let why: Vec<_> = card.map(|card| card["why"].as_str().unwrap()).collect();
        assert!(why.len() == 1 && why[0].contains("--features cards"), "{why:?}");
        assert!(text.contains("--features cards"), "{text}");
    }
}

#[test]
fn a_card_that_is_not_there_is_refused_with_what_to_do() {
    let calibrate =
        ["calibrate", "hudin-2012", "--device", "card", "--card", "nowhere", "--at=1,1", "-o", "x"];
    let (status, said) =
        if cfg!(feature = "cards") { (1, "there is no `nowhere`") } else { (2, "--features cards") };
    assert!(refused(&calibrate, status).contains(said));
}
