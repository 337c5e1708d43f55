//! WAV of float64, which the reader of other kinds does not know.

use crate::StoreError;
use std::io::{self, Cursor, Read};

/// Largest chunk other than samples that is kept while the format is looked for, in bytes.
const MOST: u64 = 1 << 20;

/// Format tags of RIFF: float samples, and a format whose real tag stands further on (`WAVE_FORMAT_EXTENSIBLE`).
const FLOAT: u16 = 3;
const EXTENSIBLE: u16 = 0xfffe;

/// The sample format of a WAV file, by its first chunks.
pub(crate) enum Format<R> {
    /// Float64: samples per second, channels, and what follows the format.
    Float64 { rate: u32, channels: u16, rest: R },
    /// Any other format: all bytes of the file, for the reader of the other formats.
    Other(io::Chain<Cursor<Vec<u8>>, R>),
}

/// Looks at the chunks up to the format, without losing any.
pub(crate) fn format<R: Read>(mut reader: R) -> io::Result<Format<R>> {
    let mut seen = Vec::new();
    let described = described(&mut reader, &mut seen)?;
    Ok(match described.and_then(|from| wide(&seen[from..])) {
        Some((rate, channels)) => Format::Float64 { rate, channels, rest: reader },
        None => Format::Other(Cursor::new(seen).chain(reader)),
    })
}

/// Reads up to the end of the format, if there is one; where in what was seen it begins.
fn described(reader: &mut impl Read, seen: &mut Vec<u8>) -> io::Result<Option<usize>> {
    let mut take = |bytes: u64, seen: &mut Vec<u8>| -> io::Result<bool> {
        Ok(reader.by_ref().take(bytes).read_to_end(seen)? as u64 == bytes)
    };
    if !take(12, seen)? || !seen.starts_with(b"RIFF") || seen[8..] != *b"WAVE" {
        return Ok(None);
    }
    loop {
        let head = seen.len();
        if !take(8, seen)? || &seen[head..head + 4] == b"data" {
            return Ok(None);
        }
        let length =
            u64::from(u32::from_le_bytes([seen[head + 4], seen[head + 5], seen[head + 6], seen[head + 7]]));
        let format = &seen[head..head + 4] == b"fmt ";
        // Chunks begin at even places.
        if length > MOST || !take(length + length % 2, seen)? {
            return Ok(None);
        }
        if format {
            return Ok(Some(head + 8));
        }
    }
}

/// Rate and channels, if a format is that of float64.
fn wide(chunk: &[u8]) -> Option<(u32, u16)> {
    let word = |at: usize| Some(u16::from_le_bytes([*chunk.get(at)?, *chunk.get(at + 1)?]));
    let tag = match word(0)? {
        // The tag proper is the first word of the identifier that ends the format.
        EXTENSIBLE => word(24)?,
        tag => tag,
    };
    let rate = u32::from(word(4)?) | u32::from(word(6)?) << 16;
    (tag == FLOAT && word(14)? == 64).then_some((rate, word(2)?))
}

/// The samples of float64 behind a format, channel after channel within each.
pub(crate) fn samples(
    mut reader: impl Read,
    name: &str,
    mut keep: impl FnMut(usize, f64) -> Result<(), StoreError>,
) -> Result<(), StoreError> {
    let ended = |samples: usize| {
        let found = format!("a file that ends after {samples} samples");
        StoreError::content(name, "a WAV file of integers, float32 or float64", found)
    };
    let mut head = [0; 8];
    let length = loop {
        reader.read_exact(&mut head).map_err(|_| ended(0))?;
        let length = u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]]));
        if head.starts_with(b"data") {
            break length;
        }
        io::copy(&mut (&mut reader).take(length + length % 2), &mut io::sink()).map_err(|_| ended(0))?;
    };
    let mut reader = reader.take(length);
    let mut sample = [0; 8];
    for i in 0..(length / 8) as usize {
        reader.read_exact(&mut sample).map_err(|_| ended(i))?;
        keep(i, f64::from_le_bytes(sample))?;
    }
    Ok(())
}
