//! What a page knows of the surface's clock belongs to the surface that it is told of.

mod common;

use common::Served;
use serde_json::{Value, json};
use tungstenite::Message;

#[test]
fn who_hears_that_a_surface_is_played_otherwise_knows_its_clock() {
    let served = Served::new(None);
    let mut page = served.page();
    let (mut asked, mut before, mut head) = (false, 0.0, 0.0);
    loop {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let message: Value = serde_json::from_str(&text).unwrap();
        match message["is"].as_str() {
            Some("status") => head = message["head_s"].as_f64().unwrap(),
            Some("settings") if message["load"] == true => break,
            _ => {}
        }
        if !asked && head > 0.5 {
            (asked, before) = (true, head);
            page.send(Message::text(json!({ "do": "settings", "load": true }).to_string())).unwrap();
        }
    }
    assert!(head < before, "the clock stands at {head} s, as that of the surface before");
}
