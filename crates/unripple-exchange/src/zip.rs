//! Archives as NPZ files are: zip files whose members are stored or deflated.

use crate::bytes::Order;
use crate::error::shown;
use crate::{ExchangeError, Place};
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::borrow::Cow;

/// What is at the end of the archive, before a comment of at most 65 535 bytes.
const END: &[u8] = b"PK\x05\x06";
const END_SIZE: usize = 22;

/// What begins an entry of the directory, and a member.
const ENTRY: &[u8] = b"PK\x01\x02";
const ENTRY_SIZE: usize = 46;
const MEMBER: &[u8] = b"PK\x03\x04";
const MEMBER_SIZE: usize = 30;

/// Value of a field of 4 bytes that stands elsewhere, in 8 bytes.
const ELSEWHERE: u64 = u32::MAX as u64;

/// A member of an archive, as its directory describes it.
pub(crate) struct Member {
    /// Name of the member in the archive.
    pub name: String,
    method: u16,
    check: u32,
    packed: u64,
    unpacked: u64,
    offset: u64,
}

/// The members of an archive.
pub(crate) fn members(bytes: &[u8], file: &str) -> Result<Vec<Member>, ExchangeError> {
    let refused = |at: usize, expected: &str, found: &str| {
        ExchangeError::content(file, Place::Byte(at), expected, found)
    };
    let from = bytes.len().saturating_sub(END_SIZE + usize::from(u16::MAX));
    let tail = &bytes[from..];
    let found = tail.windows(END.len()).rposition(|four| four == END).map(|at| from + at);
    let end = found.filter(|at| bytes.len() - at >= END_SIZE);
    let end = end.ok_or_else(|| refused(bytes.len(), "the end of a zip archive", "none"))?;
    let little = Order::Little;
    let (mut count, mut at) =
        (u64::from(little.u16(&bytes[end + 10..])), u64::from(little.u32(&bytes[end + 16..])));
    if at == ELSEWHERE || count == u64::from(u16::MAX) {
        (count, at) =
            wide_end(bytes, end).ok_or_else(|| refused(end, "a zip archive with a directory", "none"))?;
    }
    let mut at = usize::try_from(at).unwrap_or(usize::MAX);
    let mut members = Vec::new();
    for _ in 0..count {
        let entry = bytes.get(at..).filter(|entry| entry.len() >= ENTRY_SIZE && entry.starts_with(ENTRY));
        let entry = entry.ok_or_else(|| refused(at.min(bytes.len()), "an entry of a directory", "none"))?;
        let [name, extra, comment] = [28, 30, 32].map(|field| usize::from(little.u16(&entry[field..])));
        let size = ENTRY_SIZE + name + extra + comment;
        if entry.len() < size {
            return Err(refused(at, "a whole entry of a directory", "the end of the file"));
        }
        let [packed, unpacked, offset] = [20, 24, 42].map(|field| u64::from(little.u32(&entry[field..])));
        let mut member = Member {
            name: String::from_utf8_lossy(&entry[ENTRY_SIZE..ENTRY_SIZE + name]).into_owned(),
            method: little.u16(&entry[10..]),
            check: little.u32(&entry[16..]),
            packed,
            unpacked,
            offset,
        };
        member.widen(&entry[ENTRY_SIZE + name..ENTRY_SIZE + name + extra]);
        members.push(member);
        at += size;
    }
    // Members that share bytes would take more memory than the file bounds.
    let packed = members.iter().fold(0_u64, |sum, member| sum.saturating_add(member.packed));
    if packed > bytes.len() as u64 {
        return Err(refused(end, "members that share no bytes", "more bytes than the file has"));
    }
    Ok(members)
}

/// Number of entries and offset of the directory of an archive of the 64-bit form, whose end is at `end`.
fn wide_end(bytes: &[u8], end: usize) -> Option<(u64, u64)> {
    let little = Order::Little;
    let locator = bytes.get(end.checked_sub(20)?..end)?;
    let at = usize::try_from(little.u64(&locator[8..])).ok()?;
    let record = bytes.get(at..at.checked_add(56)?)?;
    let whole = locator.starts_with(b"PK\x06\x07") && record.starts_with(b"PK\x06\x06");
    whole.then(|| (little.u64(&record[32..]), little.u64(&record[48..])))
}

impl Member {
    /// Takes sizes and offset of 8 bytes from the extra field, where those of 4 bytes say so.
    fn widen(&mut self, mut extra: &[u8]) {
        let little = Order::Little;
        while extra.len() >= 4 {
            let (kind, size) = (little.u16(extra), usize::from(little.u16(&extra[2..])));
            let Some(mut field) = extra.get(4..4 + size) else { return };
            if kind == 1 {
                for value in [&mut self.unpacked, &mut self.packed, &mut self.offset] {
                    if *value == ELSEWHERE && field.len() >= 8 {
                        *value = little.u64(field);
                        field = &field[8..];
                    }
                }
            }
            extra = &extra[4 + size..];
        }
    }

    /// The bytes of the member, unpacked, with their checksum compared.
    pub fn unpack<'a>(&self, bytes: &'a [u8], file: &str) -> Result<Cow<'a, [u8]>, ExchangeError> {
        let named = || Place::Named(self.name.clone());
        let refused =
            |expected: String, found: String| ExchangeError::content(file, named(), expected, found);
        let packed = self.packed_bytes(bytes).ok_or_else(|| {
            refused(format!("{} bytes at byte {}", self.packed, self.offset), "the end of the file".into())
        })?;
        let most = crate::room::most(packed.len());
        if self.unpacked > most {
            return Err(refused(format!("at most {most} bytes"), format!("{}", self.unpacked)));
        }
        let unpacked = match self.method {
            0 => Cow::Borrowed(packed),
            8 => {
                let limit = usize::try_from(self.unpacked).unwrap_or(usize::MAX);
                let unpacked = decompress_to_vec_with_limit(packed, limit);
                Cow::Owned(unpacked.map_err(|error| {
                    refused("bytes that deflate has packed".into(), format!("{:?}", error.status))
                })?)
            }
            other => return Err(refused("a member stored or deflated".into(), format!("method {other}"))),
        };
        if unpacked.len() as u64 != self.unpacked {
            return Err(refused(format!("{} bytes", self.unpacked), unpacked.len().to_string()));
        }
        let check = crc32(&unpacked);
        if check != self.check {
            return Err(refused(format!("the checksum {:08x}", self.check), format!("{check:08x}")));
        }
        Ok(unpacked)
    }

    fn packed_bytes<'a>(&self, bytes: &'a [u8]) -> Option<&'a [u8]> {
        let little = Order::Little;
        let member = bytes.get(usize::try_from(self.offset).ok()?..)?;
        if member.len() < MEMBER_SIZE || !member.starts_with(MEMBER) {
            return None;
        }
        let [name, extra] = [26, 28].map(|field| usize::from(little.u16(&member[field..])));
        member.get(MEMBER_SIZE + name + extra..)?.get(..usize::try_from(self.packed).ok()?)
    }
}

/// Checksum of zip files: CRC-32 with the reversed polynomial of Ethernet.
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut n = 0;
        while n < 256 {
            let mut value = n as u32;
            let mut bit = 0;
            while bit < 8 {
                value = if value & 1 == 1 { (value >> 1) ^ 0xedb8_8320 } else { value >> 1 };
                bit += 1;
            }
            table[n] = value;
            n += 1;
        }
        table
    };
    !bytes.iter().fold(u32::MAX, |check: u32, byte| TABLE[usize::from((check as u8) ^ byte)] ^ (check >> 8))
}

/// Refuses what is no archive at all, so that the message says what the file is.
pub(crate) fn is_archive(bytes: &[u8], file: &str) -> Result<(), ExchangeError> {
    if bytes.starts_with(MEMBER) || bytes.starts_with(END) {
        return Ok(());
    }
    let found = shown(&bytes[..bytes.len().min(16)]);
    Err(ExchangeError::content(file, Place::Whole, "an NPZ file, which is a zip archive", found))
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_checksum_is_that_of_zip() {
        // The check value of the catalogue of parametrised CRC algorithms.
        assert_eq!(super::crc32(b"123456789"), 0xcbf4_3926);
    }
}
