//! One page's link: what it is shown, and what it asks for.

use crate::board::Notice;
use crate::studio::Studio;
use crate::wire::{Command, LONGEST};
use axum::extract::ws::{Message, Utf8Bytes, WebSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::time::{Instant, MissedTickBehavior, timeout};

/// Frames that may be on their way before the page says that it has drawn them.
const UNSEEN: u64 = 3;

/// A page that does not say what it has drawn is shown a frame this often.
const UNSURE: Duration = Duration::from_secs(1);

/// How long a message may take to leave before the page is given up.
const STUCK: Duration = Duration::from_secs(20);

/// A page is asked whether it is still there this often, and given up when it has said nothing for so many times: then there is nobody at
/// the other end.
const ASKED: Duration = Duration::from_secs(5);
const UNANSWERED: u32 = 4;

/// Messages a second that are listened to, refusals that are borne, and refusals that wait to be told.
const FASTEST: u32 = 600;
const BORNE: u32 = 50;
const WAITING: usize = 32;

/// Names for pages.
static GIVEN: AtomicU64 = AtomicU64::new(1);

/// Fingers of a page are numbered from its own number times this.
pub const FINGERS: u64 = 1000;

/// Whoever asked for something: is told why it is refused.
#[derive(Clone, Debug)]
pub struct Caller {
    told: Sender<String>,
}

impl Caller {
    /// Whoever hears what is sent here.
    pub fn new(told: Sender<String>) -> Self {
        Self { told }
    }

    /// Tells, unless so much waits to be told that it would be no use.
    pub fn refuse(&self, why: &str) {
        let text = serde_json::json!({ "is": "fault", "text": why }).to_string();
        let _ = self.told.try_send(text);
    }
}

/// Serves a page until it goes.
pub async fn serve(mut socket: WebSocket, studio: Arc<Studio>) {
    let page = GIVEN.fetch_add(1, Ordering::Relaxed);
    let (told, faults) = channel(WAITING);
    studio.look();
    let mut link = Link {
        studio: studio.clone(),
        page,
        caller: Caller::new(told),
        faults,
        texts: 0,
        frames: 0,
        shown: 0,
        seen: 0,
        last: Instant::now(),
        refused: 0,
        unanswered: 0,
        second: (Instant::now(), 0),
        fingers: Vec::new(),
    };
    link.talk(&mut socket).await;
    link.lift();
}

/// A page's link at work.
struct Link {
    studio: Arc<Studio>,
    page: u64,
    caller: Caller,
    faults: Receiver<String>,
    /// Of the newest text that was sent, and of the newest frame.
    texts: u64,
    frames: u64,
    /// Newest frame that was sent, and that was drawn, and when the former was.
    shown: u64,
    seen: u64,
    last: Instant,
    refused: u32,
    /// Questions since the page said something.
    unanswered: u32,
    /// The second under way, and messages in it.
    second: (Instant, u32),
    /// Fingers that are down.
    fingers: Vec<u64>,
}

impl Link {
    async fn talk(&mut self, socket: &mut WebSocket) {
        let mut news = self.studio.board.watch();
        let mut ask = tokio::time::interval(ASKED);
        // After a sleep of this machine a page has time to answer, too.
        ask.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            if !self.catch_up(socket).await {
                return;
            }
            let late = self.last + UNSURE;
            tokio::select! {
                changed = news.changed() => if changed.is_err() { return },
                fault = self.faults.recv() => {
                    let Some(fault) = fault else { return };
                    if !send(socket, Message::Text(fault.into())).await { return }
                }
                heard = socket.recv() => match heard {
                    Some(Ok(message)) => {
                        self.unanswered = 0;
                        if !self.hear(message) { return }
                    }
                    _ => return,
                },
                _ = ask.tick() => {
                    self.unanswered += 1;
                    let gone = self.unanswered > UNANSWERED;
                    if gone || !send(socket, Message::Ping(Default::default())).await { return }
                }
                () = tokio::time::sleep_until(late), if self.shown > self.seen + UNSEEN => self.seen = self.shown,
            }
        }
    }

    /// Sends what the page has not been sent; frames only as fast as it draws them.
    async fn catch_up(&mut self, socket: &mut WebSocket) -> bool {
        let waits = self.shown.saturating_sub(self.seen) > UNSEEN;
        for (version, notice) in self.studio.board.since(self.texts.min(self.frames)) {
            let message = match notice {
                Notice::Text(text) if version > self.texts => {
                    self.texts = version;
                    Message::Text(Utf8Bytes::from(&*text))
                }
                Notice::Frame(bytes, frame) if version > self.frames && !waits => {
                    (self.frames, self.shown, self.last) = (version, frame, Instant::now());
                    Message::Binary(bytes)
                }
                Notice::Text(_) | Notice::Frame(..) => continue,
            };
            if !send(socket, message).await {
                return false;
            }
        }
        true
    }

    /// Takes in a message; `false` ends the link.
    fn hear(&mut self, message: Message) -> bool {
        let text = match message {
            Message::Text(text) => text,
            Message::Binary(_) => return self.refuse("message: expected text, found bytes"),
            Message::Close(_) => return false,
            Message::Ping(_) | Message::Pong(_) => return true,
        };
        if self.second.0.elapsed() >= Duration::from_secs(1) {
            self.second = (Instant::now(), 0);
        }
        self.second.1 += 1;
        if self.second.1 > FASTEST {
            return self.refuse(&format!("messages: expected at most {FASTEST} a second, found more"));
        }
        match Command::read(&text) {
            Ok(Command::Seen { frame }) => self.seen = self.seen.max(frame.min(self.shown)),
            Ok(Command::Touch { finger, phase, at_mm }) => {
                let finger = self.page * FINGERS + u64::from(finger);
                self.fingers.retain(|other| *other != finger);
                if phase != crate::wire::Phase::Up {
                    self.fingers.push(finger);
                }
                self.studio.touch(finger, phase, at_mm);
            }
            Ok(command) => self.studio.obey(command, &self.caller),
            Err(error) => return self.refuse(&error.to_string()),
        }
        true
    }

    /// Says why something is refused; `false` if that was so once too often.
    fn refuse(&mut self, why: &str) -> bool {
        self.refused += 1;
        self.studio.log(&format!("page {}: refused: {why}", self.page));
        self.caller.refuse(why);
        self.refused <= BORNE
    }

    /// Lifts the fingers of a page that goes.
    fn lift(&mut self) {
        for finger in self.fingers.drain(..) {
            self.studio.touch(finger, crate::wire::Phase::Up, [0.0; 2]);
        }
    }
}

/// Sends a message, unless the page takes nothing any more.
async fn send(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(STUCK, socket.send(message)).await, Ok(Ok(())))
}

/// The longest message that is taken from a page.
pub const TAKEN: usize = LONGEST;
