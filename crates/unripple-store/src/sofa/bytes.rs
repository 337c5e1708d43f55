//! Bytes as HDF5 has them: little-endian, and checked by Jenkins' lookup3.

/// The address that HDF5 uses for "nowhere": all bits set.
pub(super) const NOWHERE: u64 = u64::MAX;

/// Bytes in the making.
#[derive(Clone, Debug, Default)]
pub(super) struct Bytes(pub Vec<u8>);

impl Bytes {
    /// Appends bytes as they are.
    pub fn raw(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    /// Appends one byte.
    pub fn u8(self, value: u8) -> Self {
        self.raw(&[value])
    }

    /// Appends a number of two bytes, the least significant first.
    pub fn u16(self, value: u16) -> Self {
        self.raw(&value.to_le_bytes())
    }

    /// Appends a number of four bytes, the least significant first.
    pub fn u32(self, value: u32) -> Self {
        self.raw(&value.to_le_bytes())
    }

    /// Appends a number of eight bytes, the least significant first.
    pub fn u64(self, value: u64) -> Self {
        self.raw(&value.to_le_bytes())
    }

    /// Appends the 4-byte checksum of all bytes before it, and returns all bytes.
    pub fn checked(self) -> Vec<u8> {
        let check = checksum(&self.0);
        self.u32(check).0
    }
}

/// Up to the next multiple of eight.
pub(super) fn aligned(at: u64) -> u64 {
    at.next_multiple_of(8)
}

/// Bob Jenkins' `hashlittle` of lookup3 (2006), from 0: what HDF5 checks its metadata by.
pub(super) fn checksum(bytes: &[u8]) -> u32 {
    let start = 0xdead_beef_u32.wrapping_add(bytes.len() as u32);
    let mut state = [start; 3];
    // The last twelve bytes, or fewer, are stirred otherwise.
    let last = bytes.len().saturating_sub(1) / 12 * 12;
    let (whole, rest) = bytes.split_at(last);
    for words in whole.chunks_exact(12) {
        add(&mut state, words);
        mix(&mut state);
    }
    if rest.is_empty() {
        return state[2];
    }
    add(&mut state, rest);
    finish(&mut state);
    state[2]
}

/// Adds up to twelve bytes as three words.
fn add(state: &mut [u32; 3], bytes: &[u8]) {
    for (i, byte) in bytes.iter().enumerate() {
        let word = &mut state[i / 4];
        *word = word.wrapping_add(u32::from(*byte) << (8 * (i % 4)));
    }
}

fn mix(state: &mut [u32; 3]) {
    // Of words a, b, c in turn: x -= y, x ^= rot(y), y += z.
    for (round, turn) in [4, 6, 8, 16, 19, 4].into_iter().enumerate() {
        let [x, y, z] = [round % 3, (round + 2) % 3, (round + 1) % 3];
        state[x] = state[x].wrapping_sub(state[y]) ^ state[y].rotate_left(turn);
        state[y] = state[y].wrapping_add(state[z]);
    }
}

fn finish(state: &mut [u32; 3]) {
    // Of words c, a, b in turn: x ^= y, x -= rot(y).
    for (round, turn) in [14, 11, 25, 16, 4, 14, 24].into_iter().enumerate() {
        let [x, y] = [(round + 2) % 3, (round + 1) % 3];
        state[x] = (state[x] ^ state[y]).wrapping_sub(state[y].rotate_left(turn));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_its_authors_examples() {
        // From the driver in lookup3.c.
        assert_eq!(checksum(b""), 0xdead_beef);
        assert_eq!(checksum(b"Four score and seven years ago"), 0x1777_0551);
    }
}
