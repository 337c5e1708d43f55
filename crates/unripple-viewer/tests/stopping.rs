//! What pages ask for can be stopped, and keeps nobody else waiting.

mod common;

use common::{Served, until};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::sync::Arc;
use tungstenite::{Message, WebSocket};

/// Most messages on the surface's state, of which there are five a second, from what a page asks to its answer.
const LOOKS: usize = 10;

type Page = WebSocket<TcpStream>;

/// A viewer with a library that never answers: a call that cannot be interrupted, and takes no processor time.
fn stuck() -> Served {
    Served::with(None, |view| {
        view.respond = Some(Arc::new(|_| {
            loop {
                std::thread::park();
            }
        }));
    })
}

fn say(page: &mut Page, message: Value) {
    page.send(Message::text(message.to_string())).unwrap();
}

fn measure(page: &mut Page, id: u64) {
    say(page, json!({ "do": "measure", "id": id, "at": [[62, 90]] }));
}

/// Has a page ask for what never ends, and waits until it is computed.
fn asking(served: &Served, id: u64) -> Page {
    let mut page = served.page();
    measure(&mut page, id);
    while until(&mut page, "design")["done"] != true {}
    until(&mut page, "status");
    page
}

/// Edits the surface, so that it has a model in place of the library, and waits until pages are told.
fn edited(page: &mut Page) {
    say(page, json!({ "do": "edit", "tension_n_per_m": 150 }));
    while until(page, "surface")["values"]["tension_n_per_m"] != 150.0 {}
}

/// Reads until a message of a kind comes, before much else is told.
fn soon(page: &mut Page, kind: &str) -> Value {
    let mut looks = 0;
    while looks <= LOOKS {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let message: Value = serde_json::from_str(&text).unwrap();
        if message["is"] == kind {
            return message;
        }
        looks += usize::from(message["is"] == "status");
    }
    panic!("no {kind} within {LOOKS} messages on the surface's state");
}

#[test]
fn what_runs_is_stopped_and_something_else_is_measured() {
    let served = stuck();
    let mut page = asking(&served, 5);
    say(&mut page, json!({ "do": "stop", "id": 5 }));
    assert_eq!(soon(&mut page, "stopped")["id"], 5);
    edited(&mut page);
    measure(&mut page, 6);
    assert_eq!(until(&mut page, "measured")["id"], 6);
}

#[test]
fn what_is_newer_takes_the_place_of_what_runs() {
    let served = stuck();
    let mut page = asking(&served, 1);
    edited(&mut page);
    measure(&mut page, 2);
    assert_eq!(soon(&mut page, "stopped")["id"], 1);
    assert_eq!(until(&mut page, "measured")["id"], 2);
}

#[test]
fn what_a_page_asked_for_goes_with_it() {
    let served = stuck();
    let (leaves, mut stays) = (asking(&served, 1), served.page());
    edited(&mut stays);
    measure(&mut stays, 2);
    drop(leaves);
    assert_eq!(until(&mut stays, "measured")["id"], 2);
}

#[test]
fn a_window_that_goes_on_after_the_responses_is_refused() {
    let served = Served::new(None);
    let mut page = served.page();
    until(&mut page, "surface");
    let compare = json!({ "do": "compare", "at": [[62, 90]], "methods": ["one-bit", "inverse"] });
    for mut asked in [json!({ "do": "measure", "at": [[62, 90]] }), compare] {
        asked["window_ms"] = json!(9000);
        say(&mut page, asked);
        let why = until(&mut page, "fault")["text"].as_str().unwrap().to_owned();
        assert!(why.starts_with("samples of the window: expected at most "), "{why}");
        assert!(why.contains(", the length of the responses") && why.ends_with(", found 432001"), "{why}");
    }
}
