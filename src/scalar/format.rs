//! The two formats of numbers, `f32` and `f64`, and their limits.
/// A format of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Numbers of 32 bits.
    F32,
    /// Numbers of 64 bits.
    F64,
}

impl Format {
    /// Returns the nearest number of the format; infinite beyond the largest one.
    #[must_use]
    pub(crate) fn round(self, x: f64) -> f64 {
        match self {
            Format::F32 => f64::from(x as f32),
            Format::F64 => x,
        }
    }
    /// Returns the distance from 1 to the next larger number.
    #[must_use]
    #[inline(always)]
    pub const fn epsilon(self) -> f64 {
        match self {
            Format::F32 => f32::EPSILON as f64,
            Format::F64 => f64::EPSILON,
        }
    }
    /// Returns the largest finite number.
    #[must_use]
    #[inline(always)]
    pub const fn largest(self) -> f64 {
        match self {
            Format::F32 => f32::MAX as f64,
            Format::F64 => f64::MAX,
        }
    }
    /// Returns the largest finite number to a power between −1 and 1.
    #[inline]
    pub(crate) fn largest_to(self, power: f64) -> f64 {
        super::to_power(self.largest(), self.epsilon(), power)
    }
    /// Returns the area at or below which a shape counts as empty, where a box has a side of about one: its reciprocal,
    /// sixty-four times over, would not be finite, and derivatives could not cancel.
    #[must_use]
    #[inline(always)]
    pub const fn empty(self) -> f64 {
        64.0 / self.largest()
    }
    /// Returns the sine below which two directions count as exactly parallel, such as those of headings that
    /// differ by π/2 as it is rounded. (With 24 bits a smaller one still matters to a long thin
    /// box; its reciprocal's powers must not overflow.)
    #[must_use]
    #[inline(always)]
    pub const fn parallel(self) -> f64 {
        match self {
            Format::F32 => 2e-10,
            Format::F64 => 4e-16,
        }
    }
    /// Returns `true` if products carry a low part through cancellation: for 24-bit significands, with which a rotated
    /// long thin box would otherwise lose its width.
    #[must_use]
    #[inline(always)]
    pub const fn is_compensated(self) -> bool {
        matches!(self, Format::F32)
    }
}
