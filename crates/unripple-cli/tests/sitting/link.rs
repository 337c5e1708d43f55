//! A link to the program: of a client of its touch port, or of a page of the viewer.

use crate::program::Task;
use serde_json::Value;
use std::io::ErrorKind;
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Error, Message, WebSocket};

/// How long the program may take to accept a connection, and to answer on it, before another is tried. On a busy machine that is seconds.
pub const ANSWER: Duration = Duration::from_secs(10);

/// How often it is looked whether an answer has come.
const LOOK: Duration = Duration::from_millis(5);

/// A link that never waits: what has not come yet is not heard.
pub struct Link {
    socket: WebSocket<TcpStream>,
    task: Task,
    address: SocketAddr,
}

impl Link {
    /// Opens a link; the error says why there is none.
    pub fn open(task: Task, address: SocketAddr) -> Result<Self, String> {
        let said = |error: std::io::Error| error.to_string();
        let stream = TcpStream::connect_timeout(&address, ANSWER).map_err(said)?;
        stream.set_nodelay(true).map_err(said)?;
        stream.set_read_timeout(Some(ANSWER)).map_err(said)?;
        let mut request = format!("ws://{address}{}", task.path()).into_client_request().unwrap();
        request.headers_mut().insert("Origin", format!("http://{address}").parse().unwrap());
        let (socket, _) = tungstenite::client(request, stream).map_err(|error| error.to_string())?;
        socket.get_ref().set_nonblocking(true).map_err(said)?;
        Ok(Self { socket, task, address })
    }

    /// Opens the link anew, if that is possible.
    pub fn reopen(&mut self) {
        if let Ok(link) = Self::open(self.task, self.address) {
            *self = link;
        }
    }

    /// The connection below.
    pub fn stream(&mut self) -> &mut TcpStream {
        self.socket.get_mut()
    }

    /// The connection below, which stays open.
    pub fn into_stream(self) -> TcpStream {
        self.socket.into_inner()
    }

    /// Sends a message; false if the program takes no more.
    pub fn send(&mut self, message: Message) -> bool {
        match self.socket.send(message) {
            Ok(()) => true,
            // It waits, and goes with the next.
            Err(Error::Io(error)) => error.kind() == ErrorKind::WouldBlock,
            Err(_) => false,
        }
    }

    /// Sends a message as JSON; false if the program takes no more.
    pub fn say(&mut self, message: &Value) -> bool {
        self.send(Message::text(message.to_string()))
    }

    /// Sends what a finger does; false if the program takes no more.
    pub fn touch(&mut self, finger: u32, phase: &str, at_mm: [f64; 2]) -> bool {
        let message = self.task.touch(finger, phase, at_mm);
        self.say(&message)
    }

    /// All that has come since, and answers the questions whether somebody is there.
    pub fn heard(&mut self) -> Vec<Value> {
        let mut heard = Vec::new();
        while let Ok(message) = self.socket.read() {
            if let Message::Text(text) = message {
                heard.extend(serde_json::from_str::<Value>(&text).ok());
            }
        }
        heard
    }

    /// The first message that is wanted; the error says what did not come.
    pub fn until(
        &mut self,
        what: &str,
        deadline: Instant,
        wanted: impl Fn(&Value) -> bool,
    ) -> Result<Value, String> {
        while Instant::now() < deadline {
            if let Some(found) = self.heard().into_iter().find(&wanted) {
                return Ok(found);
            }
            std::thread::sleep(LOOK);
        }
        Err(format!("no word of {what}"))
    }
}
