//! Outcomes of comparisons.
use std::fmt::Debug;
use std::ops::{BitAnd, BitOr, Not};

/// The outcome of a comparison: a `bool`, one `bool` per SIMD lane, or a symbol of a recording.
///
/// [`any`](Mask::any) and [`all`](Mask::all) are **hints** for leaving early: the code that follows must give the value
/// that it gives without them, that is if `any` were `true` and `all` `false`. A symbol returns these unless its truth
/// is known; [recording](crate::ad::program) refuses a function whose value depends on the result. Choose with
/// [`Scalar::select`](crate::Scalar::select). Code that needs control flow requires `S: Scalar<Mask = bool>`.
pub trait Mask:
    Copy + Debug + Send + Sync + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Returns `true` if any lane is true or that is unknown. A hint: `false` allows to skip work that only true lanes
    /// need.
    fn any(self) -> bool;
    /// Returns `true` if every lane is true, `false` if that is unknown. A hint: `true` allows to skip work that only
    /// false lanes need.
    fn all(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}
