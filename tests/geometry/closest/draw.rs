//! Numbers at random, the same ones every time.

pub struct Dice(pub u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 20
    }
    pub fn below(&mut self, n: usize) -> usize {
        self.next() as usize % n
    }
    /// A whole number of at most some magnitude.
    pub fn whole(&mut self, most: usize) -> f64 {
        self.below(2 * most + 1) as f64 - most as f64
    }
    /// A length of 0 to 3, seldom 0.
    pub fn length(&mut self) -> f64 {
        [0.0, 1.0, 1.0, 2.0, 2.0, 3.0][self.below(6)]
    }
}
