//! Boxes as Gaussians, as operations.
//!
//! Motions are those of the plane: boxes that turn about all axes promise nothing about turns. Where all
//! lengths of a pair are zero, divergences jump to zero and similarities to those of identical boxes.
use crate::Obb2;
use crate::gaussian::{
    bhattacharyya, jeffreys, kfiou, kullback_leibler, probiou, solid, wasserstein,
    wasserstein_squared,
};
use crate::operation;
use crate::shape::Obb3;

operation! {
    /// [`wasserstein`] of two rotated boxes.
    pub WassersteinObb2 = "wasserstein_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { wasserstein(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays, Rotation Stays]
    jumps Never
    slopes Reverse

    /// [`wasserstein_squared`] of two rotated boxes.
    pub WassersteinSquaredObb2 = "wasserstein_squared_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { wasserstein_squared(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2), Exchange Stays, Rotation Stays]
    jumps Never
    slopes Reverse

    /// [`kullback_leibler`] of two rotated boxes.
    pub KullbackLeiblerObb2 = "kullback_leibler_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { kullback_leibler(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Rotation Stays]
    jumps FromZero
    slopes Reverse

    /// [`jeffreys`] of two rotated boxes.
    pub JeffreysObb2 = "jeffreys_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { jeffreys(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps FromZero
    slopes Reverse

    /// [`bhattacharyya`] of two rotated boxes.
    pub BhattacharyyaObb2 = "bhattacharyya_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { bhattacharyya(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps FromZero
    slopes Reverse

    /// [`probiou`] of two rotated boxes.
    pub ProbiouObb2 = "probiou_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { probiou(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps Anywhere
    slopes Reverse

    /// [`kfiou`] of two rotated boxes.
    pub KfiouObb2 = "kfiou_obb2":
        (a: Obb2<S>, b: Obb2<S>) -> S { kfiou(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays]
    jumps Anywhere
    slopes Reverse

    /// [`solid::wasserstein`] of two boxes of any orientation.
    pub WassersteinObb3 = "wasserstein_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::wasserstein(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// [`solid::wasserstein_squared`] of two boxes of any orientation.
    pub WassersteinSquaredObb3 = "wasserstein_squared_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::wasserstein_squared(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(2), Exchange Stays]
    jumps Never
    slopes Reverse

    /// [`solid::kullback_leibler`] of two boxes of any orientation.
    pub KullbackLeiblerObb3 = "kullback_leibler_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::kullback_leibler(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    jumps FromZero
    slopes Reverse

    /// [`solid::jeffreys`] of two boxes of any orientation.
    pub JeffreysObb3 = "jeffreys_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::jeffreys(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps FromZero
    slopes Reverse

    /// [`solid::bhattacharyya`] of two boxes of any orientation.
    pub BhattacharyyaObb3 = "bhattacharyya_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::bhattacharyya(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps FromZero
    slopes Reverse

    /// [`solid::probiou`] of two boxes of any orientation.
    pub ProbiouObb3 = "probiou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::probiou(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Reverse

    /// [`solid::kfiou`] of two boxes of any orientation.
    pub KfiouObb3 = "kfiou_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { solid::kfiou(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    jumps Anywhere
    slopes Reverse
}
