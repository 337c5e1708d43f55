//! Messages and pictures of the session for pages, before they are sent.

use serde::Serialize;
use serde_json::{Value, json};

/// Files of a measurement that a page has requested: a focus, computed and evaluated.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Number of the page that requested it.
    pub page: u64,
    /// The page's own number for the request.
    pub id: u64,
    /// Bytes of the file `drive.wav`.
    pub drive: Vec<u8>,
    /// Text of the file `report.json`.
    pub json: String,
    /// Text of the file `report.md`.
    pub markdown: String,
}

/// What is known of an encoded picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Picture {
    /// Number of the picture, which rises with each picture.
    pub number: u64,
    /// Number of the first picture of the same clock; those before are of another one.
    pub first: u64,
    /// Largest motion of the places that are followed, in m or m/s, if the picture shows the strongest instant since the one before; `None`
    /// if it shows the instant requested.
    pub strength: Option<f32>,
}

impl Picture {
    /// Whether this picture is worth more to a page that has time for one alone than a `newer` one: more moves in it.
    pub fn outdoes(&self, newer: &Self) -> bool {
        let stronger = self.strength.zip(newer.strength).is_some_and(|(old, new)| old > new);
        stronger && self.number >= newer.first
    }
}

/// The picture in which most moves of those that could not be sent to a page: a page that draws few must not miss every focus. `B` are the
/// bytes of a picture.
#[derive(Clone, Debug)]
pub struct Held<B>(Option<(B, Picture)>);

impl<B> Default for Held<B> {
    fn default() -> Self {
        Self(None)
    }
}

impl<B> Held<B> {
    /// What a page is to be sent when a newer picture comes: this one, or the one held if that [outdoes](Picture::outdoes) it. While
    /// the page is `full` that is held instead, and there is nothing to send.
    pub fn pass(&mut self, bytes: B, picture: Picture, full: bool) -> Option<(B, Picture)> {
        let held = self.0.take().filter(|(_, held)| held.outdoes(&picture));
        let better = held.unwrap_or((bytes, picture));
        if full {
            self.0 = Some(better);
            return None;
        }
        Some(better)
    }
}

/// One message of the session to pages.
#[derive(Clone, Debug)]
pub enum Out {
    /// Kind and JSON text for all pages, in place of the last message of that kind.
    Text(String, String),
    /// Kind and bytes of a picture for all pages, in place of the last picture of that kind, and what is known of it.
    Frame(String, Vec<u8>, Picture),
    /// Kind of message whose last message is no longer valid.
    Withdraw(String),
    /// Number of a page, and the reason why its request is refused.
    Refuse(u64, String),
    /// Number of a page, and the page's own number for a request whose computation was cancelled.
    Stopped(u64, u64),
    /// Number of a page, and the JSON text that answers it alone.
    Answer(u64, String),
    /// Files of a focus that was computed on a page's request.
    Measured(Box<Measured>),
}

/// The text of the surface's file in the message that describes the surface.
pub fn toml(message: &str) -> String {
    let value: Value = serde_json::from_str(message).unwrap_or_default();
    value.get("toml").and_then(Value::as_str).unwrap_or_default().to_owned()
}

/// The message that tells a page why its request is refused.
pub fn refusal(why: &str) -> String {
    json!({ "is": "fault", "text": why }).to_string()
}

/// The message that tells a page that the computation of its request with a number was cancelled.
pub fn stopped(id: u64) -> String {
    json!({ "is": "stopped", "id": id }).to_string()
}

/// Messages to pages, the oldest first.
#[derive(Debug, Default)]
pub struct Outbox(Vec<Out>);

impl Outbox {
    /// Adds a message as JSON for all pages.
    pub fn tell(&mut self, kind: &str, message: &impl Serialize) {
        // A message is made of numbers and names: always JSON.
        if let Ok(text) = serde_json::to_string(message) {
            self.0.push(Out::Text(kind.to_owned(), text));
        }
    }

    /// Adds a picture for all pages, and what is known of it.
    pub fn frame(&mut self, kind: String, bytes: Vec<u8>, picture: Picture) {
        self.0.push(Out::Frame(kind, bytes, picture));
    }

    /// Withdraws the last message of a kind.
    pub fn withdraw(&mut self, kind: &str) {
        self.0.push(Out::Withdraw(kind.to_owned()));
    }

    /// Tells one page, given by its number, why its request is refused.
    pub fn refuse(&mut self, page: u64, why: impl Into<String>) {
        self.0.push(Out::Refuse(page, why.into()));
    }

    /// Tells one page, given by its number, that the computation of its request of number `id` was
    /// cancelled.
    pub fn stopped(&mut self, page: u64, id: u64) {
        self.0.push(Out::Stopped(page, id));
    }

    /// Adds a message.
    pub fn push(&mut self, out: Out) {
        self.0.push(out);
    }

    /// Removes and returns all messages.
    pub fn take(&mut self) -> Vec<Out> {
        std::mem::take(&mut self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_kept_for_what_moves_in_it_on_its_own_clock_alone() {
        let picture = |number, first, strength| Picture { number, first, strength };
        let focus = picture(7, 3, Some(2e-5));
        assert!(focus.outdoes(&picture(9, 3, Some(1e-6))));
        assert!(!focus.outdoes(&picture(9, 3, Some(3e-5))));
        assert!(!focus.outdoes(&picture(9, 8, Some(1e-6))), "of a surface that is gone");
        assert!(!focus.outdoes(&picture(9, 3, None)), "where time stands still the newest is shown");
    }

    #[test]
    fn the_strongest_of_the_pictures_that_a_page_missed_is_sent_once() {
        let picture = |number, strength| Picture { number, first: 1, strength: Some(strength) };
        let (mut held, full) = (Held::default(), true);
        for (number, strength) in [(1, 1e-6), (2, 3e-5), (3, 2e-6)] {
            assert_eq!(held.pass(number, picture(number, strength), full), None);
        }
        assert_eq!(held.pass(4, picture(4, 1e-6), !full), Some((2, picture(2, 3e-5))));
        assert_eq!(held.pass(5, picture(5, 1e-6), !full), Some((5, picture(5, 1e-6))));
    }
}
