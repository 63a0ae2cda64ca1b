//! Boxes as Gaussians, as operations.
//!
//! If all lengths of a pair are zero, divergences jump to zero, and similarities jump to the value for identical boxes.
use crate::gaussian::{
    bhattacharyya, jeffreys, kfiou, kullback_leibler, probiou, solid, wasserstein,
    wasserstein_squared,
};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{
    Bhattacharyya, Jeffreys, Kfiou, KullbackLeibler, Probiou, SquaredWasserstein, Wasserstein,
};
use crate::{Obb2, Obb3};

table! {
    /// The [Wasserstein distance](crate::gaussian::wasserstein) of {} as Gaussians whose standard deviations
    /// are half the sizes: a length.
    Wasserstein: (a, b) -> S { wasserstein(a, b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "wasserstein_obb2": Obb2, Obb2;
        "wasserstein_obb3": Obb3, Obb3 { solid::wasserstein(a, b) };
    }
    /// The [squared Wasserstein distance](crate::gaussian::wasserstein_squared) of {} as Gaussians whose
    /// standard deviations are half the sizes: the square of a length.
    SquaredWasserstein: (a, b) -> S { wasserstein_squared(a, b) }
    [rigid(2), symmetric] (jumps Never) derivative Reverse {
        "wasserstein_squared_obb2": Obb2, Obb2;
        "wasserstein_squared_obb3": Obb3, Obb3 { solid::wasserstein_squared(a, b) };
    }
    /// The [Kullback-Leibler divergence](crate::gaussian::kullback_leibler) of {} as Gaussians whose standard
    /// deviations are half the sizes, from the first one to the second one, whose covariance is inverted.
    KullbackLeibler: (a, b) -> S { kullback_leibler(a, b) } [similar] (jumps FromZero) derivative Reverse {
        "kullback_leibler_obb2": Obb2, Obb2;
        "kullback_leibler_obb3": Obb3, Obb3 { solid::kullback_leibler(a, b) };
    }
    /// The [Jeffreys divergence](crate::gaussian::jeffreys) of {} as Gaussians whose standard deviations are half
    /// the sizes: the sum of the Kullback-Leibler divergences both ways.
    Jeffreys: (a, b) -> S { jeffreys(a, b) } [similar, symmetric] (jumps FromZero) derivative Reverse {
        "jeffreys_obb2": Obb2, Obb2;
        "jeffreys_obb3": Obb3, Obb3 { solid::jeffreys(a, b) };
    }
    /// The [Bhattacharyya distance](crate::gaussian::bhattacharyya) of {} as Gaussians whose standard deviations
    /// are half the sizes.
    Bhattacharyya: (a, b) -> S { bhattacharyya(a, b) } [similar, symmetric] (jumps FromZero) derivative Reverse {
        "bhattacharyya_obb2": Obb2, Obb2;
        "bhattacharyya_obb3": Obb3, Obb3 { solid::bhattacharyya(a, b) };
    }
    /// The [probabilistic IoU](crate::gaussian::probiou) of {} as Gaussians of the variance of uniform boxes,
    /// size²/12: 0 to 1.
    Probiou: (a, b) -> S { probiou(a, b) } [similar, symmetric] (jumps Anywhere) derivative Reverse {
        "probiou_obb2": Obb2, Obb2;
        "probiou_obb3": Obb3, Obb3 { solid::probiou(a, b) };
    }
    /// The [IoU by a Kalman filter](crate::gaussian::kfiou) of {} as Gaussians whose standard deviations are half
    /// the sizes. It is blind to centres and at most 1/3, in space 1/(2^2.5 - 1).
    Kfiou: (a, b) -> S { kfiou(a, b) } [similar, symmetric] (jumps Anywhere) derivative Reverse {
        "kfiou_obb2": Obb2, Obb2;
        "kfiou_obb3": Obb3, Obb3 { solid::kfiou(a, b) };
    }
}
