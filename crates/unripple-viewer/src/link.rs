//! One page's WebSocket link: sends it messages and pictures, and receives its commands.

use crate::host::SessionHost;
use crate::notices::Notice;
use axum::body::Bytes;
use axum::extract::ws::{Message, Utf8Bytes, WebSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use tokio::sync::mpsc::{Receiver, channel};
use tokio::time::{Instant, MissedTickBehavior, timeout};
use unripple_session::{Command, Held, LONGEST, Phase};

/// Number of frames that may be sent before the page says that it has drawn them. With one a distant page draws one frame for each round
/// trip; with many it lags behind by as many.
const UNSEEN: u64 = 4;

/// A page that does not say what it has drawn is shown a frame this often. So a hidden page still follows, and costs
/// next to nothing.
const UNSURE: Duration = Duration::from_secs(1);

/// How long a message may take to leave before the page is given up. Much shorter would cut off phones that change
/// networks.
const STUCK: Duration = Duration::from_secs(20);

/// A page is asked whether it is still there this often, and given up when it has said nothing for so many times: then there is nobody at
/// the other end.
const ASKED: Duration = Duration::from_secs(5);
const UNANSWERED: u32 = 4;

/// Largest number of messages per second beside moves of fingers; of moves, which ten fingers make on a screen of 120 Hz, and of which more
/// are dropped; of all messages: as no hands make; of refusals before the link is closed, and of refusals that may wait to be sent.
const FASTEST: u32 = 600;
const MOVES: u32 = 1200;
const MOST: u32 = 10 * FASTEST;
const BORNE: u32 = 50;
const WAITING: usize = 32;

/// The number that the next page gets: from 1, never used again.
static GIVEN: AtomicU64 = AtomicU64::new(1);

/// Serves a page's link until it is closed.
pub async fn serve(mut socket: WebSocket, host: Arc<SessionHost>) {
    let page = GIVEN.fetch_add(1, Ordering::Relaxed);
    let (told, faults) = channel(WAITING);
    host.come(page, told);
    let mut link = Link {
        host,
        page,
        faults,
        texts: 0,
        frames: 0,
        shown: 0,
        seen: 0,
        last: Instant::now(),
        held: Held::default(),
        refused: 0,
        unanswered: 0,
        second: Second::now(),
    };
    link.talk(&mut socket).await;
    link.host.leave(page);
}

/// A page's link at work.
struct Link {
    host: Arc<SessionHost>,
    page: u64,
    faults: Receiver<String>,
    /// Version of the newest text that was sent, and of the newest frame.
    texts: u64,
    frames: u64,
    /// Number of the newest frame that was sent, and of the newest that was drawn; when the former was sent.
    shown: u64,
    seen: u64,
    last: Instant,
    held: Held<Bytes>,
    refused: u32,
    /// Questions since the page said something.
    unanswered: u32,
    second: Second,
}

/// The second under way, and the messages in it: all, moves of fingers, and requests.
struct Second {
    began: Instant,
    all: u32,
    moves: u32,
    requests: u32,
}

impl Second {
    fn now() -> Self {
        Self { began: Instant::now(), all: 0, moves: 0, requests: 0 }
    }
}

impl Link {
    async fn talk(&mut self, socket: &mut WebSocket) {
        let mut news = self.host.notices.watch();
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
                () = tokio::time::sleep_until(late), if self.shown >= self.seen + UNSEEN => self.seen = self.shown,
            }
        }
    }

    /// Sends what the page has not been sent; frames only as fast as it draws them.
    async fn catch_up(&mut self, socket: &mut WebSocket) -> bool {
        let full = self.shown.saturating_sub(self.seen) >= UNSEEN;
        for (version, notice) in self.host.notices.since(self.texts.min(self.frames)) {
            let message = match notice {
                Notice::Text(text) if version > self.texts => {
                    self.texts = version;
                    Message::Text(Utf8Bytes::from(&*text))
                }
                Notice::Frame(bytes, picture) if version > self.frames => {
                    let Some((bytes, picture)) = self.held.pass(bytes, picture, full) else { continue };
                    (self.frames, self.shown, self.last) = (version, picture.number, Instant::now());
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
        if self.second.began.elapsed() >= Duration::from_secs(1) {
            self.second = Second::now();
        }
        self.second.all += 1;
        if self.second.all > MOST {
            return self.refuse_haste();
        }
        match Command::read(&text) {
            Ok(Command::Seen { frame }) => self.seen = self.seen.max(frame.min(self.shown)),
            Ok(command @ Command::Touch { phase: Phase::Move, .. }) => {
                self.second.moves += 1;
                // Another move follows, or a lift, which says where it was.
                if self.second.moves <= MOVES {
                    self.host.obey(self.page, command);
                }
            }
            // A finger whose lift is lost would stay.
            Ok(lift @ Command::Touch { phase: Phase::Up, .. }) => self.host.obey(self.page, lift),
            Ok(command) => {
                self.second.requests += 1;
                if self.second.requests > FASTEST {
                    return self.refuse_haste();
                }
                self.host.obey(self.page, command);
            }
            Err(error) => return self.refuse(&error.to_string()),
        }
        true
    }

    fn refuse_haste(&mut self) -> bool {
        self.refuse(&format!("messages: expected at most {FASTEST} a second, found more"))
    }

    /// Says why something is refused; `false` if that was so once too often.
    fn refuse(&mut self, why: &str) -> bool {
        self.refused += 1;
        self.host.log(&format!("page {}: refused: {why}", self.page));
        self.host.refuse(self.page, why);
        self.refused <= BORNE
    }
}

/// Sends a message, unless the page takes nothing any more.
async fn send(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(STUCK, socket.send(message)).await, Ok(Ok(())))
}

/// Longest message that is accepted from a page, in bytes.
pub const TAKEN: usize = LONGEST;
