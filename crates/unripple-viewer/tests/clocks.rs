//! What a page knows of the surface's clock belongs to the surface that it is told of, and it sees the focuses however few pictures it draws.

mod common;

use common::Served;
use serde_json::{Value, json};
use std::time::Duration;
use tungstenite::Message;

/// How long a slow page takes to draw a picture: at ten pulses a second there are three focuses in it, fewer where the surface falls behind.
const DRAWN: Duration = Duration::from_millis(300);

/// Pictures that a slow page draws, after those that it was sent before it was slow.
const PICTURES: usize = 5;
const BEFORE: usize = 6;

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

/// The number of a picture, and the motion under the first finger in it, in m; `None` without a finger.
fn moved(frame: &[u8]) -> (u64, Option<f64>) {
    let length = u32::from_le_bytes(*frame.first_chunk().unwrap()) as usize;
    let head: Value = serde_json::from_slice(&frame[4..4 + length]).unwrap();
    let count = |key: &str| head[key].as_u64().unwrap() as usize;
    let last = 4 + length + 2 * (count("columns") * count("rows") + count("samples").max(1) - 1);
    let sample = |scale: f64| f64::from(i16::from_le_bytes([frame[last], frame[last + 1]])) * scale;
    (head["frame"].as_u64().unwrap(), head["traces"][0]["scale"].as_f64().map(|scale| sample(scale).abs()))
}

#[test]
fn a_page_that_draws_few_pictures_sees_a_focus_in_each() {
    let served = Served::new(None);
    let mut page = served.page();
    let press = json!({ "do": "touch", "finger": 0, "phase": "down", "at_mm": [62, 90] });
    page.send(Message::text(press.to_string())).unwrap();
    let mut found = Vec::new();
    while found.len() < BEFORE + PICTURES {
        let Message::Binary(frame) = page.read().unwrap() else { continue };
        let (number, moved) = moved(&frame);
        found.extend(moved);
        if !found.is_empty() {
            std::thread::sleep(DRAWN);
        }
        page.send(Message::text(json!({ "do": "seen", "frame": number }).to_string())).unwrap();
    }
    let seen = &found[BEFORE..];
    let most = seen.iter().copied().fold(0.0, f64::max);
    assert!(most > 0.0 && seen.iter().all(|moved| *moved > 0.5 * most), "{seen:?} m");
}
