//! Distances of boxes as Gaussians, as operations.
use crate::Obb2;
use crate::gaussian::{wasserstein, wasserstein_squared};
use crate::operation;

operation! {
    /// [`wasserstein`] of two rotated boxes.
    pub WassersteinObb2 = "wasserstein_obb2": (a: Obb2<S>, b: Obb2<S>) -> S { wasserstein(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays, Rotation Stays]
    jumps Never
    slopes Reverse

    /// [`wasserstein_squared`] of two rotated boxes.
    pub WassersteinSquaredObb2 = "wasserstein_squared_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { wasserstein_squared(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2), Exchange Stays, Rotation Stays]
    jumps Never
    slopes Reverse
}
