use super::panel::Row;

/// Numbers that look random (SplitMix64; Steele, Lea and Flood, *OOPSLA* 2014), the same whenever the seed is.
#[derive(Clone, Debug)]
pub(super) struct Random(pub(super) u64);

impl Random {
    /// Uniform between -1 and 1.
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * (2.0 / (1u64 << 53) as f64) - 1.0
    }

    /// A row of them.
    pub(super) fn row(&mut self) -> Row {
        std::array::from_fn(|_| self.next())
    }
}
