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
    /// The [Wasserstein distance](crate::gaussian::wasserstein) of {} as Gaussians.
    Wasserstein: (a, b) -> S { wasserstein(a, b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "wasserstein_obb2": Obb2, Obb2;
        "wasserstein_obb3": Obb3, Obb3 { solid::wasserstein(a, b) };
    }
    /// The [squared Wasserstein distance](crate::gaussian::wasserstein_squared) of {} as Gaussians.
    SquaredWasserstein: (a, b) -> S { wasserstein_squared(a, b) }
    [rigid(2), symmetric] (jumps Never) derivative Reverse {
        "wasserstein_squared_obb2": Obb2, Obb2;
        "wasserstein_squared_obb3": Obb3, Obb3 { solid::wasserstein_squared(a, b) };
    }
    /// The [Kullback-Leibler divergence](crate::gaussian::kullback_leibler) of {} as Gaussians.
    KullbackLeibler: (a, b) -> S { kullback_leibler(a, b) } [similar] (jumps FromZero) derivative Reverse {
        "kullback_leibler_obb2": Obb2, Obb2;
        "kullback_leibler_obb3": Obb3, Obb3 { solid::kullback_leibler(a, b) };
    }
    /// The [Jeffreys divergence](crate::gaussian::jeffreys) of {} as Gaussians.
    Jeffreys: (a, b) -> S { jeffreys(a, b) } [similar, symmetric] (jumps FromZero) derivative Reverse {
        "jeffreys_obb2": Obb2, Obb2;
        "jeffreys_obb3": Obb3, Obb3 { solid::jeffreys(a, b) };
    }
    /// The [Bhattacharyya distance](crate::gaussian::bhattacharyya) of {} as Gaussians.
    Bhattacharyya: (a, b) -> S { bhattacharyya(a, b) } [similar, symmetric] (jumps FromZero) derivative Reverse {
        "bhattacharyya_obb2": Obb2, Obb2;
        "bhattacharyya_obb3": Obb3, Obb3 { solid::bhattacharyya(a, b) };
    }
    /// The [probabilistic IoU](crate::gaussian::probiou) of {} as Gaussians, 0 to 1.
    Probiou: (a, b) -> S { probiou(a, b) } [similar, symmetric] (jumps Anywhere) derivative Reverse {
        "probiou_obb2": Obb2, Obb2;
        "probiou_obb3": Obb3, Obb3 { solid::probiou(a, b) };
    }
    /// The [IoU by a Kalman filter](crate::gaussian::kfiou) of {} as Gaussians.
    Kfiou: (a, b) -> S { kfiou(a, b) } [similar, symmetric] (jumps Anywhere) derivative Reverse {
        "kfiou_obb2": Obb2, Obb2;
        "kfiou_obb3": Obb3, Obb3 { solid::kfiou(a, b) };
    }
}
