//! A real device that can be opened by one alone is handed on from one way of playing to the next.

mod common;

use common::{Served, until};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use tungstenite::{Message, WebSocket};
use unripple::core::{Device, DeviceError, Layout, Status, Surface};
use unripple_viewer::Opener;

/// Outputs of the card.
const OUTPUTS: usize = 8;

/// Blocks after which the card is surely played on, and messages on the surface's state within which they come.
const BLOCKS: usize = 10;
const LOOKS: usize = 200;

type Page = WebSocket<TcpStream>;

/// A card that one alone can have open.
#[derive(Default)]
struct Card {
    open: AtomicBool,
    openings: AtomicUsize,
    blocks: AtomicUsize,
}

impl Card {
    fn opener(self: &Arc<Self>) -> Opener {
        let card = self.clone();
        Arc::new(move |surface| card.clone().opened(surface))
    }

    fn opened(self: Arc<Self>, surface: &Surface) -> Result<Box<dyn Device>, String> {
        if self.open.swap(true, Ordering::SeqCst) {
            return Err("expected a card that nobody has open, found one in use".into());
        }
        let layout = Layout {
            device: "card".into(),
            rate: surface.emission.rate,
            block: 480,
            outputs: surface.actuators.iter().map(|actuator| actuator.name.clone()).collect(),
            inputs: Vec::new(),
            full_scale: surface.emission.limit,
        };
        let opened = Opened { card: self, layout };
        let outputs = opened.layout.outputs.len();
        if outputs > OUTPUTS {
            return Err(format!("outputs: expected at most {OUTPUTS}, found {outputs}"));
        }
        opened.card.openings.fetch_add(1, Ordering::SeqCst);
        Ok(Box::new(opened))
    }

    fn openings(&self) -> usize {
        self.openings.load(Ordering::SeqCst)
    }

    /// Waits until the card has been opened so often, and is played.
    fn played(&self, page: &mut Page, openings: usize) {
        let mut from = None;
        for _ in 0..LOOKS {
            until(page, "status");
            let blocks = self.blocks.load(Ordering::SeqCst);
            if self.openings() == openings && blocks > *from.get_or_insert(blocks) + BLOCKS {
                return;
            }
        }
        panic!("opened {} times, {} blocks", self.openings(), self.blocks.load(Ordering::SeqCst));
    }
}

/// The card while it is open.
struct Opened {
    card: Arc<Card>,
    layout: Layout,
}

impl Drop for Opened {
    fn drop(&mut self) {
        self.card.open.store(false, Ordering::SeqCst);
    }
}

impl Device for Opened {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        Status::default()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        std::thread::sleep(Duration::from_secs_f64(self.layout.block as f64 / self.layout.rate));
        self.card.blocks.fetch_add(1, Ordering::SeqCst);
        Ok(())
    }
}

/// A viewer that plays a card, and a page of it.
fn playing() -> (Arc<Card>, Served, Page) {
    let card = Arc::new(Card::default());
    let opener = card.opener();
    let served = Served::with(None, |view| view.device = Some(opener));
    let page = served.page();
    (card, served, page)
}

fn say(page: &mut Page, message: Value) {
    page.send(Message::text(message.to_string())).unwrap();
}

/// Waits until the surface is played by a method; nothing may be said to have failed.
fn by(page: &mut Page, method: &str) {
    let mut looks = 0;
    while looks < LOOKS {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let message: Value = serde_json::from_str(&text).unwrap();
        match message["is"].as_str() {
            Some("settings") if message["method"] == method => return,
            Some("notice") => panic!("{}", message["text"]),
            Some("status") => looks += 1,
            _ => {}
        }
    }
    panic!("not played by {method}");
}

#[test]
fn another_method_plays_the_same_device() {
    let (card, mut served, mut page) = playing();
    by(&mut page, "time-reversal");
    for method in ["one-bit", "inverse"] {
        say(&mut page, json!({ "do": "settings", "method": method }));
        by(&mut page, method);
        card.played(&mut page, 1);
    }
    served.stop();
    assert!(!card.open.load(Ordering::SeqCst), "the card is still open");
}

#[test]
fn another_surface_opens_the_device_anew() {
    let (card, _served, mut page) = playing();
    say(&mut page, json!({ "do": "edit", "tension_n_per_m": 150 }));
    card.played(&mut page, 2);
}

#[test]
fn a_surface_that_the_device_cannot_play_leaves_the_one_before() {
    let (card, _served, mut page) = playing();
    say(&mut page, json!({ "do": "edit", "actuators": 9 }));
    let why = until(&mut page, "notice")["text"].as_str().unwrap().to_owned();
    assert_eq!(why, "device: outputs: expected at most 8, found 9");
    card.played(&mut page, 2);
}
