//! Messages and pictures of the session for pages, before they are sent.

use serde::Serialize;

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

/// One message of the session to pages.
#[derive(Clone, Debug)]
pub enum Out {
    /// Kind and JSON text for all pages, in place of the last message of that kind.
    Text(String, String),
    /// Kind, bytes and number of a picture for all pages, in place of the last picture of that kind.
    Frame(String, Vec<u8>, u64),
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

    /// Adds a picture for all pages, with its number.
    pub fn frame(&mut self, kind: String, bytes: Vec<u8>, number: u64) {
        self.0.push(Out::Frame(kind, bytes, number));
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
