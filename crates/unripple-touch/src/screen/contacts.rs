//! Access to the input events of a touch screen.

use super::slots::Event;
use std::io;
#[cfg(unix)]
use std::os::fd::BorrowedFd;

/// The input events of a touch screen, read from the kernel or from a list.
pub trait Contacts: Send {
    /// Appends the next events that are available, some tens at a time; never blocks. If it appends none, no more are
    /// available.
    fn read(&mut self, events: &mut Vec<Event>) -> io::Result<()>;

    /// The slot that the next events belong to; called after events were lost.
    fn slot(&mut self) -> io::Result<usize>;

    /// File that becomes readable when there are events; without one, the screen is polled every 2 ms.
    #[cfg(unix)]
    fn file(&self) -> Option<BorrowedFd<'_>> {
        None
    }

    /// Opens a screen again after a read error.
    fn reopen(&mut self) -> io::Result<()>;
}
