//! A connection that gives a bounded number of bytes per poll.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;

/// A connection that gives a bounded number of bytes per poll, however fast they come.
#[derive(Debug)]
pub(super) struct Metered {
    stream: TcpStream,
    left: usize,
}

impl Metered {
    pub(super) fn new(stream: TcpStream) -> Self {
        Self { stream, left: 0 }
    }

    /// The connection itself.
    #[cfg(unix)]
    pub(super) fn stream(&self) -> &TcpStream {
        &self.stream
    }

    /// Sets how many bytes may be read from now on.
    pub(super) fn allow(&mut self, bytes: usize) {
        self.left = bytes;
    }
}

impl Read for Metered {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let most = buffer.len().min(self.left);
        if most == 0 {
            return Err(Error::from(ErrorKind::WouldBlock));
        }
        let read = self.stream.read(&mut buffer[..most])?;
        self.left -= read;
        Ok(read)
    }
}

impl Write for Metered {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        self.stream.flush()
    }
}
