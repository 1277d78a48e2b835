//! A small deterministic random number generator.

/// `SplitMix64`.
pub(crate) struct Random(u64);

impl Random {
    /// The generator of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 random bits.
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// An integer of a small inclusive range.
    pub(crate) fn integer(&mut self, low: i64, high: i64) -> i64 {
        low + (self.next() % (high - low + 1) as u64) as i64
    }

    /// A number between -1 and 1.
    pub(crate) fn signed(&mut self) -> f64 {
        (self.next() as i64 >> 11) as f64 / (1_u64 << 52) as f64
    }

    /// A half-space with small integer components, as numbers and as integers.
    pub(crate) fn small_plane(&mut self) -> [i64; 4] {
        [self.integer(-3, 3), self.integer(-3, 3), self.integer(-3, 3), self.integer(-2, 6)]
    }
}
