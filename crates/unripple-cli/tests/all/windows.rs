//! Surfaces of five kinds, whose losses are those of a material: every command and the page name the same window.
//!
//! One loss factor of each kind, and not `compare`, which takes its time; with `UNRIPPLE_ALL_TARGETS=1` all four, twenty surfaces, and that too.

use crate::common;
use crate::window_common;

use common::{Scratch, json, number};
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::time::Duration;
use tungstenite::Message;
use tungstenite::client::IntoClientRequest;
use unripple_core::Surface;
use unripple_store::to_toml;
use window_common::{LOSS_FACTORS, drum, film, glass, panel, table, with_loss};

/// A viewer, ended with this.
struct Viewer(Child);

impl Drop for Viewer {
    fn drop(&mut self) {
        // One that has ended cannot be ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The window of the design that a page is shown, in s.
fn shown(file: &str) -> f64 {
    let mut command = crate::common::program();
    command.args(["view", file, "--port", "0", "--no-browser"]).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut viewer = Viewer(command.spawn().unwrap());
    let mut url = String::new();
    BufReader::new(viewer.0.stdout.take().unwrap()).read_line(&mut url).unwrap();
    let address = url.trim().trim_start_matches("http://").trim_end_matches('/').to_owned();
    let mut request = format!("ws://{address}/link").into_client_request().unwrap();
    request.headers_mut().insert("Origin", format!("http://{address}").parse().unwrap());
    let stream = TcpStream::connect(&address).unwrap_or_else(|error| panic!("{url}: {error}"));
    stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
    let (mut page, _) = tungstenite::client(request, stream).unwrap();
    loop {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let told: Value = serde_json::from_str(&text).unwrap();
        if told["is"] == "design" {
            assert_eq!(told["fault"], Value::Null);
            if let Some(ms) = told.pointer("/act/window_ms").and_then(Value::as_f64) {
                return 1e-3 * ms;
            }
        }
    }
}

fn is_the_same_everywhere(kind: &Surface) {
    let scratch = Scratch::new(&format!("windows-{}", kind.name));
    let all = std::env::var_os("UNRIPPLE_ALL_TARGETS").is_some();
    let which = if all { &LOSS_FACTORS[..] } else { &LOSS_FACTORS[2..3] };
    for loss_factor in which {
        let surface = with_loss(kind, *loss_factor);
        let file = scratch.file(&format!("{loss_factor}.toml"), to_toml(&surface));
        let (width, height) = surface.outline.extent();
        let at = format!("{},{}", 410.0 * width, 530.0 * height);
        let window = number(&json(&["design", &file]), "/window_recommended_s");
        let out = scratch.join(&format!("out-{loss_factor}"));
        // Only the window is of interest, so the fewest modes will do.
        let top = surface.emission.band[1].to_string();
        let focus = ["focus", &file, "--at", &at, "--judge-hz", &top, "-o", &out];
        let focused = number(&json(&focus), "/window_s");
        let compared = || number(&json(&["compare", &file, "--at", &at]), "/window_s");
        let compared = all.then(compared);
        let page = shown(&file);
        println!(
            "{} {loss_factor}: {:.2} ms, focus {:.2}, the page {:.2}, compare {compared:?} s",
            kind.name,
            1e3 * window,
            1e3 * focused,
            1e3 * page
        );
        assert_eq!([focused, compared.unwrap_or(window)], [window; 2]);
        // Told in ms there.
        assert!((page / window - 1.0).abs() < 1e-9, "{page}, not {window}");
    }
}

#[test]
fn of_a_film() {
    is_the_same_everywhere(&film());
}

#[test]
fn of_a_glass_plate() {
    is_the_same_everywhere(&glass());
}

#[test]
fn of_a_panel_on_springs() {
    is_the_same_everywhere(&panel());
}

#[test]
fn of_a_drum_skin() {
    is_the_same_everywhere(&drum());
}

#[test]
fn of_a_table() {
    is_the_same_everywhere(&table());
}
