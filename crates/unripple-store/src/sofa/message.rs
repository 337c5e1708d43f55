//! Messages of an HDF5 object header, which describe the object.

use super::bytes::{Bytes, NOWHERE};

/// Types of header messages, by HDF5's numbers (File Format Specification 3.0, IV.A.2).
const DATASPACE: u8 = 0x01;
const LINK_INFO: u8 = 0x02;
const DATATYPE: u8 = 0x03;
const FILL_VALUE: u8 = 0x05;
const LINK: u8 = 0x06;
const LAYOUT: u8 = 0x08;
const GROUP_INFO: u8 = 0x0a;
const ATTRIBUTE: u8 = 0x0c;

/// Largest number of bytes of an attribute's value: a message counts its bytes in sixteen bits. 5 535 of the 65 535 are left for
/// its name, type and shape.
pub(super) const MOST_TEXT: usize = 60_000;

/// Type of the elements of a dataset or attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Text in UTF-8, with its number of bytes.
    Text(u32),
    I32,
    F32,
    F64,
    /// A sequence, of any length, of references to objects: held in the global heap.
    References,
}

impl Kind {
    /// Size of one element in bytes.
    pub fn size(self) -> u64 {
        match self {
            Self::Text(bytes) => u64::from(bytes),
            Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
            Self::References => 16,
        }
    }

    fn encoded(self) -> Vec<u8> {
        // A class with the version of its encoding, 24 bits of its own, and the size of an element.
        let begin =
            |class: u8, bits: [u8; 3]| Bytes::default().u8(0x10 | class).raw(&bits).u32(self.size() as u32);
        match self {
            // Ended by a zero where there is room, as netCDF has it, in UTF-8.
            Self::Text(_) => begin(3, [0x10, 0, 0]).0,
            // Signed, at bit 0, all 32 bits of it.
            Self::I32 => begin(0, [0x08, 0, 0]).u16(0).u16(32).0,
            // Place of the sign; of bits from 0: exponent's place and size, mantissa's place and size, bias.
            Self::F32 => begin(1, [0x20, 31, 0]).u16(0).u16(32).raw(&[23, 8, 0, 23]).u32(127).0,
            Self::F64 => begin(1, [0x20, 63, 0]).u16(0).u16(64).raw(&[52, 11, 0, 52]).u32(1023).0,
            Self::References => begin(9, [0, 0, 0]).u8(0x17).raw(&[0; 3]).u32(8).0,
        }
    }
}

/// Sizes along each axis; none of a single value.
fn dataspace(shape: &[u64]) -> Vec<u8> {
    let simple = u8::from(!shape.is_empty());
    let begin = Bytes::default().u8(2).u8(shape.len() as u8).u8(0).u8(simple);
    shape.iter().fold(begin, |bytes, size| bytes.u64(*size)).0
}

/// An object's header: messages, one by one, and at last a checksum.
#[derive(Clone, Debug, Default)]
pub(super) struct Header(Bytes);

impl Header {
    fn message(self, kind: u8, body: &[u8]) -> Self {
        Self(self.0.u8(kind).u16(body.len() as u16).u8(0).raw(body))
    }

    /// Makes the object a group of `links` objects, which keeps the order in which its links were made.
    pub fn group(self, links: u64) -> Self {
        let info = Bytes::default().u8(0).u8(1).u64(links).u64(NOWHERE).u64(NOWHERE);
        self.message(LINK_INFO, &info.0).message(GROUP_INFO, &[0, 0])
    }

    /// Adds a link to the group: a name for the object at an address.
    pub fn link(self, name: &str, order: u64, address: u64) -> Self {
        // The order is said; the name's length takes two bytes.
        let body = Bytes::default().u8(1).u8(0x05).u64(order).u16(name.len() as u16).raw(name.as_bytes());
        self.message(LINK, &body.u64(address).0)
    }

    /// Makes the object a dataset with contiguous storage: its values lie one after another, from byte `address` of the file on.
    pub fn dataset(self, kind: Kind, shape: &[u64], address: u64) -> Self {
        let size = shape.iter().product::<u64>() * kind.size();
        let layout = Bytes::default().u8(3).u8(1).u64(address).u64(size);
        // Space is taken when something is written; a fill value is written if there is one, and there is none.
        self.message(DATASPACE, &dataspace(shape))
            .message(DATATYPE, &kind.encoded())
            .message(FILL_VALUE, &[3, 0x0a])
            .message(LAYOUT, &layout.0)
    }

    /// Adds an attribute; `value` has the bytes of its elements.
    pub fn attribute(self, name: &str, kind: Kind, shape: &[u64], value: &[u8]) -> Self {
        let (datatype, space) = (kind.encoded(), dataspace(shape));
        let body = Bytes::default()
            .u8(3)
            .u8(0)
            .u16(name.len() as u16 + 1)
            .u16(datatype.len() as u16)
            .u16(space.len() as u16)
            .u8(0)
            .raw(name.as_bytes())
            .u8(0)
            .raw(&datatype)
            .raw(&space)
            .raw(value);
        self.message(ATTRIBUTE, &body.0)
    }

    /// Adds an attribute of text. An empty text becomes one zero byte, since HDF5 has no text without bytes.
    pub fn text(self, name: &str, text: &str) -> Self {
        let text = if text.is_empty() { "\0" } else { text };
        self.attribute(name, Kind::Text(text.len() as u32), &[], text.as_bytes())
    }

    /// The whole header, version 2, as bytes of the file.
    pub fn encoded(self) -> Vec<u8> {
        let messages = self.0.0;
        Bytes::default().raw(b"OHDR").u8(2).u8(0x02).u32(messages.len() as u32).raw(&messages).checked()
    }
}
