//! The memory that what is read of one file may take: packed files, and numbers of one byte, grow when they are read.

use crate::{ExchangeError, Place};

/// Most bytes of all arrays of a file, and of what is unpacked of it, 4 GiB, and most per byte of the file, which is what deflate can reach.
const MOST_BYTES: u64 = 1 << 32;
const MOST_RATIO: u64 = 1032;

/// Bytes of a number, of a letter and, without its letters, of a text as they are kept.
pub(crate) const NUMBER: usize = 8;
pub(crate) const LETTER: usize = 4;
pub(crate) const TEXT: usize = 24;

/// Most bytes that so many bytes of a file may unpack to.
pub(crate) fn most(bytes: usize) -> u64 {
    (bytes as u64).saturating_mul(MOST_RATIO).min(MOST_BYTES)
}

/// The memory that is left for the arrays of a file.
pub(crate) struct Room<'a> {
    /// Name of the file in messages.
    pub file: &'a str,
    left: u64,
    most: u64,
}

impl<'a> Room<'a> {
    /// The room for the arrays of a file of so many bytes.
    pub fn of(bytes: usize, file: &'a str) -> Self {
        let most = most(bytes);
        Self { file, left: most, most }
    }

    /// Takes the room for a number of values of so many bytes each; `at` is their place in the file.
    ///
    /// # Errors
    /// [`ExchangeError::Content`] if there is no room left.
    pub fn take(&mut self, count: usize, each: usize, at: Place) -> Result<(), ExchangeError> {
        let wanted = (count as u64).saturating_mul(each as u64);
        let Some(left) = self.left.checked_sub(wanted) else {
            let expected = format!("arrays of at most {} bytes in memory", self.most);
            let found = format!("{wanted} bytes more than the {} that are taken", self.most - self.left);
            return Err(ExchangeError::content(self.file, at, expected, found));
        };
        self.left = left;
        Ok(())
    }
}
