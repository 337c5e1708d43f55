//! Messages and pictures for pages, on their way out of the session.

use serde::Serialize;

/// Files of the last act that was measured.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The number that the page gave it.
    pub id: u64,
    /// Bytes of the file `drive.wav`.
    pub drive: Vec<u8>,
    /// Text of the file `report.json`.
    pub json: String,
    /// Text of the file `report.md`.
    pub markdown: String,
}

/// One message of the session to pages.
#[derive(Clone, Debug)]
pub enum Out {
    /// JSON for all pages, in place of the last of its kind.
    Text(String, String),
    /// A picture of the field for all pages, in place of the last of its kind, and its number.
    Frame(String, Vec<u8>, u64),
    /// The last message of a kind holds no longer.
    Withdraw(String),
    /// Why what one page asked for is refused.
    Refuse(u64, String),
    /// Files of an act that was measured.
    Measured(Box<Measured>),
}

/// Messages, oldest first.
#[derive(Debug, Default)]
pub struct Outbox(Vec<Out>);

impl Outbox {
    /// JSON for all pages.
    pub fn tell(&mut self, kind: &str, message: &impl Serialize) {
        // A message is made of numbers and names: always JSON.
        if let Ok(text) = serde_json::to_string(message) {
            self.0.push(Out::Text(kind.to_owned(), text));
        }
    }

    /// A picture for all pages.
    pub fn frame(&mut self, kind: String, bytes: Vec<u8>, number: u64) {
        self.0.push(Out::Frame(kind, bytes, number));
    }

    /// The last message of a kind holds no longer.
    pub fn withdraw(&mut self, kind: &str) {
        self.0.push(Out::Withdraw(kind.to_owned()));
    }

    /// Says to one page, by its number, why what it asked for is refused.
    pub fn refuse(&mut self, page: u64, why: impl Into<String>) {
        self.0.push(Out::Refuse(page, why.into()));
    }

    /// Adds a message.
    pub fn push(&mut self, out: Out) {
        self.0.push(out);
    }

    /// All messages, which leave.
    pub fn take(&mut self) -> Vec<Out> {
        std::mem::take(&mut self.0)
    }
}
