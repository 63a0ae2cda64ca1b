//! Independent comparisons: each reads the [evidence](crate::ad::check::evidence) about one input and returns its
//! findings. [`judge`](crate::ad::check::judge) refuses for their faults, or explains them by the findings of others.
//!
//! | file | comparison |
//! | --- | --- |
//! | `values` | the value with that of other paths |
//! | `proof` | a distance in space with the plane and the points that prove it |
//! | `exact` | the adjoint with duals, ours and num-dual's, batches and further witnesses |
//! | `wide` | single precision with double |
//! | `projection` | the adjoint with duals along a direction |
//! | `linear` | the adjoint of a sum with the sum of the adjoints |
//! | `steps` | adjoint and duals with differences, and with both sides at a kink |
//! | `invariance` | the value and its derivatives with those of the moved input |
//! | `curvature` | second derivatives with one another |
pub(crate) mod along;
pub(crate) mod assessment;
pub(crate) mod curvature;
pub(crate) mod derivative_test;
pub(crate) mod exact;
pub(crate) mod invariance;
pub(crate) mod linear;
pub(crate) mod nearby;
pub(crate) mod projection;
pub(crate) mod proof;
pub(crate) mod steps;
pub(crate) mod values;
pub(crate) mod wide;
