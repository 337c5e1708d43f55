//! A TCP port for WebSocket clients.

use super::connection::{Connection, Gone};
use crate::{Counts, Fingers, Heard, Options, Source, TouchError};
use std::io::ErrorKind;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
#[cfg(unix)]
use std::os::fd::{AsFd, BorrowedFd};
use std::sync::Arc;
use unripple_core::require;

/// Interval at which clients are checked, to be pinged or disconnected, in s. Far below the seconds of silence that
/// are allowed.
const LOOK: f64 = 0.1;

/// Connections taken in one poll, so that a flood of them keeps no finger waiting.
const ACCEPTED: usize = 8;

/// Options of a WebSocket port: origins, number of connections, time-out.
#[derive(Clone, Debug, PartialEq)]
pub struct WebSocketOptions {
    /// Pages that may connect beside those of this machine, as browsers name them: `https://lab.example:8443`.
    pub origins: Vec<String>,
    /// Largest number of connections at once. A further one replaces the oldest that has not completed its handshake; if there is
    /// none, the new one is closed.
    pub most: usize,
    /// Time after which a client that sends nothing, not even the answer to a ping, is disconnected, in s.
    pub silence: f64,
}

impl Default for WebSocketOptions {
    /// Pages of this machine only, 16 connections, 5 s of silence.
    fn default() -> Self {
        Self { origins: Vec::new(), most: 16, silence: 5.0 }
    }
}

/// A TCP port that speaks the protocol of [`SCHEMA`](crate::SCHEMA) over WebSocket.
///
/// Fingers of a connection are lifted when it closes, and when its client no longer answers pings.
pub struct WebSocketPort {
    name: String,
    listener: TcpListener,
    fingers: Fingers,
    connections: Vec<Connection>,
    given: u32,
    origins: Arc<[String]>,
    most: usize,
    silence: f64,
}

impl WebSocketPort {
    /// Opens a TCP port that accepts connections from this machine only; with port number 0 the system chooses a free
    /// one.
    ///
    /// ```
    /// use unripple_core::{Outline, Shape};
    /// use unripple_touch::{Options, WebSocketOptions, WebSocketPort};
    ///
    /// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    /// let port = WebSocketPort::local(0, Options::new(&sheet), WebSocketOptions::default())?;
    /// assert!(port.address().ip().is_loopback());
    /// # Ok::<(), unripple_touch::TouchError>(())
    /// ```
    pub fn local(port: u16, options: Options, sockets: WebSocketOptions) -> Result<Self, TouchError> {
        Self::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)), options, sockets)
    }

    /// Opens a TCP port at an address. Any address but a loopback one also accepts connections from the network.
    pub fn bind(
        address: SocketAddr,
        options: Options,
        sockets: WebSocketOptions,
    ) -> Result<Self, TouchError> {
        let fix = "another program may listen there: stop it, or choose another port";
        let error = |error| TouchError::io(format!("listening at TCP {address}"), error, fix);
        let WebSocketOptions { origins, most, silence } = sockets;
        require("connections at once", (1..=256).contains(&most), "1 to 256", most as f64)?;
        require("silence of a client, s", (0.1..=3600.0).contains(&silence), "0.1 to 3600", silence)?;
        let fingers = Fingers::new(options)?;
        let listener = TcpListener::bind(address).map_err(error)?;
        listener.set_nonblocking(true).map_err(error)?;
        let name = format!("WebSocket {}", listener.local_addr().map_err(error)?);
        let (connections, origins) = (Vec::with_capacity(most), origins.into());
        Ok(Self { name, listener, fingers, connections, given: 0, origins, most, silence })
    }

    /// Address at which the port listens.
    pub fn address(&self) -> SocketAddr {
        self.listener.local_addr().unwrap_or_else(|_| SocketAddr::from((Ipv4Addr::LOCALHOST, 0)))
    }

    /// Number of connections and fingers that are kept in memory.
    pub fn tracked(&self) -> usize {
        self.connections.len() + self.fingers.count()
    }

    fn accept(&mut self) {
        for _ in 0..ACCEPTED {
            match self.listener.accept() {
                Ok((stream, _)) => self.welcome(stream),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                Err(_) => {
                    self.fingers.counts.failed += 1;
                    return;
                }
            }
        }
    }

    fn welcome(&mut self, stream: TcpStream) {
        if self.connections.len() >= self.most {
            self.fingers.counts.crowded += 1;
            // A client that sends nothing must not keep others out: the oldest without a complete handshake makes
            // room.
            let Some(quiet) = self.connections.iter().position(Connection::is_shaking) else { return };
            self.connections.remove(quiet);
        }
        // Answers are short and must not be delayed.
        if stream.set_nonblocking(true).and_then(|()| stream.set_nodelay(true)).is_err() {
            self.fingers.counts.failed += 1;
            return;
        }
        let (origins, now) = (self.origins.clone(), self.fingers.awake());
        self.connections.push(Connection::new(stream, self.given, origins, now));
        self.given = self.given.wrapping_add(1);
        self.fingers.counts.senders += 1;
    }

    fn leave(&mut self, peer: u32, why: Gone, heard: &mut Heard) {
        self.fingers.lift_where(|key| key.peer == peer, heard);
        let counts = &mut self.fingers.counts;
        match why {
            Gone::Closed => {}
            Gone::Malformed => counts.malformed += 1,
            Gone::Foreign => counts.foreign += 1,
            Gone::Silent => counts.silent += 1,
        }
    }
}

impl Source for WebSocketPort {
    fn name(&self) -> &str {
        &self.name
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        self.fingers.begin(now);
        self.accept();
        let mut i = 0;
        while i < self.connections.len() {
            match self.connections[i].poll(self.silence, &mut self.fingers, heard) {
                Ok(()) => i += 1,
                Err(why) => {
                    let gone = self.connections.remove(i);
                    self.leave(gone.peer, why, heard);
                }
            }
        }
        self.fingers.expire(heard);
    }

    fn due(&self, now: f64) -> Option<f64> {
        // What was read already and not yet taken makes no socket readable.
        let more = self.connections.iter().any(Connection::has_more);
        (!self.connections.is_empty()).then_some(if more { now } else { now + LOOK })
    }

    #[cfg(unix)]
    fn files<'a>(&'a self, files: &mut Vec<BorrowedFd<'a>>) {
        files.push(self.listener.as_fd());
        files.extend(self.connections.iter().filter_map(|connection| Some(connection.stream()?.as_fd())));
    }

    fn counts(&self) -> Counts {
        self.fingers.counts
    }
}
