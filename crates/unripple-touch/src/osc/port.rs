//! A UDP port that receives OSC and TUIO.

use super::packet::LONGEST;
use super::receiver::OscReceiver;
use crate::{Counts, Heard, Options, Source, TouchError};
use std::io::ErrorKind;
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
#[cfg(unix)]
use std::os::fd::{AsFd, BorrowedFd};

/// Packets read in one poll, so that a flood of them keeps nobody waiting: the rest is read by the next poll.
const PACKETS: usize = 256;
/// Bytes read in one poll, and a last packet more. The rest waits for the next poll, so that a flood keeps nobody
/// waiting.
const BYTES: usize = 64 * 1024;

/// A UDP port that receives TUIO 1.1, TUIO 2.0 and the addresses under `/unripple/`.
///
/// Packets wait in the system's buffer until the next poll; when that is full, the system drops them.
pub struct OscPort {
    name: String,
    socket: UdpSocket,
    receiver: OscReceiver,
    buffer: Vec<u8>,
}

impl OscPort {
    /// The UDP port that TUIO trackers send to by default.
    pub const PORT: u16 = 3333;

    /// Opens a UDP port that receives from this machine only; with port 0 the system chooses a free one.
    ///
    /// ```
    /// use unripple_core::{Outline, Shape};
    /// use unripple_touch::{Heard, Options, OscPort, Source};
    ///
    /// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    /// let mut port = OscPort::local(0, Options::new(&sheet))?;
    /// let sender = std::net::UdpSocket::bind("127.0.0.1:0").unwrap();
    /// sender.send_to(b"/unripple/effect\0\0\0\0,s\0\0click\0\0\0", port.address()).unwrap();
    /// let mut heard = Heard::default();
    /// while heard.wishes.is_empty() {
    ///     port.poll(0.0, &mut heard);
    /// }
    /// # Ok::<(), unripple_touch::TouchError>(())
    /// ```
    pub fn local(port: u16, options: Options) -> Result<Self, TouchError> {
        Self::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)), options)
    }

    /// Opens a UDP port at an address. Any address but a loopback one also receives from the network.
    pub fn bind(address: SocketAddr, options: Options) -> Result<Self, TouchError> {
        let fix = "another program may listen there: stop it, or choose another port";
        let error = |error| TouchError::io(format!("listening at UDP {address}"), error, fix);
        let receiver = OscReceiver::new(options)?;
        let socket = UdpSocket::bind(address).map_err(error)?;
        socket.set_nonblocking(true).map_err(error)?;
        let name = format!("UDP {}", socket.local_addr().map_err(error)?);
        // One byte more than the longest packet shows a longer one, which the system cuts.
        Ok(Self { name, socket, receiver, buffer: vec![0; LONGEST + 1] })
    }

    /// Address at which the port listens.
    pub fn address(&self) -> SocketAddr {
        self.socket.local_addr().unwrap_or_else(|_| SocketAddr::from((Ipv4Addr::LOCALHOST, 0)))
    }

    /// Number of fingers, senders and names of senders that are kept in memory.
    pub fn tracked(&self) -> usize {
        self.receiver.tracked()
    }
}

impl Source for OscPort {
    fn name(&self) -> &str {
        &self.name
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        self.receiver.begin(now);
        let mut bytes = 0;
        for _ in 0..PACKETS {
            match self.socket.recv_from(&mut self.buffer) {
                Ok((length, from)) => {
                    self.receiver.packet(from, &self.buffer[..length], heard);
                    bytes += length;
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(_) => {
                    self.receiver.fail();
                    break;
                }
            }
            if bytes > BYTES {
                break;
            }
        }
        self.receiver.end(heard);
    }

    fn due(&self, now: f64) -> Option<f64> {
        self.receiver.due(now)
    }

    #[cfg(unix)]
    fn files<'a>(&'a self, files: &mut Vec<BorrowedFd<'a>>) {
        files.push(self.socket.as_fd());
    }

    fn counts(&self) -> Counts {
        self.receiver.counts()
    }
}
