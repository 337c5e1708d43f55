//! The global heap, in one collection: what attributes of no fixed size point to.

use super::bytes::{Bytes, aligned};

/// Fewest bytes of a collection: HDF5 refuses a smaller one.
const LEAST: u64 = 4096;

/// Bytes before an object, and before the first. Both are fixed by HDF5's format of version 1.
const HEAD: u64 = 16;

/// References to objects, each a sequence of one. Its size does not depend on the addresses.
#[derive(Clone, Debug, Default)]
pub(super) struct Heap {
    objects: Vec<u64>,
}

impl Heap {
    /// Adds a reference to an object at an address. Returns the bytes by which an attribute refers to it, if the heap
    /// is at `at`.
    pub fn keep(&mut self, address: u64, at: u64) -> Vec<u8> {
        self.objects.push(address);
        Bytes::default().u32(1).u64(at).u32(self.objects.len() as u32).0
    }

    /// Size of the collection in bytes.
    pub fn size(&self) -> u64 {
        aligned(HEAD + (HEAD + 8) * self.objects.len() as u64).max(LEAST)
    }

    /// The collection as bytes of the file.
    pub fn encoded(&self) -> Vec<u8> {
        let mut bytes = Bytes::default().raw(b"GCOL").u32(1).u64(self.size());
        for (i, address) in self.objects.iter().enumerate() {
            bytes = bytes.u16(i as u16 + 1).u16(1).u32(0).u64(8).u64(*address);
        }
        let left = self.size() - bytes.0.len() as u64;
        if left >= HEAD {
            // Object 0 is the room that is left.
            bytes = bytes.u64(0).u64(left);
        }
        bytes.0.resize(self.size() as usize, 0);
        bytes.0
    }
}
