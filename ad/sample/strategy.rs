//! Strategies for [`proptest`]: shapes as the harness draws them, for properties of your own.
//! Needs the feature `proptest`.
//!
//! The harness's own code ([`ad::sample`](crate::ad::sample)) draws shapes, lists hard cases and makes a failing
//! shape simpler; a failing input prints as code.
//!
//! ```
//! use geograd::ad::sample::strategy::{any, thin, touching};
//! use geograd::{Obb2, Vec2};
//! use proptest::prelude::*;
//!
//! proptest! {
//!     # #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]
//!     // #[test]
//!     fn ratios_stay_in_bounds((a, b) in any::<(Obb2<f64>, Obb2<f64>)>()) {
//!         prop_assert!((0.0..=1.0).contains(&a.iou(b)));
//!     }
//!     // #[test]
//!     fn touching_boxes_share_hardly_anything((a, b) in touching::<(Obb2<f64>, Obb2<f64>)>()) {
//!         prop_assert!(a.iou(b) < 1e-9);
//!     }
//!     // #[test]
//!     fn the_same_in_single_precision(a in thin::<Obb2<f64>>().prop_map(|a| a.cast::<f32>())) {
//!         prop_assert_eq!(a.iou(a), 1.0);
//!     }
//!     // #[test]
//!     fn rings((ring, at) in any::<(Vec<Vec2<f64>>, Vec2<f64>)>()) {
//!         let around = ring.iter().all(|p| (*p - at).length() >= 0.0);
//!         prop_assert!(around);
//!     }
//! }
//! # use geograd::Pack;
//! # fn main() {
//! #     ratios_stay_in_bounds();
//! #     touching_boxes_share_hardly_anything();
//! #     the_same_in_single_precision();
//! #     rings();
//! # }
//! ```
use crate::ad::sample::{Draw, Family, Sample, simpler};
use proptest::prelude::Rng;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use std::fmt::{self, Debug};
use std::marker::PhantomData;

/// A strategy for shapes, pairs of shapes and rings of one [`Family`].
pub struct Shapes<X> {
    family: Family,
    shape: PhantomData<fn() -> X>,
}

/// Returns the strategy for the shapes of a family.
pub fn of<X: Sample>(family: Family) -> Shapes<X> {
    Shapes {
        family,
        shape: PhantomData,
    }
}

/// One function per family.
macro_rules! families {
    ($($(#[$doc:meta])* $name:ident = $family:ident;)*) => { $(
        $(#[$doc])*
        pub fn $name<X: Sample>() -> Shapes<X> {
            of(Family::$family)
        }
    )* };
}
families! {
    /// The mixture that the harness itself draws.
    any = Any;
    /// The cases at which geometry fails: ties, zero sizes, shapes inside each other.
    hard = Hard;
    /// Shapes of about unit size near the origin.
    ordinary = Ordinary;
    /// Much longer than wide.
    thin = Thin;
    /// From 10⁻¹² to 10⁻⁴ in size.
    tiny = Tiny;
    /// From 10⁴ to 10¹² in size.
    huge = Huge;
    /// As far from the origin as 10² to 10⁶ of their own size.
    far = Far;
    /// Pairs in which the second shape touches the first.
    touching = Touching;
}

impl<X> Clone for Shapes<X> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<X> Copy for Shapes<X> {}
impl<X> Debug for Shapes<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Shapes").field(&self.family).finish()
    }
}

impl<X: Sample> Strategy for Shapes<X> {
    type Tree = Simpler<X>;
    type Value = X;
    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let drawn: X = self.family.draw(&mut Draw::new(runner.rng().next_u64()));
        Ok(Simpler {
            fails: drawn.clone(),
            now: drawn,
            next: 0,
            done: false,
        })
    }
}

/// A drawn shape, and simpler ones while those still fail.
#[derive(Clone, Debug)]
pub struct Simpler<X> {
    /// The simplest one that failed.
    fails: X,
    now: X,
    /// The number of the next simpler one to try.
    next: usize,
    /// `true` if all have been tried.
    done: bool,
}

impl<X: Sample> Simpler<X> {
    fn advance(&mut self) -> bool {
        let next = (0..)
            .zip(simpler(&self.fails))
            .skip(self.next)
            .find(|(_, x)| x.inside());
        match next {
            Some((i, x)) => (self.now, self.next) = (x, i + 1),
            None => self.now = self.fails.clone(),
        }
        self.next > 0 && self.now.scalars() != self.fails.scalars()
    }
}

impl<X: Sample> ValueTree for Simpler<X> {
    type Value = X;
    fn current(&self) -> X {
        self.now.clone()
    }
    fn simplify(&mut self) -> bool {
        self.fails = self.now.clone();
        self.next = 0;
        !self.done && self.advance()
    }
    fn complicate(&mut self) -> bool {
        // Back at the input that fails, the runner requests a simpler one once more, and goes on to the next part of a
        // tuple if there is none. Returning `false` would end the search.
        if self.done {
            return false;
        }
        self.done = !self.advance();
        true
    }
}
