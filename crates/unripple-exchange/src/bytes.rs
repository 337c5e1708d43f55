//! Bytes of a file that are read from front to back, with an error where they end.

use crate::{ExchangeError, Place};

/// Order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    Little,
    Big,
}

impl Order {
    /// The other order.
    pub fn other(self) -> Self {
        match self {
            Self::Little => Self::Big,
            Self::Big => Self::Little,
        }
    }

    /// The first bytes of a slice as an array of `N`, least significant byte first; zeros in place of what is missing.
    fn little<const N: usize>(self, bytes: &[u8]) -> [u8; N] {
        let mut array = [0; N];
        let taken = bytes.len().min(N);
        array[..taken].copy_from_slice(&bytes[..taken]);
        if self == Self::Big {
            array.reverse();
        }
        array
    }

    /// An unsigned integer of 2 bytes.
    pub fn u16(self, bytes: &[u8]) -> u16 {
        u16::from_le_bytes(self.little(bytes))
    }

    /// An unsigned integer of 4 bytes.
    pub fn u32(self, bytes: &[u8]) -> u32 {
        u32::from_le_bytes(self.little(bytes))
    }

    /// An unsigned integer of 8 bytes.
    pub fn u64(self, bytes: &[u8]) -> u64 {
        u64::from_le_bytes(self.little(bytes))
    }

    /// A single-precision number of 4 bytes.
    pub fn f32(self, bytes: &[u8]) -> f64 {
        f64::from(f32::from_le_bytes(self.little(bytes)))
    }

    /// A double-precision number of 8 bytes.
    pub fn f64(self, bytes: &[u8]) -> f64 {
        f64::from_le_bytes(self.little(bytes))
    }
}

/// Bytes that are taken from the front.
#[derive(Clone, Copy)]
pub(crate) struct Bytes<'a> {
    rest: &'a [u8],
    /// Offset of `rest` in the file.
    pub at: usize,
    /// Name of the file in messages.
    pub file: &'a str,
}

impl<'a> Bytes<'a> {
    /// The bytes of a file, or of a part of it that begins at the byte `at`.
    pub fn of(rest: &'a [u8], at: usize, file: &'a str) -> Self {
        Self { rest, at, file }
    }

    /// Number of bytes that are left.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    /// The next bytes; `what` says in the error what they should be.
    pub fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], ExchangeError> {
        let Some((taken, rest)) = self.rest.split_at_checked(count) else {
            let expected = format!("{count} bytes of {what}");
            return Err(self.refused(expected, format!("{} bytes", self.rest.len())));
        };
        self.rest = rest;
        self.at += count;
        Ok(taken)
    }

    /// The error of what is at this place.
    pub fn refused(&self, expected: impl Into<String>, found: impl std::fmt::Display) -> ExchangeError {
        ExchangeError::content(self.file, Place::Byte(self.at), expected, found)
    }
}
