//! Data elements of a MATLAB file: a type, a size, and as many bytes.

use crate::bytes::{Bytes, Order};
use crate::room::{self, Room};
use crate::{ExchangeError, Place};

/// Types of elements: an array with its description, and one that is compressed.
pub(super) const MATRIX: u32 = 14;
pub(super) const PACKED: u32 = 15;

/// Types of numbers by their size: unsigned and signed integers, single and double precision; and texts.
const INT8: u32 = 1;
const UINT8: u32 = 2;
const INT16: u32 = 3;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const SINGLE: u32 = 7;
pub(super) const DOUBLE: u32 = 9;
const INT64: u32 = 12;
const UINT64: u32 = 13;
const UTF8: u32 = 16;
const UTF16: u32 = 17;
const UTF32: u32 = 18;

/// A data element.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    /// Type of the element by its number.
    pub kind: u32,
    /// The bytes of its content.
    pub bytes: &'a [u8],
    /// The byte of the file at which its content begins.
    pub at: usize,
}

impl<'a> Element<'a> {
    /// The next element.
    pub fn next(bytes: &mut Bytes<'a>, order: Order) -> Result<Self, ExchangeError> {
        let tag = order.u32(bytes.take(4, "the type of an element")?);
        // Four bytes at most are in the tag itself, with type and size in two bytes each.
        let (small, kind) = (tag >> 16, tag & 0xffff);
        if small > 0 {
            if small > 4 {
                return Err(bytes.refused("an element of at most 4 bytes", small));
            }
            let at = bytes.at;
            let taken = bytes.take(4, "a short element")?;
            return Ok(Self { kind, bytes: &taken[..small as usize], at });
        }
        let size = order.u32(bytes.take(4, "the size of an element")?) as usize;
        let at = bytes.at;
        let taken = bytes.take(size, "an element")?;
        if kind != PACKED {
            // Some writers leave out what fills the last element up.
            bytes.take((8 - size % 8) % 8, "what fills an element up").or_else(|error| {
                let left = bytes.left();
                if left == 0 { Ok(&[][..]) } else { Err(error) }
            })?;
        }
        Ok(Self { kind, bytes: taken, at })
    }

    /// Bytes of one of its numbers; `None` if it holds none.
    fn size(&self) -> Option<usize> {
        Some(match self.kind {
            INT8 | UINT8 | UTF8 => 1,
            INT16 | UINT16 | UTF16 => 2,
            INT32 | UINT32 | SINGLE | UTF32 => 4,
            DOUBLE | INT64 | UINT64 => 8,
            _ => return None,
        })
    }

    /// Its numbers, for which there must be room; none if it holds none.
    pub fn numbers(&self, order: Order, room: &mut Room<'_>) -> Result<Vec<f64>, ExchangeError> {
        let Some(size) = self.size() else { return Ok(Vec::new()) };
        room.take(self.bytes.len() / size, room::NUMBER, Place::Byte(self.at))?;
        let kind = self.kind;
        let number = move |bytes: &[u8]| match kind {
            INT8 => f64::from(bytes[0] as i8),
            UINT8 | UTF8 => f64::from(bytes[0]),
            INT16 => f64::from(order.u16(bytes) as i16),
            UINT16 | UTF16 => f64::from(order.u16(bytes)),
            INT32 => f64::from(order.u32(bytes) as i32),
            SINGLE => order.f32(bytes),
            DOUBLE => order.f64(bytes),
            INT64 => order.u64(bytes) as i64 as f64,
            UINT64 => order.u64(bytes) as f64,
            _ => f64::from(order.u32(bytes)),
        };
        Ok(self.bytes.chunks_exact(size).map(number).collect())
    }

    /// Its letters, one for each number, or more for a text in UTF-8, for which there must be room; none if it holds none.
    pub fn letters(&self, order: Order, room: &mut Room<'_>) -> Result<Vec<char>, ExchangeError> {
        if self.kind == UTF8 {
            room.take(self.bytes.len(), room::LETTER, Place::Byte(self.at))?;
            return Ok(String::from_utf8_lossy(self.bytes).chars().collect());
        }
        let letter = |number: f64| char::from_u32(number as u32).unwrap_or(char::REPLACEMENT_CHARACTER);
        Ok(self.numbers(order, room)?.into_iter().map(letter).collect())
    }
}
