//! One WebSocket client.

use super::message::{self, Message};
use super::metered::Metered;
use super::origin::admitted;
use crate::{Fingers, Heard, Key};
use std::io::ErrorKind;
use std::net::TcpStream;
use std::sync::Arc;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::server::{Callback, ErrorResponse, Request, Response, ServerHandshake};
use tungstenite::handshake::{HandshakeError, MidHandshake};
use tungstenite::http::{StatusCode, header};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, WebSocket};
use unripple_core::Phase;

/// Bytes and messages read from one connection in one poll. The rest waits for the next poll, so that one client
/// keeps no other waiting.
const BYTES: usize = 16 * 1024;
const MESSAGES: usize = 64;
/// The longest message, in bytes: a touch takes some hundred, and a longer one is refused.
const LONGEST: usize = 4 * 1024;
/// Answers that may wait for a client to take them, in bytes. A client that takes none is dropped when they are full,
/// so that memory is bounded.
const WAITING: usize = 16 * 1024;

/// Refuses requests from foreign pages.
pub(super) struct Doorkeeper {
    allowed: Arc<[String]>,
}

impl Callback for Doorkeeper {
    fn on_request(self, request: &Request, response: Response) -> Result<Response, ErrorResponse> {
        let mut origins = request.headers().get_all(header::ORIGIN).iter();
        let good = match (origins.next(), origins.next()) {
            (None, _) => true,
            (Some(origin), None) => origin.to_str().is_ok_and(|origin| admitted(origin, &self.allowed)),
            _ => false,
        };
        if good {
            return Ok(response);
        }
        let mut refusal = ErrorResponse::new(Some("this page may not connect\n".to_owned()));
        *refusal.status_mut() = StatusCode::FORBIDDEN;
        Err(refusal)
    }
}

enum State {
    Shaking(Box<MidHandshake<ServerHandshake<Metered, Doorkeeper>>>),
    Open(Box<WebSocket<Metered>>),
}

/// Why a connection is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gone {
    Closed,
    Malformed,
    Foreign,
    Silent,
}

/// A client, from its first byte on. Times are those of the clock of time-outs.
pub(super) struct Connection {
    pub(super) peer: u32,
    state: Option<State>,
    spoken: f64,
    pinged: f64,
    more: bool,
}

impl Connection {
    pub(super) fn new(stream: TcpStream, peer: u32, allowed: Arc<[String]>, now: f64) -> Self {
        let config = WebSocketConfig::default()
            .read_buffer_size(LONGEST)
            .write_buffer_size(0)
            .max_write_buffer_size(WAITING)
            .max_message_size(Some(LONGEST))
            .max_frame_size(Some(LONGEST));
        let door = Doorkeeper { allowed };
        let shaking = ServerHandshake::start(Metered::new(stream), door, Some(config));
        Self { peer, state: Some(State::Shaking(Box::new(shaking))), spoken: now, pinged: now, more: false }
    }

    /// Whether messages that were received already may still have to be processed.
    pub(super) fn has_more(&self) -> bool {
        self.more
    }

    /// The socket, which becomes readable when there is something to poll for.
    #[cfg(unix)]
    pub(super) fn stream(&self) -> Option<&TcpStream> {
        match self.state.as_ref()? {
            State::Shaking(shaking) => Some(shaking.get_ref().get_ref().stream()),
            State::Open(socket) => Some(socket.get_ref().stream()),
        }
    }

    /// Whether the WebSocket handshake is not complete.
    pub(super) fn is_shaking(&self) -> bool {
        matches!(self.state, Some(State::Shaking(_)))
    }

    /// Reads what came and answers it.
    pub(super) fn poll(
        &mut self,
        silence: f64,
        fingers: &mut Fingers,
        heard: &mut Heard,
    ) -> Result<(), Gone> {
        let now = fingers.awake();
        if now - self.spoken > silence {
            return Err(Gone::Silent);
        }
        let open = match self.state.take() {
            Some(State::Shaking(mut shaking)) => {
                shaking.get_mut().get_mut().allow(BYTES);
                shake(*shaking)?
            }
            Some(open) => open,
            None => return Err(Gone::Closed),
        };
        self.state = Some(match open {
            State::Open(mut socket) => {
                socket.get_mut().allow(BYTES);
                self.listen(&mut socket, fingers, heard)?;
                self.ping(&mut socket, fingers)?;
                State::Open(socket)
            }
            shaking => shaking,
        });
        Ok(())
    }

    fn listen(
        &mut self,
        socket: &mut WebSocket<Metered>,
        fingers: &mut Fingers,
        heard: &mut Heard,
    ) -> Result<(), Gone> {
        self.more = false;
        for _ in 0..MESSAGES {
            let message = match socket.read() {
                Ok(message) => message,
                Err(error) if would_block(&error) => return Ok(()),
                Err(error) => return Err(why(&error)),
            };
            // A client that says anything, or answers a ping, still has its fingers where they are.
            self.spoken = fingers.awake();
            let peer = self.peer;
            fingers.renew_where(|key| key.peer == peer);
            let answer = match &message {
                tungstenite::Message::Text(text) => self.hear(text, fingers, heard),
                tungstenite::Message::Binary(_) => {
                    fingers.counts.packets += 1;
                    fingers.counts.malformed += 1;
                    Some(message::error("expected text, found bytes"))
                }
                tungstenite::Message::Close(_) => return Err(Gone::Closed),
                _ => None,
            };
            if let Some(answer) = answer {
                send(socket, tungstenite::Message::text(answer))?;
            }
        }
        self.more = true;
        Ok(())
    }

    /// Does what a message asks, and returns what to answer.
    fn hear(&self, text: &str, fingers: &mut Fingers, heard: &mut Heard) -> Option<String> {
        fingers.counts.packets += 1;
        match Message::read(text) {
            Ok(Message::Hello) => Some(message::hello(&fingers.options().surface)),
            Ok(Message::Clear) => {
                fingers.lift_where(|key| key.peer == self.peer, heard);
                None
            }
            Ok(Message::Wish(wish)) => {
                fingers.take_wish(wish, heard);
                None
            }
            Ok(Message::Touch { finger, phase, at, force }) => {
                let key = Key { peer: self.peer, stream: 0, session: i64::from(finger) };
                let there = fingers.has(key);
                if (phase != Phase::Down && !there) || phase == Phase::Up {
                    if fingers.lift(key, heard) {
                        return None;
                    }
                    fingers.counts.unknown += 1;
                    return Some(message::error(&format!("expected a finger that is down, found {finger}")));
                }
                if phase == Phase::Down {
                    // A finger that comes twice has left in between.
                    fingers.lift(key, heard);
                }
                let put = fingers.put(key, at?, force, heard);
                put.err().map(|refusal| message::error(&refusal.to_string()))
            }
            Err(what) => {
                fingers.counts.malformed += 1;
                Some(message::error(&what))
            }
        }
    }

    /// Asks a client that has been quiet whether it is still there.
    fn ping(&mut self, socket: &mut WebSocket<Metered>, fingers: &Fingers) -> Result<(), Gone> {
        let (now, quiet) = (fingers.awake(), fingers.options().timeout / 4.0);
        if now - self.spoken.max(self.pinged) >= quiet {
            self.pinged = now;
            send(socket, tungstenite::Message::Ping(Default::default()))?;
        }
        match socket.flush() {
            Err(error) if !would_block(&error) => Err(why(&error)),
            _ => Ok(()),
        }
    }
}

fn shake(shaking: MidHandshake<ServerHandshake<Metered, Doorkeeper>>) -> Result<State, Gone> {
    match shaking.handshake() {
        Ok(socket) => Ok(State::Open(Box::new(socket))),
        Err(HandshakeError::Interrupted(shaking)) => Ok(State::Shaking(Box::new(shaking))),
        Err(HandshakeError::Failure(error)) => Err(why(&error)),
    }
}

fn send(socket: &mut WebSocket<Metered>, message: tungstenite::Message) -> Result<(), Gone> {
    match socket.write(message) {
        Err(error) if !would_block(&error) => Err(why(&error)),
        _ => Ok(()),
    }
}

fn would_block(error: &Error) -> bool {
    matches!(error, Error::Io(error) if error.kind() == ErrorKind::WouldBlock)
}

fn why(error: &Error) -> Gone {
    match error {
        Error::Http(_) => Gone::Foreign,
        Error::WriteBufferFull(_) => Gone::Silent,
        Error::Io(_) | Error::ConnectionClosed | Error::AlreadyClosed => Gone::Closed,
        Error::Protocol(ProtocolError::ResetWithoutClosingHandshake | ProtocolError::HandshakeIncomplete) => {
            Gone::Closed
        }
        _ => Gone::Malformed,
    }
}
